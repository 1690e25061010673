//! The targets without coverage to guide them, on any toolchain: random bytes, or the corpus with
//! random changes. `cargo run --release --example blind -- TARGET SECONDS SEED`, or a file in place
//! of SECONDS.

use std::panic::catch_unwind;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use std::{env, fs, process};

use oorandom::Rand64;

/// What tends to be read wrongly.
const WORDS: [&str; 34] = [
    "-1",
    "0",
    "-0",
    "1e999",
    "1e-320",
    "1e300",
    "nan",
    "inf",
    "-inf",
    "18446744073709551615",
    "99999999999",
    "50001",
    "[",
    "]",
    "{",
    "}",
    ",",
    "\"",
    "\n",
    " ",
    "null",
    "true",
    "[[bodies]]",
    "= [",
    "\n=== b\n",
    "\n=== H\n",
    "$",
    "\\operatorname{",
    "\\hat",
    "<script>",
    "../",
    "\u{1b}[2J",
    "[[section]]",
    "[axes]",
];

fn main() {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [target, limit, seed] = &arguments[..] else {
        eprintln!("TARGET SECONDS|FILE SEED");
        process::exit(2);
    };
    let Ok(seconds) = limit.parse().map(Duration::from_secs) else {
        return run(target, &fs::read(limit).expect("a file"));
    };
    let corpus: Vec<_> = seeds(target).map(|file| fs::read(file).expect("a file")).collect();
    let is_structured = ["solvers", "judge", "diagnose", "simulator"].contains(&target.as_str());
    let mut random = Rand64::new(seed.parse().expect("a seed"));
    let (begin, mut count, mut slowest) = (Instant::now(), 0, Duration::ZERO);
    while begin.elapsed() < seconds {
        let bytes = match is_structured {
            true => (0..below(&mut random, 280) + 20).map(|_| byte(&mut random)).collect(),
            false => changed(&corpus, &mut random),
        };
        let before = Instant::now();
        if catch_unwind(|| run(target, &bytes)).is_err() {
            let path = format!("crash-{target}-{seed}-{count}");
            fs::write(&path, &bytes).expect("a place to write to");
            println!("{path}");
            process::exit(1);
        }
        slowest = slowest.max(before.elapsed());
        count += 1;
    }
    println!("{target}: {count} inputs in {seconds:?}, the slowest in {slowest:?}");
}

/// The files of the corpus, and those of the tests of a reader.
fn seeds(target: &str) -> impl Iterator<Item = PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let tests = root.join("../crates/files/tests/problems/exchange");
    let files = |folder: PathBuf| {
        let entries = fs::read_dir(folder).into_iter().flatten();
        entries.map(|entry| entry.expect("an entry").path())
    };
    let ending = match target {
        "fclib" => "hdf5",
        "siconos" => "dat",
        other => other,
    };
    let of_tests = files(tests.join("matlab")).chain(files(tests.join("siconos")));
    let of_tests = of_tests.chain(files(tests));
    let of_tests = of_tests.filter(move |file| file.extension().is_some_and(|own| *own == *ending));
    files(root.join("corpus").join(target)).chain(of_tests)
}

fn run(target: &str, bytes: &[u8]) {
    match target {
        "scene" => std::str::from_utf8(bytes).map_or((), lcplab_fuzz::read_scene),
        "markup" => std::str::from_utf8(bytes).map_or((), lcplab_fuzz::read_markup),
        "report" => std::str::from_utf8(bytes).map_or((), lcplab_fuzz::read_report),
        "results" => std::str::from_utf8(bytes).map_or((), lcplab_fuzz::read_results),
        "grid" => std::str::from_utf8(bytes).map_or((), lcplab_fuzz::read_grid),
        "solvers" => lcplab_fuzz::solvers(bytes).unwrap_or_default(),
        "judge" => lcplab_fuzz::judge(bytes).unwrap_or_default(),
        "diagnose" => lcplab_fuzz::diagnose(bytes).unwrap_or_default(),
        "simulator" => lcplab_fuzz::simulator(bytes).unwrap_or_default(),
        format => lcplab_fuzz::read(&format.replace('_', "-"), bytes),
    }
}

fn below(random: &mut Rand64, end: usize) -> usize {
    random.rand_range(0..end as u64) as usize
}

fn byte(random: &mut Rand64) -> u8 {
    below(random, 256) as u8
}

/// A file of the corpus with up to five changes.
fn changed(corpus: &[Vec<u8>], random: &mut Rand64) -> Vec<u8> {
    let mut bytes = corpus[below(random, corpus.len())].clone();
    for _ in 0..=below(random, 5) {
        let at = below(random, bytes.len() + 1);
        let end = (at + below(random, 20)).min(bytes.len());
        match below(random, 6) {
            0 => bytes.iter_mut().skip(at).take(1).for_each(|b| *b ^= 1 << (at % 8)),
            1 => drop(bytes.drain(at..end)),
            2 => bytes.extend_from_within(at..end),
            3 => {
                let other = &corpus[below(random, corpus.len())];
                let from = below(random, other.len());
                bytes.splice(at..at, other[from..].iter().copied().take(60));
            }
            _ => {
                let is_part = |b: &&u8| b.is_ascii_alphanumeric() || b".-+".contains(b);
                let word = bytes[at..].iter().take_while(is_part).count();
                let new = WORDS[below(random, WORDS.len())].bytes();
                bytes.splice(at..at + word, new);
            }
        }
    }
    bytes
}

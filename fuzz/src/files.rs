//! Bytes as the files of a problem in another program's format.

use std::fs;
use std::path::PathBuf;
use std::sync::OnceLock;

use lcplab::files::{Format, Input, encode};
use lcplab::lcp::file::Problem;
use lcplab::memory::Memory;

/// What stands between two files in one input.
const NEXT: &[u8] = b"\n=== ";
/// What a reader may take.
const MOST: Memory = Memory::bytes(100_000_000);

/// Reads the bytes in a format: the main file, then after a line `=== part` each that goes with it.
/// What was read must survive our own format.
pub fn read(format: &str, bytes: &[u8]) {
    let format = Format::by_name(format).expect("a known format");
    let main = save(format, bytes);
    match (format.read)(&Input::new(&main, MOST)) {
        Ok(problem) => assert_survives(&problem),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// A folder for the life of the process, in memory where there is such a place.
pub fn folder() -> &'static PathBuf {
    static FOLDER: OnceLock<PathBuf> = OnceLock::new();
    FOLDER.get_or_init(|| {
        let shared = PathBuf::from("/dev/shm");
        let base = if shared.is_dir() { shared } else { std::env::temp_dir() };
        tempfile::tempdir_in(base).expect("a folder").keep()
    })
}

/// Writes the files and removes those of the input before.
fn save(format: &Format, bytes: &[u8]) -> PathBuf {
    for part in format.beside {
        let _ = fs::remove_file(path(format, part)); // most of the time there is none
    }
    let main = match format.in_folder {
        Some(ending) if ending.starts_with('_') => folder().join(format!("p{ending}")),
        _ => folder().join(format!("p{}", format.endings[0])),
    };
    for (k, file) in split(bytes).into_iter().enumerate() {
        if k == 0 {
            fs::write(&main, file).expect("a place to write to");
        } else if let Some((part, rest)) = named(format, file) {
            fs::write(path(format, part), rest).expect("a place to write to");
        }
    }
    main
}

fn path(format: &Format, part: &str) -> PathBuf {
    let ending = format.endings[0].rsplit('.').next().unwrap_or_default();
    folder().join(format!("p_{part}.{ending}"))
}

/// The part that the first line names, and what follows it.
fn named<'a>(format: &Format, file: &'a [u8]) -> Option<(&'static str, &'a [u8])> {
    let end = file.iter().position(|&byte| byte == b'\n')?;
    let part = format.beside.iter().find(|part| part.as_bytes() == &file[..end])?;
    Some((part, &file[end + 1..]))
}

fn split(mut bytes: &[u8]) -> Vec<&[u8]> {
    let mut files = Vec::new();
    while let Some(at) = bytes.windows(NEXT.len()).position(|window| window == NEXT) {
        files.push(&bytes[..at]);
        bytes = &bytes[at + NEXT.len()..];
    }
    files.push(bytes);
    files
}

/// Bit by bit what it was after it was written as JSON and read again; other formats may refuse it.
fn assert_survives(problem: &Problem) {
    let text = problem.to_json().to_string();
    let back = Problem::parse(&text, "again").expect("what we write we read");
    let (one, other) = (&problem.lcp, &back.lcp);
    let bits = |v: &[f64]| v.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
    for (one, other) in [(one.b(), other.b()), (one.lo(), other.lo()), (one.hi(), other.hi())] {
        assert_eq!(bits(one), bits(other));
    }
    for i in 0..one.len() {
        let row = |k: &lcplab::lcp::Lcp| {
            k.matrix().row(i).iter().map(|(j, a)| (j, a.to_bits())).collect::<Vec<_>>()
        };
        assert_eq!(row(one), row(other), "row {i}");
    }
    for format in lcplab::files::ALL {
        let _ = encode(problem, format); // an error is an answer
    }
}

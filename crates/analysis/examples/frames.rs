//! Solves recorded frames by each method, and prints how many answers the judge accepts.
//!
//! ```sh
//! cargo run --release -p lcplab-analysis --example frames -- frames coupled-box 20
//! cargo run --release -p lcplab-analysis --example frames -- frames own 20 apgd cone-pgs clarabel
//! ```
//!
//! The arguments are a folder, a friction model or `own` for that of each file, the time limit of a
//! solve (s), and the names of methods; by default all of them.

use std::collections::BTreeMap;
use std::env;
use std::error::Error;
use std::fs;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use lcplab_analysis::{friction, methods};
use lcplab_files::{model, read};
use lcplab_judge::Demand;
use lcplab_lcp::Question;
use lcplab_lcp::friction::Model;
use lcplab_solver::{Method, Options, Status, Stop};

/// The outcomes of a method: answers that the judge accepts, and the others by their status.
#[derive(Default)]
struct Tally {
    accepted: usize,
    others: BTreeMap<String, Vec<String>>,
    seconds: f64,
}

fn main() -> Result<(), Box<dyn Error>> {
    let arguments: Vec<String> = env::args().skip(1).collect();
    let [folder, asked, limit, names @ ..] = &arguments[..] else {
        return Err("give a folder, a friction model or own, and a time limit in seconds".into());
    };
    let asked: Option<Model> = if asked == "own" { None } else { Some(asked.parse()?) };
    let limit = Duration::from_secs_f64(limit.parse()?);
    let entries = fs::read_dir(folder)?.map(|entry| entry.map(|entry| entry.path()));
    let mut files: Vec<PathBuf> = entries.collect::<Result<_, _>>()?;
    files.retain(|file| file.extension().is_some_and(|own| own == "npz"));
    files.sort();
    let mut tallies: BTreeMap<&'static str, Tally> = BTreeMap::new();
    for file in &files {
        let name = file.file_stem().map_or(String::new(), |stem| stem.to_string_lossy().into());
        let problem = read(file, None)?;
        let Ok(question) = Question::new(&problem, asked.or_else(|| model(&problem)), &name) else {
            println!("{name} cannot be stated under this model");
            continue;
        };
        let takes = |method: &&Method| {
            let is_asked = names.is_empty() || names.iter().any(|own| own == method.name());
            is_asked && method.takes(question.model())
        };
        for method in methods::with_reference().methods().filter(takes) {
            let tally = tallies.entry(method.name()).or_default();
            let (stop, start) = (Stop::after(limit), Instant::now());
            let (solution, judged) = friction::solve(
                &question,
                method,
                &Options::default(),
                &Demand::default(),
                &mut stop.watch(&mut ()),
            );
            let seconds = start.elapsed().as_secs_f64();
            tally.seconds = tally.seconds.max(seconds);
            if judged.certificate.verdict.is_solution() {
                tally.accepted += 1;
                continue;
            }
            let status = match solution.status {
                Status::Stopped => "time limit".to_string(),
                status => status.to_string(),
            };
            let what = format!("{name} ({:.1e})", judged.certificate.scaled_residual);
            tally.others.entry(status).or_default().push(what);
        }
    }
    println!("{} frames", files.len());
    for (name, tally) in tallies {
        println!("{name}: {} accepted, at most {:.1} s", tally.accepted, tally.seconds);
        for (status, files) in tally.others {
            println!("    {} {status}: {}", files.len(), files.join(", "));
        }
    }
    Ok(())
}

//! lcplab compared with Open Dynamics Engine, Bullet, Siconos, DART, Rapier and clarabel.
//!
//! ```text
//! cargo run --release                            all, as a table on the terminal
//! cargo run --release -- problems                only numerical problems; `scenes`: only scenes
//! cargo run --release -- --json ../peers.json    the same, and the recording behind `peers.md`
//! ```
//!
//! All contenders get the same numbers, take turns in this process and use one thread. An answer is
//! checked before its time counts; a failing run has no time.

mod bullet;
mod clarabel;
mod contender;
mod dart;
mod library;
mod ode;
mod ours;
mod problems;
mod raw;
mod siconos;
mod trial;
mod world;

use std::error::Error;
use std::path::PathBuf;

use lcplab_benches::recording::Recording;
use lcplab_benches::{machine, table};

/// The options of the command line.
struct Asked {
    problems: bool,
    scenes: bool,
    json: Option<PathBuf>,
}

fn main() -> Result<(), Box<dyn Error>> {
    let asked = asked()?;
    let libraries = library::all();
    for library in libraries.iter().filter(|library| library.version.is_none()) {
        println!("skipped: {} is not installed ({})", library.name, library.package);
    }
    let recording = Recording {
        date: machine::today(),
        machine: machine::describe(),
        libraries,
        problems: if asked.problems { problems::run()? } else { Vec::new() },
        scenes: if asked.scenes { world::run()? } else { Vec::new() },
    };
    println!("{}", table::markdown(&recording));
    if let Some(path) = asked.json {
        std::fs::write(path, serde_json::to_string(&recording)? + "\n")?;
    }
    Ok(())
}

fn asked() -> Result<Asked, String> {
    let mut asked = Asked { problems: true, scenes: true, json: None };
    let mut arguments = std::env::args().skip(1);
    while let Some(argument) = arguments.next() {
        match argument.as_str() {
            "problems" => asked.scenes = false,
            "scenes" => asked.problems = false,
            "--json" => asked.json = Some(arguments.next().ok_or("--json needs a file")?.into()),
            other => {
                return Err(format!("{other:?}: only problems, scenes and --json FILE are known"));
            }
        }
    }
    Ok(asked)
}

//! Writes the recorded numbers that pages show:
//!
//! ```text
//! cargo run -p lcplab-benches                              benches/peers.md from the recorded run
//! cargo run --release -p lcplab-benches -- solver-times    reports/solver_times.json, by measuring
//! ```

use std::error::Error;
use std::path::Path;

use lcplab_benches::solver_times;
use lcplab_benches::table::{goals, page, recorded};

fn main() -> Result<(), Box<dyn Error>> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
    let argument = std::env::args().nth(1);
    match argument.as_deref() {
        None => std::fs::write(folder.join("peers.md"), page(&recorded()?, &goals()?))?,
        Some("solver-times") => {
            let record = serde_json::to_string_pretty(&solver_times::measure()?)?;
            std::fs::write(folder.join("../reports/solver_times.json"), record + "\n")?;
        }
        Some(other) => return Err(format!("{other:?}: only solver-times is known").into()),
    }
    Ok(())
}

//! Writes `benches/peers.md` from the recorded run: `cargo run -p lcplab-benches`.

use std::error::Error;

use lcplab_benches::table::{goals, page, recorded};

fn main() -> Result<(), Box<dyn Error>> {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/peers.md");
    std::fs::write(path, page(&recorded()?, &goals()?))?;
    Ok(())
}

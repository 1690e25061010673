//! Pages as readers use them: clicks, keys and print, in headless Chromium.
//!
//! ```text
//! cargo test --test browser
//! ```

mod address;
mod driver;
mod layout;
mod lesson;
mod live;
mod player;
mod plot;
mod print;
mod proof;
mod python;
#[path = "../suite/report/page/sample.rs"]
mod sample;
mod table;
mod theme;
mod wheel;

use std::fs;
use std::process::Command;

use driver::Page;

/// Widths of a desk and of a phone (px).
const WIDTHS: [u32; 2] = [1280, 390];

/// The page with every kind of block.
fn sample() -> Page {
    Page(sample::page().render().unwrap())
}

/// The page that a command writes into its folder under this name.
fn written(arguments: &[&str], name: &str) -> Page {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    let output = command.args(arguments).arg("--out").arg(folder.path()).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    Page(fs::read_to_string(folder.path().join(name)).unwrap())
}

#[test]
#[should_panic(expected = "this is wrong")]
fn a_complaint_of_the_page_is_heard() {
    Page(
        "<html><head></head><body><script>console.error('this is wrong')</script></body></html>"
            .into(),
    )
    .seen(1280, "return 1");
}

#[test]
#[should_panic(expected = "Content Security Policy")]
fn the_policy_stops_what_is_not_the_pages_own() {
    let Page(html) = sample();
    let stranger = "<img src=\"https://example.org/eye.png\" onerror=\"console.log(1)\"></body>";
    Page(html.replacen("</body>", stranger, 1)).seen(1280, "return 1");
}

//! The live pages: problems that are dragged, methods that are stepped through, by the same solvers compiled to
//! WebAssembly. `live/README.md` says how they are built.

use std::path::Path;

use crate::error::Result;
use crate::file;
use crate::page::Live;

include!(concat!(env!("OUT_DIR"), "/live.rs"));

/// A page.
#[derive(Debug, Clone, Copy)]
pub struct Page {
    /// Its name; the file is called so.
    pub name: &'static str,
    /// What it shows.
    pub about: &'static str,
}

/// All of them.
pub const PAGES: [Page; 5] = [
    Page {
        name: "two_rows",
        about: "two rows: the plane of x, complementary cones, six methods step by step",
    },
    Page {
        name: "stack",
        about: "a stack: who carries what after a row, after a sweep, and in motion",
    },
    Page {
        name: "friction",
        about: "friction: square, polygon and disc, their nearest points, a block's way over the floor",
    },
    Page {
        name: "problem",
        about: "your problem: solve it by any method, step by step and derived; judge and prove any x",
    },
    Page {
        name: "painleve",
        about: "Painlevé's rod: which friction and angle leave one, no or two forces; let it go",
    },
];

impl Page {
    /// The file.
    pub fn text(&self) -> String {
        let own = TEXTS.iter().find(|text| text.0 == self.name);
        let (_, before, module, after) = own.expect("each page has a file");
        [*before, module, after].concat()
    }
}

/// The live pages to which words link, as `[a stack](live/stack.html#solver=pgs)`, to be opened in place.
pub fn linked(text: &str) -> Vec<Live> {
    let links = text.split("](live/").skip(1).map(|after| after.split(')').next().unwrap_or(""));
    let live = |link: &str| {
        let (file, state) = link.split_once('#').unwrap_or((link, ""));
        let page = PAGES.iter().find(|page| file.strip_suffix(".html") == Some(page.name))?;
        let title = format!("Open it here: {}", page.about);
        Some(Live { name: page.name.into(), title, html: page.text(), state: state.into() })
    };
    links.filter_map(live).collect()
}

/// Writes the live pages that a page links to beside it.
///
/// # Errors
/// If a file cannot be written.
pub fn write_linked(html: &str, folder: &Path) -> Result<()> {
    let is_linked = |page: &&Page| html.contains(&format!("href=\"live/{}.html", page.name));
    for page in PAGES.iter().filter(is_linked) {
        file::write_in(folder, format!("live/{}.html", page.name), page.text())?;
    }
    Ok(())
}

//! The live pages: problems that are dragged, methods that are stepped through, by the same solvers compiled to
//! WebAssembly. `live/README.md` says how they are built.

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

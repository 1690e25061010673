//! The live pages: problems that are dragged, methods that are stepped through, by the same solvers compiled to
//! WebAssembly. `live/README.md` says how they are built.

/// A page.
#[derive(Debug, Clone, Copy)]
pub struct Page {
    /// Its name; the file is called so.
    pub name: &'static str,
    /// What it shows.
    pub about: &'static str,
    /// The file.
    pub text: &'static str,
}

/// All of them.
pub const PAGES: [Page; 3] = [
    Page {
        name: "two_rows",
        about: "two rows: the plane of x, complementary cones, six methods step by step",
        text: include_str!("../live/two_rows.html"),
    },
    Page {
        name: "stack",
        about: "a stack: who carries what after a row, after a sweep, and in motion",
        text: include_str!("../live/stack.html"),
    },
    Page {
        name: "friction",
        about: "friction: square, polygon and disc, their nearest points, a block's way over the floor",
        text: include_str!("../live/friction.html"),
    },
];

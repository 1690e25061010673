//! The live pages: problems that can be dragged and methods that can be stepped through, with the
//! same solvers compiled to WebAssembly. `live/README.md` describes how the module is built.

use std::path::Path;
use std::sync::LazyLock;

use sha2::{Digest, Sha256};

use crate::error::Result;
use crate::file;
use crate::page::{Live, base64};
use lcplab_page::escape::with_bound_units;

/// The solvers and the judge as a WebAssembly module, deflated.
const MODULE: &[u8] = include_bytes!("module.wasm.deflate");
const FRAME: &str = include_str!("page/frame.html");
const STYLE: &str = include_str!("page/live.css");
/// The script that all pages share.
const SCRIPT: &str = include_str!("page/live.js");

/// A page.
#[derive(Debug, Clone, Copy)]
pub struct Page {
    /// The name of the page and of its file.
    pub name: &'static str,
    /// The title.
    pub title: &'static str,
    /// What it shows.
    pub about: &'static str,
    body: &'static str,
    script: &'static str,
}

macro_rules! page {
    ($name:literal, $title:literal, $about:literal) => {
        Page {
            name: $name,
            title: $title,
            about: $about,
            body: include_str!(concat!("page/", $name, ".html")),
            script: include_str!(concat!("page/", $name, ".js")),
        }
    };
}

/// All pages.
pub const PAGES: [Page; 6] = [
    page!(
        "two_rows",
        "Two rows",
        "two rows: the plane of x, complementary cones, six methods step by step"
    ),
    page!(
        "stack",
        "A stack",
        "a stack: the load on each contact after each row update, after each sweep, and during the motion"
    ),
    page!(
        "friction",
        "Friction",
        "friction: square, polygon and disk, their nearest points, the path of a block on the floor"
    ),
    page!(
        "problem",
        "Your problem",
        "your problem: solve it with any method, follow the steps and the derivation, check and prove any x"
    ),
    page!(
        "cone_proof",
        "Proof by a shrinking box",
        "proof by a shrinking box: the friction disk, a box around x, and its images, which close in on the exact impulse"
    ),
    page!(
        "painleve",
        "Painlevé's rod",
        "Painlevé's rod: the friction and angle with one, no or two forces, and the motion"
    ),
];

impl Page {
    /// The content of the file.
    pub fn text(&self) -> String {
        static MODULE_TEXT: LazyLock<String> = LazyLock::new(|| base64(MODULE));
        self.around(&MODULE_TEXT)
    }

    /// The same in a folder with all pages, to which it links.
    ///
    /// ```
    /// let page = lcplab::live::PAGES[0];
    /// assert!(page.text_in_folder().contains("<a href=\"stack.html\">A stack</a>"));
    /// assert!(!page.text().contains("stack.html"));
    /// ```
    pub fn text_in_folder(&self) -> String {
        let link = |page: &Page| match page.name == self.name {
            true => format!("<b aria-current=\"page\">{}</b>", page.title),
            false => format!("<a href=\"{}.html\">{}</a>", page.name, page.title),
        };
        let links = PAGES.iter().map(link).collect::<Vec<_>>().join(" ");
        self.text().replacen(
            "<h1>",
            &format!("<nav aria-label=\"Live pages\">{links}</nav>\n<h1>"),
            1,
        )
    }

    /// The content of the file with another deflated module.
    pub fn text_with(&self, module: &[u8]) -> String {
        self.around(&base64(module))
    }

    fn around(&self, module: &str) -> String {
        let script = [SCRIPT, self.script].concat();
        FRAME
            .replace("@title@", &format!("{} · lcplab", self.title))
            .replace("@style@", STYLE)
            .replace("@body@", &with_bound_units(self.body))
            .replace("@hash@", &base64(&Sha256::digest(&script)))
            .replace("@script@", &script)
            .replace("@module@", module)
    }
}

/// The live pages to which a text links, as `[a stack](live/stack.html#solver=pgs)`, to be opened
/// in place.
pub(crate) fn linked(text: &str) -> Vec<Live> {
    let links = text.split("](live/").skip(1).map(|after| after.split(')').next().unwrap_or(""));
    let live = |link: &str| {
        let (file, state) = link.split_once('#').unwrap_or((link, ""));
        let page = PAGES.iter().find(|page| file.strip_suffix(".html") == Some(page.name))?;
        let about = page.about.split_once(": ").map_or(page.about, |(_, about)| about);
        let title = format!("Open the live page \"{}\": {about}", page.title);
        Some(Live { name: page.name.into(), title, html: page.text(), state: state.into() })
    };
    links.filter_map(live).collect()
}

/// Writes the live pages that a page links to next to it.
///
/// # Errors
/// If a file cannot be written.
pub(crate) fn write_linked(html: &str, folder: &Path) -> Result<()> {
    let is_linked = |page: &&Page| html.contains(&format!("href=\"live/{}.html", page.name));
    for page in PAGES.iter().filter(is_linked) {
        file::write_in(folder, format!("live/{}.html", page.name), page.text())?;
    }
    Ok(())
}

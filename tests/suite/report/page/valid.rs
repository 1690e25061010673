//! Pages as a browser and a screen reader find them: no parse error, every id once, every link
//! leads somewhere, everything has a name.

use std::collections::{BTreeMap, HashSet};
use std::path::Path;
use std::process::Command;

use html5ever::tendril::TendrilSink;
use html5ever::{ParseOpts, parse_document};
use markup5ever_rcdom::{Handle, NodeData, RcDom};

use super::sample;
use crate::lesson;

/// No page is larger (bytes).
const LARGEST: usize = 5_000_000;

/// An element of a page, in the order of the page.
struct Element {
    name: String,
    attributes: BTreeMap<String, String>,
    /// All text in it.
    text: String,
    /// The index of the element around it.
    parent: Option<usize>,
}

impl Element {
    fn get(&self, name: &str) -> Option<&str> {
        self.attributes.get(name).map(String::as_str)
    }

    fn has_words(&self, name: &str) -> bool {
        self.get(name).is_some_and(|words| !words.trim().is_empty())
    }
}

/// The elements of a page, and what the parser complained of.
fn parsed(html: &str) -> (Vec<Element>, Vec<String>) {
    let options = ParseOpts::default();
    let dom = parse_document(RcDom::default(), options).one(html);
    let mut elements = Vec::new();
    collect(&dom.document, None, &mut elements);
    let errors = dom.errors.borrow().iter().map(ToString::to_string).collect();
    (elements, errors)
}

/// Adds the elements of a node; returns its text.
fn collect(node: &Handle, parent: Option<usize>, elements: &mut Vec<Element>) -> String {
    let mut own = parent;
    match &node.data {
        NodeData::Text { contents } => return contents.borrow().to_string(),
        NodeData::Element { name, attrs, .. } => {
            let attribute =
                |a: &html5ever::Attribute| (a.name.local.to_string(), a.value.to_string());
            own = Some(elements.len());
            elements.push(Element {
                name: name.local.to_string(),
                attributes: attrs.borrow().iter().map(attribute).collect(),
                text: String::new(),
                parent,
            });
        }
        _ => {}
    }
    let text: String =
        node.children.borrow().iter().map(|child| collect(child, own, elements)).collect();
    if let (Some(k), NodeData::Element { .. }) = (own, &node.data) {
        elements[k].text = text.clone();
    }
    text
}

/// All that is wrong with a page in this folder.
fn faults(html: &str, folder: &Path) -> Vec<String> {
    let (elements, mut faults) = parsed(html);
    let named = |k: usize| {
        let element = &elements[k];
        let id = element.get("id").or(element.get("class")).unwrap_or("");
        format!("<{} {id}>", element.name)
    };
    let inside = |k: usize, name: &str| {
        let mut around = elements[k].parent;
        while let Some(outer) = around {
            if elements[outer].name == name {
                return true;
            }
            around = elements[outer].parent;
        }
        false
    };
    let children = |k: usize, name: &str| {
        elements.iter().filter(|e| e.parent == Some(k) && e.name == name).collect::<Vec<_>>()
    };
    let mut ids = HashSet::new();
    for id in elements.iter().filter_map(|element| element.get("id")) {
        if !ids.insert(id) {
            faults.push(format!("the id {id:?} twice"));
        }
    }
    let mut level = 0;
    for (k, element) in elements.iter().enumerate() {
        let mut wrong = |what: String| faults.push(format!("{}: {what}", named(k)));
        for reference in ["aria-labelledby", "aria-describedby", "aria-controls", "for"] {
            for id in element.get(reference).unwrap_or("").split_whitespace() {
                if !ids.contains(id) {
                    wrong(format!("{reference} names {id:?}, which is not there"));
                }
            }
        }
        if let Some(address) = element.get("href").filter(|_| element.name == "a") {
            match address.strip_prefix('#') {
                Some(id) if ids.contains(id) => {}
                None if address.starts_with("https://") => {}
                None if folder.join(address.split('#').next().unwrap()).is_file() => {}
                _ => wrong(format!("the link {address:?} leads nowhere")),
            }
            if element.text.trim().is_empty() && !element.has_words("aria-label") {
                wrong("a link without words".into());
            }
        }
        match element.name.as_str() {
            "svg" if !inside(k, "svg") && element.get("aria-hidden") != Some("true") => {
                let message = |name| children(k, name).iter().any(|e| !e.text.trim().is_empty());
                if !(element.has_words("aria-label") || message("title") && message("desc")) {
                    wrong("has neither title and desc nor a label".into());
                }
            }
            "table"
                if !elements
                    .iter()
                    .enumerate()
                    .any(|(i, e)| e.name == "th" && inside(i, "table")) =>
            {
                wrong("has no heads".into());
            }
            "th" if element.get("scope").is_none() => wrong("has no scope".into()),
            "img" if element.get("alt").is_none() => wrong("has no alt".into()),
            "button" if element.text.trim().is_empty() && !element.has_words("aria-label") => {
                wrong("has no name".into());
            }
            "h1" | "h2" | "h3" | "h4" => {
                let own = element.name.as_bytes()[1] - b'0';
                if own > level + 1 {
                    wrong(format!("a heading of level {own} after one of level {level}"));
                }
                level = own;
            }
            "html" if element.get("lang").is_none() => wrong("has no language".into()),
            _ => {}
        }
    }
    let count =
        |name: &str| elements.iter().filter(|e| e.name == name && e.parent.is_some()).count();
    for name in ["h1", "main", "nav"] {
        if count(name) != 1 {
            faults.push(format!("{} <{name}>", count(name)));
        }
    }
    if html.len() > LARGEST {
        faults.push(format!("{} bytes", html.len()));
    }
    faults
}

/// What a page has that its policy would not let in, or that there is no policy before it.
fn assert_policy(html: &str) {
    let (elements, _) = parsed(html);
    let is_script = |e: &&Element| e.name == "script" && e.get("type").is_none();
    let scripts: Vec<_> = elements.iter().filter(is_script).collect();
    assert!(matches!(scripts[..], [own] if own.get("src").is_none()), "{} scripts", scripts.len());
    for element in &elements {
        let handler = element.attributes.keys().find(|name| name.starts_with("on"));
        assert!(handler.is_none(), "<{}> has {handler:?}", element.name);
    }
    let head = elements.iter().take_while(|e| !["style", "script"].contains(&e.name.as_str()));
    let policy = head.filter(|e| e.get("http-equiv") == Some("Content-Security-Policy"));
    let policy = policy.filter_map(|e| e.get("content")).next().unwrap();
    assert!(policy.starts_with("default-src 'none'; script-src 'sha256-"), "{policy}");
    assert!(!policy.contains("http") && !policy.contains('*'), "{policy}");
}

fn assert_valid(html: &str, folder: &Path) {
    assert!(html.len() > 1000 && html.contains("</html>"));
    assert_policy(html);
    let faults = faults(html, folder);
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Checks every page that a command writes into its folder, or into this file in it.
fn written_by(arguments: &[&str], file: &str) -> usize {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join(file);
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    let output = command.args(arguments).args(["--out", out.to_str().unwrap()]).output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    pages_in(folder.path())
}

/// Checks every page in a folder.
fn pages_in(folder: &Path) -> usize {
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let pages = files.filter(|path| path.extension().is_some_and(|kind| kind == "html"));
    pages.map(|page| assert_valid(&std::fs::read_to_string(page).unwrap(), folder)).count()
}

#[test]
fn a_page_with_every_kind_of_block_is_valid() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("data")).unwrap();
    for figure in sample::figures() {
        for (kind, text) in [("svg", figure.svg()), ("csv", figure.csv())] {
            let name = format!("data/{}.{kind}", figure.id());
            std::fs::write(folder.path().join(name), text).unwrap();
        }
    }
    // The small table's file.
    std::fs::write(folder.path().join("data/squares.csv"), "").unwrap();
    assert_valid(&sample::page().render().unwrap(), folder.path());
}

#[test]
fn the_handout_is_valid() {
    assert_eq!(pages_in(lesson::handout()), 1);
}

#[test]
fn every_lesson_is_valid() {
    assert_eq!(pages_in(lesson::pages()), 21);
}

#[test]
fn pages_of_simulations_are_valid() {
    assert_eq!(written_by(&["simulate", "stack", "--steps", "3"], ""), 1);
    assert_eq!(written_by(&["compare", "pendulum", "--steps", "3", "--solver", "dantzig"], ""), 1);
}

#[test]
fn a_derivation_is_valid() {
    assert_eq!(written_by(&["explain", "fig7", "--format", "html"], "fig7.html"), 1);
}

#[test]
fn every_fault_is_seen() {
    let folder = tempfile::tempdir().unwrap();
    let bad = [
        ("<p><b>a</p>", "Unexpected"),
        ("<i id=a></i><i id=a></i>", "\"a\" twice"),
        ("<a href=\"#nowhere\">a</a>", "leads nowhere"),
        ("<a href=\"no.csv\">a</a>", "leads nowhere"),
        ("<a href=\"#content\"></a>", "without words"),
        ("<svg></svg>", "neither title"),
        ("<svg><title>a</title><desc> </desc></svg>", "neither title"),
        ("<table><tr><td>1</td></tr></table>", "no heads"),
        ("<table><tr><th>1</th></tr></table>", "no scope"),
        ("<img src=\"a\">", "no alt"),
        ("<button></button>", "no name"),
        ("<h4>a</h4>", "level 4 after"),
        ("<p aria-labelledby=\"b\">a</p>", "names \"b\""),
        ("<h1>b</h1>", "2 <h1>"),
    ];
    let page = |body: &str| {
        format!(
            "<!DOCTYPE html><html lang=en><title>a</title><h1>a</h1><nav>b</nav>\
             <main id=content>{body}</main></html>"
        )
    };
    assert!(faults(&page(""), folder.path()).is_empty(), "{:?}", faults(&page(""), folder.path()));
    for (body, words) in bad {
        let found = faults(&page(body), folder.path());
        assert!(found.iter().any(|fault| fault.contains(words)), "{body}: {found:?}");
    }
}

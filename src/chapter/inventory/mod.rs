//! The inventory of the chapter: a row for each equation, listing, figure, note, claim,
//! demonstration and suggestion, with what it says, whether that is correct, and where the library
//! has it.
//!
//! ```
//! use lcplab::chapter::inventory::{Verdict, named};
//!
//! let (_, position_update) = named("16")?; // or "(16)"
//! assert_eq!(position_update.verdict, Verdict::Wrong);
//! assert_eq!(position_update.errata, ["E21"]);
//! # Ok::<(), lcplab::error::Error>(())
//! ```

mod show;

pub(crate) use show::chosen;
pub use show::list;

use std::sync::LazyLock;

use serde::{Deserialize, Serialize};
use serde_json::{Value, json};

use super::code;
use super::data::{self, one_line};
use crate::error::{Error, Result};

/// A statement or figure of the chapter, as stored in `inventory.toml`.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Entry {
    /// Its number: `(16)`, `Code 6`, `Fig 7`; U for equations without number, N for notes, T for
    /// claims and techniques, D for demonstrations, W for further work, K for the key terms, with
    /// our own numbering.
    pub id: String,
    /// Whether it is correct.
    pub verdict: Verdict,
    /// What it says, in our own words; plain text.
    #[serde(deserialize_with = "one_line")]
    pub says: String,
    /// The related errata.
    #[serde(default)]
    pub errata: Vec<String>,
    /// Where the library has it: a module or item (`lcp::merit`), `scene fig7`, a command (`lcplab
    /// report verification`), `test solver::pgs`, `bench pivoting` or `example own_solver`.
    #[serde(default)]
    pub code: Vec<String>,
    /// The lessons that teach it.
    pub lesson: Vec<u8>,
    /// A remark; if there is no code, the reason.
    #[serde(default, deserialize_with = "one_line")]
    pub remark: String,
}

/// Whether an entry is correct.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Derived again or tested, and correct.
    Right,
    /// A matter of signs or terms, or true under an unstated condition.
    Convention,
    /// A reader corrects it at a glance.
    Misprint,
    /// A reader draws a wrong conclusion, or parts that are usable alone do not fit together.
    Misleading,
    /// Following it leads to a wrong result or a crash.
    Wrong,
    /// A claim about behavior or cost that our measurements confirm.
    Confirmed,
    /// Advice or taste, which no number can decide.
    Opinion,
    /// A picture, demonstration or suggestion without a claim; rebuilt here.
    Rebuilt,
}

/// A group of entries.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Group {
    /// The name that selects it.
    pub kind: String,
    /// The heading.
    pub title: String,
    /// The entries in the chapter's order.
    #[serde(rename = "entry")]
    pub entries: Vec<Entry>,
}

/// The groups in the order of the lists.
pub(crate) fn groups() -> &'static [Group] {
    static GROUPS: LazyLock<Vec<Group>> =
        LazyLock::new(|| data::list("inventory.toml", include_str!("../inventory.toml")));
    &GROUPS
}

/// All entries in order.
pub fn all() -> impl Iterator<Item = &'static Entry> {
    groups().iter().flat_map(|group| &group.entries)
}

/// The entry with this number and its group, in upper or lower case; the brackets of an equation
/// may be omitted.
///
/// # Errors
/// If there is no such entry.
pub fn named(id: &str) -> Result<(&'static Group, &'static Entry)> {
    let bare = |id: &str| id.trim_matches(['(', ')']).replace(' ', "").to_lowercase();
    let wanted = bare(id);
    let found = groups().iter().find_map(|group| {
        group.entries.iter().find(|entry| bare(&entry.id) == wanted).map(|entry| (group, entry))
    });
    found.ok_or_else(|| Error::Unknown {
        kind: "entry of the chapter",
        name: id.to_string(),
        known: ranges(),
    })
}

/// The available entries, by first and last.
fn ranges() -> Vec<String> {
    let range = |group: &Group| match group.entries.as_slice() {
        [] => String::new(),
        [only] => only.id.clone(),
        [first, .., last] => format!("{} … {}", first.id, last.id),
    };
    let others = ["E01 … E67", "errata", "glossary", "references"].map(str::to_string);
    groups().iter().map(range).chain(others).collect()
}

/// The group with this name.
///
/// # Errors
/// If there is no such group.
pub(crate) fn group(kind: &str) -> Result<&'static Group> {
    groups().iter().find(|group| group.kind.eq_ignore_ascii_case(kind)).ok_or_else(|| {
        Error::Unknown {
            kind: "kind of entry",
            name: kind.to_string(),
            known: groups().iter().map(|group| group.kind.clone()).collect(),
        }
    })
}

impl Entry {
    /// The entry as JSON; a listing also has its printed and corrected forms.
    pub fn to_json(&self, kind: &str) -> Value {
        let mut entry = json!({
            "id": self.id, "kind": kind, "says": self.says, "verdict": self.verdict,
            "errata": self.errata, "code": self.code, "lesson": self.lesson, "remark": self.remark,
        });
        if let Some(listing) = code::listing(&self.id) {
            entry["printed"] = listing.printed.into();
            entry["corrected"] = listing.corrected.into();
        }
        entry
    }
}

impl Verdict {
    /// All verdicts, in the order of their explanation.
    pub const ALL: [Verdict; 8] = [
        Verdict::Right,
        Verdict::Convention,
        Verdict::Misprint,
        Verdict::Misleading,
        Verdict::Wrong,
        Verdict::Confirmed,
        Verdict::Opinion,
        Verdict::Rebuilt,
    ];

    /// The word used in lists.
    pub fn word(self) -> &'static str {
        match self {
            Verdict::Right => "right",
            Verdict::Convention => "convention",
            Verdict::Misprint => "misprint",
            Verdict::Misleading => "misleading",
            Verdict::Wrong => "wrong",
            Verdict::Confirmed => "confirmed",
            Verdict::Opinion => "opinion",
            Verdict::Rebuilt => "rebuilt",
        }
    }

    /// The verdict with this word.
    ///
    /// # Errors
    /// If there is no such verdict.
    pub(crate) fn named(word: &str) -> Result<Self> {
        let found = Verdict::ALL.into_iter().find(|v| v.word().eq_ignore_ascii_case(word));
        found.ok_or_else(|| Error::Unknown {
            kind: "verdict",
            name: word.to_string(),
            known: Verdict::ALL.map(|verdict| verdict.word().to_string()).to_vec(),
        })
    }
}

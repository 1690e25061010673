//! The inventory as documents: lists by group, and single entries in full.

use super::{Entry, Group, Verdict, groups};
use crate::chapter::code;
use crate::chapter::exhibit::{self, Exhibit};
use crate::document::{Block, Document, Section, Table};

/// The entries of a group, or of all, with a verdict, or with any.
pub(crate) fn chosen(
    kind: Option<&Group>,
    verdict: Option<Verdict>,
) -> impl Iterator<Item = (&'static Group, Vec<&'static Entry>)> {
    let kind = kind.map(|group| &group.kind);
    groups().iter().filter(move |group| kind.is_none_or(|kind| *kind == group.kind)).map(
        move |group| {
            let wanted = |entry: &&Entry| verdict.is_none_or(|verdict| verdict == entry.verdict);
            (group, group.entries.iter().filter(wanted).collect())
        },
    )
}

/// A list of entries, one table per group.
pub fn list(kind: Option<&Group>, verdict: Option<Verdict>) -> Document {
    let mut document =
        Document { title: "The chapter".into(), is_accepted: true, ..Document::default() };
    let mut count = 0;
    for (group, entries) in chosen(kind, verdict).filter(|(_, entries)| !entries.is_empty()) {
        count += entries.len();
        let mut section = Section::new(&group.title);
        let columns = ["no.", "verdict", "errata", "says", "lesson", "code"];
        let title = format!("{}, with verdicts", group.title);
        let rows = entries.into_iter().map(line).collect();
        section.blocks.push(Block::Table(Table::whole(title, &columns, rows)));
        document.add("", section);
    }
    document.lead = format!(
        "{count} entries. lcplab chapter NUMBER shows one of them, lcplab chapter E07 an erratum; N, T, D, W, U \
         and K are numbered here, not in print."
    );
    document
}

fn line(entry: &Entry) -> Vec<String> {
    let errata = match entry.errata.as_slice() {
        [] | [_] | [_, _] => entry.errata.join(" "),
        [first, .., last] => format!("{first} … {last}"),
    };
    let code = match entry.code.as_slice() {
        [] => String::new(),
        [only] => only.clone(),
        [first, rest @ ..] => format!("{first}, + {}", rest.len()),
    };
    let lessons: Vec<String> = entry.lesson.iter().map(u8::to_string).collect();
    vec![
        entry.id.clone(),
        entry.verdict.word().to_string(),
        errata,
        entry.says.clone(),
        lessons.join(", "),
        code,
    ]
}

impl Entry {
    /// The entry in full.
    pub(crate) fn document(&self) -> Document {
        let mut document = Document {
            title: format!("K&M {}", self.id),
            lead: self.says.clone(),
            is_accepted: true,
            ..Document::default()
        };
        let mut verdict = Section::new("verdict");
        verdict.say(format!("{}: {}", self.verdict.word(), self.verdict.meaning()));
        if !self.remark.is_empty() {
            verdict.say(self.remark.as_str());
        }
        document.add("", verdict);
        let sections =
            [self.listing(), self.errata_section(), self.code_section(), self.lesson_section()];
        for section in sections {
            if !section.blocks.is_empty() {
                document.add("", section);
            }
        }
        document
    }

    /// The printed and corrected forms of a listing.
    fn listing(&self) -> Section {
        let mut section = Section::new("both forms");
        if let Some(listing) = code::listing(&self.id) {
            section.say(format!("Printed, {}: {}", listing.title, listing.printed));
            section.say(format!("Corrected: {}", listing.corrected));
        }
        section
    }

    fn errata_section(&self) -> Section {
        let mut section = Section::new("errata");
        let line = |id: &String| match exhibit::named(id) {
            Ok(Exhibit { title, severity, .. }) => {
                vec![id.clone(), severity.word().to_string(), title.clone()]
            }
            Err(_) => vec![id.clone(), String::new(), String::new()],
        };
        if !self.errata.is_empty() {
            let rows = self.errata.iter().map(line).collect();
            section.table("what is wrong", &["no.", "severity", "about"], rows);
        }
        section
    }

    fn code_section(&self) -> Section {
        let mut section = Section::new("in the library");
        let line = |place: &String| {
            let (kind, name) = match place.split_once(' ') {
                Some(("lcplab", _)) => ("command", place.as_str()),
                Some((kind, name)) => (kind, name),
                None => ("module or item", place.as_str()),
            };
            vec![kind.to_string(), name.to_string()]
        };
        if !self.code.is_empty() {
            let rows = self.code.iter().map(line).collect();
            section.table("where it is", &["what", "name"], rows);
        }
        section
    }

    fn lesson_section(&self) -> Section {
        let mut section = Section::new("lessons");
        for number in &self.lesson {
            section.say(format!("lcplab lesson {number}"));
        }
        section
    }
}

impl Verdict {
    /// What the word means.
    pub(crate) fn meaning(self) -> &'static str {
        match self {
            Verdict::Right => "derived again or tested, and correct.",
            Verdict::Convention => {
                "a choice of signs or terms, or true under an unstated condition."
            }
            Verdict::Misprint => "a reader corrects it at a glance.",
            Verdict::Misleading => {
                "a reader draws a wrong conclusion, or parts that are usable alone do not fit together."
            }
            Verdict::Wrong => "following it gives a wrong result or a crash.",
            Verdict::Confirmed => "a claim that our measurements confirm.",
            Verdict::Opinion => "advice or taste, which no number can decide.",
            Verdict::Rebuilt => "it makes no claim; it is rebuilt here.",
        }
    }
}

//! Texts that become pages: report and grid files, results, and markup. What is read is drawn.

use std::fs;

use lcplab::error::Error;
use lcplab::file::is_name;
use lcplab::json;
use lcplab::report::experiment::Experiment;
use lcplab::report::grid::{Grid, plan_table};
use lcplab::report::page::{Block, Page, Section};
use lcplab::report::results::Results;
use lcplab::report::view::{self, ReportPage};

use crate::files::folder;

/// A report file: a page without findings, or an error that names the file.
pub fn read_report(text: &str) {
    let path = folder().join("report.toml");
    fs::write(&path, text).expect("a place to write to");
    match Experiment::load(&path.to_string_lossy()) {
        Ok(experiment) => {
            if let Ok(document) = view::document(&Results::empty(&experiment)) {
                assert_sound(&document);
            }
        }
        Err(error) => assert_names(&error, "report.toml"),
    }
}

/// A grid file: a plan, or an error that names the file.
pub fn read_grid(text: &str) {
    match Grid::from_toml("grid.toml", text) {
        Ok(grid) => {
            let count =
                grid.axes.iter().fold(1, |all: usize, axis| all.saturating_mul(axis.points.len()));
            if count > 1000 {
                return; // a plan of more is only longer
            }
            if let Ok(plan) = grid.plan() {
                let _ = lcplab::report::terminal::table(&plan_table(&grid, &plan, 40));
            }
        }
        Err(error) => assert_names(&error, "grid.toml"),
    }
}

/// Results as `report results.json` reads them.
pub fn read_results(text: &str) {
    let Ok(value) = json::parse(text) else { return };
    let Ok(results) = serde_json::from_value::<Results>(value) else { return };
    if let Ok(document) = view::document(&results) {
        assert_sound(&document);
    }
}

/// A text as a paragraph, a caption and an equation.
pub fn read_markup(text: &str) {
    let blocks = vec![
        Block::Text(text.into()),
        Block::Note(text.into()),
        Block::Equation { latex: text.into(), label: None },
    ];
    for block in blocks {
        let section = Section {
            id: "one".into(),
            title: text.into(),
            blocks: vec![block],
            ..Section::default()
        };
        let page = Page { title: text.into(), sections: vec![section], ..Page::default() };
        assert_own(&page);
    }
}

/// Whatever is drawn is the page's own, and its files lie beside it.
fn assert_sound(document: &ReportPage) {
    for section in &document.page.sections {
        assert!(is_name(&section.id) || document.page.render().is_err(), "{:?}", section.id);
    }
    for figure in &document.figures {
        let _ = (figure.svg(), figure.csv());
    }
    assert_own(&document.page);
}

/// One script, no tag that acts, every formula closed; or an error.
fn assert_own(page: &Page) {
    let Ok(html) = page.render() else { return };
    let count = |piece: &str| html.matches(piece).count();
    let animations = count("<script type=\"application/json\">");
    assert_eq!(count("<script"), 1 + animations);
    assert_eq!(count("<math"), count("</math>"));
    for tag in ["<iframe", "<object", "<embed", "<form", "<base", "href=\"javascript:"] {
        assert_eq!(count(tag), 0, "{tag}");
    }
}

fn assert_names(error: &Error, file: &str) {
    assert!(error.to_string().contains(file), "{error}");
}

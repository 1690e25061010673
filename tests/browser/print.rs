//! Print: pages come out, without what only a screen can use.

use std::fs;
use std::process::Command;

use serde_json::json;

use super::driver::{Page, chromium};
use super::sample;

/// The pages of a PDF document.
fn pages(pdf: &[u8]) -> usize {
    assert!(pdf.starts_with(b"%PDF-"));
    String::from_utf8_lossy(pdf).matches("/Type /Page\n").count()
}

#[test]
fn a_page_prints() {
    let folder = tempfile::tempdir().unwrap();
    let (page, pdf) = (folder.path().join("index.html"), folder.path().join("out.pdf"));
    fs::write(&page, sample().0).unwrap();
    let to = format!("--print-to-pdf={}", pdf.display());
    chromium(folder.path(), &[&to, "--no-pdf-header-footer"], &page);
    let count = pages(&fs::read(&pdf).unwrap());
    // Six figures, of which two fit on a sheet, a table of sixty rows and a page of words.
    assert!((4..=12).contains(&count), "{count} pages");
}

#[test]
fn a_report_is_printed_to_a_file() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    command.args(["report", "chapter", "--out", "report.pdf"]).current_dir(folder.path());
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(String::from_utf8_lossy(&output.stdout).ends_with("report.pdf\n"));
    let count = pages(&fs::read(folder.path().join("report.pdf")).unwrap());
    assert!((3..=5).contains(&count), "{count} sheets: folded parts are not printed");
    assert!(folder.path().join("reports/chapter/index.html").is_file());
}

#[test]
fn buttons_are_not_printed_and_heads_are_repeated() {
    // The rules for print, applied to the screen, and those for the screen not.
    let mut page = sample();
    page.0 = page.0.replace("@media print", "@media all").replace("@media screen", "@media print");
    let seen = page.seen(
        700, // of a sheet
        "const gone = ['.theme', '.rail', '.skip', '.anchor', '.file', '.screen', '.tabs', '.origin'];
        return [gone.filter((name) => all(name).some(shown)), getComputedStyle(find('thead')).display,
          getComputedStyle(find('figure.plot .scroll')).breakInside, all('.stills').every(shown)];",
    );
    assert_eq!(seen, json!([[], "table-header-group", "avoid", true]));
}

#[test]
fn the_standard_report_has_at_most_12_sheets_and_every_figure_on_them_has_its_marks() {
    let folder = tempfile::tempdir().unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
    command.args(["report", "--out", "report.pdf"]).current_dir(folder.path());
    let output = command.output().unwrap();
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let count = pages(&fs::read(folder.path().join("report.pdf")).unwrap());
    assert!((5..=12).contains(&count), "{count} sheets");
    // The rules for print, applied to the screen: of every figure that is not folded away,
    // something of each kind of mark has a size.
    let page = folder.path().join("reports/standard/index.html");
    let page = fs::read_to_string(page).unwrap();
    let page = page.replace("@media print", "@media all").replace("@media screen", "@media print");
    let seen = Page(page).seen(
        688, // px between the margins of A4
        "const bare = (figure) => [...figure.querySelectorAll('svg [class]')].filter((mark) =>
            !mark.closest('.here, [hidden]') && getComputedStyle(mark).display === 'none');
        const open = all('figure.plot').filter((figure) => !figure.closest('details'));
        // Text of at least 7 pt: on a sheet, 1 px is 0.75 pt.
        const scale = (svg) => svg.getBoundingClientRect().width / svg.viewBox.baseVal.width;
        const size = (text) => 0.75 * scale(text.ownerSVGElement) * Number(text.getAttribute('font-size'));
        const texts = open.flatMap((figure) => [...figure.querySelectorAll('svg text')]).filter(shown);
        const small = texts.filter((text) => size(text) < 7.0);
        return [open.length > 4, open.flatMap(bare).map((mark) => mark.getAttribute('class')),
          texts.length > 200, small.map((text) => text.textContent + ': ' + size(text).toFixed(1) + ' pt')];",
    );
    assert_eq!(seen, json!([true, [], true, []]));
}

#[test]
fn a_figure_alone_is_one_sheet_of_its_size() {
    let folder = tempfile::tempdir().unwrap();
    let (svg, pdf) = (folder.path().join("f.svg"), folder.path().join("f.pdf"));
    for file in [&svg, &pdf] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_lcplab"));
        command.args([
            "report",
            "solvers",
            "--section",
            "ratio",
            "--figure",
            "ratio_error",
            "--out",
        ]);
        let output = command.arg(file).output().unwrap();
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    }
    let pdf = fs::read(pdf).unwrap();
    assert_eq!(pages(&pdf), 1);
    let size = |key: &str| -> f64 {
        let svg = fs::read_to_string(&svg).unwrap();
        let value = svg.split(&format!(" {key}=\"")).nth(1).unwrap().split('"').next().unwrap();
        value.parse().unwrap()
    };
    // A point is 1/72 inch, a pixel 1/96.
    let text = String::from_utf8_lossy(&pdf);
    let sheet = text.split("/MediaBox [").nth(1).unwrap().split(']').next().unwrap().to_string();
    let sheet: Vec<f64> = sheet.split_whitespace().map(|word| word.parse().unwrap()).collect();
    for (side, key) in sheet[2..].iter().zip(["width", "height"]) {
        assert!((side - 0.75 * size(key)).abs() < 1.0, "{key}: {sheet:?}");
    }
}

//! Tables say once what is the same in every row, and omit what has no room.

use lcplab_page::page::markup::literal;
use lcplab_page::page::{Block, Cell, Column, Mark, Page, Section, Table};
use lcplab_page::terminal;

/// Three rows: a name, a constant in seconds, an empty column, a secondary one, a marked constant.
fn table() -> Table {
    let row = |name: &str, hash: usize| {
        vec![
            Cell::text(name),
            Cell::text("5"),
            Cell::text("–"),
            Cell::count(hash),
            Cell::text("bad").marked(Mark::Bad),
        ]
    };
    let rows = vec![row("a", 1), row("b", 2), row("c", 3)];
    let mut table = Table::new(
        "Runs",
        "*limit*: of each run. *reason*: why it ended early. *hash*: of its numbers.",
        "name | #limit (s) | reason | #hash | verdict",
        rows,
    );
    table.columns[3].secondary = true;
    table
}

fn titles(table: &Table) -> Vec<&str> {
    table.columns.iter().map(|column: &Column| column.title.as_str()).collect()
}

#[test]
fn a_column_of_one_value_is_a_remark_unless_it_is_marked_or_there_are_two_rows() {
    let (condensed, same) = table().condensed();
    assert_eq!(titles(&condensed), ["name", "hash", "verdict"]);
    assert_eq!(condensed.rows[1].len(), 3);
    assert_eq!(same, [("limit".into(), "5 s".into())]);

    let mut two = table();
    two.rows.pop();
    assert_eq!(titles(&two.condensed().0), titles(&two));
}

#[test]
fn a_page_reads_the_title_of_a_column_of_one_value_as_markup_and_the_value_as_text() {
    let mut table = table();
    table.columns[1].title = literal("limit (s)");
    table.rows.iter_mut().for_each(|row| row[1].text = "a_*b*".into());
    let blocks = vec![Block::Table(table)];
    let section = Section { id: "runs".into(), title: "Runs".into(), blocks, ..Section::default() };
    let page = Page { title: "Report".into(), sections: vec![section], ..Page::default() };
    let html = page.render().unwrap().replace('\u{a0}', " ");
    assert!(html.contains("The same in every row: limit (s) = a_*b*"), "{html}");
}

#[test]
fn a_terminal_marks_bad_cells_and_explains_neither_secondary_nor_empty_columns() {
    let words = "Runs
    name   verdict
    a      ✗ bad
    b      ✗ bad
    c      ✗ bad
The same in every row: limit = 5 s.
limit: of each run.
";
    assert_eq!(terminal::table(&table()), words);
}

#[test]
fn a_table_that_is_too_wide_for_a_terminal_is_written_row_by_row() {
    let row = |name: &str, number: f64| {
        let numbers = (0..12).map(|k| Cell::number(number + f64::from(k) / 8.0, 4));
        [Cell::text(name), Cell::text("a method")].into_iter().chain(numbers).collect()
    };
    let headings: Vec<String> = (0..12).map(|k| format!("#quantity {k} (m)")).collect();
    let headings = format!("case | method | {}", headings.join(" | "));
    let mut wide = Table::new("Wide", "", &headings, vec![row("one", 0.5), row("two", 2.0)]);
    wide.rows[0][2] = Cell::text("–");
    wide.rows[1][3].mark = Mark::Bad;
    let words = terminal::table_within(&wide, 100);
    assert!(words.lines().all(|line| line.chars().count() <= 100), "{words}");
    let starts = "Wide\n    one, a method\n        quantity 1 (m): 0.625; quantity 2 (m): 0.75; ";
    assert!(words.starts_with(starts), "{words}");
    let second = "\n    two, a method\n        quantity 0 (m): 2; quantity 1 (m): ✗ 2.125; ";
    assert!(words.contains(second), "{words}");
    assert_eq!(terminal::table_within(&table(), 100), terminal::table(&table()));
}

#[test]
fn a_table_of_words_names_the_column_in_each_cell_for_narrow_screens_and_one_of_numbers_does_not() {
    let row = || vec![Cell::text("a"), Cell::text("solver"), Cell::text("detected")];
    let words = Table::new("Defects", "", "what was wrong | stage | outcome", vec![row(), row()]);
    let page = |table: Table| {
        let (id, title, blocks) = ("one".into(), "One".into(), vec![Block::Table(table)]);
        let section = Section { id, title, blocks, ..Section::default() };
        Page { title: "A page".into(), sections: vec![section], ..Page::default() }
            .render()
            .unwrap()
    };
    let html = page(words);
    assert!(html.contains(r#"data-column="stage">solver<"#), "{html}");
    assert!(!html.contains(r#"data-column="what was wrong""#));
    assert!(!page(table()).contains("data-column=\""));
}

/// A page with only this table.
fn page_of(table: Table) -> String {
    let (id, title, blocks) = ("one".into(), "One".into(), vec![Block::Table(table)]);
    let section = Section { id, title, blocks, ..Section::default() };
    Page { title: "A page".into(), sections: vec![section], ..Page::default() }.render().unwrap()
}

#[test]
fn a_table_of_more_numbers_than_a_phone_has_room_for_names_the_column_in_each_cell() {
    let html = |columns: usize| {
        let heads: Vec<String> = (0..columns).map(|k| format!("#x{k} (m)")).collect();
        let row = |at: f64| {
            let numbers = (0..columns).map(|k| Cell::number(at + 0.001 * k as f64, 4));
            std::iter::once(Cell::text("case")).chain(numbers).collect()
        };
        let headings = format!("case | {}", heads.join(" | "));
        page_of(Table::new("Numbers", "", &headings, vec![row(1.0), row(2.0)]))
    };
    // Ten numbers of five digits need about twice the width, two fit.
    assert!(html(10).contains("data-column=\"x3 (m)\">1.003<"), "{}", html(10));
    assert!(!html(2).contains("data-column=\""));
}

#[test]
fn of_a_table_of_many_sheets_only_marked_rows_are_printed() {
    let html = |rows: usize| {
        let row = |k: usize| {
            let mark = if k == 7 { Mark::Bad } else { Mark::Good };
            vec![Cell::text(format!("case {k}")), Cell::count(k).marked(mark)]
        };
        page_of(Table::new("Cases", "", "case | #number", (0..rows).map(row).collect()))
    };
    let says = "Of the 404 rows only those with a ✗ or ! are printed: 1.";
    assert!(html(404).contains(says) && html(404).contains("unprinted\""));
    assert!(!html(40).contains("Of the 40 rows") && !html(40).contains("unprinted\""));
}

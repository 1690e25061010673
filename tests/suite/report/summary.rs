//! The table that sums a report up.

use lcplab::report::page::Mark;
use lcplab::report::view;

use super::standard::{experiment, run_all, table};

#[test]
fn a_summary_says_how_every_study_came_out() {
    let text = "title = 't'\nlead = ''\n[[section]]\ntitle = 'First'\nsummary = true\n\
                [[section]]\nstudy = 'cross-check'\nscenes = [{ scene = 'fig7' }, { scene = 'moon' }]\n\
                [[section]]\nstudy = 'cross-check'\nscenes = [{ scene = 'fig7' }]\n";
    let results = run_all(&experiment(text).unwrap());
    let rows = table(&view::document(&results).unwrap(), "summary").rows;
    let marks: Vec<Mark> = rows.iter().map(|row| row[2].mark).collect();
    assert_eq!(marks, [Mark::Bad, Mark::Good]);
    assert!(rows[0][1].text.ends_with("1 of 2 tasks failed."), "{}", rows[0][1].text);
}

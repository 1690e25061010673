//! Published problems with their exact answers, and the table that sums a report up.

use lcplab::report::page::Mark;
use lcplab::report::study::Study;
use lcplab::report::study::published::Plan;
use lcplab::report::view::{self, View};

use super::standard::{experiment, run_all, table};

#[test]
fn solutions_are_the_published_fractions_and_lemkes_path_is_as_long() {
    let plan =
        Plan { problems: ["cps-2", "cps-3", "ortiz", "pang-perturbed"].map(Into::into).into() };
    let found: Vec<_> = (0..4).map(|k| plan.run(k).unwrap().0).collect();
    assert_eq!(found[0].solutions, [["0", "1", "3"]]);
    assert_eq!(found[1].solutions.len(), 3);
    assert_eq!(found[2].solutions, [["2/3", "0", "1/3", "0"]]);
    assert!(found[3].solutions.is_empty());
    let paths = [(5, false), (1, true), (3, false), (4, true)];
    assert_eq!(found.iter().map(|finding| finding.path().unwrap()).collect::<Vec<_>>(), paths);
    let outcome = plan.outcome(&found);
    assert!(outcome.good, "{}", outcome.says);
}

#[test]
fn a_problem_without_solution_is_claimed_solved_by_nobody() {
    let plan = Plan { problems: vec!["kostreva-2".into()] };
    let found = plan.run(0).unwrap().0;
    assert!(found.solutions.is_empty());
    assert!(found.solvers.iter().all(|row| row.claimed == 0));
}

#[test]
fn a_summary_says_how_every_study_came_out() {
    let text = "title = 't'\nlead = ''\n[[section]]\ntitle = 'First'\nsummary = true\n\
                [[section]]\nstudy = 'published'\nproblems = ['cps-1', 'moon']\n\
                [[section]]\nstudy = 'worst-cases'\nsizes = [2]\n";
    let results = run_all(&experiment(text).unwrap());
    let rows = table(&view::document(&results).unwrap(), "summary").rows;
    let marks: Vec<Mark> = rows.iter().map(|row| row[2].mark).collect();
    assert_eq!(marks, [Mark::Bad, Mark::Good]);
    assert!(rows[0][1].text.ends_with("1 of 2 tasks failed."), "{}", rows[0][1].text);
}

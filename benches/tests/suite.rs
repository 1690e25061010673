//! The studies of speed: nothing is timed that is not right. What the clock says is no test.

use lcplab::lcp::merit;
use lcplab::report::results::Results;
use lcplab::report::study::attempt::Outcome;
use lcplab::report::view::{self, View};
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::{Pgs, Settings};
use lcplab_benches::study::singular;
use lcplab_benches::study::sparse_speed;
use lcplab_benches::study::sweep_speed::{self, Checked, ROW_BY_ROW};
use lcplab_benches::study::timing::{Contender, Time, interleaved};
use lcplab_benches::study::yardstick::{Finding, YARDSTICK};

use lcplab::report::experiment::Experiment;
use lcplab::report::page::Table;
use lcplab::report::view::Document;
use lcplab::report::{kind, run};
use lcplab::solver::Stop;
use lcplab_testing::iterates;

/// All kinds on problems that take milliseconds.
const SMALL: &str = r#"
title = "small"
lead = "Small."

[[section]]
study = "singular"
boxes = [2, 3]
seconds = 0.0

[[section]]
study = "sparse-speed"
problems = [{ scene = "stack", step = 2, goal = 1.0 }]
sweeps = 20
seconds = 0.0

[[section]]
study = "sweep-speed"
dense = [24]
scenes = [{ scene = "stack", step = 2 }]
tolerances = [1e-1, 1e-2]
rounds = 1
"#;

fn small() -> Results {
    kind::add(lcplab_benches::KINDS);
    let experiment = Experiment::parse(SMALL, "small.toml", "small").unwrap();
    let progress = indicatif::ProgressBar::hidden();
    run::run(&experiment, None, &progress, &Stop::default(), &|_| Ok(())).unwrap()
}

/// The document's table whose file has this name.
fn table(document: &Document, name: &str) -> Table {
    document.tables.iter().find(|(id, _)| id == name).expect("a table of that name").1.clone()
}

fn times<P: View>(results: &Results, section: &str) -> Vec<P::Times> {
    let of_section = results.machine.times.iter().filter(|timed| timed.section == section);
    of_section.map(|timed| serde_json::from_value(timed.times.clone()).unwrap()).collect()
}

#[test]
fn every_form_sweeps_as_the_plain_loop_and_only_such_are_timed() {
    let results = small();
    let findings = results.findings::<sweep_speed::Plan>().unwrap();
    let forms: Vec<usize> = findings.iter().map(|finding| finding.forms.len()).collect();
    assert_eq!(forms, [3, 3]);
    for form in findings.iter().flat_map(|finding| &finding.forms) {
        assert!(form.agrees() && form.difference < 1e-12, "{form:?}");
    }
    for (times, finding) in
        times::<sweep_speed::Plan>(&results, "sweep-speed").iter().zip(&findings)
    {
        assert_eq!(times.read.is_some(), finding.tolerances.is_empty());
        for form in &finding.forms {
            assert!(times.runs.iter().any(|run| run.form == form.form), "{}", form.form);
        }
        assert!(
            times.runs.iter().all(|run| 0.0 < run.sweep.best && run.sweep.best <= run.sweep.median)
        );
    }
}

#[test]
fn a_form_that_is_another_sweep_is_bad_and_not_timed() {
    let wrong = |difference, same_bits| {
        let (form, sweeps) = ("wrong".to_string(), Vec::new());
        Checked { form, difference, same_bits, sweeps }
    };
    assert!(wrong(1e-13, true).agrees());
    for form in [wrong(1e-6, true), wrong(f64::NAN, true), wrong(0.0, false)] {
        assert!(!form.agrees());
        let mut findings = small().findings::<sweep_speed::Plan>().unwrap();
        findings[0].forms.push(form);
        let outcome = View::outcome(&sweep_speed::Plan::default(), &findings);
        assert!(!outcome.good && outcome.says.starts_with("6 of 7"), "{}", outcome.says);
    }
}

/// The registered solver is the other method: the count is the first look, every twenty sweeps, at
/// which its residual is small enough.
#[test]
fn sweeps_are_counted_until_the_residual_is_a_part_of_the_first() {
    let findings = small().findings::<sweep_speed::Plan>().unwrap();
    let form = findings[1].forms.iter().find(|form| form.form == ROW_BY_ROW).unwrap();
    let settings = Settings { max_iterations: 20, ..Settings::default() };
    let way = Box::new(Pgs { settings, ..Pgs::default() });
    let mut simulation = Simulation::new(Scene::load("stack").unwrap(), way);
    let lcp =
        (0..2).map(|_| simulation.step().unwrap()).last().unwrap().solves.remove(0).problem.lcp;
    let settings =
        Settings { tolerance: 0.0, max_iterations: 2000, check_every: 2000, ..Settings::default() };
    let iterates = iterates(&Pgs { settings, ..Pgs::default() }, &lcp);
    let first = merit::natural_residual(&lcp, &vec![0.0; lcp.len()]);
    for (part, counted) in [1e-1, 1e-2].into_iter().zip(&form.sweeps) {
        let small = |x: &&Vec<f64>| merit::natural_residual(&lcp, x) <= part * first;
        let looks = iterates.iter().skip(19).step_by(20);
        let look = looks.take_while(|x| !small(x)).count();
        assert_eq!(*counted, Some(20 * (look + 1)));
    }
}

#[test]
fn every_time_of_a_redundant_problem_belongs_to_an_accepted_answer() {
    let results = small();
    let findings = results.findings::<singular::Plan>().unwrap();
    let times = times::<singular::Plan>(&results, "singular");
    assert_eq!((findings.len(), times.len()), (8, 8)); // 2 stacks, with and without friction, twice
    for (finding, times) in findings.iter().zip(&times) {
        assert_eq!(finding.problem, times.problem);
        assert_eq!(finding.answers[0].solver, YARDSTICK);
        for answer in &finding.answers {
            let solved = answer.outcome.is_solved();
            assert_eq!(times.of(&answer.solver).is_some(), solved, "{}", answer.solver);
            assert_eq!(times.failed.contains(&answer.solver), !solved);
            assert!(!solved || answer.residual <= 1e-9, "{answer:?}");
        }
    }
    let dantzig =
        |f: &Finding| f.answers.iter().any(|a| a.solver == "dantzig" && a.outcome.is_solved());
    assert!(findings.iter().all(dantzig));
}

#[test]
fn a_refuted_claim_is_bad_and_has_no_time() {
    let mut findings = small().findings::<singular::Plan>().unwrap();
    let plan = singular::Plan::default();
    assert!(View::outcome(&plan, &findings).good);
    findings[0].answers[1].outcome = Outcome::Refuted;
    let outcome = View::outcome(&plan, &findings);
    assert!(!outcome.good && outcome.says.ends_with("1 claims refuted"), "{}", outcome.says);
}

#[test]
fn both_forms_of_a_sparse_problem_are_accepted_and_timed() {
    let results = small();
    let findings = results.findings::<sparse_speed::Plan>().unwrap();
    let times = times::<sparse_speed::Plan>(&results, "sparse-speed");
    let [ours_and_clarabel] = &times[..] else { panic!("{times:?}") };
    assert_eq!(findings[0].answers.len(), 4);
    for judged in &findings[0].answers {
        let answer = &judged.answer;
        assert!(answer.outcome.is_solved() && answer.residual <= 2e-7, "{answer:?}");
        assert!(ours_and_clarabel.solvers.iter().any(|(name, _)| *name == answer.solver));
        assert_eq!(judged.asked.is_some(), answer.solver.starts_with("clarabel"));
    }
    let [ours, clarabel] = ours_and_clarabel.better();
    assert!(ours.unwrap() > 0.0 && clarabel.unwrap() > 0.0);
    let plan = sparse_speed::Plan::default();
    assert!(View::outcome(&plan, &findings).good);
}

#[test]
fn goals_say_what_was_asked_and_whether_it_was_reached() {
    let document = view::document(&small()).unwrap();
    for name in ["singular_goals", "sparse_goals", "sweep_goals"] {
        let goals = table(&document, name);
        assert!(goals.how_to_read.contains("cargo bench"), "{}", goals.how_to_read);
        assert!(goals.rows.iter().any(|row| row[2].value.is_some()));
        for row in &goals.rows {
            let must = &row[1].text;
            let number: f64 = must.split_once(' ').unwrap().1.parse().unwrap();
            let reached = row[2].value.is_some_and(|measured| match must.starts_with('≤') {
                true => measured <= number,
                false => measured >= number,
            });
            assert_eq!(row[4].text == "yes", reached, "{row:?}");
        }
    }
}

#[test]
fn what_is_found_out_is_the_same_every_time_but_for_the_clock() {
    assert_eq!(small().sections, small().sections);
}

/// In each round everybody has a turn; the first round warms up and does not count.
#[test]
fn contenders_take_turns_and_the_first_round_does_not_count() {
    let turns = std::cell::RefCell::new(String::new());
    let contender = |name: char, seconds: [f64; 4]| {
        let turns = &turns;
        let mut runs = seconds.into_iter();
        Contender::new(move || {
            turns.borrow_mut().push(name);
            runs.next().unwrap()
        })
    };
    let mut both = [contender('a', [9.0, 3.0, 1.0, 2.0]), contender('b', [0.1, 5.0, 5.0, 4.0])];
    let times = interleaved(3, &mut both);
    assert_eq!(times, [Time { median: 2.0, best: 1.0 }, Time { median: 5.0, best: 4.0 }]);
    assert_eq!(*turns.borrow(), "abababab");
}

#[test]
fn all_studies_of_the_shipped_report_run_beside_nothing_else() {
    let report = lcplab_benches::report().unwrap();
    let studies: Vec<_> = report.sections.iter().filter_map(|s| s.study.as_ref()).collect();
    assert_eq!(studies.len(), 9);
    assert!(studies.iter().all(|study| study.alone()));
    assert!(report.sections.iter().any(|section| section.shown.times));
}

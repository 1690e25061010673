use lcplab::report::study::posed::{Loaded, Source};
use lcplab::report::study::solver_times::{Record, SolverTime, TenSweeps, TimedProblem};
use lcplab::solver::{Options, Registry, Settings, Start, Status};

/// Problems of up to this many rows are solved again.
const ROWS: usize = 80;

#[test]
fn recorded_solvers_still_need_the_recorded_iterations() {
    let record = Record::shipped().unwrap();
    let settings = Settings::default()
        .with_tolerance(record.tolerance)
        .with_max_iterations(record.max_iterations);
    let options = Options::default().with_settings(settings).with_omega(record.omega);
    let mut again = 0;
    for timed in record.problems.iter().filter(|timed| timed.rows <= ROWS) {
        let lcp = timed.problem.posed().unwrap().lcp;
        for own in &timed.solvers {
            let solver = Registry::standard().entry(&own.solver).unwrap().build(&options);
            let solution = solver.solve(&lcp, &Start::default(), &mut ());
            let is_solved = solution.status == Status::Solved;
            let found = (solution.iterations, is_solved);
            let name = timed.problem.name();
            assert_eq!(found, (own.iterations, own.seconds.is_some()), "{}, {name}", own.solver);
            again += 1;
        }
    }
    assert!(again >= 40, "{again}");
}

/// Three solvers on two problems: `quick` fails once; `even` takes 3 and 2 times the least time,
/// `odd` 1 and 5 times.
fn small() -> Record {
    let problem = |times: [(&str, Option<f64>); 3]| TimedProblem {
        problem: Source::Stack(Loaded { boxes: 2, ratio: 1.0, friction: 0.0 }),
        rows: 8,
        stored: 64,
        ten_sweeps: TenSweeps { seconds: 1.0, unsupported: None },
        solvers: times
            .map(|(solver, seconds)| SolverTime { solver: solver.into(), iterations: 1, seconds })
            .into(),
    };
    let both = [
        [("quick", None), ("even", Some(6.0)), ("odd", Some(2.0))],
        [("quick", Some(1.0)), ("even", Some(2.0)), ("odd", Some(5.0))],
    ];
    Record { problems: both.map(problem).into(), ..Record::shipped().unwrap() }
}

#[test]
fn the_recommended_solver_solves_all_and_is_never_far_from_the_fastest() {
    let record = small();
    let recommended = record.recommended().unwrap();
    assert_eq!(recommended.solver, "even");
    assert_eq!((recommended.worst.rival, recommended.worst.factor), ("odd", 3.0));
    assert_eq!(recommended.worst.problem, &record.problems[0]);
}

#[test]
fn times_within_five_percent_are_equal() {
    let mut problem = small().problems.remove(1);
    assert_eq!(problem.fastest_or("even"), Some(("quick", 1.0)));
    problem.solvers[1].seconds = Some(1.04);
    assert_eq!(problem.fastest_or("even"), Some(("even", 1.04)));
}

//! Engine cards: the shipped measurements, compared with closed forms that share no code with the
//! Python that recorded them.

use std::f64::consts::TAU;
use std::path::PathBuf;

use lcplab::judge::{Demand, Verdict};
use lcplab::lcp::Question;
use lcplab::report::friction::JudgedAnswer;
use lcplab::report::study::Study;
use lcplab::report::study::cards::{Column, Frame, Phenomenon, Plan, Record, SolverPart};
use lcplab::report::view::{ReportPage, View};
use lcplab::scene::catalogue::spin::FreeBody;
use lcplab::scene::{Description, Integrator, Scene, Scheme};
use lcplab::simulation::Simulation;
use lcplab::solver::{Options, Registry, Start, default_for};

const G: f64 = 9.81;

fn shipped() -> Record {
    Record::load(None).unwrap()
}

fn phenomenon<'a>(record: &'a Record, name: &str) -> &'a Phenomenon {
    record.phenomena.iter().find(|own| own.name == name).unwrap_or_else(|| panic!("no {name}"))
}

/// The laws of a phenomenon, in the order of what is measured.
fn laws(record: &Record, name: &str) -> Vec<f64> {
    let measured = phenomenon(record, name).columns.iter().map(|own| &own.measured);
    let all: Vec<Vec<f64>> = measured
        .filter(|measured| !measured.is_empty())
        .map(|measured| measured.iter().map(|own| own.law).collect())
        .collect();
    assert!(all.iter().all(|laws| *laws == all[0]), "{name}: one law for all engines");
    all[0].clone()
}

/// The time from φ0 to 0 by ∫ dφ/√(2 ω² (cos φ − cos φ0)), four times: the substitution sin(φ/2) =
/// k sin ψ leaves no singularity, and Simpson's rule does the rest.
fn period(square: f64, start: f64) -> f64 {
    let (k, count) = ((start / 2.0).sin(), 1000);
    let f = |psi: f64| 1.0 / (1.0 - (k * psi.sin()).powi(2)).sqrt();
    let h = std::f64::consts::FRAC_PI_2 / f64::from(count);
    let sum: f64 = (0..count)
        .map(|i| {
            let at = f64::from(i) * h;
            h / 6.0 * (f(at) + 4.0 * f(at + h / 2.0) + f(at + h))
        })
        .sum();
    4.0 * sum / square.sqrt()
}

/// By how many degrees a plate of 0.6 × 0.6 × 0.05 m and 1 kg goes round in 10 s on a stem of 0.2
/// m, at 30° from the vertical and with 13.94011 rad/s about its axis: the root of m g l = Ω (I₃ ω₃
/// − I₁ Ω cos θ) by bisection.
fn top_goes_round() -> f64 {
    let (along, across) = (2.0 * 0.36 / 12.0, (0.36 + 0.0025) / 12.0 + 0.04);
    let pull = |rate: f64| {
        rate * (along * 13.940_110 - across * rate * 30f64.to_radians().cos()) - G * 0.2
    };
    let (mut low, mut high) = (0.0, 5.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        if pull(middle) < 0.0 { low = middle } else { high = middle }
    }
    (10.0 * low).to_degrees()
}

fn scene(phenomenon: &Phenomenon) -> Scene {
    let description = Description::from_toml(&phenomenon.name, &phenomenon.scene).unwrap();
    Scene::new(&phenomenon.name, &description).unwrap()
}

/// Twice the time from rest to rest at acceleration level: between the last step down and the first
/// one back the kinetic energy is least, and a parabola through three steps has the instant.
fn bricards_period(record: &Record) -> f64 {
    let mut scene = scene(phenomenon(record, "bricard"));
    scene.step.scheme = Scheme::Acceleration;
    scene.step.integrator = Integrator::Rk4;
    scene.step.dt = 0.002;
    let mut simulation = Simulation::of(&scene).unwrap();
    let mut kinetic = vec![0.0];
    let falls = |k: &[f64]| k[k.len() - 1] <= k[k.len() - 2];
    while kinetic.len() < 400 || falls(&kinetic) {
        kinetic.push(simulation.step().unwrap().motion.kinetic);
    }
    let [a, b, c] = kinetic[kinetic.len() - 3..] else { panic!("three steps") };
    let back = (c - a) / (2.0 * (a - 2.0 * b + c));
    2.0 * scene.step.dt * ((kinetic.len() - 2) as f64 - back)
}

fn assert_laws(record: &Record, name: &str, expected: &[f64]) {
    let found = laws(record, name);
    assert_eq!(found.len(), expected.len(), "{name}");
    for (found, expected) in found.iter().zip(expected) {
        assert!(
            (found - expected).abs() <= 2e-5 * expected.abs(),
            "{name}: {found}, not {expected}"
        );
    }
}

#[test]
fn the_laws_of_the_record_are_those_of_mechanics() {
    let record = shipped();
    assert_laws(&record, "stopping", &[1e3 * 4.0 / (2.0 * 0.5 * G), 0.0]);
    let slope = 25f64.to_radians();
    let slides = 1e3 * G * (slope.sin() - 0.3 * slope.cos()) / 2.0;
    assert_laws(&record, "directions", &[slides, 0.0]);
    assert_laws(&record, "rolling", &[10.0 / 7.0, 0.0]);
    assert_laws(&record, "free_fall", &[3.0 - G / 2.0, 3f64.sqrt().to_degrees()]);
    assert_laws(&record, "weight", &[100.0]);
    // The last flight above a hundredth of the drop of 1 m is the third: it begins when two are
    // over.
    let (speed, e) = ((2.0 * G).sqrt(), 0.5);
    let third = speed / G * (1.0 + 2.0 * e + 2.0 * e * e);
    let arrival = (e.powi(3) * speed + (e.powi(6) * speed * speed - 2.0 * G * 0.01).sqrt()) / G;
    assert_laws(&record, "bounce", &[1e3 * e * e, third + arrival]);
    let rod = (1.0 + 0.05f64.powi(2)) / 12.0 + 0.25;
    let swings = period(G * 0.5 / rod, std::f64::consts::FRAC_PI_2);
    assert_laws(&record, "pendulum", &[swings, 0.0, 0.0]);
    let crank = (0.25 + 0.05f64.powi(2)) / 12.0 + 0.0625;
    let square = G * (0.5 + 0.5) / (2.0 * crank + 0.25);
    assert_laws(&record, "closed_loop", &[period(square, 60f64.to_radians()), 0.0, 0.0]);
    let moments = [0.04 + 0.01, 0.09 + 0.01, 0.09 + 0.04].map(|sum| sum / 12.0);
    let turns = FreeBody { moments, rates: [0.0, 5.0, 0.5] }.period() / 2.0;
    assert_laws(&record, "angular_momentum", &[0.0, 0.0, turns]);
    assert_laws(&record, "spring", &[TAU / 50f64.sqrt(), 0.0]);
    assert_laws(&record, "bricard", &[bricards_period(&record), 0.0, 0.0]);
    let [held, slides] = laws(&record, "capstan")[..] else { panic!("two loads") };
    // T₂/T₁ of a thin chain of twelve links; the weight and the thickness of this one are worth a
    // tenth.
    let part = 0.3 * (TAU / 48.0).tan();
    let ratio = ((1.0 + part) / (1.0 - part)).powi(12);
    let thin = 1e3 * G * (3.0 - ratio) / (3.0 + ratio) * 0.4f64.powi(2) / 2.0;
    assert!(held == 0.0 && (slides / thin - 1.0).abs() < 0.12, "{slides} beside {thin}");
    assert_laws(&record, "predictability", &[2.0 / (0.5 * G)]);
    assert_laws(&record, "top", &[0.0, top_goes_round()]);
    assert_laws(&record, "flying_tree", &[0.0; 4]);
    assert_laws(&record, "standing_tree", &[100.0, 100.0, 0.0, 0.0]);
    let still = [
        "creep",
        "wall",
        "lift",
        "tower",
        "mass_ratio",
        "bullet",
        "chain",
        "painleve",
        "repeat",
        "order",
    ];
    for name in still {
        assert!(laws(&record, name).iter().all(|law| *law == 0.0), "{name}: nothing moves");
    }
}

#[test]
fn a_verdict_of_the_record_is_the_comparison_that_it_stands_for() {
    for phenomenon in &shipped().phenomena {
        for measured in phenomenon.columns.iter().flat_map(|own| &own.measured) {
            let apart = (measured.value - measured.law).abs();
            // Six digits are kept.
            let border = (apart / measured.tolerance - 1.0).abs() < 1e-4;
            assert!(border || measured.holds == (apart <= measured.tolerance), "{measured:?}");
            assert!(measured.tolerance > 0.0, "{measured:?}");
        }
    }
}

#[test]
fn engines_are_shown_only_if_their_accurate_settings_fly_as_a_stone_does() {
    let record = shipped();
    for own in &phenomenon(&record, "free_fall").columns {
        assert!(own.settings == "defaults" || own.holds(), "{own:?}");
    }
}

#[test]
fn lcplabs_schemes_keep_every_law_that_their_theory_lets_them_keep() {
    let record = shipped();
    let missed = |scheme: &str| -> Vec<&str> {
        let misses =
            |own: &&Column| own.settings == scheme && !own.measured.is_empty() && !own.holds();
        let all = record.phenomena.iter();
        all.filter(|own| own.columns.iter().any(|own| misses(&own)))
            .map(|own| own.name.as_str())
            .collect()
    };
    // A spring is a soft row, taken implicitly: 1 − e^(−ω²ht) of its energy is gone, and with ω² =
    // 50/s² in 9.3 s a hundredth of it asks for h = 0.02 ms. The rows of Bricard's hinges become
    // independent as errors of positions grow: then he locks, or forces grow without bound, as at
    // the acceleration level with 5 ms, which fails and so measures nothing. A contact is a row
    // from 0.05 m on, and a step of the bullet is longer; only the acceleration level looks for the
    // instant at which bodies meet.
    assert_eq!(missed("velocity, cone"), ["spring", "bullet", "bricard"]);
    // A box rubs with up to √2 times its coefficient: all other schemes have one.
    assert_eq!(missed("velocity"), ["spring", "directions", "bullet", "bricard"]);
    assert_eq!(missed("acceleration"), ["spring", "directions"]);
    // What is compliant yields to a thousandfold load, and joints to theirs, of a chain as over a
    // post. XPBD's few sweeps leave some of it, and its velocities, which are differences of
    // positions, damp what turns.
    let yields = ["spring", "capstan", "directions", "mass_ratio", "bullet", "chain", "bricard"];
    assert_eq!(missed("soft"), yields);
    let of_positions = [
        "spring",
        "capstan",
        "directions",
        "mass_ratio",
        "tower",
        "bullet",
        "pendulum",
        "top",
        "closed_loop",
        "bricard",
    ];
    assert_eq!(missed("xpbd"), of_positions);
}

#[test]
fn the_record_is_good_unless_lcplab_misses_more_than_is_known_or_a_verdict_is_not_its_numbers() {
    let plan = Plan::default();
    let faults = |change: &dyn Fn(&mut Column), engine: &str, settings: &str, name: &str| {
        let mut record = shipped();
        let phenomena = record.phenomena.iter_mut().filter(|own| own.name == name);
        let mut columns = phenomena.flat_map(|own| &mut own.columns);
        let is_it = |own: &&mut Column| own.engine == engine && own.settings == settings;
        change(columns.find(is_it).expect("such a run"));
        let outcome = plan.outcome(&[record]);
        assert_eq!(outcome.good, !outcome.says.contains("unexpected"), "{}", outcome.says);
        !outcome.good
    };
    let nothing = |_: &mut Column| ();
    assert!(!faults(&nothing, "lcplab", "velocity", "weight"), "as it is shipped");
    let misses = |column: &mut Column| {
        let measured = &mut column.measured[0];
        measured.value = measured.law + 3.0 * measured.tolerance;
        measured.holds = false;
    };
    assert!(faults(&misses, "lcplab", "velocity", "weight"));
    assert!(!faults(&misses, "lcplab", "velocity", "spring"), "it is known to miss that");
    assert!(!faults(&misses, "mujoco", "accurate", "weight"), "what others miss is a finding");
    assert!(faults(&misses, "mujoco", "accurate", "free_fall"), "the adapter is wrong");
    let fails = |column: &mut Column| {
        column.measured.clear();
        column.failed = Some("stopped".into());
    };
    assert!(faults(&fails, "lcplab", "velocity", "weight"));
    let lies = |column: &mut Column| column.measured[0].holds = !column.measured[0].holds;
    assert!(faults(&lies, "mujoco", "defaults", "weight"));
}

#[test]
fn two_reported_findings_are_in_the_record_as_their_formulas_say() {
    let record = shipped();
    let mujoco = |name: &str| {
        let of = |own: &&Column| own.engine == "mujoco" && own.settings == "defaults";
        phenomenon(&record, name).columns.iter().find(of).unwrap().measured[0].value
    };
    // (1 − d)/d · g sin θ/b with d = 0.95 and b = 2/(0.95 · 0.02 s), in µm/s: the impedance is a
    // little less.
    let creep = 1e6 * (0.05 / 0.95) * G * 20f64.to_radians().sin() * (0.95 * 0.02 / 2.0);
    assert!((mujoco("creep") / creep - 1.0).abs() < 0.1, "{} beside {creep}", mujoco("creep"));
    // What leaves the ground with μ v rises by (μ v)²/2g; a softened contact leaves a part of that.
    let highest = 1e3 * (0.5f64 * 6.0).powi(2) / (2.0 * G);
    assert!((0.01..1.0).contains(&(mujoco("lift") / highest)), "{}", mujoco("lift"));
}

#[test]
fn mujoco_solves_what_it_poses_so_that_what_it_misses_is_missed_by_the_model() {
    let record = shipped();
    let frames = || record.frames.iter().filter(|frame| frame.engine == "mujoco");
    assert!(frames().count() >= 3);
    assert!(frames().all(|frame| frame.verdict == "proved"), "{:?}", record.frames);
    let (plan, missed) = (Plan::default(), phenomenon(&record, "creep"));
    let of = |own: &&Column| own.engine == "mujoco" && own.settings == "defaults";
    assert!(!missed.columns.iter().find(of).unwrap().holds());
    let document = ReportPage::of(&plan, std::slice::from_ref(&record));
    let (_, table) = document.tables.iter().find(|(id, _)| id == "cards_frames").unwrap();
    assert_eq!(table.rows.len(), record.frames.len());
}

/// Each run of an external engine that violates a law says which part of it is the solver's, or why
/// that is not known; the page shows it in the row of the violation and of no other.
#[test]
fn each_violated_law_of_another_engine_names_the_solvers_part() {
    let (plan, record) = (Plan::default(), shipped());
    let document = ReportPage::of(&plan, std::slice::from_ref(&record));
    let mut checked = 0;
    for phenomenon in &record.phenomena {
        let others = phenomenon.columns.iter().filter(|own| own.engine != "lcplab");
        for own in others.filter(|own| !own.measured.is_empty()) {
            assert!(own.solver.is_some(), "{}: {} {}", phenomenon.name, own.engine, own.settings);
            checked +=
                usize::from(matches!(own.solver, Some(SolverPart::Checked { steps: 1.., .. })));
        }
        let id = format!("cards_{}", phenomenon.name);
        let (_, table) = document.tables.iter().find(|(own, _)| *own == id).unwrap();
        for row in &table.rows {
            let (engine, verdict, part) = (&row[0], &row[6], &row[7]);
            let is_violated = verdict.text.ends_with('×') || verdict.text == "no end";
            let is_named = !part.text.is_empty() && part.text != "–";
            let is_other = engine.text != "lcplab";
            assert_eq!(is_named, is_violated && is_other, "{}: {}", phenomenon.name, part.text);
        }
    }
    assert!(checked > 100, "{checked}");
    // MuJoCo's creep is the model's: its solver is right to a millionth of each step.
    let creep = &phenomenon(&record, "creep").columns;
    let of = |own: &&Column| own.engine == "mujoco" && own.settings == "defaults";
    let Some(SolverPart::Checked { above: 0, error, .. }) = creep.iter().find(of).unwrap().solver
    else {
        panic!("checked");
    };
    assert!(error < 1e-6);
    // PyBullet stops after fifty sweeps, which its own laws of rows show.
    let of = |own: &&Column| own.engine == "pybullet" && own.settings == "defaults";
    let weight = phenomenon(&record, "weight").columns.iter().find(of).unwrap();
    assert!(matches!(weight.solver, Some(SolverPart::Checked { above: 1.., is_bound: false, .. })));
}

/// The verdict on an engine's own answer, under the friction model of its problem.
fn verdict(frame: &Frame) -> Verdict {
    let (problem, demand) =
        (frame.problem().unwrap(), Demand { tolerance: 1e-6, ..Demand::default() });
    let question = Question::new(&problem, None, "engines.json").unwrap();
    JudgedAnswer::of(&question, &frame.answer, &demand).certificate.verdict
}

#[test]
fn the_judge_says_of_an_engines_answer_what_the_record_says() {
    for frame in &shipped().frames {
        let verdict = verdict(frame);
        assert_eq!(verdict.word(), frame.verdict, "{} {}", frame.engine, frame.phenomenon);
        if let Verdict::NotASolution { row, .. } = verdict {
            assert_eq!(Some(row), frame.row, "{} {}", frame.engine, frame.phenomenon);
            assert!(frame.missed > Some(0.0) && frame.problem["rows"][row]["label"].is_string());
        }
    }
}

/// A is definite and no row coupled: there is one solution, and the engine stops a millionth of it
/// off.
#[test]
fn the_default_solver_finds_what_an_engine_finds_where_there_is_one_solution() {
    let frames = shipped().frames;
    let alone = frames.iter().filter(|frame| ["mujoco", "drake", "dart"].contains(&&*frame.engine));
    for frame in alone {
        let lcp = frame.problem().unwrap().lcp;
        let solver =
            Registry::standard().entry(default_for(&lcp)).unwrap().build(&Options::default());
        let own = solver.solve(&lcp, &Start::default(), &mut ()).x;
        let most = own.iter().fold(0.0, |most, x| f64::max(most, x.abs()));
        for (own, theirs) in own.iter().zip(&frame.answer) {
            let name = (&frame.engine, &frame.phenomenon);
            assert!((own - theirs).abs() < 1e-4 * most, "{name:?}: {own} {theirs}");
        }
    }
}

#[test]
fn every_scene_of_the_record_is_one_and_every_curve_has_a_value_for_each_x() {
    for phenomenon in &shipped().phenomena {
        scene(phenomenon);
        for own in phenomenon.columns.iter().filter(|own| !own.measured.is_empty()) {
            assert_eq!(own.y.len(), phenomenon.x.values.len(), "{}", phenomenon.name);
        }
    }
}

#[test]
fn the_page_has_a_row_a_phenomenon_and_a_column_an_engine_and_every_miss_is_a_number() {
    let (plan, record) = (Plan::default(), shipped());
    let headline = plan.headline(std::slice::from_ref(&record));
    let matrix = headline.figure.unwrap();
    assert!(matrix.svg().contains(">accurate settings</text>"));
    let csv = matrix.csv();
    for law in &record.phenomena {
        let is_installed = |own: &&Column| own.engine != "lcplab" && own.settings == "defaults";
        for own in law.columns.iter().filter(is_installed) {
            let (name, engine) = (law.name.replace('_', " "), record.title(&own.engine));
            let start = format!("{name},as installed,{engine},");
            let value = csv.lines().find_map(|line| line.strip_prefix(&start)).unwrap();
            let is_number = value.parse::<f64>().is_ok_and(|own| own > 0.0 && own.is_finite());
            assert_eq!(is_number, !own.measured.is_empty() && !own.holds(), "{start}");
        }
    }
    assert!(headline.answer.unwrap().contains("laws of mechanics"));
    let (_, uses) = headline.table.unwrap();
    let uses: String = uses.rows.iter().map(|row| row[0].text.as_str()).collect();
    for use_ in [
        "A gripper",
        "A tower",
        "A mechanism",
        "Flight",
        "Rolling and sliding",
        "Throws and impacts",
        "Learning and optimization",
    ] {
        assert!(uses.contains(use_), "{uses}");
    }
}

#[test]
fn a_file_that_is_no_record_is_one_message_with_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let of = |text: &str| {
        let file: PathBuf = folder.path().join("record.json");
        std::fs::write(&file, text).unwrap();
        let plan = Plan { record: Some(file) };
        plan.run(0, Registry::standard()).unwrap_err().to_string()
    };
    let newer = of(r#"{ "format": 2, "engines": [], "phenomena": [] }"#);
    assert!(
        newer.ends_with("record.json: record: has the format 2; this version reads 1"),
        "{newer}"
    );
    let lacking = of(r#"{ "format": 1, "engines": [] }"#);
    assert!(lacking.contains("missing field `phenomena`"), "{lacking}");
}

//! Other engines beside ours, as they were recorded.

use super::goal::{self, Asked, Goal};
use crate::study::peers::{Answer, Engine, GOALS, Library, Plan, Recording, Scene};
use lcplab::report::page::{Cell, Column, Mark, Table};
use lcplab::report::view::attempt::{anchor, listed, tolerance};
use lcplab::report::view::{Document, Outcome, View};

/// How to make another recording.
const COMMAND: &str = "cd benches/peers && cargo run --release -- --json ../peers.json";

impl View for Plan {
    const TITLE: &'static str = "Other engines";

    fn show(&self, recordings: &[Recording], document: &mut Document) {
        for recording in recordings {
            document.text(words(recording));
            let goals: Vec<Goal> = GOALS.iter().map(|goal| asked(recording, goal)).collect();
            let table = goal::table("Beside other engines: goals", COMMAND, &goals);
            document.table("peers_goals", table);
            document.table("peers_problems", problems(recording));
            for scene in &recording.scenes {
                document.table(&format!("peers_{}", anchor(&scene.name)), engines(scene));
            }
        }
    }

    fn outcome(&self, recordings: &[Recording]) -> Outcome {
        let ours = || {
            recordings.iter().flat_map(|r| &r.problems).flat_map(|p| &p.answers).filter(|a| a.ours)
        };
        let answered = ours().filter(|answer| answer.time.is_some()).count();
        let says = format!(
            "recorded beside other engines: {answered} of our {} runs answered",
            ours().count()
        );
        Outcome { good: answered == ours().count(), says }
    }
}

/// Where the numbers come from.
fn words(recording: &Recording) -> String {
    let machine = &recording.machine;
    let version = |library: &Library| {
        library.version.as_ref().map(|version| format!("{} {version}", library.name))
    };
    let present: Vec<String> = recording.libraries.iter().filter_map(version).collect();
    let absent = recording.libraries.iter().filter(|library| library.version.is_none());
    let absent: Vec<&str> = absent.map(|library| library.name.as_str()).collect();
    let skipped = match absent.is_empty() {
        true => String::new(),
        false => format!(" Not installed, and so skipped: {}.", listed(&absent)),
    };
    format!(
        "*A recording, not a measurement of this report*: the engines are no part of this program. Made on {}, \
         on {} ({} threads, one used), {}, {}, with {}.{skipped} For another one: `{COMMAND}`. All got the \
         same numbers, in turns, in one process. Every answer was looked at before its time counted: ours \
         by the judge at 1e-9, those of peers at 1e-6, since single digits are not what is compared. Clarabel was asked for as \
         little as takes it to 1e-9.",
        recording.date,
        machine.processor,
        machine.threads,
        machine.system,
        machine.compiler,
        listed(&present),
    )
}

fn asked(recording: &Recording, goal: &crate::study::peers::Goal) -> Goal {
    let ours = goal.ours.unwrap_or("the fastest of ours");
    let peer = if goal.peer.is_empty() { "the fastest peer" } else { goal.peer };
    Goal {
        what: format!("{}: {ours} beside {peer}", goal.problem),
        asked: Asked::AtLeast(goal.faster),
        unit: "times as fast",
        measured: recording.faster(goal),
    }
}

/// A row an answer.
fn problems(recording: &Recording) -> Table {
    let row = |name: &str, rows: usize, answer: &Answer| {
        let residual = answer.residual.map_or("not finite".into(), tolerance);
        let outcome = match (&answer.complaint, answer.time) {
            (_, Some(_)) => Cell::text("answered"),
            (Some(complaint), None) => Cell::text(format!("failed: {complaint}")).marked(Mark::Bad),
            (None, None) => Cell::text("failed, and did not say so").marked(Mark::Bad),
        };
        let milliseconds = |seconds: Option<f64>| {
            seconds.map_or(Cell::text("–"), |seconds| Cell::number(1e3 * seconds, 3))
        };
        vec![
            Cell::text(name),
            Cell::count(rows),
            Cell::text(&answer.contender),
            outcome,
            Cell::text(residual),
            milliseconds(answer.time.map(|time| time.median)),
            milliseconds(answer.time.map(|time| time.best)),
        ]
    };
    let all = recording.problems.iter().flat_map(|problem| {
        problem.answers.iter().map(|answer| row(&problem.name, problem.rows, answer))
    });
    Table {
        title: "Problems in numbers: everybody's answer and time".into(),
        how_to_read: "The scaled residual of x as it was returned. A failing run has no time, however short it \
                      was. Copies of A that a library overwrites are not counted, our own setup is."
            .into(),
        columns: vec![
            Column::words("problem"),
            Column::numbers("rows", ""),
            Column::words("solver"),
            Column::words("outcome"),
            Column::words("residual"),
            Column::numbers("median", "ms"),
            Column::numbers("best", "ms"),
        ],
        rows: all.collect(),
        ..Table::default()
    }
}

fn engines(scene: &Scene) -> Table {
    let row = |engine: &Engine| {
        let millimetres =
            |metres: Option<f64>| metres.map_or(Cell::text("–"), |m| Cell::number(1e3 * m, 2));
        let kept = match engine.step {
            Some(_) => Cell::text("yes").marked(Mark::Good),
            None => Cell::text("no").marked(Mark::Note),
        };
        let step = |seconds: Option<f64>| {
            seconds.map_or(Cell::text("–"), |seconds| Cell::number(1e3 * seconds, 3))
        };
        vec![
            Cell::text(&engine.engine),
            Cell::count(engine.iterations),
            millimetres(engine.reached.map(|reached| reached.penetration)),
            millimetres(engine.reached.map(|reached| reached.drift)),
            kept,
            step(engine.step.map(|step| step.median)),
            step(engine.step.map(|step| step.best)),
        ]
    };
    Table {
        title: format!("{}: a step, at equal penetration and drift", scene.name),
        how_to_read: format!(
            "{} cubes of 1 m and 1 kg at rest, steps of {} ms. Each engine has as few iterations as keep, after {} s, the \
             deepest overlap within {} mm and every centre within {} mm of its place; what an iteration is, \
             each decides for itself. Then the engines step in turns. A step is all that an engine does: collisions, \
             solving, moving.",
            scene.bodies,
            lcplab::number::readable(1e3 * scene.dt, 3),
            scene.after,
            1e3 * scene.bounds.penetration,
            1e3 * scene.bounds.drift,
        ),
        columns: vec![
            Column::words("engine"),
            Column::numbers("iterations", ""),
            Column::numbers("overlap", "mm"),
            Column::numbers("drift", "mm"),
            Column::words("within the bounds"),
            Column::numbers("median", "ms"),
            Column::numbers("best", "ms"),
        ],
        rows: scene.engines.iter().map(row).collect(),
        ..Table::default()
    }
}

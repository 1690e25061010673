//! What a whole step costs, and how that grows.

use super::goal::{self, Asked, Goal};
use crate::study::step_speed::{Finding, Kind, Plan, Times};
use lcplab::plot::{Axis, Lines, Panel, Series};
use lcplab::report::page::{Cell, Column, Mark, Table};
use lcplab::report::view::{Document, Outcome as Verdict, View};
use lcplab::simulation::stepper::Part;

impl View for Plan {
    const TITLE: &'static str = "The whole step";

    fn show(&self, findings: &[Finding], document: &mut Document) {
        document.text(format!(
            "Finding the pairs that are near, the points where they touch, the rows with what they start \
             from, {} sweeps, and the motion: a step of the *stepper*, which forms no matrix, keeps its memory, \
             and gives the motion of a simulation by `pgs`. Row by row in natural order, or eight pairs of \
             bodies at a time from the ground up, on one thread and on two.",
            self.sweeps
        ));
        document.table("steps", standing(findings));
    }

    fn show_times(&self, times: &[Times], document: &mut Document) {
        let goals: Vec<Goal> = [self.first_tower(times), self.threads(times)]
            .into_iter()
            .chain([Kind::Tower, Kind::Net].into_iter().flat_map(|kind| self.growth(kind, times)))
            .collect();
        let (title, command) =
            ("The whole step: goals", "cargo bench -p lcplab-benches --bench step");
        document.table("step_goals", goal::table(title, command, &goals));
        document.figure(figure(times));
        document.table("step_times", seconds(times));
        document.table("step_parts", parts(times));
    }

    fn outcome(&self, findings: &[Finding]) -> Verdict {
        let same = findings.iter().filter(|finding| finding.same_bits).count();
        let says =
            format!("{same} of {} scenes step to the same bits on two threads", findings.len());
        Verdict { good: same == findings.len(), says }
    }
}

impl Plan {
    fn first_tower(&self, times: &[Times]) -> Goal {
        let first = times.iter().find(|times| times.kind == Kind::Tower);
        Goal {
            what: first.map_or("a tower".into(), |times| format!("{}, one thread", times.scene)),
            asked: Asked::AtMost(self.goal.milliseconds),
            unit: "ms a step",
            measured: first.map(|times| 1e3 * times.eight_pairs[0].best),
        }
    }

    fn threads(&self, times: &[Times]) -> Goal {
        let first = times.iter().find(|times| times.kind == Kind::Tower);
        let sweeps = |times: &Times| times.parts.map(|parts| parts[Part::Sweeps as usize].best);
        Goal {
            what: "its sweeps on two threads".into(),
            asked: Asked::AtLeast(self.goal.threads),
            unit: "times as fast as on one",
            measured: first.map(sweeps).map(|[one, two]| one / two),
        }
    }

    /// The power of the contacts with which the time grows: the slope of a line through the logarithms,
    /// by least squares.
    fn growth(&self, kind: Kind, times: &[Times]) -> Option<Goal> {
        let points: Vec<(f64, f64)> = times.iter().filter(|t| t.kind == kind).map(point).collect();
        let what = match kind {
            Kind::Tower => "towers: power of the contacts with which a step grows, one thread",
            Kind::Net => "nets: power of the rods with which a step grows, one thread",
        };
        (points.len() > 1).then(|| Goal {
            what: what.into(),
            asked: Asked::AtMost(self.goal.power),
            unit: "",
            measured: Some(slope(&points)),
        })
    }
}

/// Contacts and milliseconds on one thread.
fn point(times: &Times) -> (f64, f64) {
    (times.contacts as f64, 1e3 * times.eight_pairs[0].best)
}

/// Of ln y by ln x.
fn slope(points: &[(f64, f64)]) -> f64 {
    let logs = || points.iter().map(|&(x, y)| (libm::log(x), libm::log(y)));
    let count = points.len() as f64;
    let (x, y) = logs().fold((0.0, 0.0), |(x, y), (a, b)| (x + a / count, y + b / count));
    let (over, under) =
        logs().fold((0.0, 0.0), |(o, u), (a, b)| (o + (a - x) * (b - y), u + (a - x) * (a - x)));
    over / under
}

fn figure(times: &[Times]) -> Lines {
    let of = |kind: Kind, name: &str, value: fn(&Times) -> f64| {
        let points = times.iter().filter(|times| times.kind == kind);
        let points = points.map(|times| (times.contacts as f64, 1e3 * value(times))).collect();
        Series::measured(name, points)
    };
    Lines {
        id: "step_growth".into(),
        title: "A whole step by its contacts or rods".into(),
        caption: "By the best of the timed steps. Parallel to the dashed line, a step grows as its contacts do; \
                  steeper beyond the size of a cache, where the rows come from memory in every sweep."
            .into(),
        x: Axis::log("contacts or rods", ""),
        panels: vec![Panel {
            y: Axis::log("time of a step", "ms"),
            series: vec![
                of(Kind::Tower, "towers, one thread", |times| times.eight_pairs[0].best),
                of(Kind::Tower, "towers, two threads", |times| times.eight_pairs[1].best),
                of(Kind::Tower, "towers, row by row", |times| times.row_by_row.best),
                of(Kind::Net, "nets, one thread", |times| times.eight_pairs[0].best),
                Series::reference("in proportion", proportional(times)),
            ],
        }],
    }
}

/// From the first point in proportion to the contacts.
fn proportional(times: &[Times]) -> Vec<(f64, f64)> {
    let Some((x, y)) = times.first().map(point) else { return Vec::new() };
    let most = times.iter().map(|times| times.contacts as f64).fold(x, f64::max);
    vec![(x, y), (most, y * most / x)]
}

fn standing(findings: &[Finding]) -> Table {
    let row = |finding: &Finding| {
        let same = match finding.same_bits {
            true => Cell::text("yes").marked(Mark::Good),
            false => Cell::text("no").marked(Mark::Bad),
        };
        vec![
            Cell::text(&finding.scene),
            Cell::count(finding.bodies),
            Cell::count(finding.contacts),
            Cell::count(finding.rows),
            Cell::number(1e3 * finding.deepest, 2),
            Cell::number(finding.bytes as f64 / finding.contacts as f64, 4),
            same,
        ]
    };
    Table {
        title: "Scenes that are stepped".into(),
        how_to_read: "After the timed steps. A contact has three rows, a rod one; the bytes are those of all \
                      arrays that a step keeps: contacts, rows, their order."
            .into(),
        columns: vec![
            Column::words("scene"),
            Column::numbers("bodies", ""),
            Column::numbers("contacts or rods", ""),
            Column::numbers("rows", ""),
            Column::numbers("deepest contact", "mm"),
            Column::numbers("memory of each", "bytes"),
            Column::words("same bits on two threads"),
        ],
        rows: findings.iter().map(row).collect(),
        ..Table::default()
    }
}

fn seconds(times: &[Times]) -> Table {
    let row = |times: &Times| {
        let [one, two] = times.eight_pairs;
        let cells = [times.row_by_row, one, two].map(|time| Cell::number(1e3 * time.best, 3));
        let rest = [
            Cell::number(1e3 * one.median, 3),
            Cell::number(1e9 * one.best / times.rows as f64, 3),
        ];
        [Cell::text(&times.scene), Cell::count(times.contacts)]
            .into_iter()
            .chain(cells)
            .chain(rest)
            .collect()
    };
    Table {
        title: "Time of a whole step".into(),
        columns: vec![
            Column::words("scene"),
            Column::numbers("contacts or rods", ""),
            Column::numbers("row by row, best", "ms"),
            Column::numbers("eight pairs, best", "ms"),
            Column::numbers("on two threads, best", "ms"),
            Column::numbers("eight pairs, median", "ms"),
            Column::numbers("eight pairs, a row", "ns"),
        ],
        rows: times.iter().map(row).collect(),
        ..Table::default()
    }
}

fn parts(times: &[Times]) -> Table {
    let row = |times: &Times| {
        let cells = times.parts[0].map(|time| Cell::number(1e3 * time.best, 3));
        [Cell::text(&times.scene)].into_iter().chain(cells).collect()
    };
    let columns = Part::ALL.map(|part| Column::numbers(part.name(), "ms"));
    Table {
        title: "Where the time of a step goes".into(),
        how_to_read: "Eight pairs at a time, one thread, the best of each part.".into(),
        columns: [Column::words("scene")].into_iter().chain(columns).collect(),
        rows: times.iter().map(row).collect(),
        ..Table::default()
    }
}

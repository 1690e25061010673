//! Who sticks on the ramp, and how fast the others slide.

use super::attempt::listed;
use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::ramp::{Finding, Plan, Slid};

/// An acceleration may differ from the formula by this much (m/s²).
const AGREES: f64 = 1e-3;

impl View for Plan {
    const TITLE: &'static str = "A ramp: who sticks, and how fast the others slide";

    fn show(&self, findings: &[Vec<Finding>], document: &mut Document) {
        let all: Vec<&Finding> = findings.iter().flatten().collect();
        let Some(first) = all.first() else { return };
        document.text(format!(
            "Boxes start at rest on a ramp whose slope is $\\tan\\theta$ = {}. A box sticks if its \
             coefficient of friction is above that; if not, it slides with",
            readable(first.slope, 4)
        ));
        document.equation("a = g\\,(\\sin\\theta - \\mu\\cos\\theta)", "Coulomb");
        document.figure(figure(&all));
        document.figure(speeds(&all));
        document.table("ramp", table(&all));
    }

    fn outcome(&self, findings: &[Vec<Finding>]) -> Outcome {
        let (may_miss, must_agree): (Vec<&Finding>, Vec<&Finding>) =
            findings.iter().flatten().partition(|finding| self.may_miss.contains(&finding.name));
        let ((agree, all), (of_others, others)) = (counted(&must_agree), counted(&may_miss));
        let mut says = format!("{agree} of {all} boxes on the ramp move as the formula says");
        if !may_miss.is_empty() {
            let names: Vec<&str> = may_miss.iter().map(|finding| &*finding.name).collect();
            says +=
                &format!(", {of_others} of {others} under {}, which may miss it", listed(&names));
        }
        let is_whole = must_agree.iter().all(|finding| finding.ending.is_none());
        Outcome { good: agree == all && is_whole, says }
    }
}

/// How many boxes move as the formula says, and how many there are.
fn counted(findings: &[&Finding]) -> (usize, usize) {
    let boxes = || findings.iter().flat_map(|finding| &finding.boxes);
    (boxes().filter(|slid| agrees(slid)).count(), boxes().count())
}

fn agrees(slid: &Slid) -> bool {
    (slid.acceleration - slid.expected).abs() <= AGREES
}

fn figure(findings: &[&Finding]) -> Lines {
    let measured = findings.iter().map(|finding| {
        let points = finding.boxes.iter().map(|slid| (slid.mu, slid.acceleration));
        Series::points(finding.name.clone(), points.collect())
    });
    let most = findings.iter().flat_map(|f| &f.boxes).map(|slid| slid.mu).fold(0.0, f64::max);
    let [sin, cos] = findings[0].pull;
    let line = (0..=100).map(|k| most * f64::from(k) / 100.0);
    let line = line.map(|mu| (mu, (sin - mu * cos).max(0.0))).collect();
    Lines {
        id: "ramp".into(),
        title: "Acceleration of each box down the ramp".into(),
        caption: "A marker each box and way to step the ramp; the line is the formula.".into(),
        x: Axis::linear("coefficient of friction μ", ""),
        panels: vec![Panel {
            y: Axis::linear("acceleration", "m/s²"),
            series: measured.chain([Series::theory("theory", line)]).collect(),
        }],
    }
}

/// The speeds of the box that sticks by least, on an axis of its own.
fn speeds(findings: &[&Finding]) -> Lines {
    let sticks = |finding: &Finding| {
        let boxes = finding.boxes.iter().filter(|slid| slid.expected == 0.0);
        boxes.min_by(|a, b| a.mu.total_cmp(&b.mu)).cloned()
    };
    let curve = |finding: &&Finding| {
        let slid = sticks(finding)?;
        let points = slid.speeds.iter().map(|(time, speed)| (*time, 1e3 * speed)).collect();
        Some(Series::measured(finding.name.clone(), points))
    };
    let mu = sticks(findings[0]).map_or(f64::NAN, |slid| slid.mu);
    Lines {
        id: "ramp_creep".into(),
        title: format!("The box that just sticks, μ = {}", readable(mu, 4)),
        caption:
            "Its speed must stay 0. What creeps has friction that needs some slip before it holds, \
                  or sweeps that end early."
                .into(),
        x: Axis::linear("time", "s"),
        panels: vec![Panel {
            y: Axis::linear("speed down the ramp", "mm/s"),
            series: findings.iter().filter_map(curve).collect(),
        }],
    }
}

fn table(findings: &[&Finding]) -> Table {
    let mut columns = vec![Column::words("stepped by")];
    let boxes = &findings[0].boxes;
    columns.extend(
        boxes.iter().map(|slid| Column::numbers(format!("μ = {}", readable(slid.mu, 3)), "m/s²")),
    );
    let expected = boxes.iter().map(|slid| Cell::number(slid.expected, 5));
    let mut rows = vec![[Cell::text("theory")].into_iter().chain(expected).collect()];
    rows.extend(findings.iter().map(|finding| {
        let name = match &finding.ending {
            Some(why) => Cell::text(format!("{}: {why}", finding.name)).marked(Mark::Bad),
            None => Cell::text(&finding.name),
        };
        let cell = |slid: &Slid| {
            let shown = if slid.acceleration.abs() < 1e-9 { 0.0 } else { slid.acceleration };
            let mark = if agrees(slid) { Mark::Good } else { Mark::Note };
            Cell { value: Some(slid.acceleration), ..Cell::number(shown, 5) }.marked(mark)
        };
        [name].into_iter().chain(finding.boxes.iter().map(cell)).collect::<Vec<_>>()
    }));
    Table {
        title: "Accelerations on the ramp".into(),
        how_to_read: format!(
            "Speed at the end over the time. A cell is good if it is within {} m/s² of the formula in the \
             first row.",
            readable(AGREES, 1)
        ),
        columns,
        rows,
        ..Table::default()
    }
}

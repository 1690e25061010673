//! How fast a box creeps that should stick.

use super::{Document, Outcome, View};
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::creep::{Finding, Plan};

/// A measured speed may differ from the formula by this part of it.
const AGREES: f64 = 0.01;
/// A box that is slower than this (m/s) does not creep.
const REST: f64 = 1e-6;

impl View for Plan {
    const TITLE: &'static str = "Friction that needs slip never holds";

    fn show(&self, findings: &[Vec<Finding>], document: &mut Document) {
        let all: Vec<&Finding> = findings.iter().flatten().collect();
        document.text(
            "A box lies on a slope that is rough enough to hold it. Where friction is a row of an LCP, it \
             holds. Where it is a force that grows with the slip, $f = -d\\,v$ up to $\\mu N$, the box must \
             move to be held: it creeps for ever, at",
        );
        document.equation(
            "v = \\frac{W \\sin\\theta}{n\\,d} = \\varepsilon\\,\\frac{\\tan\\theta}{\\mu}, \\qquad \
             \\varepsilon = \\frac{\\mu N}{d}",
            "n contacts; ε is the slip that mobilises μN",
        );
        document.text(
            "A shorter step does not help. A larger $d$ does, until the explicit step is too long for it.",
        );
        document.figure(figure(&all));
        document.table("creep", table(&all));
    }

    fn outcome(&self, findings: &[Vec<Finding>]) -> Outcome {
        let all = || findings.iter().flatten();
        let agree = all().filter(|finding| agrees(finding)).count();
        let says =
            format!("{agree} of {} boxes creep as the formula says, or not at all", all().count());
        Outcome { good: agree == all().count(), says }
    }
}

/// Whether the box is as fast as the formula says.
fn agrees(finding: &Finding) -> bool {
    let apart = (finding.speed - finding.expected).abs();
    finding.ending.is_none() && apart <= AGREES * finding.expected + REST
}

fn figure(findings: &[&Finding]) -> Lines {
    let points = |value: fn(&Finding) -> f64| {
        let own = findings.iter().filter_map(|f| Some((f.smoothing?, value(f))));
        own.filter(|point| point.1 > 0.0).collect::<Vec<_>>()
    };
    let series = vec![
        Series::points("penalty", points(|finding| finding.speed)),
        Series::theory("theory: ε tan θ/μ", points(|finding| finding.expected)),
    ];
    Lines {
        id: "creep".into(),
        title: "Creep of a box that should stick".into(),
        caption: "Each marker is a damping d of the penalty method. Other schemes do not smooth \
                  friction; the table has their speeds."
            .into(),
        x: Axis::log("smoothing ε", "m/s"),
        panels: vec![Panel { y: Axis::log("speed down the slope", "m/s"), series }],
    }
}

fn table(findings: &[&Finding]) -> Table {
    Table {
        title: "Creep by scheme".into(),
        how_to_read:
            "The speed at the end of the run. It agrees if it is within 1 % of the formula, or, \
                      where the formula is 0, below 10⁻⁶ m/s."
                .into(),
        columns: vec![
            Column::words("scheme"),
            Column::numbers("d", "N s/m"),
            Column::numbers("ε", "m/s"),
            Column::numbers("speed", "m/s"),
            Column::numbers("expected", "m/s"),
            Column::words("agreement"),
        ],
        rows: findings.iter().map(|finding| cells(finding)).collect(),
        ..Table::default()
    }
}

fn cells(finding: &Finding) -> Vec<Cell> {
    let or_dash = |value: Option<f64>| value.map_or(Cell::text("–"), |v| Cell::number(v, 3));
    let (speed, expected) = (finding.speed, finding.expected);
    let verdict = match &finding.ending {
        Some(why) => Cell::text(why).marked(Mark::Bad),
        None if agrees(finding) => Cell::text("agrees").marked(Mark::Good),
        None if expected == 0.0 => Cell::text("creeps").marked(Mark::Note),
        None => Cell::text("differs").marked(Mark::Bad),
    };
    let shown = if speed.abs() < 1e-12 { 0.0 } else { speed };
    vec![
        Cell::text(&finding.scheme),
        or_dash(finding.damping),
        or_dash(finding.smoothing),
        Cell { value: Some(speed), ..Cell::number(shown, 3) },
        Cell::number(expected, 3),
        verdict,
    ]
}

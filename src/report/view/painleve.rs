//! Painlevé's rod: the friction at which forces run out, and the impulses beyond it.

use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Lines, Panel, Series};
use crate::report::page::{Cell, Column, Mark, Table};
use crate::report::study::painleve::{Finding, Forces, Plan};

impl View for Plan {
    const TITLE: &'static str = "Painlevé's rod: where forces have no answer";

    fn show(&self, findings: &[Vec<Finding>], document: &mut Document) {
        let all: Vec<&Finding> = findings.iter().flatten().collect();
        let Some(first) = all.first() else { return };
        document.text(
            "Push a piece of chalk ahead of the hand and it stutters. A rod slides on the ground with its \
             lower end ahead; friction at that end turns it into the ground. A normal force $f$ with its \
             friction $\\mu f$ moves the end by",
        );
        document.equation(
            "a_n = A f, \\qquad m A = 1 + \\frac{m}{I}\\, r_x (r_x + \\mu r_z)",
            "the end at r from the middle",
        );
        document.text(format!(
            "with $r_x$ ahead of the middle and $r_z < 0$ below it; so the force that keeps the end from sinking in is \
             $f = m g / (m A)$. It grows with friction, and beyond $\\mu^*$ = {} $A$ is negative: the harder the ground \
             pushes, the faster the end sinks in. At *acceleration* level there is then no solution, and a vector \
             proves it in exact arithmetic. At *velocity* level there is one: within a single step the end is stopped \
             as if it had hit something, by {} times the impulse of the weight. Nothing did hit it. It is as much as \
             it takes to end the slip within the step, so that from there on more friction changes nothing. That is \
             why rigid bodies with dry friction are stepped with impulses.",
            readable(first.critical, 4),
            readable(all.iter().map(|finding| finding.expected).fold(0.0, f64::max), 3)
        ));
        document.figure(figure(&all));
        document.table("painleve", table(&all));
    }

    fn outcome(&self, findings: &[Vec<Finding>]) -> Outcome {
        let all = || findings.iter().flatten();
        let right = all().filter(|finding| agrees(finding)).count();
        let says = format!(
            "{right} of {} rods have the forces and impulses that geometry says",
            all().count()
        );
        Outcome { good: right == all().count(), says }
    }
}

/// Numbers that differ by this part are the same; the rod is narrow, not flat.
const SAME: f64 = 1e-5;

/// Forces exist below μ*, and none beyond; they and the impulses are those of geometry.
fn agrees(finding: &Finding) -> bool {
    let is_expected = |found: f64| (found / finding.expected - 1.0).abs() <= SAME;
    let forces = match finding.forces {
        Forces::Found(force) => finding.mobility > 0.0 && is_expected(force),
        Forces::Impossible => finding.mobility < 0.0,
        Forces::Failed(_) => false,
    };
    forces && is_expected(finding.impulse)
}

fn figure(findings: &[&Finding]) -> Lines {
    let points = |value: &dyn Fn(&Finding) -> Option<f64>| {
        findings.iter().filter_map(|f| Some((f.mu, value(f)?))).collect::<Vec<_>>()
    };
    let found = |finding: &Finding| match finding.forces {
        Forces::Found(force) => Some(force),
        _ => None,
    };
    let critical = findings.first().map_or(f64::NAN, |finding| finding.critical);
    let top = findings.iter().map(|f| f.impulse).fold(1.0, f64::max);
    let border =
        |from: f64, to: f64| Series::reference("μ*", vec![(critical, from), (critical, to)]);
    Lines {
        id: "painleve".into(),
        title: "The normal force and impulse of the first step".into(),
        caption: "Below: how the end answers to being pushed. Above: the force that acceleration level \
                  finds, as long as there is one, and the impulse of velocity level, per step; 1 is what \
                  the weight gives in a step."
            .into(),
        x: Axis::linear("coefficient of friction μ", ""),
        panels: vec![
            Panel {
                y: Axis::log("normal force, in weights", ""),
                series: vec![
                    Series::points("acceleration", points(&found)),
                    Series::points("velocity", points(&|f| Some(f.impulse))),
                    border(0.1, 10.0 * top),
                ],
            },
            Panel {
                y: Axis::linear("m A", ""),
                series: vec![
                    Series::measured("m A by geometry", points(&|f| Some(f.mobility))),
                    border(-10.0, 10.0),
                ],
            },
        ],
    }
}

fn table(findings: &[&Finding]) -> Table {
    let cells = |finding: &&Finding| {
        let forces = match &finding.forces {
            Forces::Found(force) => Cell::text(format!("{} weights", readable(*force, 4))),
            Forces::Impossible => Cell::text("none, proved"),
            Forces::Failed(why) => Cell::text(why).marked(Mark::Bad),
        };
        vec![
            Cell::number(finding.mu, 4),
            Cell::number(finding.mobility, 3),
            Cell::number(finding.expected, 4),
            forces,
            Cell::number(finding.impulse, 4),
            Cell::number(finding.speed, 4),
            match agrees(finding) {
                true => Cell::text("as geometry says").marked(Mark::Good),
                false => Cell::text("differs").marked(Mark::Bad),
            },
        ]
    };
    Table {
        title: "The rod's first step at both levels".into(),
        how_to_read: "*m A* comes from the rod's geometry alone; forces must exist where it is positive and \
                      not where it is negative. *by geometry*: $1/(m A)$; where such a force would end the slip within the \
                      step, what just ends it. Beyond $\\mu^*$ acceleration level, which begins with the slip, \
                      finds no force for it, and velocity level the one that ends it. *speed*: of the rod's middle after the step, in parts of that before. The rod \
                      is as narrow as a blade here: of a wide one either lower corner may carry all, and neither \
                      force nor impulse is unique."
            .into(),
        columns: vec![
            Column::numbers("μ", ""),
            Column::numbers("m A", ""),
            Column::numbers("by geometry", "weights × dt"),
            Column::words("force at acceleration level"),
            Column::numbers("impulse at velocity level", "weights × dt"),
            Column::numbers("speed", ""),
            Column::words("agreement"),
        ],
        rows: findings.iter().map(cells).collect(),
        ..Table::default()
    }
}

//! The residual of each row after each sweep, as shades.

use super::attempt::section_id;
use super::{Document, Outcome, View};
use crate::number::readable;
use crate::plot::{Axis, Heat, Shaded};
use crate::report::study::residual_map::{Map, Method, Plan};

/// A residual (m/s) up to this is rounding.
const ROUNDING: f64 = 1e-14;

impl View for Plan {
    const TITLE: &'static str = "How news travels through a stack";

    fn show(&self, maps: &[Map], document: &mut Document) {
        document.text(format!(
            "{} bodies have fallen for one step. All of them move at the same speed, so at the start \
             only the lowest contact closes, and it asks for the impulse that stops one body: the weight \
             of the others is news that has to climb. A row that has heard nothing has nothing to do.",
            self.bodies
        ));
        document.figure(self.figure(section_id(document), maps));
        document.text(self.words(maps));
    }

    fn outcome(&self, _: &[Map]) -> Outcome {
        Outcome::undecided()
    }
}

impl Plan {
    fn figure(&self, id: String, maps: &[Map]) -> Heat {
        let panel = |map: &Map| {
            let name = match map.method {
                Method::BestSor => format!("{} = {}", map.method.name(), readable(map.omega, 4)),
                method => method.name().to_string(),
            };
            Shaded { name, rows: map.residuals.clone() }
        };
        Heat {
            id,
            title: format!("The residual of {} rows, sweep by sweep", self.bodies),
            caption: "Each small square is a row after a sweep, the ground's contact at the bottom. \
                      White is a residual of 0. Top-down there is a white wedge of rows that have not \
                      heard yet, and news climbs one row a sweep; from the ground up it reaches the top in \
                      the first sweep, halved in each row (the row swept last is always satisfied). Then \
                      all rows fade together, and slowly. With the best ω the news comes back: a dark front \
                      starts at the top and runs down one row a sweep, and behind it the residual is \
                      lower. Jacobi's rows act in turns, every other sweep."
                .into(),
            across: "sweep".into(),
            upwards: "contact, from the ground up".into(),
            value: Axis::log("residual", "m/s"),
            zero: ROUNDING,
            panels: maps.iter().map(panel).collect(),
        }
    }

    fn words(&self, maps: &[Map]) -> String {
        let largest = |map: &Map| {
            let last = map.residuals.iter().filter_map(|row| row.last());
            last.copied().fold(0.0, f64::max)
        };
        // In a sweep from the ground up the top row has heard, and has answered.
        let heard = |map: &Map| {
            let top = map.residuals.iter().rev().nth(1)?;
            top.iter().position(|residual| *residual > ROUNDING)
        };
        let of = |map: &Map| {
            let arrives = heard(map).map_or("never".into(), |sweep| format!("after sweep {sweep}"));
            format!(
                "- *{}*: the contact below the top one first hears of the ground {arrives}; after sweep {} the largest \
                 residual is {} m/s.",
                map.method.name(),
                self.sweeps,
                readable(largest(map), 2)
            )
        };
        maps.iter().map(of).collect::<Vec<_>>().join("\n")
    }
}

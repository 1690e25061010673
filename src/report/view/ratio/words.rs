//! What came out for the stack in question, in words.

use super::by_cost;
use crate::number::{count, readable};
use crate::report::study::attempt::{Attempt, Outcome};
use crate::report::study::ratio::{Plan, Stack, Tried};
use crate::report::view::attempt::{iterations_in_words, listed, rough, tolerance};
use crate::solver::Group;

impl Plan {
    /// What came out for the chosen stack, in words.
    pub(super) fn words(&self, stack: &Stack, stacks: &[Stack]) -> String {
        let solved = by_cost(stack);
        let last = self.tolerances.last().copied().unwrap_or(0.0);
        let mut text = format!(
            "**Which solver for {} boxes with a mass ratio of {}?** ",
            self.boxes,
            readable(stack.ratio, 3)
        );
        let proved = solved.iter().filter(|attempt| attempt.outcome == Outcome::Proved).count();
        text += &format!(
            "{} of {} solvers solved it to {}, all of these accepted by the judge, {proved} proved. ",
            solved.len(),
            stack.tried.iter().filter_map(Tried::last).filter(|a| a.outcome.is_attempt()).count(),
            tolerance(last)
        );
        let first = |group: Group| {
            solved.iter().find(|attempt| Group::of(&attempt.solver) == Some(group)).copied()
        };
        let best: Vec<String> = Group::ALL.into_iter().filter_map(first).map(cost).collect();
        if !best.is_empty() {
            text += &format!("The cheapest of each kind: {}. ", listed(&best));
        }
        text += &self.growth(stack, stacks);
        let failed: Vec<String> = stack
            .tried
            .iter()
            .filter_map(Tried::last)
            .filter(|attempt| !attempt.outcome.is_solved())
            .map(|attempt| format!("*{}* ({})", attempt.solver, attempt.outcome.words()))
            .collect();
        text + &match failed.is_empty() {
            true => {
                format!("With {} iterations at most nobody failed.", count(self.max_iterations))
            }
            false => format!("Without an answer: {}.", listed(&failed)),
        }
    }

    /// Why: how the sweeps of Gauss-Seidel and the pivots of Dantzig's method grow with the ratio.
    fn growth(&self, stack: &Stack, stacks: &[Stack]) -> String {
        let even = stacks
            .iter()
            .filter(|s| s.system == stack.system && s.ratio < stack.ratio)
            .min_by(|a, b| a.ratio.total_cmp(&b.ratio));
        let Some(even) = even else { return String::new() };
        let times = |solver: &str| {
            let of = |stack: &Stack| {
                let tried = stack.tried.iter().find(|tried| tried.solver() == solver)?;
                Some(tried.last().filter(|attempt| attempt.outcome.is_solved())?.iterations)
            };
            Some((of(even)?, of(stack)?))
        };
        let told = |solver: &str| {
            let (before, after) = times(solver)?;
            Some(format!(
                "*{solver}* takes {} at r = {} and {} here",
                iterations_in_words(solver, before),
                readable(even.ratio, 3),
                count(after)
            ))
        };
        let told: Vec<String> = ["pgs", "dantzig"].into_iter().filter_map(told).collect();
        if told.is_empty() {
            String::new()
        } else {
            format!("The reason: {}. ", told.join(", while "))
        }
    }

    /// What the first precision is worth.
    pub(super) fn loose(&self, stack: &Stack) -> String {
        let pgs = stack.tried.iter().find(|tried| tried.solver() == "pgs");
        let first = pgs.and_then(|tried| Some((tried.attempts.first()?, *tried.missing.first()?)));
        match (first, self.tolerances.first()) {
            (Some((attempt, Some(missing))), Some(first)) if attempt.outcome.is_solved() => {
                format!(
                    "A looser precision is no way out: at {} *pgs* stops after {}, with {} % of the weight \
                 not carried. ",
                    tolerance(*first),
                    iterations_in_words("pgs", attempt.iterations),
                    readable(100.0 * missing, 2)
                )
            }
            _ => String::new(),
        }
    }
}

/// Who is cheapest, and who comes near: `*dantzig* is the cheapest (60 pivots, 12 000 multiplications)`.
pub(super) fn cheapest(solved: &[&Attempt]) -> String {
    let Some((least, others)) = solved.split_first() else { return "nobody solved it".into() };
    let near = others.iter().filter(|attempt| attempt.work <= NEAR * least.work);
    let near: Vec<String> = near.map(|attempt| format!("*{}*", attempt.solver)).collect();
    let within = match near.is_empty() {
        true => "no other one comes within ten times that".to_string(),
        false => format!(
            "within ten times that {} {}",
            if near.len() == 1 { "is" } else { "are" },
            listed(&near)
        ),
    };
    format!(
        "*{}* is the cheapest ({}, {} multiplications); {within}",
        least.solver,
        iterations_in_words(&least.solver, least.iterations),
        rough(least.work)
    )
}

/// A solver comes near the cheapest one if it takes at most so many times its multiplications, which are leading terms.
const NEAR: f64 = 10.0;

/// `*dantzig* with 60 pivots (12 000 multiplications, proved)`.
fn cost(attempt: &Attempt) -> String {
    format!(
        "*{}* with {} ({} multiplications, {})",
        attempt.solver,
        iterations_in_words(&attempt.solver, attempt.iterations),
        rough(attempt.work),
        attempt.outcome.words()
    )
}

//! Explains one LCP of a step: its origin, the law of friction, the solver, the answer or why there
//! is none.

use super::answer::{self, Reading};
use super::solve::{self, Solved};
use super::units::Units;
use super::{Method, derivation, friction, refutation, setup};
use lcplab_judge::ray::Farkas;
use lcplab_lcp::error::Result;
use lcplab_lcp::friction::ProblemForm;
use lcplab_mechanics::formulation::{Posing, Problem};
use lcplab_mechanics::scene::Scene;
use lcplab_mechanics::simulation::Solve;
use lcplab_page::document::Document;
use lcplab_solver::Solution;

/// Answers that differ by less than this part of the largest x are the same.
const SAME: f64 = 1e-9;

/// How the solve of an LCP ended.
#[derive(Clone, Copy)]
pub(super) enum Ending<'a> {
    /// With an answer, accepted or not.
    ExplainedAnswer,
    /// The simulation knows that there is none, by this vector; without one, all active sets were
    /// tried.
    Impossible(Option<&'a Farkas>),
}

/// An LCP of a step, to be explained at this place in a document.
pub(super) struct Single<'a> {
    pub scene: &'a Scene,
    pub method: &'a Method,
    pub own: &'a Solve,
    pub place: &'a str,
    /// The LCP of the same step that was explained before it.
    pub before: Option<&'a Problem>,
    /// Whether the document explains an LCP before this one.
    pub is_again: bool,
}

impl Single<'_> {
    /// Adds its sections.
    pub fn explain(&self, document: &mut Document, ending: Ending) -> Result<()> {
        let Single { scene, own, place, .. } = *self;
        let problem = &own.problem;
        let posing = own.posing.as_ref();
        document.add(place, setup::rows(scene, problem, posing, self.is_again));
        let units = Units::of(problem);
        document.add(place, derivation::newton_to_lcp(scene, problem, self.before, posing, &units));
        let is_accepted = match posing {
            None => self.boxed(document, ending)?,
            Some(posing) => self.posed(document, posing)?,
        };
        document.is_accepted &= is_accepted;
        if matches!(ending, Ending::ExplainedAnswer) {
            document.add(place, derivation::motion(problem, &own.solution.x, scene.step.dt));
        }
        Ok(())
    }

    /// The LCP itself; returns whether the judge accepts the answer.
    fn boxed(&self, document: &mut Document, ending: Ending) -> Result<bool> {
        let reading = self.reading();
        match ending {
            Ending::ExplainedAnswer => self.answered(document, &reading),
            Ending::Impossible(proof) => {
                let Solved { section, .. } =
                    solve::by_suitable(&reading, self.method, Some(&self.own.start))?;
                document.add(self.place, section);
                document.add(self.place, refutation::section(&reading, proof));
                Ok(false)
            }
        }
    }

    /// The LCP under another law of friction.
    fn posed(&self, document: &mut Document, posing: &Posing) -> Result<bool> {
        match &posing.posed {
            ProblemForm::Boxed(frozen) => {
                let at = posing.frozen_at.as_deref().unwrap_or(&self.own.start);
                let reading = Reading { lcp: frozen, ..self.reading() };
                document.add(self.place, friction::frozen(&reading, &self.own.problem.lcp, at));
                self.answered(document, &reading)
            }
            ProblemForm::Polyhedral(polygons) => {
                friction::polygons(&self.under_friction(), document, polygons)
            }
            ProblemForm::Cone(cones) => friction::cones(&self.under_friction(), document, cones),
        }
    }

    /// The answer to a polygon or a cone.
    fn under_friction(&self) -> friction::ExplainedAnswer<'_> {
        friction::ExplainedAnswer {
            place: self.place,
            method: self.method,
            rows: self.reading(),
            answer: &self.own.solution,
            solver: &self.own.solver,
            start: Some(&self.own.start),
        }
    }

    /// The solver at work, its answer, or the reason why there is none.
    fn answered(&self, document: &mut Document, reading: &Reading) -> Result<bool> {
        let own = &self.own.solution;
        let Solved { mut section, solution } =
            solve::by_suitable(reading, self.method, Some(&self.own.start))?;
        let largest = own.x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
        let differs = |(a, b): (&f64, &f64)| (a - b).abs() > SAME * largest;
        if solution.x.iter().zip(&own.x).any(differs) {
            section
                .say(format!("The simulation came to its answer in another way: {}.", own.status));
        }
        document.add(self.place, section);
        let (section, is_accepted) = answer::section(reading, own, &self.method.demand());
        document.add(self.place, section);
        self.refuted(document, reading, &solution);
        Ok(is_accepted)
    }

    /// A proof that there is no answer, if the solver ended on a ray that proves it.
    pub fn refuted(&self, document: &mut Document, reading: &Reading, solution: &Solution) {
        if let Some(proof) = refutation::of(reading.lcp, solution) {
            document.add(self.place, refutation::section(reading, Some(&proof)));
        }
    }

    /// The problem's own LCP with the meaning of its rows.
    pub fn reading(&self) -> Reading<'_> {
        let problem = &self.own.problem;
        let labels = setup::labels(self.scene, &problem.assembly.rows);
        let is_again = self.is_again;
        Reading { lcp: &problem.lcp, labels, units: Units::of(problem), is_again }
    }
}

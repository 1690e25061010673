//! Friction problems in `solve` and `judge`: which model, and what is printed.

use std::path::Path;

use lcplab::certificate::{Demand, Verdict, judge_friction};
use lcplab::error::{Error, Result};
use lcplab::lcp::file::{Problem, number};
use lcplab::lcp::friction::{FrictionProblem, Model, Posed};
use lcplab::report::answer::claim;
use lcplab::report::friction::Judged;
use lcplab::report::methods;
use lcplab::solver::{Method, Options, Status};
use serde_json::{Map, Value, json};

use super::limits::Limits;
use super::problem::outcome;
use super::{Outcome, print};

/// A friction problem under the model it is solved and judged under.
pub struct Friction {
    model: Model,
    problem: FrictionProblem,
    posed: Posed,
}

/// The model to take: the one asked for, else the file's, else Coulomb's law for a solver that is
/// made for cones only. Without any, friction rows are rows of a boxed LCP like others.
pub fn model(asked: Option<Model>, solver: Option<&str>, problem: &Problem) -> Option<Model> {
    let is_for_cones = |name: &&str| {
        methods::entry(name).is_err() && methods::by_name(name, Model::CoulombCone).is_ok()
    };
    let law = solver.filter(is_for_cones).map(|_| Model::CoulombCone);
    asked.or(problem.model).or(law)
}

impl Friction {
    /// The friction problem of a file called `path`.
    pub fn of(problem: &Problem, model: Model, path: &Path) -> Result<Self> {
        let input = path.display().to_string();
        let friction = problem.friction().ok_or_else(|| {
            let reason = format!("is missing: {model} is a model of friction");
            Error::invalid(&input, "friction_index", reason)
        })?;
        let friction = friction.map_err(|error| error.within(&input))?;
        let posed = model.pose(&friction, problem.frozen_at.as_deref());
        let posed = posed.map_err(|error| error.within(&input))?;
        Ok(Friction { model, problem: friction, posed })
    }

    /// Solves it, has the answer judged and prints both.
    pub fn solve(
        &self,
        title: &str,
        method: &Method,
        options: &Options,
        demand: &Demand,
        json: bool,
        limits: &Limits,
    ) -> Result<Outcome> {
        let stop = limits.stop();
        let solution = method.solve(&self.posed, options, &mut stop.watch(&mut ()));
        let stopped = stop.reason().filter(|_| solution.status == Status::Stopped);
        limits.over();
        let judged = Judged::of(&self.problem, &self.posed, &solution.x, demand);
        let judged = judged.with_claim(&self.posed, &solution.status, demand);
        let (word, message) = claim(&solution.status, judged.certificate.refutation(), stopped);
        if json {
            let mut object = Map::new();
            object.insert("status".into(), json!(word));
            object.insert("x".into(), solution.x.iter().map(|&x| number(x)).collect());
            object.insert("iterations".into(), json!(solution.iterations));
            object.insert("solver".into(), json!(method.name()));
            object.insert("message".into(), json!(message));
            self.print_json(object, &judged)?;
        } else {
            let status = if word == message { message } else { format!("{word}: {message}") };
            let solver = format!("solver     {}\n", method.name());
            let status = format!("status     {status}, {} iterations\n", solution.iterations);
            self.print_text(title, &(solver + &status), &judged)?;
        }
        Ok(outcome(&judged.certificate.verdict, stopped))
    }

    /// Judges an answer and prints the verdict.
    pub fn judge(&self, title: &str, x: &[f64], demand: &Demand, json: bool) -> Result<Verdict> {
        let judged = Judged::of(&self.problem, &self.posed, x, demand);
        if json {
            self.print_json(Map::new(), &judged)?;
        } else {
            self.print_text(title, "", &judged)?;
        }
        Ok(judged.certificate.verdict)
    }

    /// The verdict on an answer, and its scaled residual.
    pub fn verdict(&self, x: &[f64], demand: &Demand) -> (Verdict, f64) {
        let certificate = judge_friction(&self.posed, x, demand);
        (certificate.verdict, certificate.scaled_residual)
    }

    fn print_json(&self, mut object: Map<String, Value>, judged: &Judged) -> Result<()> {
        object.insert("model".into(), json!(self.model.to_string()));
        object.extend(judged.json());
        print(&format!("{}\n", Value::Object(object)))
    }

    fn print_text(&self, title: &str, claim: &str, judged: &Judged) -> Result<()> {
        let contacts = self.problem.contacts().len();
        let model = format!("model      {}, {contacts} contacts\n", self.model);
        print(&format!("{title}\n{model}{claim}{}", judged.text()))
    }
}

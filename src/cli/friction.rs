//! Friction problems in `solve` and `judge`.

use lcplab::error::Result;
use lcplab::judge::Demand;
use lcplab::lcp::Question;
use lcplab::lcp::file::number;
use lcplab::number::counted;
use lcplab::report::answer::{attempts_json, attempts_text};
use lcplab::report::friction::{JudgedAnswer, solve as solve_and_judge, solve_by_default};
use lcplab::report::motion_error::MotionError;
use lcplab::solver::{Method, Options, Solution, Status};
use serde_json::{Map, Value, json};

use super::limits::Limits;
use super::problem::{outcome, status_text};
use super::{Outcome, print};

/// Solves a friction problem by a method, or by the fallback sequence without one, judges the
/// answer and prints both; also returns the solution.
pub fn solve(
    question: &Question,
    title: &str,
    method: Option<&Method>,
    options: &Options,
    demand: &Demand,
    json: bool,
    limits: &Limits,
) -> Result<(Outcome, Solution)> {
    let stop = limits.stop();
    let (solver, solution, attempts, judged) = match method {
        Some(method) => {
            let (solution, judged) =
                solve_and_judge(question, method, options, demand, &mut stop.watch(&mut ()));
            (method.name().to_string(), solution, Vec::new(), judged)
        }
        None => {
            let (answered, judged) =
                solve_by_default(question, options, demand, &mut stop.watch(&mut ()));
            (answered.solver, answered.solution, answered.attempts, judged)
        }
    };
    let stopped = stop.reason().filter(|_| solution.status == Status::Stopped);
    limits.over();
    let (word, message) = judged.claim(&solution.status, stopped);
    if json {
        let mut object = Map::new();
        object.insert("status".into(), json!(word));
        object.insert("x".into(), solution.x.iter().map(|&x| number(x)).collect());
        object.insert("iterations".into(), json!(solution.iterations));
        object.insert("solver".into(), json!(solver));
        object.extend(attempts_json(&attempts));
        object.insert("message".into(), json!(message));
        print_json(question, object, &solution.x, &judged)?;
    } else {
        let solver = format!("solver     {solver}\n");
        let status = status_text(word, message);
        let status =
            format!("status     {status}, {}\n", counted(solution.iterations, "iteration"));
        let claim = solver + &status + &attempts_text(&attempts);
        print(&text(question, title, &claim, &solution.x, &judged))?;
    }
    Ok((outcome(&judged.certificate.verdict, stopped), solution))
}

/// Prints the answer's object.
pub fn print_json(
    question: &Question,
    mut object: Map<String, Value>,
    x: &[f64],
    judged: &JudgedAnswer,
) -> Result<()> {
    object.insert("model".into(), json!(question.model().map(|model| model.to_string())));
    object.extend(judged.json());
    object.extend(MotionError::json(question, x));
    print(&format!("{}\n", Value::Object(object)))
}

/// The model, the claim of a solver and the verdict on its answer.
pub fn text(
    question: &Question,
    title: &str,
    claim: &str,
    x: &[f64],
    judged: &JudgedAnswer,
) -> String {
    let model = question.model().zip(question.friction()).map(|(model, friction)| {
        format!("model      {model}, {}\n", counted(friction.contacts().len(), "contact"))
    });
    let model = model.unwrap_or_default();
    let motion = MotionError::text(question, x);
    format!("{title}\n{model}{claim}{}{motion}", judged.text())
}

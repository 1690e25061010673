//! The forces of an answer by pair of bodies, by body and by contact, and which of them are unique.
//!
//! A problem file with the keys `motion`, `rows` and `bodies` says which bodies a row acts between.
//! Jᵀ x of the rows of a pair is the force on its second body in world axes, and the moment about
//! the body's center of mass. An impulse is divided by `dt`: the result is the mean force of the
//! step.
//!
//! Contact forces are often not unique: a table on four legs rests on any forces with the right sum
//! and moments. Therefore each number that an engineer reads has a *range*: the least and the
//! largest value among all forces that cause the same motion and obey the same bounds and friction
//! limits, and its value in the answer with the smallest Σ x² (`range`).

mod range;
mod show;

use std::collections::BTreeMap;

use serde_json::Value;

use lcplab_lcp::file::Problem;
use lcplab_lcp::{Gauss, Level, Question};
use range::Ranges;

/// A force and a moment in world axes.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Wrench {
    /// The force (N), or the impulse (N s) if the file states no `dt`.
    pub force: [f64; 3],
    /// The moment about the body's center of mass (N m or N m s); 0 for point masses.
    pub moment: [f64; 3],
}

/// The values that a force can have without a change of the motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// The least value.
    pub least: f64,
    /// The largest value.
    pub most: f64,
    /// Its value where Σ x² is smallest.
    pub least_norm: f64,
    /// Whether least and most differ by at most a millionth of the largest force.
    pub is_unique: bool,
}

/// The normal force of a contact.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactLoad {
    /// The label of its row.
    pub label: String,
    /// The normal force (N or N s), positive if it pushes.
    pub value: f64,
    /// The force on the body with friction, and its moment.
    pub wrench: Wrench,
    /// The contact's point from the body's center of mass, in world axes (m); without friction
    /// rows the nearest point of the line of action; 0 for point masses.
    pub arm: [f64; 3],
    /// Its range; `None` if it was not examined.
    pub range: Option<Range>,
}

/// What one body does to another.
#[derive(Debug, Clone, PartialEq)]
pub struct PairLoad {
    /// The body that pushes; empty for the world.
    pub by: String,
    /// The body that is pushed.
    pub on: String,
    /// The sum over the rows of the pair; the other body feels the opposite force.
    pub wrench: Wrench,
    /// The part of the force that acts against gravity (N), without gravity its size.
    pub carried: f64,
    /// Its range; `None` if it was not examined.
    pub range: Option<Range>,
    /// Its contacts.
    pub contacts: Vec<ContactLoad>,
}

/// The sum of all forces on a body.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyLoad {
    /// The body.
    pub name: String,
    /// The sum over all rows.
    pub wrench: Wrench,
    /// The weight in world axes (N or N s); `None` if the file states no gravity.
    pub weight: Option<[f64; 3]>,
}

/// The forces of an answer.
#[derive(Debug, Clone, PartialEq)]
pub struct Loads {
    /// "N", or "N s" for impulses.
    pub unit: &'static str,
    /// The pairs of bodies that rows act between, in the order of the rows.
    pub pairs: Vec<PairLoad>,
    /// The movable bodies.
    pub bodies: Vec<BodyLoad>,
    /// Why no range was examined, if that is so.
    pub unexamined: Option<String>,
}

/// A movable body of the file: its columns of J.
struct Body {
    name: String,
    first: usize,
    is_point: bool,
}

impl Loads {
    /// The forces of x. `None` if the file does not state masses, rows and bodies, or if friction
    /// is not that of boxes.
    ///
    /// ```
    /// use lcplab_lcp::Question;
    /// use lcplab_lcp::file::Problem;
    /// use lcplab_analysis::loads::Loads;
    ///
    /// // 2 kg on two supports, as points of the same body: 19.62 N for both.
    /// let text = r#"{"A": {"dense": [[0.5, 0.5], [0.5, 0.5]]}, "b": [-0.0981, -0.0981], "dt": 0.01,
    ///     "rows": [{"label": "left", "kind": "normal", "bodies": ["ground", "load"]},
    ///              {"label": "right", "kind": "normal", "bodies": ["ground", "load"]}],
    ///     "bodies": [{"name": "load", "first": 0, "count": 3}], "gravity": [0, 0, -0.0981],
    ///     "motion": {"mass": [[0, 0, 2], [1, 1, 2], [2, 2, 2]], "jacobian": [[0, 2, 1], [1, 2, 1]],
    ///                "bias": [0, 0], "compliance": [0, 0], "target": [0, 0, -0.0981], "level": "velocity"}}"#;
    /// let question = Question::new(&Problem::parse(text, "supports.json")?, None, "supports.json")?;
    /// let loads = Loads::of(&question, &[0.1962, 0.0]).unwrap();
    /// let pair = &loads.pairs[0];
    /// assert!((pair.carried - 19.62).abs() < 1e-9 && pair.range.unwrap().is_unique);
    /// let left = pair.contacts[0].range.unwrap();
    /// assert!(left.least.abs() < 1e-6 && (left.most - 19.62).abs() < 1e-6);
    /// assert!((left.least_norm - 9.81).abs() < 1e-6);
    /// assert!(loads.text().contains("on load by ground"));
    /// assert_eq!(loads.json()["unit"], "N");
    /// assert_eq!(loads.section().title, "forces by body"); // for a document or a page
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn of(question: &Question, x: &[f64]) -> Option<Loads> {
        let (problem, lcp) = (question.problem(), question.boxed()?);
        let gauss = problem.motion.as_ref()?;
        let bodies = movable(problem)?;
        let (unit, dt) = match (gauss.level, problem.extra.get("dt").and_then(Value::as_f64)) {
            (Some(Level::Velocity), Some(dt)) if dt > 0.0 => ("N", dt),
            (Some(Level::Velocity), _) => ("N s", 1.0),
            (Some(Level::Acceleration), _) => ("N", 1.0),
            (None, _) => return None,
        };
        let gravity = gravity(problem).map(|g| match gauss.level {
            // What gravity adds to a velocity in a step.
            Some(Level::Velocity) => g.map(|g| g / dt),
            _ => g,
        });
        let ranges = Ranges::of(question, x);
        let range = |c: &[(usize, f64)]| ranges.as_ref().ok()?.range(c).map(|range| range.over(dt));
        let pairs = rows_by_pair(problem, &bodies)?.into_iter().map(|pair| {
            let sum = wrench(gauss, &bodies[pair.body], &pair.rows, x, dt);
            let up = direction(gravity, sum.force);
            let along = |&i: &usize| {
                let force = columns(gauss, &bodies[pair.body], i)[0];
                (i, up.iter().zip(force).map(|(u, f)| u * f).sum::<f64>())
            };
            let parts: Vec<(usize, f64)> = pair.rows.iter().map(along).collect();
            let contact = |&i: &usize| {
                let is_friction = |k: &usize| lcp.coupled_to(*k).is_some_and(|(n, _)| n == i);
                let own = pair.rows.iter().copied().filter(|k| *k == i || is_friction(k));
                let own: Vec<usize> = own.collect();
                ContactLoad {
                    label: label(problem, i).unwrap_or_default(),
                    value: x[i] / dt,
                    wrench: wrench(gauss, &bodies[pair.body], &own, x, dt),
                    arm: arm(own.iter().map(|&k| columns(gauss, &bodies[pair.body], k)).collect()),
                    range: range(&[(i, 1.0)]),
                }
            };
            let is_normal = |i: &&usize| kind(problem, **i) == Some("normal");
            PairLoad {
                by: pair.by,
                on: bodies[pair.body].name.clone(),
                wrench: sum,
                carried: parts.iter().map(|(i, part)| part * x[*i]).sum::<f64>() / dt,
                range: range(&parts),
                contacts: pair.rows.iter().filter(is_normal).map(contact).collect(),
            }
        });
        let pairs = pairs.collect();
        let all: Vec<usize> = (0..lcp.len()).collect();
        let sums = bodies.iter().map(|body| BodyLoad {
            name: body.name.clone(),
            wrench: wrench(gauss, body, &all, x, dt),
            weight: gravity.map(|g| g.map(|g| g * mass(gauss, body))),
        });
        let bodies = sums.collect();
        Some(Loads { unit, pairs, bodies, unexamined: ranges.as_ref().err().cloned() })
    }
}

impl Range {
    fn over(self, dt: f64) -> Self {
        let [least, most, least_norm] = [self.least, self.most, self.least_norm].map(|v| v / dt);
        Range { least, most, least_norm, ..self }
    }
}

/// The rows between two bodies.
struct Pair {
    by: String,
    /// The index of the body that the force acts on.
    body: usize,
    rows: Vec<usize>,
}

/// The rows by their pair, in the order of the first row of each. `None` if a row names no movable
/// body.
fn rows_by_pair(problem: &Problem, bodies: &[Body]) -> Option<Vec<Pair>> {
    let mut pairs: Vec<Pair> = Vec::new();
    let mut places = BTreeMap::new();
    for i in 0..problem.lcp.len() {
        let names = problem.extra.get("rows")?.get(i)?.get("bodies")?.as_array()?;
        let names: Vec<&str> = names.iter().map(|name| name.as_str().unwrap_or("")).collect();
        let place = |name: &str| bodies.iter().position(|body| body.name == name);
        // The force on the last movable body.
        let body = names.iter().rev().find_map(|name| place(name))?;
        let by = names.iter().find(|name| **name != bodies[body].name).copied().unwrap_or("");
        let key = (by.to_string(), body);
        let k = *places.entry(key).or_insert_with(|| {
            pairs.push(Pair { by: by.to_string(), body, rows: Vec::new() });
            pairs.len() - 1
        });
        pairs[k].rows.push(i);
    }
    Some(pairs)
}

fn movable(problem: &Problem) -> Option<Vec<Body>> {
    let body = |body: &Value| {
        let count = body.get("count")?.as_u64()?;
        Some(Body {
            name: body.get("name")?.as_str()?.to_string(),
            first: usize::try_from(body.get("first")?.as_u64()?).ok()?,
            is_point: count < 6,
        })
    };
    problem.extra.get("bodies")?.as_array()?.iter().map(body).collect()
}

fn gravity(problem: &Problem) -> Option<[f64; 3]> {
    let all = problem.extra.get("gravity")?.as_array()?;
    let all: Vec<f64> = all.iter().map(Value::as_f64).collect::<Option<_>>()?;
    all.try_into().ok()
}

fn label(problem: &Problem, i: usize) -> Option<String> {
    Some(problem.extra.get("rows")?.get(i)?.get("label")?.as_str()?.to_string())
}

fn kind(problem: &Problem, i: usize) -> Option<&str> {
    problem.extra.get("rows")?.get(i)?.get("kind")?.as_str()
}

/// Against gravity; without gravity along the force; 0 if there is neither.
fn direction(gravity: Option<[f64; 3]>, force: [f64; 3]) -> [f64; 3] {
    let size = |v: [f64; 3]| v.iter().map(|v| v * v).sum::<f64>().sqrt();
    match gravity.filter(|g| size(*g) > 0.0) {
        Some(g) => g.map(|v| -v / size(g)),
        None if size(force) > 0.0 => force.map(|v| v / size(force)),
        None => [0.0; 3],
    }
}

/// The force and the moment on a body from an impulse of 1 in a row.
fn columns(gauss: &Gauss, body: &Body, row: usize) -> [[f64; 3]; 2] {
    let mut both = [[0.0; 3]; 2];
    for &(column, value) in &gauss.jacobian[row] {
        let count = if body.is_point { 3 } else { 6 };
        if let Some(k) = column.checked_sub(body.first).filter(|k| *k < count) {
            both[k / 3][k % 3] += value;
        }
    }
    both
}

/// The point r at which forces along orthogonal unit vectors d have the moments m = r × d.
///
/// Σ d × m is 2 r for three directions, and r − d (d·r) for one. Two leave r's part along both once
/// and the rest twice.
fn arm(rows: Vec<[[f64; 3]; 2]>) -> [f64; 3] {
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| a[k] * b[k]).sum::<f64>();
    let mut sum = [0.0; 3];
    for [d, m] in &rows {
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            sum[k] += d[next] * m[last] - d[last] * m[next];
        }
    }
    match rows[..] {
        [[d, _], [e, _]] => {
            let (along_d, along_e) = (dot(sum, d), dot(sum, e));
            std::array::from_fn(|k| (sum[k] + along_d * d[k] + along_e * e[k]) / 2.0)
        }
        [_, _, _] => sum.map(|part| part / 2.0),
        _ => sum,
    }
}

fn wrench(gauss: &Gauss, body: &Body, rows: &[usize], x: &[f64], dt: f64) -> Wrench {
    let mut sum = Wrench::default();
    for &i in rows {
        let [force, moment] = columns(gauss, body, i);
        for k in 0..3 {
            sum.force[k] += force[k] * x[i] / dt;
            sum.moment[k] += moment[k] * x[i] / dt;
        }
    }
    sum
}

fn mass(gauss: &Gauss, body: &Body) -> f64 {
    let own = |&&(i, j, _): &&(usize, usize, f64)| i == body.first && j == body.first;
    gauss.mass.iter().find(own).map_or(0.0, |(_, _, mass)| *mass)
}

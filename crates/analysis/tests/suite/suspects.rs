//! A solver with a bug is suspected itself, not the scene that it runs on.

use lcplab_analysis::diagnosis::unsupported::{Examination, Slow, examine_scene};
use lcplab_lcp::Lcp;
use lcplab_mechanics::scene::Scene;
use lcplab_solver::{Entry, Method, Observer, Registry, Solution, Solver, Start, Status};

/// The bug in a loop of projected Gauss-Seidel.
#[derive(Debug, Clone, Copy)]
enum Bug {
    /// Nothing.
    None,
    /// Friction is limited by the normal forces of the first sweep.
    FrozenAfterOneSweep,
    /// The increment of a sweep is clamped to the bounds, not the sum.
    ClampedIncrements,
    /// The bound of friction is μ² times the normal force.
    MuSquared,
    /// Friction is left out.
    NoFriction,
    /// It gives no answer.
    Silent,
}

/// A user's solver: this number of sweeps, from x = 0.
struct Own {
    name: &'static str,
    bug: Bug,
    sweeps: usize,
}

impl Own {
    /// The bounds of a row in a sweep; `first` is x after the first one.
    fn bounds(&self, lcp: &Lcp, i: usize, x: &[f64], first: Option<&[f64]>) -> (f64, f64) {
        let Some(coupling) = lcp.coupling() else { return (lcp.lo()[i], lcp.hi()[i]) };
        let Some(normal) = coupling.index(i) else { return (lcp.lo()[i], lcp.hi()[i]) };
        let mu = coupling.mu(i);
        let bound = match (self.bug, first) {
            (Bug::FrozenAfterOneSweep, Some(first)) => mu * first[normal].max(0.0),
            (Bug::MuSquared, _) => mu * mu * x[normal].max(0.0),
            (Bug::NoFriction, _) => 0.0,
            _ => mu * x[normal].max(0.0),
        };
        (-bound, bound)
    }
}

impl Solver for Own {
    fn name(&self) -> &str {
        self.name
    }

    fn solve(&self, lcp: &Lcp, _: &Start<'_>, _: &mut dyn Observer) -> Solution {
        let mut x = vec![0.0; lcp.len()];
        if let Bug::Silent = self.bug {
            let reason = "it says \"IndexError\"".into();
            return Solution::new(lcp, x, Status::NoAnswer { reason }, 0);
        }
        let mut first: Option<Vec<f64>> = None;
        for _ in 0..self.sweeps {
            for i in 0..lcp.len() {
                let (lo, hi) = self.bounds(lcp, i, &x, first.as_deref());
                let change = -lcp.row_w(i, &x) / lcp.matrix().diagonal(i);
                x[i] = match self.bug {
                    Bug::ClampedIncrements => x[i] + change.max(lo).min(hi),
                    _ => (x[i] + change).max(lo).min(hi),
                };
            }
            first.get_or_insert_with(|| x.clone());
        }
        Solution::new(lcp, x, Status::IterationLimit, self.sweeps)
    }
}

/// The solvers, and one with a bug.
fn with_own(name: &'static str, bug: Bug) -> Registry {
    with(Entry::new(name, move |options| {
        Box::new(Own { name, bug, sweeps: options.settings.max_iterations })
    }))
}

/// The solvers, and this one.
fn with(entry: Entry) -> Registry {
    let mut solvers = Registry::default();
    solvers.add(Method::Boxed(entry)).unwrap();
    solvers
}

/// Boxes on each other that are pushed.
fn pushed(boxes: usize, solver: &str, sweeps: usize, solvers: Registry) -> Examination {
    let ground = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    let cube = |k: usize| {
        format!(
            "[[bodies]]\nname = \"box{k}\"\nshape = {{ box = [1, 1, 1] }}\nmass = 1\nposition = [0, 0, {}]\n\
             velocity = [{}, 0, 0]\n",
            0.5 + k as f64,
            k as f64 + 1.0
        )
    };
    let head = format!(
        "[step]\ndt = 0.01\ncount = 10\n[contact]\nfriction = 0.5\n\
         [solver]\nname = {solver:?}\nmax_iterations = {sweeps}\n"
    );
    let text = head + ground + &(0..boxes).map(cube).collect::<String>();
    let mut scene = Scene::from_toml("pushed.toml", &text).unwrap();
    scene.solvers = solvers;
    examine_scene(&scene, None).unwrap()
}

/// The first cause, if it is the solver.
fn suspected(found: &Examination) -> &Slow {
    assert_eq!(found.causes().first(), Some(&"suspect the solver"), "{}", found.headline());
    let cause = &found.unsupported.as_ref().unwrap().causes[0];
    let words = cause.to_string();
    assert!(
        words.starts_with("its error is ") && words.contains("plain projected Gauss-Seidel has "),
        "{words}"
    );
    cause
}

#[test]
fn a_solver_that_is_worse_than_plain_sweeps_is_suspected_first_and_the_scene_is_not() {
    for (name, bug) in [
        ("frozen-bound", Bug::FrozenAfterOneSweep),
        ("clamped-increments", Bug::ClampedIncrements),
        ("mu-squared", Bug::MuSquared),
    ] {
        for sweeps in [1000, 3000] {
            let found = pushed(3, name, sweeps, with_own(name, bug));
            let Slow::Solver { with, plain, .. } = suspected(&found) else { panic!("{name}") };
            assert!(*plain < 0.01 && *with > 2.0 * plain, "{name}: {with} {plain}");
            assert_eq!(found.unsupported.as_ref().unwrap().causes.len(), 1, "{name}");
        }
    }
}

#[test]
fn the_scene_is_blamed_for_no_more_than_plain_sweeps_leave() {
    let mut blamed = 0;
    for (boxes, sweeps) in [(4, 20), (6, 20), (8, 20), (8, 40)] {
        let found = pushed(boxes, "left-out", sweeps, with_own("left-out", Bug::NoFriction));
        let unsupported = found.unsupported.as_ref().unwrap();
        let Some(Slow::Solver { plain, .. }) = unsupported.causes.first() else { continue };
        for cause in &unsupported.causes[1..] {
            let (Slow::Tall { without, .. }
            | Slow::MassRatio { without, .. }
            | Slow::Order { without }) = cause
            else {
                continue;
            };
            assert!(without.with <= plain * 1.000_001, "{boxes} {sweeps}: {cause}");
            blamed += 1;
        }
    }
    assert!(blamed > 0, "no scene was hard for plain sweeps");
}

#[test]
fn the_known_mistakes_are_tried_on_the_answer_of_a_suspected_solver() {
    let found = pushed(2, "no-friction", 50, with_own("no-friction", Bug::NoFriction));
    let Slow::Solver { mistakes, .. } = suspected(&found) else { panic!() };
    assert!(mistakes.iter().any(|own| own.what.contains("friction left out")), "{mistakes:?}");
    assert!(found.to_json()["solve"]["causes"][0]["mistakes"].is_array());
}

#[test]
fn a_solver_without_an_answer_is_suspected_with_its_reason() {
    let found = pushed(2, "silent", 100, with_own("silent", Bug::Silent));
    let words = suspected(&found).to_string();
    assert!(words.contains("It gave no answer:") && words.contains("IndexError"), "{words}");
}

#[test]
fn a_solver_as_good_as_plain_sweeps_is_not_suspected() {
    // Too few sweeps for a tall stack, with any solver.
    let found = pushed(8, "sound", 10, with_own("sound", Bug::None));
    let causes = found.causes();
    assert!(!causes.is_empty() && !causes.contains(&"suspect the solver"), "{causes:?}");
    assert!(pushed(2, "sound", 2000, with_own("sound", Bug::None)).causes().is_empty());
}

/// A solver that does two sweeps and then reports a ray.
struct GivesUp;

impl Solver for GivesUp {
    fn name(&self) -> &str {
        "gives-up"
    }

    fn solve(&self, lcp: &Lcp, _: &Start<'_>, _: &mut dyn Observer) -> Solution {
        let direction = vec![0.0; lcp.len()];
        Solution::new(lcp, vec![0.0; lcp.len()], Status::Ray { row: 0, direction }, 2)
    }
}

#[test]
fn a_solver_that_gives_up_is_the_first_cause() {
    let solvers = with(Entry::new("gives-up", |_| Box::new(GivesUp)));
    let found = pushed(2, "gives-up", 50, solvers);
    assert_eq!(found.causes().first(), Some(&"the solver gave up"), "{:?}", found.causes());
    let output = found.gave_up.as_ref().unwrap();
    assert!(output.starts_with("in step 1: ended on a ray"), "{output}");
    assert_eq!(found.to_json()["gave_up"], output.as_str());
}

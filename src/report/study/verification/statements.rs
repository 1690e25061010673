//! What `diagnose` and `compare` state about a run, where it has a closed form: the unsupported
//! weight, the causes, friction outside the cone, the measured laws, counts and labels.

use std::collections::BTreeSet;
use std::f64::consts::SQRT_2;

use super::collisions::under_penalty;
use super::measure::{Case, Known, Method, ROUNDING, first, start};
use super::{Row, Size};
use crate::diagnosis;
use crate::diagnosis::unsupported::{Examination, examine_scene};
use crate::error::Result;
use crate::lcp::Lcp;
use crate::lcp::friction::Model;
use crate::scene::{Integrator, Scene, Scheme};
use crate::simulation::Slips;
use crate::solver;
use crate::solver::{
    Dantzig, Entry, Enumeration, Observer, Options, Registry, Solution, Solver, Start, Stop,
};
use lcplab_analysis::comparison::{Comparison, Run, compare};

const SUMMED: (f64, &str) = (1e-6, "the tolerance of the solver, accumulated over the steps");
const COUNT: (f64, &str) = (0.0, "a count");
const G: f64 = 9.81;

/// The sweeps of the remedies that `diagnose` tries; what it states does not depend on them.
const FEW: usize = 100;

/// A solver with a planted error: the forces of Dantzig's method, halved.
struct Half(Dantzig);

impl Solver for Half {
    fn name(&self) -> &str {
        "half"
    }

    fn solve(&self, lcp: &Lcp, start: &Start<'_>, observer: &mut dyn Observer) -> Solution {
        let Solution { mut x, status, iterations, .. } = self.0.solve(lcp, start, observer);
        x.iter_mut().for_each(|x| *x *= 0.5);
        Solution::new(lcp, x, status, iterations)
    }
}

/// A door on two hinges of one axis, askew to the axes of the world, with a motor.
const DOOR: &str = "gravity = [0, 0, 0]\nstep.baumgarte = 0.1\n[[bodies]]\nname = \"door\"\n\
    mass = 20\nshape = { box = [1, 0.05, 2] }\nposition = [0.5, 0, 0]\n\
    [[constraints]]\nkind = \"hinge\"\nbodies = [\"door\"]\naxis = [0.1, 0.2, 1]\n\
    point = [0.08, 0.16, 0.8]\n[[constraints]]\nkind = \"hinge\"\nbodies = [\"door\"]\n\
    axis = [0.1, 0.2, 1]\npoint = [-0.08, -0.16, -0.8]\n[[constraints]]\n\
    kind = \"motor_rotation\"\nbodies = [\"door\"]\naxis = [0.1, 0.2, 1]\nspeed = 2\n\
    effort = 1e4\n";

/// The reference of `diagnose` is an accepted answer and not that of the solver under examination:
/// of forces that are half of the right ones, half of the weight is missing. A solver that gave up
/// is the first cause.
pub(super) fn reference(size: Size) -> Result<Vec<Row>> {
    let mut stack = Scene::load_with("stack", &[("generate.count".into(), "2".into())])?;
    stack.solver.name = "half".into();
    stack.solver.max_iterations = FEW;
    let half = Entry::new("half", |options: &Options| {
        Box::new(Half(Dantzig { settings: options.settings.clone() }))
    });
    stack.solvers.add(solver::Method::Boxed(half))?;
    let what = "unsupported part of the weight if the solver halves every force";
    let known = vec![Known::exact(SUMMED, what, "\\tfrac12", "", 0.5)];
    let mut rows = Case::of("diagnosis", stack, size).rows(Method::Velocity, known, |scene| {
        let mut scene = scene.clone();
        scene.step.count = 1;
        Some(vec![examine_scene(&scene, None).ok()?.unsupported?.missing])
    });
    let mut door = Scene::from_toml("door", DOOR)?;
    door.solver.name = Enumeration::NAME.into();
    let what = "rank of the cause \"the solver gave up\"";
    let known = vec![Known::exact(COUNT, what, "1", "", 1.0)];
    let mut case = Case::of("diagnosis", door, size);
    case.scene.step.baumgarte = 0.1;
    case.scene.step.count = 20;
    rows.extend(case.rows(Method::Velocity, known, |scene| {
        let causes = examine_scene(scene, None).ok()?.causes();
        let place = causes.iter().position(|cause| *cause == "the solver gave up")?;
        Some(vec![place as f64 + 1.0])
    }));
    Ok(rows)
}

/// A block of 2 kg that slides at 45° to the tangents: under Coulomb's cone friction is μ x_n and
/// not more, apart from rounding; the corner of a box is √2 μ x_n.
pub(super) fn at_the_limit(size: Size) -> Result<Vec<Row>> {
    let text = "contact.friction = 0.3\n[[bodies]]\nname = \"ground\"\nfixed = true\n\
        shape = { plane = [0, 0, 1] }\n[[bodies]]\nname = \"block\"\nmass = 2\n\
        shape = { box = [0.4, 0.4, 0.2] }\nposition = [0, 0, 0.1]\nvelocity = [2, 2, 0]\n";
    // Without weight: x_n is 0, and so is friction.
    let weightless = format!("gravity = [0, 0, 0]\n{text}");
    let mut rows = Vec::new();
    let of_cone = "0";
    let of_box = "\\sqrt2 - 1";
    for (text, model, formula, expected) in [
        (text, Model::CoulombCone, of_cone, 0.0),
        (weightless.as_str(), Model::CoulombCone, of_cone, 0.0),
        (weightless.as_str(), Model::CoupledBox, of_cone, 0.0),
        (text, Model::CoupledBox, of_box, SQRT_2 - 1.0),
    ] {
        let weight = if text.starts_with("gravity") { "without weight" } else { "sliding at 45°" };
        let mut scene = Scene::from_toml("sliding-block", text)?;
        scene.contact.model = model;
        let case = Case::of("friction-excess", scene, size);
        for level in [Method::Velocity, Method::Acceleration] {
            let what =
                format!("excess of friction over μ x_n, divided by μ x_n, {model}, {weight}");
            let known = vec![Known::exact(SUMMED, what, formula, "", expected)];
            rows.extend(case.rows(level, known, |scene| {
                let (mut simulation, mut slips) = (start(scene)?, Slips::default());
                for _ in 0..20 {
                    slips.add(&simulation.step().ok()?);
                }
                Some(vec![slips.cone_excess.map_or(0.0, |slip| slip.excess)])
            }));
        }
    }
    Ok(rows)
}

/// The comparison of a scene by its own scheme with Dantzig's method.
fn compared(scene: &Scene, schemes: &[Scheme], time: f64) -> Option<Comparison> {
    let entry = Registry::standard().entry(Dantzig::NAME).ok()?.clone();
    let steps = (time / scene.step.dt).round() as usize;
    let (mut comparison, _) = compare(scene, schemes, std::slice::from_ref(&entry), steps, &|| ());
    comparison.runs.retain(|run| run.solver == Dantzig::NAME || run.solver == "none");
    if schemes.len() > 1 {
        comparison.add_levels(scene, &[solver::Method::Boxed(entry)], &Stop::default());
    }
    Some(comparison)
}

/// The only run of a scene by its own scheme.
fn run(scene: &Scene, time: f64) -> Option<Run> {
    compared(scene, &[scene.step.scheme], time)?.runs.pop()
}

/// The laws that `compare` measures: closure, energy, restitution, the direction of friction, and
/// how far the levels end apart.
pub(super) fn measured_laws(size: Size) -> Result<Vec<Row>> {
    let mut rows = impacts(size)?;
    rows.extend(closure(size)?);
    rows.extend(slip_direction(size)?);
    rows.extend(levels(size)?);
    Ok(rows)
}

/// A ball of 1 kg flies at 2 m/s against a wall.
fn against_wall(e: f64) -> Result<Scene> {
    let text = format!(
        "gravity = [0, 0, 0]\ncontact.restitution = {e}\n[[bodies]]\nname = \"wall\"\n\
         fixed = true\nshape = {{ plane = [-1, 0, 0] }}\nposition = [1, 0, 0]\n\
         [[bodies]]\nname = \"ball\"\n\
         mass = 1\nshape = {{ sphere = 0.1 }}\nposition = [0.83, 0, 0]\nvelocity = [2, 0, 0]\n"
    );
    Scene::from_toml("against-wall", &text)
}

/// An impact loses (1 − e²) of the energy, and with e = 1 none. The penalty scheme has the
/// restitution of its damping instead of e.
fn impacts(size: Size) -> Result<Vec<Row>> {
    let mut rows = Vec::new();
    for e in [0.5, 1.0] {
        let case = Case::of("measured-laws", against_wall(e)?, size);
        for scheme in [Scheme::Velocity, Scheme::Acceleration, Scheme::Xpbd] {
            let formula = "-(1 - e^2)\\tfrac12 m v^2";
            let lost = -(1.0 - e * e) * 2.0;
            let known = vec![
                Known::exact(SUMMED, format!("energy change, e = {e}"), formula, "J", lost),
                Known::exact(SUMMED, format!("measured restitution minus e = {e}"), "0", "", 0.0),
            ];
            rows.extend(case.rows(Method::Scheme(scheme), known, |scene| {
                let run = run(scene, 0.2)?;
                Some(vec![run.energy_at_end(), run.laws.restitution?])
            }));
        }
    }
    // The ball touches the wall at the start: otherwise the time in the substep at which the
    // contact begins, which rounding decides, would be a part of the error.
    let mut touching = against_wall(0.2)?;
    touching.states[1].pose.p.x = 0.9;
    let case = Case::of("measured-laws", touching, size);
    let (case, damped) = under_penalty(&case, size, 1.0, 1.0);
    let formula = "e_\\zeta - e";
    let known =
        vec![Known::order(1.0, "measured restitution minus e = 0.2", formula, "", damped - 0.2)];
    rows.extend(case.rows(Method::Scheme(Scheme::Penalty), known, |scene| {
        Some(vec![run(scene, 0.2)?.laws.restitution?])
    }));
    Ok(rows)
}

/// Two balls overlap by 3 mm at the start, without feedback: that is the deepest overlap. A rod is
/// 4 mm too long: that is the drift of its joint.
fn closure(size: Size) -> Result<Vec<Row>> {
    let overlap = "gravity = [0, 0, 0]\n[[bodies]]\nname = \"a\"\nmass = 1\n\
        shape = { sphere = 0.5 }\n[[bodies]]\nname = \"b\"\nmass = 1\nshape = { sphere = 0.5 }\n\
        position = [0.997, 0, 0]\n";
    let rod = "[[bodies]]\nname = \"bob\"\nshape = \"point\"\nmass = 1\n\
        position = [0, 0, -1.004]\n[[constraints]]\nkind = \"distance\"\nbodies = [\"bob\"]\n\
        points = [[0, 0, 0], [0, 0, -1.004]]\nlength = 1\n";
    let mut rows = Vec::new();
    for level in [Method::Velocity, Method::Acceleration] {
        for (name, text, what, expected) in [
            ("overlap", overlap, "deepest overlap", 0.003),
            ("rod", rod, "drift of a joint", 0.004),
        ] {
            let case = Case::of("measured-laws", Scene::from_toml(name, text)?, size);
            let known = vec![Known::exact(SUMMED, what, "c_0", "m", expected)];
            rows.extend(case.rows(level, known, |scene| {
                let run = run(scene, 0.1)?;
                Some(vec![run.worst(|sample| sample.drift.max(sample.penetration))])
            }));
        }
    }
    Ok(rows)
}

/// A point that slides at 30° to the axes: a square of friction with its corners on the axes turns
/// friction by 30°, the corner of a box by 15°, Coulomb's cone not at all.
fn slip_direction(size: Size) -> Result<Vec<Row>> {
    let (sin, cos) = libm::sincos(30f64.to_radians());
    let text = format!(
        "contact.friction = 0.3\n[[bodies]]\nname = \"ground\"\nfixed = true\n\
         shape = {{ plane = [0, 0, 1] }}\n[[bodies]]\nname = \"point\"\nshape = \"point\"\n\
         mass = 1\nvelocity = [{}, {}, 0]\n",
        3.0 * cos,
        3.0 * sin
    );
    let square: Model = "polygon-4".parse()?;
    let mut rows = Vec::new();
    for (model, formula, expected, order) in [
        (square, "30 - 0", 30.0, Some(1.0)),
        (Model::CoupledBox, "45 - 30", 15.0, Some(1.0)),
        (Model::CoulombCone, "0", 0.0, None),
    ] {
        let mut scene = Scene::from_toml("oblique-slip", &text)?;
        scene.contact.model = model;
        let case = Case::of("measured-laws", scene, size);
        let what = format!("angle between friction and slip, {model}");
        let known = match order {
            // At the end of the first step the slip has turned by a part of dt.
            Some(order) => Known::order(order, what, formula, "°", expected),
            None => {
                Known::exact((1e-4, "the tolerance of the cone solver"), what, formula, "°", 0.0)
            }
        };
        rows.extend(case.rows(Method::Velocity, vec![known], |scene| {
            let (comparison, _) = compare(scene, &[Scheme::Velocity], &entries(), 1, &|| ());
            let angle = |run: &Run| run.laws.friction_angle;
            let found: Vec<f64> = comparison.runs.iter().filter_map(angle).collect();
            Some(vec![found.into_iter().reduce(f64::max)?])
        }));
    }
    Ok(rows)
}

fn entries() -> Vec<Entry> {
    let names = [Dantzig::NAME, solver::Lemke::NAME];
    names.iter().filter_map(|name| Registry::standard().entry(name).ok().cloned()).collect()
}

/// Free fall for T: semi-implicit Euler at velocity level ends g T dt/2 below the implicit midpoint
/// rule at acceleration level, which is exact, and half the step moves it by g T dt/4.
fn levels(size: Size) -> Result<Vec<Row>> {
    let text = "[[bodies]]\nname = \"ball\"\nmass = 1\nshape = { sphere = 0.1 }\n";
    let mut scene = Scene::from_toml("fall", text)?;
    scene.step.integrator = Integrator::ImplicitMidpoint;
    let time = 0.4;
    let what = [
        "distance between the two levels, divided by dt",
        "change by halving the step at velocity level, divided by dt",
    ];
    let known = vec![
        Known::exact(ROUNDING, what[0], "g T/2", "m/s", G * time / 2.0),
        Known::exact(ROUNDING, what[1], "g T/4", "m/s", G * time / 4.0),
    ];
    let case = Case { scene, ..Case::load("measured-laws", "stack", size)? };
    let mut rows = case.rows(Method::Midpoint, known, |scene| {
        let levels = compared(scene, &Scheme::LEVELS, time)?.levels?;
        Some(vec![levels.apart / scene.step.dt, levels.levels[0].halved / scene.step.dt])
    });
    rows.iter_mut().for_each(|row| row.method = "both levels, with the midpoint rule".into());
    Ok(rows)
}

/// Counts in the words of `diagnose` and `compare`: bodies of a chain, rows with labels of their
/// own, bodies that passed through others.
pub(super) fn counts(size: Size) -> Result<Vec<Row>> {
    let chain = "[generate]\nkind = \"chain\"\nlinks = 48\nspacing = 0.1\nmass = 0.1\n[step]\n\
        dt = 0.005\ncount = 40\n[solver]\nname = \"pgs\"\nmax_iterations = 5\n";
    let case = Case { levels: 1, ..Case::of("counts", Scene::from_toml("chain", chain)?, size) };
    let what = "number of bodies in the cause \"long chain\", 48 links";
    let known = vec![Known::exact(COUNT, what, "n", "", 48.0)];
    let mut rows =
        case.rows(Method::Velocity, known, |scene| bodies_named(&examine_scene(scene, None).ok()?));
    let sledge = "[[bodies]]\nname = \"a\"\nmass = 1\nshape = { sphere = 0.1 }\n\
        [[constraints]]\nkind = \"slider\"\nbodies = [\"a\"]\naxis = [0, 0, 1]\n\
        [[constraints]]\nkind = \"motor_translation\"\nbodies = [\"a\"]\naxis = [0, 0, 1]\n\
        speed = 1\neffort = 100\n";
    let case = Case { levels: 1, ..Case::of("counts", Scene::from_toml("sledge", sledge)?, size) };
    let what = "number of different row labels of a slider with a motor";
    let known = vec![Known::exact(COUNT, what, "5 + 1", "", 6.0)];
    rows.extend(case.rows(Method::Velocity, known, |scene| {
        let labels = |rows: &[crate::assembly::Row]| {
            rows.iter().map(|row| row.label(scene)).collect::<BTreeSet<String>>().len()
        };
        let diagnosed = diagnosis::scene(scene, 1).ok()?.labels.len();
        let own = labels(&first(scene)?.solves.last()?.problem.assembly.rows);
        Some(vec![own.min(diagnosed) as f64])
    }));
    let bullets = "gravity = [0, 0, 0]\ncontact.margin = 0.001\n[[bodies]]\nname = \"wall\"\n\
        fixed = true\nshape = { box = [0.02, 4, 4] }\nposition = [0.5, 0, 0]\n\
        [[bodies]]\nname = \"first\"\nmass = 0.01\nshape = { sphere = 0.01 }\n\
        velocity = [300, 0, 0]\n\
        [[bodies]]\nname = \"second\"\nmass = 0.01\nshape = { sphere = 0.01 }\n\
        position = [-1, 1, 0]\nvelocity = [300, 0, 0]\n";
    let case =
        Case { levels: 1, ..Case::of("counts", Scene::from_toml("bullets", bullets)?, size) };
    let what = "number of bodies that pass through a wall";
    let known = vec![Known::exact(COUNT, what, "n", "", 2.0)];
    rows.extend(
        case.rows(Method::Velocity, known, |scene| {
            Some(vec![run(scene, 0.04)?.laws.passages as f64])
        }),
    );
    Ok(rows)
}

/// The number n in "through n bodies" of the causes.
fn bodies_named(found: &Examination) -> Option<Vec<f64>> {
    let causes = &found.unsupported.as_ref()?.causes;
    let text: String = causes.iter().map(ToString::to_string).collect();
    let (_, after) = text.split_once("through ")?;
    Some(vec![after.split_whitespace().next()?.parse().ok()?])
}

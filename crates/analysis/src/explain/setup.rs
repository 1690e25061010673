//! The input of a step (states, masses, forces, rows) and its result.

use nalgebra::Vector3;

use super::step_units::of_motion;
use lcplab_lcp::friction::ProblemForm;
use lcplab_mechanics::assembly::Row;
use lcplab_mechanics::body::{Body, Mass, State, angular, linear};
use lcplab_mechanics::constraint::Kind;
use lcplab_mechanics::formulation::{Posing, Problem, Stage};
use lcplab_mechanics::scene::{Feedback, Scene};
use lcplab_mechanics::simulation::Step;
use lcplab_page::document::Section;
use lcplab_page::document::notation::{interval, plain, settled, vector};

/// s and u of the moving bodies, with this time as the title, and their masses and forces if a
/// problem has them.
pub(super) fn states(
    when: &str,
    scene: &Scene,
    states: &[State],
    problem: Option<&Problem>,
) -> Section {
    let mut section = Section::new(when);
    let title = "the moving bodies before the step: positions, velocities, masses and forces";
    state_table(&mut section, title, scene, states, problem);
    section
}

/// s and u after the step.
pub(super) fn after(scene: &Scene, before: &[State], step: &Step) -> Section {
    let mut section = Section::new("the states after the step");
    if step.solves.iter().all(|solve| solve.problem.lcp.is_empty()) {
        section.say(
            "No contact or joint acts in this step: it has no rows, and every body moves freely.",
        );
    }
    section.say("The bodies move with their new velocities, s⁺ = s + dt S u⁺ (S turns velocities into rates of positions and quaternions).");
    let states = without_rounding(scene, before, &step.states);
    state_table(&mut section, "the moving bodies after the step", scene, &states, None);
    section
}

/// The states, with 0 for velocities that are rounding errors of the speeds in the step.
pub(super) fn without_rounding(scene: &Scene, before: &[State], after: &[State]) -> Vec<State> {
    let sizes = before.iter().chain(after).map(|state| (state.v.norm(), state.omega.norm()));
    let (fastest, turning) =
        sizes.fold((0.0, 0.0), |most: (f64, f64), own| (most.0.max(own.0), most.1.max(own.1)));
    let fastest = fastest + scene.step.dt * scene.gravity.norm();
    let settle = |v: &Vector3<f64>, size: f64| {
        Vector3::from_column_slice(&settled(v.as_slice(), &[size; 3]))
    };
    let state = |own: &State| State {
        v: settle(&own.v, fastest),
        omega: settle(&own.omega, turning),
        ..*own
    };
    after.iter().map(state).collect()
}

/// The moving bodies; columns that say nothing stay empty, so that the table leaves them out.
fn state_table(
    section: &mut Section,
    title: &str,
    scene: &Scene,
    states: &[State],
    problem: Option<&Problem>,
) {
    let moving = || {
        scene
            .bodies
            .iter()
            .zip(states)
            .enumerate()
            .filter(|(_, (body, _))| body.mass != Mass::Fixed)
    };
    let is_turned = |state: &State| state.pose.q.w.abs() != 1.0 || state.omega.norm() > 0.0;
    let turns = moving().any(|(_, (body, state))| body.mass.dof() == 6 && is_turned(state));
    let only = |shown: bool, text: String| if shown { text } else { String::new() };
    let line = |(k, (body, state)): (usize, (&Body, &State))| {
        let q = state.pose.q;
        let turns = turns && body.mass.dof() == 6;
        let own = vec![
            body.name.clone(),
            triple(&state.pose.p),
            only(turns, vector(&[q.w, q.i, q.j, q.k])),
            triple(&state.v),
            only(turns, triple(&state.omega)),
        ];
        own.into_iter().chain(mass(problem, k)).collect()
    };
    let columns = [
        "body",
        "p (m)",
        "q",
        "v (m/s)",
        "ω (rad/s)",
        "m (kg)",
        "I xx, yy, zz (kg m²)",
        "I xy, xz, yz (kg m²)",
        "force (N)",
        "torque (N m)",
    ];
    section.table(title, &columns, moving().map(line).collect());
}

/// Mass, inertia, force and torque of a body in a problem; empty if it has none or they are 0.
fn mass(problem: Option<&Problem>, body: usize) -> [String; 5] {
    let Some(assembly) = problem.map(|problem| &problem.assembly) else {
        return Default::default();
    };
    let Some(block) = assembly.blocks.iter().find(|block| block.body == body) else {
        return Default::default();
    };
    let force = block.gather(&assembly.force);
    let (inertia, turns) = (block.inertia, block.dof == 6);
    let diagonal = Vector3::new(inertia[(0, 0)], inertia[(1, 1)], inertia[(2, 2)]);
    let off = Vector3::new(inertia[(0, 1)], inertia[(0, 2)], inertia[(1, 2)]);
    let only = |v: Vector3<f64>| match turns && v != Vector3::zeros() {
        true => triple(&v),
        false => String::new(),
    };
    let forces = triple(&linear(&force));
    [plain(block.mass), only(diagonal), only(off), forces, only(angular(&force))]
}

fn triple(v: &Vector3<f64>) -> String {
    vector(v.as_slice())
}

/// The kinds of the rows and their bodies; the whole label of a row if that is not unique.
pub(super) fn labels(scene: &Scene, rows: &[Row]) -> Vec<String> {
    let word = |row: &Row| format!("{} {}", row.kind.name(), row.names(scene).join(" – "));
    let words: Vec<String> = rows.iter().map(word).collect();
    let label = |(row, own): (&Row, &String)| match words.iter().filter(|word| *word == own).count()
    {
        1 => own.clone(),
        _ => row.label(scene),
    };
    rows.iter().zip(&words).map(label).collect()
}

/// c, J u, J'u and the bounds of every row.
pub(super) fn rows(
    scene: &Scene,
    problem: &Problem,
    posing: Option<&Posing>,
    is_again: bool,
) -> Section {
    let mut section = Section::new("constraints");
    let rows = &problem.assembly.rows;
    let lcp = &problem.lcp;
    let numbers = |row: &Row, bias: f64| [row.c, row.velocity, row.velocity_product, bias];
    let mut all = rows.iter().zip(&problem.bias).map(|(row, &bias)| numbers(row, bias));
    if is_again && all.all(|row| row == [0.0; 4]) {
        section.say("c, J u, J'u and the bias of every row are now 0.");
        return section;
    }
    let labels = labels(scene, rows);
    let line = |(i, row): (usize, &Row)| {
        let bounds = match lcp.coupling().and_then(|coupling| Some((coupling.index(i)?, coupling)))
        {
            Some((normal, coupling)) => {
                let mu = plain(coupling.mu(i));
                match posing.map(|posing| &posing.posed) {
                    None | Some(ProblemForm::Boxed(_)) => format!("±{mu} x of row {normal}"),
                    Some(ProblemForm::Polyhedral(_)) => {
                        format!("polygon, μ = {mu}, on row {normal}")
                    }
                    Some(ProblemForm::Cone(_)) => format!("cone, μ = {mu}, on row {normal}"),
                }
            }
            None => interval(lcp.lo()[i], lcp.hi()[i]),
        };
        vec![
            i.to_string(),
            labels[i].clone(),
            plain(row.c),
            plain(row.velocity),
            plain(row.velocity_product),
            plain(problem.bias[i]),
            bounds,
        ]
    };
    let is_angular = rows.iter().any(|row| row.kind.is_angular());
    let length = if is_angular { "m or rad" } else { "m" };
    let speed = of_motion(Stage::Velocity, is_angular);
    let rate = of_motion(Stage::Acceleration, is_angular);
    let columns = [
        "row",
        "constraint",
        &format!("c ({length})"),
        &format!("J u ({speed})"),
        &format!("J'u ({rate})"),
        &format!("bias ({})", of_motion(problem.stage, is_angular)),
        &format!("bounds of x ({})", problem.stage.unit(false)),
    ];
    if !is_again {
        section.say(
            "Rows are numbered from 0. c is the gap of a contact or the position error of a joint, J u its rate, and J'u, \
             with J' = dJ/dt, the part of its second derivative that the velocities alone cause.",
        );
    }
    section.table("the rows", &columns, rows.iter().enumerate().map(line).collect());
    section.say(bias(scene, problem));
    section
}

/// How the bias comes about, with the scene's numbers.
fn bias(scene: &Scene, problem: &Problem) -> String {
    let (step, contact) = (&scene.step, &scene.contact);
    let (dt, alpha, beta) = (plain(step.dt), plain(step.alpha), plain(step.baumgarte));
    let rows = &problem.assembly.rows;
    let mut words = match problem.stage {
        Stage::Velocity => {
            let factor = match step.feedback {
                Feedback::Corrected => {
                    format!("β/dt = {beta}/({dt} s) = {} s⁻¹", plain(step.baumgarte / step.dt))
                }
                Feedback::Unscaled => format!("β = {beta} 1/s, not divided by dt (E34)"),
                Feedback::Printed => {
                    format!("−β = −{beta} 1/s, as printed in the chapter (E34, E35)")
                }
            };
            format!(
                "The bias is the feedback of errors. A position error c is multiplied by {factor}, and a \
                 gap c > 0 of a contact by 1/dt, so that the gap can close within the step but not become \
                 an overlap. The bias of a friction row is 0, that of a motor the negative target speed."
            )
        }
        Stage::Impact => {
            "An impact takes no time, so there is no force and no bias, only J u⁺ ≥ 0.".into()
        }
        Stage::Restitution => format!(
            "Contacts bounce if they have an impulse in the first answer and approached at {} m/s or faster. They \
             have the bias e J u with e = {} and J u from the table, so w = J u⁺ + e J u ≥ 0 requires a separation at e \
             times the approach speed. The other rows keep their bias.",
            plain(contact.bounce_speed),
            plain(contact.restitution)
        ),
        Stage::Acceleration => format!(
            "The bias is J'u + 2α J u + α² c with α = {alpha} 1/s, which lets errors decay. For friction it is \
             J'u + J u/dt with dt = {dt} s, and for a motor J'u + (J u − target speed)/dt."
        ),
        Stage::Position => "The bias is the position error.".into(),
    };
    let touches = rows.iter().any(|row| row.kind == Kind::Normal);
    if problem.stage == Stage::Velocity && contact.slop > 0.0 && touches {
        words += &format!(
            " An overlap of contacts up to {0} m is allowed: the feedback uses min(c + {0}, 0).",
            plain(contact.slop)
        );
    }
    if rows.iter().any(|row| row.spring.is_some()) {
        words += " A spring of stiffness k and damping d has its own β = dt k/(d + dt k) and the compliance \
                  γ = 1/(dt (d + dt k)).";
    }
    words
}

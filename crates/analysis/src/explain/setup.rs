//! The input of a step (states, masses, forces, rows) and its result.

use nalgebra::Vector3;

use super::step_units::of_motion;
use lcplab_lcp::friction::ProblemForm;
use lcplab_mechanics::body::{Mass, State, angular, linear};
use lcplab_mechanics::constraint::Kind;
use lcplab_mechanics::formulation::{Posing, Problem, Stage};
use lcplab_mechanics::scene::{Feedback, Scene};
use lcplab_mechanics::simulation::Step;
use lcplab_page::document::notation::{bracketed, interval, plain, vector};
use lcplab_page::document::{SHOWN, Section};

/// s and u of all bodies, with this time as the title.
pub(super) fn states(when: &str, scene: &Scene, states: &[State]) -> Section {
    let mut section = Section::new(when);
    section.say("The step starts from these states s and velocities u.");
    state_table(&mut section, "the bodies before", scene, states);
    section
}

/// s and u after the step.
pub(super) fn after(scene: &Scene, step: &Step) -> Section {
    let mut section = Section::new("the states after the step");
    if step.solves.iter().all(|solve| solve.problem.lcp.is_empty()) {
        section.say(
            "No contact or joint acts in this step: it has no rows, and every body moves freely.",
        );
    }
    section.say("The bodies move with their new velocities, s⁺ = s + dt S u⁺ (S turns velocities into rates of positions and quaternions).");
    state_table(&mut section, "the bodies after", scene, &step.states);
    section
}

fn state_table(section: &mut Section, title: &str, scene: &Scene, states: &[State]) {
    let line = |(body, state): (&lcplab_mechanics::body::Body, &State)| {
        let q = state.pose.q;
        let turns = body.mass.dof() == 6;
        let only = |shown: bool, text: String| if shown { text } else { "—".into() };
        vec![
            body.name.clone(),
            triple(&state.pose.p),
            only(turns, vector(&[q.w, q.i, q.j, q.k])),
            only(body.mass.dof() > 0, triple(&state.v)),
            only(turns, triple(&state.omega)),
        ]
    };
    let columns = ["body", "p (m)", "q", "v (m/s)", "ω (rad/s)"];
    section.table(title, &columns, scene.bodies.iter().zip(states).map(line).collect());
    let is_fixed = |body: &&lcplab_mechanics::body::Body| body.mass == Mass::Fixed;
    let fixed: Vec<&str> =
        scene.bodies.iter().filter(is_fixed).take(SHOWN).map(|body| body.name.as_str()).collect();
    if !fixed.is_empty() {
        section.say(format!(
            "Fixed bodies (M⁻¹ = 0; they have no columns in J): {}.",
            fixed.join(", ")
        ));
    }
}

fn triple(v: &Vector3<f64>) -> String {
    vector(v.as_slice())
}

/// M⁻¹ and F of the moving bodies.
pub(super) fn masses(scene: &Scene, problem: &Problem) -> Section {
    let assembly = &problem.assembly;
    let mut section = Section::new("masses and forces");
    let line = |block: &lcplab_mechanics::assembly::Block| {
        let (force, u) = (block.gather(&assembly.force), block.gather(&assembly.u));
        let turns = block.dof == 6;
        let only = |text: String| if turns { text } else { "—".into() };
        let inertia = block.inertia;
        let diagonal = Vector3::new(inertia[(0, 0)], inertia[(1, 1)], inertia[(2, 2)]);
        let off = Vector3::new(inertia[(0, 1)], inertia[(0, 2)], inertia[(1, 2)]);
        vec![
            scene.bodies[block.body].name.clone(),
            plain(block.mass),
            format!("1/{} = {}", bracketed(block.mass), plain(1.0 / block.mass)),
            only(triple(&diagonal)),
            only(triple(&off)),
            triple(&linear(&force)),
            only(triple(&angular(&force))),
            triple(&linear(&u)),
        ]
    };
    let columns = [
        "body",
        "m (kg)",
        "1/m (1/kg)",
        "I xx, yy, zz (kg m²)",
        "I xy, xz, yz (kg m²)",
        "force (N)",
        "torque (N m)",
        "v (m/s)",
    ];
    section.table(
        "M, F and u of the moving bodies",
        &columns,
        assembly.blocks.iter().map(line).collect(),
    );
    section
}

/// c, J u, J'u and the bounds of every row.
pub(super) fn rows(scene: &Scene, problem: &Problem, posing: Option<&Posing>) -> Section {
    let mut section = Section::new("constraints");
    let rows = &problem.assembly.rows;
    let lcp = &problem.lcp;
    let line = |(i, row): (usize, &lcplab_mechanics::assembly::Row)| {
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
            row.label(scene),
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
    section.say(
        "c is the gap of a contact or the position error of a joint, J u its rate, and J'u, with J' = dJ/dt, the part \
         of its second derivative that the velocities alone cause.",
    );
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

//! Temporary: hashes of trajectories.
use lcplab_mechanics::body::State;
use lcplab_mechanics::scene::{Scene, Scheme, catalogue};
use lcplab_mechanics::simulation::{Simulation, Stepper, stepper::Kernel};
use std::time::Instant;

fn mix(hash: &mut u64, states: &[State]) {
    for s in states {
        let q = s.pose.q.coords;
        for x in [
            s.pose.p.x, s.pose.p.y, s.pose.p.z, q.x, q.y, q.z, q.w, s.v.x, s.v.y, s.v.z, s.omega.x,
            s.omega.y, s.omega.z,
        ] {
            *hash = (*hash ^ x.to_bits()).wrapping_mul(0x100000001b3).rotate_left(5);
        }
    }
}
const MARKS: [usize; 7] = [1, 5, 20, 50, 100, 200, 500];
fn main() {
    let only: Option<String> = std::env::args().nth(1);
    let budget: f64 = std::env::args().nth(2).map_or(2.0, |s| s.parse().unwrap());
    for shipped in catalogue::SHIPPED {
        if only.as_ref().is_some_and(|o| o != "all" && o != shipped.name) {
            continue;
        }
        let own = Scene::load(shipped.name).unwrap();
        for scheme in Scheme::ALL {
            let mut scene = own.clone();
            scene.step.scheme = scheme;
            let is_own = scheme == own.step.scheme;
            let limit = if is_own { budget } else { budget / 8.0 };
            let mut sim = Simulation::of(&scene).unwrap();
            let (start, mut hash) = (Instant::now(), 0u64);
            let mut line =
                format!("{} {}{}", shipped.name, scheme.name(), if is_own { " own" } else { "" });
            for k in 1..=500 {
                match sim.step() {
                    Ok(step) => mix(&mut hash, &step.states),
                    Err(f) => {
                        line += &format!(" {k}:failed {f}");
                        break;
                    }
                }
                if MARKS.contains(&k) {
                    line += &format!(" {k}:{hash:016x}");
                }
                if start.elapsed().as_secs_f64() > limit {
                    break;
                }
            }
            println!("{line}");
            if is_own && only.as_deref() == Some("all") {
                more(&own);
            }
        }
        if let Ok(mut stepper) = Stepper::new(own.clone(), 10, Kernel::RowByRow) {
            let (start, mut hash) = (Instant::now(), 0u64);
            let mut line = format!("{} stepper", shipped.name);
            for k in 1..=500 {
                match stepper.step() {
                    Ok(()) => mix(&mut hash, stepper.states()),
                    Err(f) => {
                        line += &format!(" {k}:failed {f}");
                        break;
                    }
                }
                if MARKS.contains(&k) {
                    line += &format!(" {k}:{hash:016x}");
                }
                if start.elapsed().as_secs_f64() > budget / 8.0 {
                    break;
                }
            }
            println!("{line}");
        }
    }
}

fn more(scene: &Scene) {
    use lcplab_mechanics::scene::{contacts, step_contacts};
    let mut sim = Simulation::of(scene).unwrap();
    let (start, mut steps, mut first, mut taken) = (Instant::now(), 0, None, 0);
    for k in 1..=500 {
        let (a, b) = (
            contacts(scene, sim.states(), scene.contact.margin.unwrap_or(0.05)).len(),
            step_contacts(scene, sim.states()).len(),
        );
        if b > a {
            steps += 1;
            first.get_or_insert((k, a, b));
        }
        if sim.step().is_err() || start.elapsed().as_secs_f64() > 1.0 {
            break;
        }
        taken = k;
    }
    if steps > 0 {
        println!("MORE {} in {steps} of {taken}, first {first:?} dt {}", scene.name, scene.step.dt);
    }
}

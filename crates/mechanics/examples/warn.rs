//! Temporary.
use lcplab_mechanics::scene::{Scene, Scheme, catalogue};
use lcplab_mechanics::simulation::Simulation;
use std::time::Instant;
fn main() {
    let args: Vec<String> = std::env::args().collect();
    let all = args[1] == "all" || args[1] == "schemes";
    let budget: f64 = args[2].parse().unwrap();
    let names: Vec<String> = if all {
        catalogue::SHIPPED.iter().map(|s| s.name.to_string()).collect()
    } else {
        vec![args[1].clone()]
    };
    for name in names {
        let mut own = Scene::load(&name).unwrap();
        for a in &args[3..] {
            if let Some(x) = a.strip_prefix("dt=") {
                own.step.dt = x.parse().unwrap();
            }
        }
        let schemes =
            if args[1] == "schemes" { Scheme::ALL.to_vec() } else { vec![own.step.scheme] };
        for scheme in schemes {
            let mut scene = own.clone();
            scene.step.scheme = scheme;
            let mut sim = Simulation::of(&scene).unwrap();
            let start = Instant::now();
            let (mut n, mut shown, mut deepest) = (0, 0, 0.0f64);
            for _ in 0..scene.step.count {
                let step = match sim.step() {
                    Ok(s) => s,
                    Err(f) => {
                        println!("{name} {} FAILED {f}", scheme.name());
                        break;
                    }
                };
                n += 1;
                deepest = deepest.max(step.motion.penetration);
                for i in &step.interpenetrations {
                    shown += 1;
                    if shown < 6 {
                        println!("{name} {}: {}", scheme.name(), i.message(&scene, step.number));
                    }
                }
                for e in step.impact_energy.iter().flatten() {
                    shown += 1;
                    if shown < 6 {
                        println!("{name} {}: {}", scheme.name(), e.message(&scene, step.number));
                    }
                }
                if start.elapsed().as_secs_f64() > budget {
                    break;
                }
            }
            println!(
                "{name} {} {n}/{} steps, {shown} warnings, K {:?} thin {:?} deepest {deepest:.2e}",
                scheme.name(),
                scene.step.count,
                sim.motion().energy(),
                scene.thinnest()
            );
        }
    }
}

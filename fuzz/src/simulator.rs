//! Three steps of a small scene, by the plain simulation and by the stepper: states stay numbers.

use arbitrary::{Result, Unstructured};
use lcplab::body::State;
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::simulation::stepper::{Kernel, Stepper};
use lcplab::solver::{Options, Registry, Settings};

use crate::scene::scene;

const STEPS: usize = 3;

/// Makes a scene of the bytes; one that has defects is an answer.
pub fn simulator(bytes: &[u8]) -> Result<()> {
    let description = scene(&mut Unstructured::new(bytes))?;
    let Ok(scene) = Scene::new("fuzz", &description) else { return Ok(()) };
    let is_sound = |states: &[State]| {
        assert!(states.iter().all(State::is_finite), "{description:?}");
    };
    let settings = Settings::default().with_max_iterations(50);
    let options = Options::default().with_settings(settings);
    let solver =
        Registry::standard().entry(&scene.solver.name).expect("a known solver").build(&options);
    let mut simulation = Simulation::new(scene.clone(), solver);
    for _ in 0..STEPS {
        let outcome = simulation.step();
        is_sound(simulation.states());
        if outcome.is_err() {
            break;
        }
    }
    let kernels = [Kernel::RowByRow, Kernel::SimdPairs { threads: 1 }];
    for mut stepper in kernels.into_iter().filter_map(|k| Stepper::new(scene.clone(), 10, k).ok()) {
        for _ in 0..STEPS {
            let outcome = stepper.step();
            is_sound(stepper.states());
            if outcome.is_err() {
                break;
            }
        }
    }
    Ok(())
}

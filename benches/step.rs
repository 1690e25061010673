//! What does a whole step cost, and how does the cost grow from 700 to 20,000 cubes? Contact
//! detection, rows, sweeps and motion, by the stepper with a fixed number of sweeps.
//!
//! The results of one and two threads must be bitwise identical before anything is timed.

use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use lcplab::scene::Scene;
use lcplab::simulation::stepper::{Kernel, Stepper};

const SWEEPS: usize = 50;
/// Steps before those that are timed.
const WARM: usize = 2;
const KERNELS: [(&str, Kernel); 3] = [
    ("row by row", Kernel::RowByRow),
    ("eight pairs, one thread", Kernel::SimdPairs { threads: 1 }),
    ("eight pairs, two threads", Kernel::SimdPairs { threads: 2 }),
];

/// A round tower of this many cubes in twenty rings.
fn tower(cubes: usize) -> Scene {
    let text = format!(
        "generate = {{ kind = \"circular_tower\", count = {cubes}, ring = {}, size = 1, mass = 1 }}\n\
         step = {{ dt = 0.005 }}\n\
         contact = {{ friction = 0.6, margin = 0.01 }}\n\
         bodies = [{{ name = \"ground\", fixed = true, shape = {{ plane = [0, 0, 1] }} }}]\n",
        cubes / 20
    );
    Scene::from_toml("tower", &text).expect("a scene")
}

/// A net of side × side points and the rods between neighbors.
fn net(side: usize) -> Scene {
    let text = format!(
        "generate = {{ kind = \"net\", rows = {side}, columns = {side}, spacing = 0.1, hang = 1, mass = 0.01 }}\n\
         step = {{ dt = 0.005, baumgarte = 0.2 }}\n"
    );
    Scene::from_toml("net", &text).expect("a scene")
}

fn warm(scene: &Scene, kernel: Kernel) -> Stepper {
    let mut stepper = Stepper::new(scene.clone(), SWEEPS, kernel).expect("a stepper");
    (0..WARM).for_each(|_| stepper.step().expect("a step"));
    stepper
}

fn steps(criterion: &mut Criterion, name: &str, sizes: &[usize], scene: impl Fn(usize) -> Scene) {
    let mut group = criterion.benchmark_group(name);
    group.sample_size(10).measurement_time(Duration::from_secs(2));
    for &size in sizes {
        let scene = scene(size);
        let [one, two] = [1, 2].map(|threads| warm(&scene, Kernel::SimdPairs { threads }));
        assert_eq!(one.states(), two.states(), "one and two threads differ");
        let contacts = if one.found().is_empty() { one.x().len() } else { one.found().len() };
        group.throughput(Throughput::Elements(contacts as u64));
        for (kernel, how) in KERNELS {
            let id = BenchmarkId::new(kernel, size);
            group.bench_function(id, |bencher| {
                let mut stepper = warm(&scene, how);
                bencher.iter(|| stepper.step().expect("a step"));
            });
        }
    }
}

fn is_test() -> bool {
    std::env::args().any(|argument| argument == "--test")
}

fn towers(criterion: &mut Criterion) {
    // The cubes of a ring of 20 or more do not overlap.
    let sizes: &[usize] = if is_test() { &[400] } else { &[700, 1400, 2800, 5600, 10_000, 20_000] };
    steps(criterion, "step of a tower", sizes, tower);
}

fn nets(criterion: &mut Criterion) {
    let sizes: &[usize] = if is_test() { &[5] } else { &[20, 40, 80, 140, 200] };
    steps(criterion, "step of a net", sizes, net);
}

criterion_group!(benches, towers, nets);
criterion_main!(benches);

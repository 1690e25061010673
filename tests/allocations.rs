//! What the storages and the stepper say of their memory, beside what the allocator saw. A program
//! of its own: it replaces the global allocator by one that counts, thread by thread.

use allocation_counter::measure;
use lcplab::lcp::{Lcp, Matrix};
use lcplab::scene::Scene;
use lcplab::simulation::stepper::{Kernel, Stepper};
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::impulses::{Row, RowByRow, SimdPairs, System};
use lcplab::storage::{ALL, Entry};

/// A pile of boxes as a step meets it: `contacts` contacts of three rows, between neighbors.
fn jacobian(contacts: usize) -> Vec<Entry> {
    let row = |i: usize| {
        let below = i / 12; // four contacts a pair
        let value = move |k: usize| {
            if (i + k).is_multiple_of(5) { 0.0 } else { 1.0 + ((i * 7 + k * 3) % 11) as f64 }
        };
        (0..12).map(move |k| (i, 6 * below + k, value(k)))
    };
    (0..3 * contacts).flat_map(row).collect()
}

#[test]
fn the_bytes_of_a_storage_are_those_the_allocator_saw() {
    for kind in &ALL {
        for contacts in [0, 1, 7, 44] {
            let entries = jacobian(contacts);
            let mut storage = None;
            let made = measure(|| storage = Some((kind.of)(140, 72, &entries)));
            let body = made.bytes_current as usize - storage.unwrap().bytes(); // the box around it
            assert!(body > 0 && body < 100, "{} with {contacts}: {body}", kind.name);
        }
    }
}

/// Besides its arrays a kernel has its threads and the counters that they share.
#[test]
fn the_bytes_of_a_kernel_are_those_the_allocator_saw() {
    let bodies = 100;
    let row = |i: usize| Row { bodies: [i / 3, i / 3 + 1], jacobian: [[1.0; 6]; 2] };
    let rows: Vec<Row> = (0..3 * (bodies - 1)).map(row).collect();
    let n = rows.len();
    let (lo, hi) = (vec![0.0; n], vec![f64::INFINITY; n]);
    let lcp = Lcp::new(Matrix::sparse(n, &[]), vec![-1.0; n], lo, hi).unwrap();
    let mut system = None;
    let made = measure(|| system = Some(System::new(bodies, &rows, &lcp).unwrap()));
    let system = system.unwrap();
    assert_eq!(made.bytes_current, system.bytes() as i64);
    let mut plain = None;
    let made = measure(|| plain = Some(RowByRow::new(&system)));
    assert_eq!(made.bytes_current, plain.unwrap().bytes() as i64);
    let mut eight = None;
    let made = measure(|| eight = Some(SimdPairs::new(&system, Width::widest()).unwrap()));
    let beside = made.bytes_current - eight.unwrap().bytes() as i64;
    assert!((0..1000).contains(&beside), "{beside}");
}

const KERNELS: [Kernel; 3] =
    [Kernel::RowByRow, Kernel::SimdPairs { threads: 1 }, Kernel::SimdPairs { threads: 2 }];

fn generated(kind: &str) -> Scene {
    let ground = "[[bodies]]\nname = \"ground\"\nfixed = true\nshape = { plane = [0, 0, 1] }\n";
    let text =
        format!("generate = {{ {kind} }}\n[contact]\nfriction = 0.5\nmargin = 0.01\n{ground}");
    Scene::from_toml("pile.toml", &text).unwrap()
}

/// Boxes that stand, boxes that fall over, balls on nets, capsules and hulls, rods, bounces.
fn scenes() -> Vec<Scene> {
    let tower = generated("kind = \"circular_tower\", count = 70, ring = 14, size = 1, mass = 1");
    let shipped = ["pyramid", "dominoes", "net", "sphere_net", "arch", "ball_chain", "cradle"];
    shipped.into_iter().map(|name| Scene::load(name).unwrap()).chain([tower]).collect()
}

/// The second time along the same way: every list is as long as it ever gets.
#[test]
fn a_warm_step_of_a_scene_allocates_nothing() {
    for scene in scenes() {
        for kernel in KERNELS {
            let mut stepper = Stepper::new(scene.clone(), 10, kernel).unwrap();
            (0..20).for_each(|_| stepper.step().unwrap());
            stepper.restart();
            let warm = measure(|| (0..20).for_each(|_| stepper.step().unwrap()));
            assert_eq!(warm.count_total, 0, "{} by {kernel:?}: {warm:?}", scene.name);
        }
    }
}

#[test]
fn the_bytes_of_a_stepper_are_about_those_the_allocator_saw() {
    let large = |scene: &Scene| scene.bodies.len() > 30;
    for scene in scenes().into_iter().filter(large) {
        for kernel in KERNELS {
            let mut stepper = None;
            let given = scene.clone();
            let info = measure(|| {
                let mut made = Stepper::new(given, 10, kernel).unwrap();
                (0..3).for_each(|_| made.step().unwrap());
                stepper = Some(made);
            });
            let part = stepper.unwrap().bytes() as f64 / info.bytes_current as f64;
            assert!((0.8..1.2).contains(&part), "{} by {kernel:?}: {part}", scene.name);
        }
    }
}

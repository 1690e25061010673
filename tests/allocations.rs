//! The memory of storages and of the stepper as the allocator saw it. A program of its own: it
//! replaces the global allocator by one that counts, thread by thread.

use allocation_counter::measure;
use lcplab::scene::Scene;
use lcplab::simulation::stepper::{Kernel, Stepper};
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

//! What the storages and the stepper say of their memory, beside what the allocator saw. A program
//! of its own: it replaces the global allocator by one that counts, thread by thread.

use allocation_counter::measure;
use lcplab::lcp::{Lcp, Matrix};
use lcplab::scene::Scene;
use lcplab::simulation::stepper::{Kernel, Stepper};
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::impulses::{Row, RowByRow, SimdPairs, System};
use lcplab::storage::{ALL, Entry, MapOfMaps, Storage, sweep};

/// A pile of boxes as a step meets it: `contacts` contacts of three rows, between neighbors.
fn jacobian(contacts: usize) -> Vec<Entry> {
    let row = |i: usize| {
        let below = i / 12; // four contacts a pair
        let value = move |k: usize| {
            if (i + k).is_multiple_of(5) { 0.0 } else { 1.0 + ((i * 7 + k * 3) % 11) as f64 }
        };
        (0..12).map(move |k| (i, 6 * below + k, value(k)))
    };
    (0..3 * contacts).flat_map(row).filter(|(.., value)| *value != 0.0).collect()
}

const BODIES: usize = 12;
/// Contacts step by step: they come and go, the most in the first round.
const CONTACTS: [usize; 6] = [40, 31, 44, 24, 38, 44];

/// A band with a diagonal, of three rows a contact.
fn band(contacts: usize) -> Vec<Entry> {
    let n = 3 * contacts;
    let row = |i: usize| {
        (i.saturating_sub(4)..n.min(i + 5)).map(move |j| (i, j, 9.0 / (1 + i.abs_diff(j)) as f64))
    };
    (0..n).flat_map(row).collect()
}

/// The steps' entries of J and A and problems, made before anything is counted.
fn steps() -> Vec<([Vec<Entry>; 2], Lcp)> {
    let lcp = |n: usize| {
        let (lo, hi) = (vec![0.0; n], vec![f64::INFINITY; n]);
        Lcp::new(Matrix::sparse(n, &[]), vec![-1.0; n], lo, hi).unwrap()
    };
    CONTACTS.iter().map(|&c| ([jacobian(c), band(c)], lcp(3 * c))).collect()
}

/// Loads both matrices and sweeps ten times, as an engine does, all in storages that are kept.
fn frame(
    [j, a]: &mut [Box<dyn Storage>; 2],
    (entries, lcp): &([Vec<Entry>; 2], Lcp),
    x: &mut Vec<f64>,
) {
    let rows = lcp.len();
    j.reset(rows, 6 * BODIES).unwrap();
    j.load(&entries[0]).unwrap();
    a.reset(rows, rows).unwrap();
    a.load(&entries[1]).unwrap();
    x.clear();
    x.resize(rows, 0.0);
    for _ in 0..10 {
        sweep(lcp, a.as_ref(), x).unwrap();
    }
}

#[test]
fn a_warm_step_allocates_nothing_where_nodes_are_kept() {
    let steps = steps();
    for kind in &ALL {
        let mut matrices = [(); 2].map(|()| (kind.new)(6 * BODIES, 6 * BODIES));
        let mut x = Vec::new();
        let mut round =
            || measure(|| steps.iter().for_each(|step| frame(&mut matrices, step, &mut x)));
        let (cold, warm) = (round(), round());
        assert!(cold.count_total > 0, "{}", kind.name);
        // A map gives its nodes back one by one and asks for them again: E56's cost.
        let frees_nodes = kind.name == "map of maps";
        assert_eq!(warm.count_total > 0, frees_nodes, "{}: {warm:?}", kind.name);
    }
}

#[test]
fn bytes_and_allocations_are_those_the_allocator_saw() {
    for kind in &ALL {
        for contacts in [0, 1, 7, 44] {
            let entries = jacobian(contacts);
            let mut storage = None;
            let made = measure(|| storage = Some((kind.new)(140, 6 * BODIES)));
            let storage = storage.as_mut().unwrap();
            let body = made.bytes_current as usize - storage.bytes(); // the box around it
            assert!(body > 0 && body < 200, "{}", kind.name);
            let before = (storage.bytes(), storage.allocations());
            let loaded = measure(|| storage.load(&entries).unwrap());
            let held = storage.bytes() as i64 - before.0 as i64;
            assert_eq!(held, loaded.bytes_current, "{} with {contacts}", kind.name);
            let asked = storage.allocations() - before.1;
            assert_eq!(asked as u64, loaded.count_total, "{} with {contacts}", kind.name);
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

#[test]
fn a_map_that_was_set_out_of_order_holds_about_what_it_says() {
    let mut map = MapOfMaps::new(100, 100);
    let info = measure(|| {
        for k in 0..6000_usize {
            let place = k * 6007 % 10_000; // 6007 and 10,000 have no common factor
            map.set(place / 100, place % 100, 1.0).unwrap();
        }
    });
    let off = map.bytes() as f64 / info.bytes_current as f64 - 1.0;
    assert!(off.abs() < 0.3, "{off}");
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

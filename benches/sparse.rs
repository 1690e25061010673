//! What does an exact answer cost for a large sparse A, compared with clarabel?
//!
//! A net has equations only; a tower has contacts, with friction bounds frozen after some sweeps.
//! Ours and clarabel, both by rows, with A, and by velocities, with the factors of A:
//!
//! ```text
//! (A + D) dx = r      or      (1 + Ĵᵀ D⁻¹ Ĵ) v = Ĵᵀ D⁻¹ r,   A = Ĵ Ĵᵀ
//! ```

mod contest;

use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use lcplab::reference::{box_qp_to, velocity_qp_to};
use lcplab::solver::kernel::impulses::{Row, RowByRow, System, WIDTH};
use lcplab::solver::{InteriorPoint, Settings, Solver, Start};
use lcplab::storage::Factors;
use lcplab_benches::problems::posed;

const TOLERANCE: f64 = 2e-7;
/// Sweeps from x = 0 before friction bounds are frozen.
const SWEEPS: usize = 500;
/// Problems with more rows are only solved by velocities: by rows the tower takes seconds.
const MOST_ROWS: usize = 2000;

fn sparse(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("sparse");
    group.sample_size(10).measurement_time(Duration::from_secs(5));
    for &scene in contest::sizes(&["net", "tower"]) {
        measure(&mut group, scene);
    }
}

fn measure(group: &mut contest::Group, scene: &str) {
    let posed = posed(scene, 3).expect("a step");
    let factors = Factors::of(&posed.assembly);
    let rows = factors.scaled_rows();
    let coupled = System::new(factors.bodies(), &rows, &posed.lcp).expect("no row of zeros");
    let mut kernel = RowByRow::new(&coupled);
    (0..SWEEPS).for_each(|_| kernel.sweep(&coupled));
    let lcp = posed.lcp.frozen_at(kernel.x());
    let system = System::new(factors.bodies(), &rows, &lcp).expect("no row of zeros");
    let ours = InteriorPoint { settings: Settings::default().with_tolerance(TOLERANCE) };
    let (jacobian, velocities) = (entries(&rows), WIDTH * system.bodies());
    let start = Start::default();
    if lcp.len() <= MOST_ROWS {
        let by_rows = |asked| box_qp_to(&lcp, asked);
        contest::clarabel(group, "clarabel, rows", scene, &lcp, TOLERANCE, by_rows);
        let by_rows = || ours.solve(&lcp, &start, &mut ());
        contest::ours(group, "interior-point, rows", scene, &lcp, TOLERANCE, by_rows);
    }
    let by_velocities = |asked| velocity_qp_to(&lcp, &jacobian, velocities, asked);
    contest::clarabel(group, "clarabel, velocities", scene, &lcp, TOLERANCE, by_velocities);
    let by_velocities = || ours.solve_factored(&lcp, &system, &start, &mut ());
    contest::ours(group, "interior-point, velocities", scene, &lcp, TOLERANCE, by_velocities);
}

/// The entries of Ĵ.
fn entries(rows: &[Row]) -> Vec<(usize, usize, f64)> {
    let mut entries = Vec::new();
    for (i, row) in rows.iter().enumerate() {
        for (body, part) in row.bodies.iter().zip(&row.jacobian) {
            let nonzero = part.iter().enumerate().filter(|(_, j)| **j != 0.0);
            entries.extend(nonzero.map(|(k, &j)| (i, WIDTH * body + k, j)));
        }
    }
    entries
}

criterion_group!(benches, sparse);
criterion_main!(benches);

use lcplab::lcp::{Lcp, Matrix};
use lcplab::scene::Scene;
use lcplab::simulation::Simulation;
use lcplab::solver::{Options, Order, Pgs, Settings, Solver, Start, by_name};
use lcplab::storage::Factors;
use lcplab::storage::{ALL, Entry, Kind, Storage, Workspace, sweep, triple_product};
use nalgebra::{DMatrix, Matrix6};
use proptest::prelude::*;

use lcplab_testing::{Iterates, cases};

const BODIES: usize = 4;

/// Rows of J over one or two of four bodies, and symmetric blocks of M⁻¹.
fn factors() -> impl Strategy<Value = Factors> {
    let block = || proptest::collection::vec(-3.0..3.0f64, 6);
    let row = (0..BODIES, 0..BODIES, block(), block());
    let mass = proptest::collection::vec(-1.0..1.0f64, 36);
    let rows = proptest::collection::vec(row, 1..9);
    (rows, proptest::collection::vec(mass, BODIES)).prop_map(|(rows, masses)| {
        let mut jacobian: Vec<Entry> = Vec::new();
        for (i, (first, second, own, other)) in rows.iter().enumerate() {
            let mut blocks = vec![(first, own)];
            blocks.extend((first != second).then_some((second, other)));
            blocks.sort_by_key(|(body, _)| **body);
            for (body, block) in blocks {
                jacobian.extend((0..6).map(|k| (i, 6 * body + k, block[k])));
            }
        }
        let inverse_masses: Vec<Matrix6<f64>> = masses
            .iter()
            .map(|values| {
                let square = Matrix6::from_row_slice(values);
                square * square.transpose() + Matrix6::identity()
            })
            .collect();
        let entry = |body: usize, i: usize, j: usize| {
            (6 * body + i, 6 * body + j, inverse_masses[body][(i, j)])
        };
        let places = (0..BODIES).flat_map(|b| (0..36).map(move |k| (b, k / 6, k % 6)));
        let inverse_mass = places.map(|(b, i, j)| entry(b, i, j)).collect();
        let (rows, columns) = (rows.len(), 6 * BODIES);
        Factors { rows, columns, jacobian, inverse_mass, inverse_masses }
    })
}

fn loaded(kind: &Kind, rows: usize, columns: usize, entries: &[Entry]) -> Box<dyn Storage> {
    let mut storage = (kind.new)(rows, columns);
    storage.load(entries).unwrap();
    storage
}

/// A = J M⁻¹ Jᵀ with all three matrices in one kind of storage.
fn assembled(kind: &Kind, factors: &Factors) -> Box<dyn Storage> {
    let j = loaded(kind, factors.rows, factors.columns, &factors.jacobian);
    let m_inv = loaded(kind, factors.columns, factors.columns, &factors.inverse_mass);
    let mut a = (kind.new)(0, 0);
    triple_product(j.as_ref(), m_inv.as_ref(), a.as_mut(), &mut Workspace::default()).unwrap();
    a
}

fn plain(rows: usize, columns: usize, entries: &[Entry]) -> DMatrix<f64> {
    let mut matrix = DMatrix::zeros(rows, columns);
    entries.iter().for_each(|&(i, j, value)| matrix[(i, j)] = value);
    matrix
}

fn entries_of(a: &dyn Storage) -> Vec<Entry> {
    let row = |i| a.row(i).unwrap().into_iter().map(move |(j, value)| (i, j, value));
    (0..a.rows()).flat_map(row).collect()
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn assembly_is_the_matrix_product_and_the_same_bits_in_every_storage(factors in factors()) {
        let j = plain(factors.rows, factors.columns, &factors.jacobian);
        let m_inv = plain(factors.columns, factors.columns, &factors.inverse_mass);
        let exact = &j * m_inv * j.transpose();
        let first = entries_of(assembled(&ALL[0], &factors).as_ref());
        for kind in &ALL {
            let a = assembled(kind, &factors);
            prop_assert_eq!(&entries_of(a.as_ref()), &first, "{}", kind.name);
        }
        let found = plain(factors.rows, factors.rows, &first);
        prop_assert!((found - exact).amax() < 1e-10); // entries of up to 10⁴
    }

    #[test]
    fn sweeps_have_the_same_bits_in_every_storage_and_in_the_solver(
        factors in factors(),
        b in proptest::collection::vec(-2.0..2.0f64, 8),
    ) {
        let n = factors.rows;
        let entries = entries_of(assembled(&ALL[0], &factors).as_ref());
        let (lo, hi) = (vec![0.0; n], vec![f64::INFINITY; n]);
        let lcp = Lcp::new(Matrix::sparse(n, &entries), b[..n].to_vec(), lo, hi).unwrap();
        let settings = Settings { tolerance: 0.0, max_iterations: 7, check_every: 1, ..Settings::default() };
        let solver = Pgs { omega: 1.0, order: Order::Natural, settings };
        let mut iterates = Iterates::default();
        solver.solve(&lcp, &Start::default(), &mut iterates);
        for kind in &ALL {
            let a = loaded(kind, n, n, &entries);
            let mut x = vec![0.0; n];
            for expected in iterates.0.iter().skip(1) {
                sweep(&lcp, a.as_ref(), &mut x).unwrap();
                prop_assert_eq!(&x, expected, "{}", kind.name);
            }
        }
    }
}

#[test]
fn storages_assemble_the_matrix_that_the_library_solves() {
    for name in ["stack", "net", "chain", "ragdoll"] {
        let scene = Scene::load(name).unwrap();
        let solver = by_name("dantzig", &Options::default()).unwrap();
        let step = Simulation::new(scene, solver).step().unwrap();
        let problem = &step.solves[0].problem;
        let factors = Factors::of(&problem.assembly);
        let largest =
            (0..factors.rows).map(|i| problem.lcp.matrix().diagonal(i)).fold(0.0, f64::max);
        for a in ALL.iter().map(|kind| assembled(kind, &factors)) {
            for i in 0..factors.rows {
                for j in 0..factors.rows {
                    let off = a.get(i, j).unwrap() - problem.lcp.matrix().entry(i, j);
                    assert!(off.abs() <= 1e-14 * largest, "{name} {} ({i}, {j}): {off}", a.name());
                }
            }
        }
    }
}

#[test]
fn a_row_without_a_diagonal_stops_the_sweep_unless_it_is_pinned() {
    use lcplab::storage::{Error, MapOfMaps};
    let a = MapOfMaps::from_rows(2, 2, &[1.0, 0.0, 0.0, 0.0]).unwrap();
    let lcp = |hi: f64| {
        let matrix = Matrix::dense(2, &[1.0, 0.0, 0.0, 0.0]);
        Lcp::new(matrix, vec![-1.0, -1.0], vec![0.0; 2], vec![f64::INFINITY, hi]).unwrap()
    };
    let mut x = [0.0; 2];
    let zero = Error::Diagonal { row: 1, diagonal: 0.0 };
    assert_eq!(sweep(&lcp(1.0), &a, &mut x), Err(zero));
    assert_eq!(sweep(&lcp(0.0), &a, &mut x), Ok(()));
    assert_eq!(x, [1.0, 0.0]);
}

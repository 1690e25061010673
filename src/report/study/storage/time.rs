//! Times of the storages on this machine: to find an entry, to multiply a row, to assemble A, to sweep.

use std::hint::black_box;
use std::time::{Duration, Instant};

use serde::{Deserialize, Serialize};

use super::structure::assembled;
use super::{Plan as Task, SEED, first_problem, scattered, shuffled};
use crate::error::Result;
use crate::formulation::Problem;
use crate::lcp::{Lcp, Matrix};
use crate::scene::Scene;
use crate::storage::Factors;
use crate::storage::{ALL, Entry, Kind, Storage, Workspace, sweep, triple_product};

/// All times.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Times {
    /// A square matrix of one size at several fills, entries at random places.
    pub by_fill: Vec<Time>,
    /// A of stacks of more and more cubes.
    pub by_size: Vec<Time>,
}

/// The times of a matrix in a storage (s).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Time {
    /// The storage's name.
    pub storage: String,
    /// Rows.
    pub rows: usize,
    /// Entries that are not zero.
    pub entries: usize,
    /// To read an entry, the mean over places chosen at random.
    pub get: f64,
    /// To multiply a row with a vector, the mean over rows.
    pub row: f64,
    /// To assemble A = J M⁻¹ Jᵀ with all three in this storage.
    pub assembly: Option<f64>,
    /// A sweep of projected Gauss-Seidel.
    pub sweep: f64,
}

/// Places and rows that are read for a mean.
const SAMPLES: usize = 64;
/// Measured for so long, and the best of so many.
const SPAN: Duration = Duration::from_millis(2);
const ROUNDS: usize = 3;

/// Measures, one after the other.
///
/// # Errors
/// Numbers that make no matrix.
pub fn run(task: &Task) -> Result<Times> {
    let order = shuffled(task.size * task.size, SEED);
    let mut by_fill = Vec::new();
    for fill in task.fills.iter().filter(|fill| **fill > 0.0) {
        let count = (fill / 100.0 * order.len() as f64).round() as usize;
        let entries = with_diagonal(task.size, scattered(task.size, &order, count));
        let lcp = contacts(task.size, &entries)?;
        for kind in &ALL {
            let mut a = (kind.new)(task.size, task.size);
            a.load(&entries)?;
            by_fill.push(Time {
                sweep: sweeping(&lcp, a.as_ref())?,
                ..reads(a.as_ref(), entries.len())
            });
        }
    }
    let mut by_size = Vec::new();
    for &bodies in &task.stacks {
        let Some(problem) = stack(bodies)? else { continue };
        let factors = Factors::of(&problem.assembly);
        let entries = assembled(&factors)?;
        let lcp = contacts(factors.rows, &entries)?;
        for kind in &ALL {
            by_size.push(of_kind(kind, &lcp, &entries, &factors)?);
        }
    }
    Ok(Times { by_fill, by_size })
}

/// A stack of so many cubes in its first step.
fn stack(bodies: usize) -> Result<Option<Problem>> {
    let text = format!(
        "title = \"a stack\"\nteaches = \"\"\n[generate]\nkind = \"stack\"\ncount = {bodies}\nsize = 1\nmass = 1\n\
         [step]\ndt = 0.01\ncount = 1\n[contact]\nfriction = 0.5\n\
         [[bodies]]\nname = \"ground\"\nfixed = true\nshape = {{ plane = [0, 0, 1] }}\n"
    );
    first_problem(Scene::from_toml("stack", &text)?)
}

/// The same with a diagonal that sweeps can divide by.
fn with_diagonal(size: usize, mut entries: Vec<Entry>) -> Vec<Entry> {
    entries.retain(|(i, j, _)| i != j);
    entries.extend((0..size).map(|i| (i, i, 1e3)));
    entries.sort_by_key(|&(i, j, _)| (i, j));
    entries
}

fn contacts(n: usize, entries: &[Entry]) -> Result<Lcp> {
    let (lo, hi) = (vec![0.0; n], vec![f64::INFINITY; n]);
    Lcp::new(Matrix::sparse(n, entries), vec![-1.0; n], lo, hi)
}

fn of_kind(kind: &Kind, lcp: &Lcp, entries: &[Entry], factors: &Factors) -> Result<Time> {
    let mut a = (kind.new)(lcp.len(), lcp.len());
    a.load(entries)?;
    let (assembly, sweep) = (Some(assembly(kind, factors)?), sweeping(lcp, a.as_ref())?);
    Ok(Time { assembly, sweep, ..reads(a.as_ref(), entries.len()) })
}

fn sweeping(lcp: &Lcp, a: &dyn Storage) -> Result<f64> {
    let mut x = vec![0.0; lcp.len()];
    sweep(lcp, a, &mut x)?;
    Ok(seconds(|| sweep(lcp, a, black_box(&mut x)).is_ok()))
}

/// Reads entries and rows.
fn reads(a: &dyn Storage, entries: usize) -> Time {
    let n = a.rows();
    let mut random = oorandom::Rand64::new(u128::from(SEED));
    let mut index = || random.rand_range(0..n as u64) as usize;
    let places: Vec<_> = (0..SAMPLES).map(|_| (index(), index())).collect();
    let x = vec![1.0; n];
    let get = seconds(|| places.iter().all(|&(i, j)| black_box(a.get(i, j)).is_ok()));
    let row = seconds(|| places.iter().all(|&(i, _)| black_box(a.row_dot(i, &x)).is_ok()));
    let mean = |time: f64| time / SAMPLES as f64;
    let storage = a.name().to_string();
    Time { storage, rows: n, entries, get: mean(get), row: mean(row), assembly: None, sweep: 0.0 }
}

fn assembly(kind: &Kind, factors: &Factors) -> Result<f64> {
    let mut j = (kind.new)(factors.rows, factors.columns);
    j.load(&factors.jacobian)?;
    let mut m_inv = (kind.new)(factors.columns, factors.columns);
    m_inv.load(&factors.inverse_mass)?;
    let mut a = (kind.new)(0, 0);
    let mut workspace = Workspace::default();
    triple_product(j.as_ref(), m_inv.as_ref(), a.as_mut(), &mut workspace)?;
    Ok(seconds(|| triple_product(j.as_ref(), m_inv.as_ref(), a.as_mut(), &mut workspace).is_ok()))
}

/// The wall time of some work (s): the best of a few rounds, each of as many runs as fill [`SPAN`].
fn seconds(mut work: impl FnMut() -> bool) -> f64 {
    let mut round = || {
        let start = Instant::now();
        let mut runs = 0.0;
        while runs == 0.0 || start.elapsed() < SPAN {
            black_box(work());
            runs += 1.0;
        }
        start.elapsed().as_secs_f64() / runs
    };
    (0..ROUNDS).map(|_| round()).fold(f64::INFINITY, f64::min)
}

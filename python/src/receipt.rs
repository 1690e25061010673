//! Bounds on the error of the motion of an engine's step.

use std::thread;

use lcplab::certificate::gap_bound::{EllipticCone, GapBound, gap_bound};
use lcplab::certificate::motion_bound::{Unproved, motion_bound};
use lcplab::error::{Error, Result};
use lcplab::lcp::Gauss;
use numpy::PyReadonlyArray1;
use pyo3::prelude::*;

use crate::refused;

type Numbers<'py> = PyReadonlyArray1<'py, f64>;
type Indices<'py> = PyReadonlyArray1<'py, i64>;
/// Rows, columns and values of stored entries.
type Triplets<'py> = (Indices<'py>, Indices<'py>, Numbers<'py>);

/// A step as an engine reports it.
#[derive(FromPyObject)]
pub struct Step<'py> {
    #[pyo3(item("mass"))]
    mass: Triplets<'py>,
    #[pyo3(item("jacobian"))]
    jacobian: Triplets<'py>,
    #[pyo3(item("bias"))]
    bias: Numbers<'py>,
    #[pyo3(item("compliance"))]
    compliance: Numbers<'py>,
    #[pyo3(item("target"))]
    target: Numbers<'py>,
    #[pyo3(item("lo"))]
    lo: Numbers<'py>,
    #[pyo3(item("hi"))]
    hi: Numbers<'py>,
    #[pyo3(item("friction_index"))]
    friction_index: Indices<'py>,
    #[pyo3(item("mu"))]
    mu: Numbers<'py>,
    #[pyo3(item("forces"))]
    forces: Numbers<'py>,
    #[pyo3(item("motion"))]
    motion: Numbers<'py>,
}

/// A step as Rust values.
struct Frame {
    gauss: Gauss,
    cones: Vec<EllipticCone>,
    forces: Vec<f64>,
    motion: Vec<f64>,
}

/// Bounds on the motion, on u(x) and between them, with the worst row.
type Bounds = (f64, f64, f64, Option<usize>);

/// The bounds of many steps, on all processors; for a step without bounds, the reason.
#[pyfunction]
pub fn motion_bounds(
    py: Python<'_>,
    steps: Vec<Step<'_>>,
) -> PyResult<Vec<(Option<Bounds>, Option<String>)>> {
    let frames = steps.iter().map(Step::frame).collect::<Result<Vec<_>>>().map_err(refused)?;
    let bounds = py.detach(|| of_all(&frames));
    let parts = |bound: std::result::Result<GapBound, Unproved>| match bound {
        Ok(GapBound { motion, answer, closure, row }) => {
            (Some((motion, answer, closure, row)), None)
        }
        Err(why) => (None, Some(why.to_string())),
    };
    Ok(bounds.into_iter().map(parts).collect())
}

fn of_all(frames: &[Frame]) -> Vec<std::result::Result<GapBound, Unproved>> {
    let threads = thread::available_parallelism().map_or(1, usize::from).min(frames.len()).max(1);
    let share = frames.len().div_ceil(threads).max(1);
    thread::scope(|scope| {
        let parts: Vec<_> = frames
            .chunks(share)
            .map(|part| scope.spawn(move || part.iter().map(Frame::bound).collect::<Vec<_>>()))
            .collect();
        parts
            .into_iter()
            .flat_map(|part| part.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic)))
            .collect()
    })
}

impl Frame {
    /// By the duality gap; of boxes without compliance by a motion that obeys all rows.
    fn bound(&self) -> std::result::Result<GapBound, Unproved> {
        let Frame { gauss, cones, forces, motion } = self;
        gap_bound(gauss, cones, forces, motion).or_else(|why| {
            if !cones.is_empty() || matches!(why, Unproved::NotFinite | Unproved::Mass) {
                return Err(why);
            }
            let bound = motion_bound(gauss, forces)?.energy_norm;
            let closure = closure(gauss, forces, motion)?;
            let motion = (bound + closure).next_up();
            Ok(GapBound { motion, answer: bound, closure, row: None })
        })
    }
}

/// |v − u(x)|_M, which no bound on any row enters.
fn closure(gauss: &Gauss, forces: &[f64], motion: &[f64]) -> std::result::Result<f64, Unproved> {
    let n = forces.len();
    let free = Gauss {
        lo: forces.to_vec(),
        hi: forces.to_vec(),
        compliance: vec![1.0; n],
        ..gauss.clone()
    };
    gap_bound(&free, &[], forces, motion).map(|bound| bound.closure)
}

impl Step<'_> {
    fn frame(&self) -> Result<Frame> {
        let target = numbers(&self.target);
        let bias = numbers(&self.bias);
        let (n, k) = (bias.len(), target.len());
        let sized = |name: &str, values: &Numbers<'_>, size: usize| {
            let values = numbers(values);
            match values.len() == size {
                true => Ok(values),
                false => Err(fault(name, format!("has {} entries, not {size}", values.len()))),
            }
        };
        let mass = entries("mass", &self.mass, k, k)?;
        let mut jacobian = vec![Vec::new(); n];
        for (i, j, value) in entries("jacobian", &self.jacobian, n, k)? {
            jacobian[i].push((j, value));
        }
        let gauss = Gauss {
            mass: mass.into_iter().filter(|(i, j, _)| i <= j).collect(),
            jacobian,
            bias,
            compliance: sized("compliance", &self.compliance, n)?,
            target,
            lo: sized("lo", &self.lo, n)?,
            hi: sized("hi", &self.hi, n)?,
            level: None,
        };
        let mu = sized("mu", &self.mu, n)?;
        let forces = sized("forces", &self.forces, n)?;
        let motion = sized("motion", &self.motion, k)?;
        let cones = cones(self.friction_index.as_array().iter().copied(), &mu)?;
        Ok(Frame { gauss, cones, forces, motion })
    }
}

fn fault(part: &str, reason: impl Into<String>) -> Error {
    Error::invalid("step", part, reason.into())
}

fn numbers(array: &Numbers<'_>) -> Vec<f64> {
    array.as_array().to_vec()
}

/// The entries of a matrix of this size.
fn entries(
    name: &str,
    (rows, columns, values): &Triplets<'_>,
    n: usize,
    k: usize,
) -> Result<Vec<(usize, usize, f64)>> {
    let places = rows.as_array().into_iter().zip(columns.as_array());
    let place = |index: i64, size: usize| usize::try_from(index).ok().filter(|&own| own < size);
    let entry = |((&i, &j), &value): ((&i64, &i64), &f64)| match (place(i, n), place(j, k)) {
        (Some(i), Some(j)) => Ok((i, j, value)),
        _ => Err(fault(name, format!("has an entry at {i}, {j}, outside {n} × {k}"))),
    };
    places.zip(values.as_array()).map(entry).collect()
}

/// The cones of rows of friction, −1 for other rows.
fn cones(index: impl Iterator<Item = i64>, mu: &[f64]) -> Result<Vec<EllipticCone>> {
    let mut friction: Vec<Vec<(usize, f64)>> = vec![Vec::new(); mu.len()];
    for (row, normal) in index.enumerate().filter(|(_, normal)| *normal != -1) {
        let place = usize::try_from(normal).ok().filter(|&k| k < mu.len() && k != row);
        let place = place.ok_or_else(|| {
            fault("friction_index", format!("row {row} names {normal}, which is no other row"))
        })?;
        friction[place].push((row, mu[row]));
    }
    let with_friction = friction.into_iter().enumerate().filter(|(_, own)| !own.is_empty());
    Ok(with_friction.map(|(normal, friction)| EllipticCone { normal, friction }).collect())
}

//! Project Chrono's matrix dumps: one file each for masses, Jacobian and forces.
//!
//! Defined by `ChSystemDescriptor` (src/chrono/solver/ChSystemDescriptor.cpp), whose
//! `WriteMatrixBlocks(path, prefix)`, formerly `DumpLastMatrices` with the prefix `dump`, writes
//! the problem solved in the last step, and by `StreamOut` in src/chrono/core/ChMatrix.h:
//!
//! | file | contents |
//! | --- | --- |
//! | `dump_H.dat`, formerly `dump_M.dat` | H, masses (and stiffness, damping) over the step; lines `row column value` |
//! | `dump_Cq.dat` | Cq, the Jacobian of the constraints; lines `row column value` |
//! | `dump_E.dat` | E, the constraints' compliance, a diagonal; optional |
//! | `dump_f.dat` | f, one number per line |
//! | `dump_b.dat` | b, one number per line |
//! | `dump_fric.dat` | μ in the normal row of a contact, −1 in its tangents, −2 in any other row |
//!
//! The path of the problem is their folder, `dump`, or `dump_Cq.dat`. With impulses l, velocities v
//! and w = Cq v + b + |E| l,
//!
//! ```text
//! H v = f + Cqᵀ l        A = Cq H⁻¹ Cqᵀ + |E|        b ← Cq H⁻¹ f + b
//! ```
//!
//! A contact has the rows n, t1, t2; rows with −2 are equations. Chrono's iterative solvers use the
//! *associated* cone (Tasora & Anitescu 2011), so that is the `model`; for Coulomb's law choose the
//! model `coulomb-cone`.
//!
//! Traps: b has the opposite sign of the lower half of Chrono's assembled right-hand side
//! (`dump_rhs.dat`), and so have its unknowns −l. E is written as +cfm although the comments say
//! −cfm; since a compliance is never negative, the reader takes the absolute value. Indices start
//! at 1 in old dumps and at 0 in current ones, unless `one_indexed` was set: the reader counts from
//! 0 if any index is 0. Current versions of Chrono no longer write `dump_fric.dat`, which
//! distinguishes joints from contacts: write it by hand, one number per line. A joint limit has −2
//! like a joint, and is read as an equation. Numbers have about twelve digits, and answers cannot
//! be more accurate. The format is import only, because a problem does not contain the H and Cq of
//! its A.

use super::delassus::{Entry, Motion, is_symmetric};
use super::words::Words;
use super::{Format, Input};
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::{Parts, Problem};
use lcplab_lcp::friction::Model;

/// Chrono's dumps.
pub const FORMAT: Format = Format {
    name: "chrono",
    about: "Project Chrono: dumps of H, Cq, E, f, b and friction, one file each",
    endings: &["_Cq.dat"],
    in_folder: Some("_Cq.dat"),
    beside: &["H", "M", "E", "f", "b", "fric"],
    carries: "contacts with friction and equations",
    law: Some(Model::AssociatedCone),
    trap: "dump_fric.dat states which rows are contacts; current versions of Chrono do not write it",
    read,
    write: None,
};

/// The part of the problem in the main file.
const MAIN: &str = "Cq";

fn read(input: &Input) -> Result<Problem> {
    let name = input.name();
    let file = |part: &str| input.companion(MAIN, part);
    let numbers = |part: &str| list(&file(part).text()?, &file(part).name());
    let (force, b) = (numbers("f")?, numbers("b")?);
    let mass = if file("H").exists() { file("H") } else { file("M") };
    let files = [Some(mass), Some(file(MAIN)), Some(file("E")).filter(Input::exists)];
    let [mass, jacobian, compliance] = blocks(&files, [force.len(), b.len()])?;
    let friction = file("fric");
    if !friction.exists() {
        let reason = "is missing; write one, a number for each row of Cq: mu for the normal of a \
                      contact, -1 for its two tangents, -2 for an equation";
        return Err(Error::invalid(friction.name(), "file", reason));
    }
    let rows = Rows::of(&numbers("fric")?, b.len(), &friction.name())?;
    let mut motion = Motion { mass, jacobian: vec![Vec::new(); b.len()], force };
    jacobian.into_iter().for_each(|(i, c, value)| motion.jacobian[i].push((c, value)));
    let mut diagonal = vec![0.0; b.len()];
    compliance.into_iter().for_each(|(i, _, value)| diagonal[i] += f64::abs(value));
    let (entries, free) = motion.dual(&diagonal, "H", &name, input.most())?;
    let b = free.iter().zip(&b).map(|(free, b)| free + b).collect();
    let Rows { lo, index, mu } = rows;
    let has_contacts = index.iter().any(Option::is_some);
    let (index, mu) = if has_contacts { (Some(index), Some(mu)) } else { (None, None) };
    let parts = Parts { entries, b, lo: Some(lo), hi: None, index, mu };
    let mut problem =
        Problem::new(input.stem(), parts.into_lcp().map_err(|error| error.within(&name))?);
    problem.model = has_contacts.then_some(Model::AssociatedCone);
    Ok(problem)
}

/// The entries of H, Cq and E, indices from 0, if they lie within the sizes of f and b.
fn blocks(files: &[Option<Input>; 3], [k, n]: [usize; 2]) -> Result<[Vec<Entry>; 3]> {
    let mut blocks = [const { Vec::new() }; 3];
    for (block, file) in blocks.iter_mut().zip(files).filter_map(|(b, f)| Some((b, f.as_ref()?))) {
        *block = entries(&file.text()?, &file.name())?;
    }
    let first = usize::from(blocks.iter().flatten().all(|(i, j, _)| *i > 0 && *j > 0));
    for ((block, file), [rows, cols]) in blocks.iter_mut().zip(files).zip([[k, k], [n, k], [n, n]])
    {
        let fault = |reason: String| {
            let name = file.as_ref().map(Input::name).unwrap_or_default();
            Err(Error::invalid(name, "file", reason))
        };
        for (i, j, value) in block.iter_mut() {
            (*i, *j) = (*i - first, *j - first);
            if *i >= rows || *j >= cols {
                return fault(format!(
                    "has an entry at {i}, {j} (from 0), outside {rows} × {cols}"
                ));
            }
            if !value.is_finite() {
                return fault(format!("has {value} at {i}, {j} (from 0)"));
            }
        }
    }
    let [mass, _, compliance] = &blocks;
    let fault = |part: &Option<Input>, reason: &str| {
        let name = part.as_ref().map(Input::name).unwrap_or_default();
        Err(Error::invalid(name, "file", reason))
    };
    if !is_symmetric(mass) {
        return fault(&files[0], "is not symmetric");
    }
    if compliance.iter().any(|(i, j, value)| i != j && *value != 0.0) {
        return fault(&files[2], "is not a diagonal");
    }
    Ok(blocks)
}

/// The entries of a matrix, lines `row column value`.
fn entries(text: &str, input: &str) -> Result<Vec<Entry>> {
    let mut words = Words::new(text, input);
    let mut entries = Vec::new();
    while !words.is_empty() {
        let place = (words.whole("a row")?, words.whole("its column")?);
        entries.push((place.0, place.1, words.number("its value")?));
    }
    Ok(entries)
}

fn list(text: &str, input: &str) -> Result<Vec<f64>> {
    let mut words = Words::new(text, input);
    let mut numbers = Vec::new();
    while !words.is_empty() {
        numbers.push(words.number(format_args!("number {}", numbers.len()))?);
    }
    match numbers.iter().find(|number| !number.is_finite()) {
        Some(number) => Err(Error::invalid(input, "file", format!("has {number}"))),
        None => Ok(numbers),
    }
}

/// The rows as classified by the coefficients of friction.
struct Rows {
    lo: Vec<f64>,
    index: Vec<Option<usize>>,
    mu: Vec<f64>,
}

impl Rows {
    fn of(friction: &[f64], n: usize, input: &str) -> Result<Self> {
        if friction.len() != n {
            let reason = format!("has {} numbers, b has {n}", friction.len());
            return Err(Error::invalid(input, "file", reason));
        }
        let mut rows = Rows { lo: vec![-f64::INFINITY; n], index: vec![None; n], mu: vec![0.0; n] };
        let mut i = 0;
        while i < n {
            match friction[i..] {
                [-2.0, ..] => i += 1,
                [mu, -1.0, -1.0, ..] if mu >= 0.0 => {
                    rows.lo[i] = 0.0;
                    for t in [i + 1, i + 2] {
                        (rows.index[t], rows.mu[t]) = (Some(i), mu);
                    }
                    i += 3;
                }
                _ => {
                    let reason = "must be -2, or mu followed by -1 and -1";
                    return Err(Error::invalid(input, format!("number {i}"), reason));
                }
            }
        }
        Ok(rows)
    }
}

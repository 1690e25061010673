//! Writes FCLIB's local problems as HDF5.

use hdf5_writer::{DatasetBuilder, H5WriteElement, Hdf5Builder, WriteOptions};

use crate::Output;
use crate::contacts::Arrangement;
use lcplab_lcp::Lcp;
use lcplab_lcp::error::{Error, Result};
use lcplab_lcp::file::Problem;

pub(super) fn write(problem: &Problem) -> Result<Output> {
    let order = Arrangement::of(problem, "fclib")?;
    let lcp = &problem.lcp;
    check_coupling(lcp, &order)?;
    let (contacts, equations) = order.rows.split_at(3 * order.mu.len());
    let b = |rows: &[usize]| rows.iter().map(|i| lcp.b()[*i]).collect::<Vec<_>>();
    let mut file = File(Hdf5Builder::new());
    file.add("spacedim", &[3i32])?;
    file.matrix("W", lcp, contacts, contacts)?;
    file.add("vectors/q", &b(contacts))?;
    file.add("vectors/mu", &order.mu)?;
    if !equations.is_empty() {
        file.matrix("V", lcp, contacts, equations)?;
        file.matrix("R", lcp, equations, equations)?;
        file.add("vectors/s", &b(equations))?;
    }
    let title = if problem.name.is_empty() { "problem" } else { &problem.name };
    let title = DatasetBuilder::fixed_string_data("fclib_local/info/title", vec![], &[title]);
    let file = file.0.dataset(title.map_err(fault)?);
    let plan = file.into_plan().map_err(fault)?;
    let bytes = plan.encode(WriteOptions::default()).map_err(fault)?;
    Ok(Output { notes: Arrangement::notes(&order.rows), ..Output::of(bytes) })
}

/// Checks that contacts and equations are coupled symmetrically, because V is written only once.
fn check_coupling(lcp: &Lcp, order: &Arrangement) -> Result<()> {
    let mut is_equation = vec![false; lcp.len()];
    order.equations().iter().for_each(|i| is_equation[*i] = true);
    for i in 0..lcp.len() {
        for (j, a) in lcp.matrix().row(i).iter().filter(|(j, _)| is_equation[i] != is_equation[*j])
        {
            if lcp.matrix().entry(j, i) != a {
                let reason =
                    "differs from A of the other triangle: FCLIB stores the coupling V once";
                return Err(Error::invalid("fclib", format!("A[{i}][{j}]"), reason));
            }
        }
    }
    Ok(())
}

struct File(Hdf5Builder);

impl File {
    /// Adds a list of numbers.
    fn add<T: H5WriteElement>(&mut self, path: &str, values: &[T]) -> Result<()> {
        let path = format!("fclib_local/{path}");
        let dataset = DatasetBuilder::typed_data(path, vec![values.len() as u64], values);
        self.0 = std::mem::take(&mut self.0).dataset(dataset.map_err(fault)?);
        Ok(())
    }

    /// The block of A with these rows and columns, as compressed columns.
    fn matrix(&mut self, name: &str, lcp: &Lcp, rows: &[usize], cols: &[usize]) -> Result<()> {
        let mut column_of = vec![None; lcp.len()];
        cols.iter().enumerate().for_each(|(k, j)| column_of[*j] = Some(k));
        let mut columns = vec![Vec::new(); cols.len()];
        for (k, i) in rows.iter().enumerate() {
            for (j, a) in lcp.matrix().row(*i).iter().filter(|(_, a)| *a != 0.0) {
                column_of[j].into_iter().for_each(|column: usize| columns[column].push((k, a)));
            }
        }
        let mut starts = vec![0];
        for column in &columns {
            starts.push(starts[starts.len() - 1] + column.len());
        }
        let integer = |value: usize| {
            i32::try_from(value).map_err(|_| fault(format!("{value} exceeds FCLIB's integers")))
        };
        let integers =
            |values: Vec<usize>| values.into_iter().map(integer).collect::<Result<Vec<_>>>();
        let entries = || columns.iter().flatten();
        self.add(&format!("{name}/nzmax"), &[integer(entries().count())?])?;
        self.add(&format!("{name}/m"), &[integer(rows.len())?])?;
        self.add(&format!("{name}/n"), &[integer(cols.len())?])?;
        self.add(&format!("{name}/nz"), &[-1i32])?;
        self.add(&format!("{name}/p"), &integers(starts)?)?;
        self.add(&format!("{name}/i"), &integers(entries().map(|(k, _)| *k).collect())?)?;
        self.add(&format!("{name}/x"), &entries().map(|(_, a)| *a).collect::<Vec<f64>>())
    }
}

fn fault(cause: impl std::fmt::Display) -> Error {
    Error::invalid("fclib", "file", cause.to_string())
}

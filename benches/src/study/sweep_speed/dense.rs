//! A dense problem: eigenvalues 1/n, 2/n, …, 1, and half of the rows free.

use std::hint::black_box;

use super::{BEFORE, COUNTED, Checked, Finding, Form, On, Plan, Started, Times, clocked};
use crate::study::timing::{Contender, Time, timed};
use lcplab::error::Result;
use lcplab::lcp::{Lcp, Matrix, library};
use lcplab::solver::kernel::Width;
use lcplab::solver::kernel::dense::{Columns, Rows};
use lcplab::solver::kernel::reading::{Reading, read};

/// The name of the form by rows.
pub const ROWS: &str = "by rows";
/// The name of the form by columns.
pub const COLUMNS: &str = "by columns";

pub(super) fn measure(plan: &Plan, problem: String, n: usize) -> Result<(Finding, Times)> {
    let lcp = posed(n)?;
    let order: Vec<usize> = (0..n).collect();
    let forms = [Form::plain(&lcp, &order), by_rows(&lcp, &order), by_columns(&lcp, &order)];
    let checked: Result<Vec<Checked>> = forms.iter().map(|form| form.checked(&lcp)).collect();
    let finding = Finding {
        problem: problem.clone(),
        rows: n,
        stored: lcp.matrix().stored(),
        tolerances: Vec::new(),
        forms: checked?,
    };
    let reads = Reading::ALL.map(|reading| contender(&lcp, reading));
    let (reads, runs) = clocked(plan, &forms, &finding, reads.into());
    let read = reads.into_iter().min_by(|a: &Time, b| a.best.total_cmp(&b.best));
    Ok((finding, Times { problem, rows: n, read, tolerances: Vec::new(), runs }))
}

fn posed(n: usize) -> Result<Lcp> {
    let lcp = library::by_name("pd")?.generate(&[("n", n as f64)])?.lcp;
    let matrix = Matrix::from(lcp.matrix().to_dense().as_view());
    Lcp::new(matrix, lcp.b().to_vec(), lcp.lo().to_vec(), lcp.hi().to_vec())
}

/// A read of the very memory that the sweeps read, warmed up as they are: a copy of A lies in other
/// pages, which has made a tenth of a difference.
fn contender(lcp: &Lcp, reading: Reading) -> Contender<'_> {
    let a = match lcp.matrix() {
        Matrix::Dense(a) => a.entries(),
        Matrix::Sparse(_) => &[],
    };
    let once = move |_| _ = black_box(read(black_box(a), reading, Width::widest()));
    Contender::new(move || {
        (0..BEFORE).for_each(once);
        timed(|| (0..COUNTED).for_each(once))
    })
}

fn by_rows<'a>(lcp: &'a Lcp, order: &[usize]) -> Form<'a> {
    let start = move |width| -> Started<'a> {
        let rows = Rows::of(lcp, 1.0, width)?;
        let sweep = move |x: &mut [f64]| rows.sweep(x);
        Ok(Box::new(On { x: vec![0.0; lcp.len()], sweep }))
    };
    form(ROWS, order, start)
}

fn by_columns<'a>(lcp: &'a Lcp, order: &[usize]) -> Form<'a> {
    let start = move |width| -> Started<'a> {
        let mut columns = Columns::of(lcp, 1.0, width)?;
        let sweep = move |x: &mut [f64]| _ = columns.sweep(x);
        Ok(Box::new(On { x: vec![0.0; lcp.len()], sweep }))
    };
    form(COLUMNS, order, start)
}

fn form<'a>(
    name: &'static str,
    order: &[usize],
    start: impl Fn(Width) -> Started<'a> + 'a,
) -> Form<'a> {
    let widths = Width::available().collect();
    Form { name, widths, order: order.to_vec(), start: Box::new(start) }
}

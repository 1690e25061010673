use lcplab_solver::kernel::Width;
use lcplab_solver::kernel::table::Table;
use lcplab_solver::linalg::elimination::difference;
use proptest::prelude::*;

use lcplab_testing::cases;

const ROWS: usize = 21;
const COLUMNS: usize = 13;

/// A table in textbook form.
#[derive(Clone)]
struct Plain(Vec<Vec<f64>>);

impl Plain {
    /// Solves row r for the variable of column c and substitutes it into the others.
    fn pivot(&mut self, r: usize, c: usize) {
        let pivot = std::mem::replace(&mut self.0[r][c], -1.0);
        let solved: Vec<f64> = self.0[r].iter().map(|entry| entry / -pivot).collect();
        for row in &mut self.0 {
            let factor = std::mem::replace(&mut row[c], 0.0);
            for (entry, new) in row.iter_mut().zip(&solved) {
                *entry = difference(*entry, -factor * new);
            }
        }
        self.0[r] = solved;
    }

    /// The position with the largest entry after this one; sizes of at least 1/8 suffice.
    fn place(&self, k: usize) -> (usize, usize) {
        let places = (0..ROWS * COLUMNS).map(|j| (k + j) % (ROWS * COLUMNS));
        let mut places = places.map(|j| (j / COLUMNS, j % COLUMNS));
        places.find(|&(r, c)| self.0[r][c].abs() >= 0.125).unwrap_or((0, 0))
    }
}

fn table(entries: &[Vec<f64>], width: Width) -> Table {
    let mut table = Table::zeros(entries.len(), entries[0].len(), width);
    for (r, row) in entries.iter().enumerate() {
        row.iter().enumerate().for_each(|(c, &entry)| table.set(r, c, entry));
    }
    table
}

fn entries(table: &Table) -> Vec<Vec<f64>> {
    let row = |r| (0..COLUMNS).map(|c| table.entry(r, c)).collect();
    (0..ROWS).map(row).collect()
}

/// Small quarters, so that entries vanish and cancel.
fn quarters() -> impl Strategy<Value = Vec<Vec<f64>>> {
    let entry = (-4i32..=4).prop_map(|k| f64::from(k) / 4.0);
    proptest::collection::vec(proptest::collection::vec(entry, COLUMNS), ROWS)
}

proptest! {
    #![proptest_config(cases(60))]

    #[test]
    fn pivots_that_wait_have_the_bits_of_pivots_made_at_once(
        start in quarters(), places in proptest::collection::vec(0..ROWS * COLUMNS, 30),
    ) {
        for width in Width::available() {
            let (mut plain, mut table) = (Plain(start.clone()), table(&start, width));
            for &k in &places {
                let (r, c) = plain.place(k);
                let column: Vec<f64> = plain.0.iter().map(|row| row[c]).collect();
                prop_assert_eq!(table.column(c), column.clone());
                if column[r] == 0.0 {
                    break;
                }
                plain.pivot(r, c);
                prop_assert_eq!(table.pivot(r, c), column, "{:?}", width);
                prop_assert_eq!(entries(&table), plain.0.clone(), "{:?}", width);
            }
            table.flush();
            prop_assert_eq!(entries(&table), plain.0);
        }
    }

    #[test]
    fn a_row_or_column_changes_its_sign_whatever_waits_for_it(
        start in quarters(), places in proptest::collection::vec(0..ROWS * COLUMNS, 5),
    ) {
        let (mut plain, mut table) = (Plain(start.clone()), table(&start, Width::widest()));
        for &k in &places {
            let (r, c) = plain.place(k);
            prop_assume!(plain.0[r][c] != 0.0);
            plain.pivot(r, c);
            table.pivot(r, c);
            plain.0[k % ROWS].iter_mut().for_each(|entry| *entry = -*entry);
            table.negate_row(k % ROWS);
            plain.0.iter_mut().for_each(|row| row[k % COLUMNS] = -row[k % COLUMNS]);
            table.negate_column(k % COLUMNS);
        }
        table.flush();
        prop_assert_eq!(entries(&table), plain.0);
    }

    #[test]
    fn exchanging_everything_inverts(
        diagonal in proptest::collection::vec(0.5..2.0f64, 37),
        u in proptest::collection::vec(-1.0..1.0f64, 37),
    ) {
        // Sherman & Morrison: (D + u uᵀ)⁻¹ = D⁻¹ − D⁻¹ u uᵀ D⁻¹ / (1 + uᵀ D⁻¹ u)
        let n = diagonal.len();
        let d = |r: usize, c: usize| if r == c { diagonal[r] } else { 0.0 };
        let row = |r: usize| (0..n).map(|c| d(r, c) + u[r] * u[c]).collect();
        let mut table = table(&(0..n).map(row).collect::<Vec<_>>(), Width::widest());
        (0..n).for_each(|k| drop(table.pivot(k, k)));
        let scale = 1.0 + (0..n).map(|k| u[k] * u[k] / diagonal[k]).sum::<f64>();
        for r in 0..n {
            for c in 0..n {
                let own = if r == c { 1.0 / diagonal[r] } else { 0.0 };
                let inverse = own - u[r] / diagonal[r] * u[c] / diagonal[c] / scale;
                prop_assert!((table.entry(r, c) - inverse).abs() < 1e-13);
            }
        }
    }
}

#[test]
fn what_cancels_is_exactly_zero() {
    // Row 1 is a third of row 0.
    let third = 1.0 / 3.0;
    let mut table = table(&[vec![3.0, 0.7], vec![1.0, 0.7 * third]], Width::widest());
    table.pivot(0, 0);
    assert_eq!(table.entry(1, 1), 0.0);
    table.flush();
    assert_eq!(table.entry(1, 1), 0.0);
}

//! Block exchange: many pivots at once, some basic variables for some nonbasic ones.

use super::Dictionary;
use crate::pivot::variable::Variable;
use crate::tolerances::CANCELLED_ENTRY;

impl Dictionary {
    /// Exchanges these basic variables for these nonbasic ones, the largest entry first, until all
    /// are exchanged or only zeros are left. An entry counts as zero if it has lost all its digits
    /// relative to its largest value during the exchange.
    pub(crate) fn exchange(
        &mut self,
        is_leaving: impl Fn(Variable) -> bool,
        is_entering: impl Fn(Variable) -> bool,
    ) {
        let mut rows: Vec<usize> = (0..self.basic.len()).collect();
        let mut columns: Vec<usize> = (0..self.nonbasic.len()).collect();
        let mut largest = vec![0.0f64; rows.len() * columns.len()];
        loop {
            rows.retain(|&r| is_leaving(self.basic[r]));
            columns.retain(|&c| is_entering(self.nonbasic[c]));
            self.table.flush();
            let (mut pivot, mut size) = (None, 0.0);
            for &r in &rows {
                for &c in &columns {
                    let now = self.table.entry(r, c).abs();
                    let seen = &mut largest[r * self.nonbasic.len() + c];
                    *seen = seen.max(now);
                    if now > CANCELLED_ENTRY * *seen && now >= size {
                        (pivot, size) = (Some((r, c)), now);
                    }
                }
            }
            let Some((r, c)) = pivot else { break };
            self.pivot(r, c);
        }
        for (&r, &c) in rows.iter().flat_map(|r| columns.iter().map(move |c| (r, c))) {
            self.table.set(r, c, 0.0);
        }
    }
}

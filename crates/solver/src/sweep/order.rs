//! The order of the rows in a sweep.
//!
//! Every order converges to a solution if the natural order does, but at another rate and, if the
//! solution is not unique, possibly to another solution. For tridiagonal and other consistently
//! ordered A the natural and the colored order have the same rate.

use lcplab_lcp::Lcp;

/// The order of the rows in a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// 1, 2, …, n.
    #[default]
    Natural,
    /// n, …, 2, 1.
    Reverse,
    /// Natural, then reverse: each row twice. The method is then called symmetric (SSOR).
    Symmetric,
    /// One random permutation, the same in every sweep.
    Shuffled {
        /// The seed of the permutation.
        seed: u64,
    },
    /// Color by color, where no two rows of a color share an entry of A: red and black for a
    /// tridiagonal A. Rows of one color are independent and could be updated in parallel.
    Colored,
}

impl Order {
    /// The row indices in this order.
    ///
    /// ```
    /// use lcplab_lcp::{Lcp, Matrix};
    /// use lcplab_solver::Order;
    ///
    /// // Each of three boxes touches the next one.
    /// let a = Matrix::from([[2.0, -1.0, 0.0], [-1.0, 2.0, -1.0], [0.0, -1.0, 2.0]]);
    /// let lcp = Lcp::new(a, vec![-1.0; 3], vec![0.0; 3], vec![f64::INFINITY; 3])?;
    /// assert_eq!(Order::Symmetric.rows(&lcp), [0, 1, 2, 2, 1, 0]);
    /// assert_eq!(Order::Colored.rows(&lcp), [0, 2, 1]); // rows 0 and 2 share no entry
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn rows(self, lcp: &Lcp) -> Vec<usize> {
        let natural = 0..lcp.len();
        match self {
            Order::Natural => natural.collect(),
            Order::Reverse => natural.rev().collect(),
            Order::Symmetric => natural.clone().chain(natural.rev()).collect(),
            Order::Shuffled { seed } => shuffled(natural.collect(), seed),
            Order::Colored => {
                let color = colors(lcp);
                let mut rows: Vec<usize> = natural.collect();
                // The sort is stable: natural order within a color.
                rows.sort_by_key(|&i| color[i]);
                rows
            }
        }
    }
}

/// Fisher-Yates with the splitmix64 generator.
fn shuffled(mut rows: Vec<usize>, seed: u64) -> Vec<usize> {
    let mut state = seed;
    for last in (1..rows.len()).rev() {
        state = state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = state;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        let pick = (z ^ (z >> 31)) % (last as u64 + 1);
        rows.swap(last, pick as usize);
    }
    rows
}

/// For each row, the least color that no earlier neighbor has. A friction row is a neighbor of the
/// row that bounds it.
fn colors(lcp: &Lcp) -> Vec<usize> {
    let n = lcp.len();
    let mut neighbors = vec![Vec::new(); n];
    let friction = lcp.coupling().into_iter().flat_map(|coupling| coupling.rows());
    for (i, j) in lcp.matrix().pattern().into_iter().chain(friction) {
        neighbors[i].push(j);
        neighbors[j].push(i);
    }
    let mut color = vec![usize::MAX; n];
    for i in 0..n {
        let taken = |c: usize| neighbors[i].iter().any(|&j| j != i && color[j] == c);
        color[i] = (0..n).find(|&c| !taken(c)).unwrap_or(0);
    }
    color
}

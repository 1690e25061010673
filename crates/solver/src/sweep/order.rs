//! In which order a sweep takes the rows.
//!
//! Every order leads to a solution where the natural one does, at another rate and, where the
//! solution is not unique, to another one. For tridiagonal and other consistently ordered A the
//! rates of the natural and the coloured order are the same.

use lcplab_problem::Lcp;

/// The order of the rows in a sweep.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Order {
    /// 1, 2, …, n.
    #[default]
    Natural,
    /// n, …, 2, 1.
    Reverse,
    /// Natural, then reverse: each row twice. The method is then called symmetric.
    Symmetric,
    /// One random permutation, the same in every sweep.
    Shuffled {
        /// The seed of the permutation.
        seed: u64,
    },
    /// Colour by colour, where no two rows of a colour have an entry of A in common: red and black
    /// for a tridiagonal A. Rows of a colour do not see each other, so they could be done at once.
    Coloured,
}

impl Order {
    /// The rows in this order.
    pub fn rows(self, lcp: &Lcp) -> Vec<usize> {
        let natural = 0..lcp.len();
        match self {
            Order::Natural => natural.collect(),
            Order::Reverse => natural.rev().collect(),
            Order::Symmetric => natural.clone().chain(natural.rev()).collect(),
            Order::Shuffled { seed } => shuffled(natural.collect(), seed),
            Order::Coloured => {
                let colour = colours(lcp);
                let mut rows: Vec<usize> = natural.collect();
                rows.sort_by_key(|&i| colour[i]); // stable: natural within a colour
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

/// The least colour that no earlier neighbour has, for each row. A friction row is a neighbour of
/// the row that bounds it.
fn colours(lcp: &Lcp) -> Vec<usize> {
    let n = lcp.len();
    let mut neighbours = vec![Vec::new(); n];
    let friction = lcp.coupling().into_iter().flat_map(|coupling| coupling.rows());
    for (i, j) in lcp.matrix().pattern().into_iter().chain(friction) {
        neighbours[i].push(j);
        neighbours[j].push(i);
    }
    let mut colour = vec![usize::MAX; n];
    for i in 0..n {
        let taken = |c: usize| neighbours[i].iter().any(|&j| j != i && colour[j] == c);
        colour[i] = (0..n).find(|&c| !taken(c)).unwrap_or(0);
    }
    colour
}

//! Elimination orderings, and the number of entries in the factor of a sparse matrix.
//!
//! A direct method factorizes A into L Lᵀ (or L D Lᵀ), and L has entries where A has none:
//! eliminating a row connects all remaining rows coupled to it. The number of entries depends only
//! on the order:
//!
//! - *natural*: the given order.
//! - *reverse Cuthill-McKee* (1969; reversed by George 1971): neighbors get nearby numbers, so that
//!   all entries stay near the diagonal.
//! - *minimum degree* (Amestoy, Davis & Duff 1996, approximate; faer's): the row with the fewest
//!   neighbors is eliminated next.
//!
//! Sweeps need no factor and no ordering of this kind; pivoting methods do.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// The graph of coupled rows: the pattern of a symmetric matrix without its diagonal.
///
/// ```
/// use lcplab::storage::{Graph, Ordering};
///
/// // A chain of three rows: a tridiagonal matrix.
/// let chain = Graph::of(3, [(0, 1), (1, 2)]);
/// assert_eq!((chain.is_empty(), chain.lower_entries()), (false, 5)); // three and two
/// assert_eq!((chain.bandwidth(&[0, 1, 2]), chain.bandwidth(&[0, 2, 1])), (1, 2));
/// // In the natural order its factor has no other entries; from the middle it has one more.
/// let mut entries = Vec::new();
/// chain.visit_factor(&[0, 1, 2], &mut |row, column| entries.push((row, column)));
/// assert_eq!(entries.len(), 5);
/// assert_eq!(chain.factor_entries(&[1, 0, 2]), 6);
/// assert_eq!(Ordering::Natural.name(), "natural");
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Graph {
    /// The neighbors of each row, ascending.
    neighbors: Vec<Vec<usize>>,
}

/// An ordering of the rows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ordering {
    /// The given order.
    Natural,
    /// Reverse Cuthill-McKee, near the diagonal.
    ReverseCuthillMcKee,
    /// Fewest neighbors first.
    MinimumDegree,
}

impl Graph {
    /// The graph of an n × n pattern; (i, j) also counts as (j, i).
    ///
    /// ```
    /// use lcplab::storage::{Graph, Ordering};
    ///
    /// // A hub and its spokes, the hub first: everything fills in. Last: nothing.
    /// let star = Graph::of(6, (1..6).map(|spoke| (0, spoke)));
    /// assert_eq!(star.factor_entries(&Ordering::Natural.rows(&star)), 21);
    /// assert_eq!(star.factor_entries(&Ordering::MinimumDegree.rows(&star)), 6 + 5);
    /// ```
    ///
    /// # Panics
    /// If an index is not below n.
    pub fn of(n: usize, pattern: impl IntoIterator<Item = (usize, usize)>) -> Self {
        let mut neighbors = vec![Vec::new(); n];
        for (i, j) in pattern.into_iter().filter(|(i, j)| i != j) {
            neighbors[i].push(j);
            neighbors[j].push(i);
        }
        for own in &mut neighbors {
            own.sort_unstable();
            own.dedup();
        }
        Graph { neighbors }
    }

    /// The number of rows.
    pub fn len(&self) -> usize {
        self.neighbors.len()
    }

    /// Whether there are no rows.
    pub fn is_empty(&self) -> bool {
        self.neighbors.is_empty()
    }

    /// The number of entries of the matrix on and below the diagonal: the minimum for its factor.
    pub fn lower_entries(&self) -> usize {
        self.len() + self.neighbors.iter().map(Vec::len).sum::<usize>() / 2
    }

    /// Calls `visit` with the positions (row, column) of the matrix with its rows in this order.
    pub(crate) fn visit(&self, order: &[usize], visit: &mut dyn FnMut(usize, usize)) {
        let place = inverse(order);
        for (i, &row) in order.iter().enumerate() {
            visit(i, i);
            self.neighbors[row].iter().for_each(|&other| visit(i, place[other]));
        }
    }

    /// Calls `visit` with the positions (row, column) of the factor L with the rows eliminated in
    /// this order. Row i of L extends from each entry of row i of A up the elimination tree, which
    /// is built on the way (Liu 1986).
    pub fn visit_factor(&self, order: &[usize], visit: &mut dyn FnMut(usize, usize)) {
        let place = inverse(order);
        let mut parent = vec![usize::MAX; self.len()];
        let mut seen_by = vec![usize::MAX; self.len()];
        for (i, &row) in order.iter().enumerate() {
            seen_by[i] = i;
            visit(i, i);
            for &other in &self.neighbors[row] {
                let mut j = place[other];
                while j < i && seen_by[j] != i {
                    seen_by[j] = i;
                    visit(i, j);
                    if parent[j] == usize::MAX {
                        parent[j] = i;
                    }
                    j = parent[j];
                }
            }
        }
    }

    /// The number of entries of L, including the diagonal.
    pub fn factor_entries(&self, order: &[usize]) -> usize {
        let mut count = 0;
        self.visit_factor(order, &mut |_, _| count += 1);
        count
    }

    /// The largest distance of an entry from the diagonal.
    pub fn bandwidth(&self, order: &[usize]) -> usize {
        let mut largest = 0;
        self.visit(order, &mut |i, j| largest = largest.max(i.abs_diff(j)));
        largest
    }

    /// Rows by distance from a start (those at equal distance in the order they were reached,
    /// fewest neighbors first), and the distance of the last.
    fn levels(&self, start: usize, reached: &mut [bool]) -> (Vec<usize>, usize) {
        let mut rows = vec![start];
        let mut distance = vec![0];
        reached[start] = true;
        let mut next = 0;
        while next < rows.len() {
            let first = rows.len();
            for &other in &self.neighbors[rows[next]] {
                if !std::mem::replace(&mut reached[other], true) {
                    rows.push(other);
                    distance.push(distance[next] + 1);
                }
            }
            rows[first..].sort_by_key(|&row| self.neighbors[row].len());
            next += 1;
        }
        (rows, distance.last().copied().unwrap_or(0))
    }

    /// A peripheral row in the component of `row`: as far as possible from the previous one.
    fn rim(&self, mut row: usize) -> usize {
        let mut eccentricity = 0;
        loop {
            let (rows, distance) = self.levels(row, &mut vec![false; self.len()]);
            if distance <= eccentricity {
                return row;
            }
            eccentricity = distance;
            row = rows.last().copied().unwrap_or(row);
        }
    }

    fn reverse_cuthill_mckee(&self) -> Vec<usize> {
        let mut order = Vec::with_capacity(self.len());
        let mut reached = vec![false; self.len()];
        let mut starts: Vec<usize> = (0..self.len()).collect();
        starts.sort_by_key(|&row| self.neighbors[row].len());
        for start in starts {
            if !reached[start] {
                order.extend(self.levels(self.rim(start), &mut reached).0);
            }
        }
        order.reverse();
        order
    }

    fn minimum_degree(&self) -> Vec<usize> {
        let n = self.len();
        let mut starts = vec![0];
        let mut entries = Vec::new();
        for own in &self.neighbors {
            entries.extend_from_slice(own);
            starts.push(entries.len());
        }
        let pattern = SymbolicSparseColMatRef::new_checked(n, n, &starts, None, &entries);
        let (mut order, mut place) = (vec![0; n], vec![0; n]);
        let mut memory = MemBuffer::new(amd::order_scratch::<usize>(n, entries.len()));
        let stack = MemStack::new(&mut memory);
        let outcome = amd::order(&mut order, &mut place, pattern, amd::Control::default(), stack);
        // It fails only on index overflow, which a graph in memory cannot cause.
        outcome.map_or_else(|_| (0..n).collect(), |_| order)
    }
}

impl Ordering {
    /// All orderings.
    pub const ALL: [Ordering; 3] =
        [Ordering::Natural, Ordering::ReverseCuthillMcKee, Ordering::MinimumDegree];

    /// Its name in tables.
    pub fn name(self) -> &'static str {
        match self {
            Ordering::Natural => "natural",
            Ordering::ReverseCuthillMcKee => "reverse Cuthill-McKee",
            Ordering::MinimumDegree => "minimum degree",
        }
    }

    /// The rows in elimination order.
    pub fn rows(self, graph: &Graph) -> Vec<usize> {
        match self {
            Ordering::Natural => (0..graph.len()).collect(),
            Ordering::ReverseCuthillMcKee => graph.reverse_cuthill_mckee(),
            Ordering::MinimumDegree => graph.minimum_degree(),
        }
    }
}

/// The position of each row in the order.
fn inverse(order: &[usize]) -> Vec<usize> {
    let mut place = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &row)| place[row] = k);
    place
}

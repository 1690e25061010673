//! The loops of a triangular factor, with L stored in panels of eight rows.
//!
//! ```text
//! panel p: rows 8p … 8p + 7, cut into tiles of eight columns; in a tile, column by column
//! ```
//!
//! Eight rows are eight lanes, whose sums are independent and need no horizontal addition, and all
//! memory access except writing a single row is sequential. A panel begins at the first tile in
//! which one of its rows has an entry: if neighbors are coupled only to neighbors, as in a stack, a
//! band remains (the *envelope* of George & Liu 1981), which reduces all costs.

use super::lanes::{Lanes, Width, Work, sum};

/// Eight consecutive entries of a vector or of a column.
pub(crate) type Lane8 = [f64; 8];

/// Eight columns of eight rows: `tile[column][row]`.
pub(crate) type Tile = [Lane8; 8];

/// A unit lower triangular matrix. The unit diagonal is not stored; all other entries of a row may
/// be zero.
#[derive(Debug, Clone)]
pub(crate) struct Panels {
    tiles: Vec<Tile>,
    /// The first tile of each panel.
    begin: Vec<usize>,
    width: Width,
}

/// The range of tiles of a panel: panel p has p + 1.
fn place(panel: usize) -> std::ops::Range<usize> {
    let start = panel * (panel + 1) / 2;
    start..start + panel + 1
}

impl Panels {
    /// An empty matrix.
    pub(crate) fn new(width: Width) -> Self {
        Panels { tiles: Vec::new(), begin: Vec::new(), width }
    }

    /// The instruction set of the loops.
    pub(crate) fn width(&self) -> Width {
        self.width
    }

    /// An entry left of the diagonal.
    pub(crate) fn entry(&self, row: usize, column: usize) -> f64 {
        let tiles = &self.tiles[place(row / 8)];
        tiles[column / 8][column % 8][row % 8]
    }

    /// The first column in which `row` may have an entry.
    pub(crate) fn first(&self, row: usize) -> usize {
        8 * self.begin[row / 8]
    }

    /// Writes a row, either after the last or over a zero one; its entries before tile `begin` are
    /// zero.
    pub(crate) fn set(&mut self, row: usize, entries: &[Lane8], begin: usize) {
        let (panel, lane) = (row / 8, row % 8);
        if panel == self.begin.len() {
            self.begin.push(panel);
            self.tiles.resize(place(panel).end, [[0.0; 8]; 8]);
        }
        let begin = begin.min(panel);
        self.begin[panel] = self.begin[panel].min(begin);
        let tiles = &mut self.tiles[place(panel)];
        for (tile, entries) in tiles[begin..panel].iter_mut().zip(&entries[begin..]) {
            for (column, entry) in tile.iter_mut().zip(entries) {
                column[lane] = *entry;
            }
        }
        for column in 0..lane {
            tiles[panel][column][lane] = entries[panel][column];
        }
    }

    /// Removes the panels from this one on.
    pub(crate) fn truncate(&mut self, panels: usize) {
        self.begin.truncate(panels);
        self.tiles.truncate(place(panels).start);
    }

    /// z ← L⁻¹ z; z is zero before panel `begin`.
    pub(crate) fn forward(&self, z: &mut [Lane8], begin: usize) {
        self.width.run(Forward { l: self, z, begin });
    }

    /// z ← L⁻ᵀ z.
    pub(crate) fn backward(&self, z: &mut [Lane8], sums: &mut Vec<Tile>) {
        sums.clear();
        sums.resize(z.len(), [[0.0; 8]; 8]);
        self.width.run(Backward { l: self, z, sums });
    }

    /// L D Lᵀ ← L D Lᵀ without row and column k, which become those of the identity.
    pub(crate) fn remove(&mut self, k: usize, diagonal: &mut [Lane8]) {
        let (begin, width) = (self.begin[k / 8], self.width);
        for tile in &mut self.tiles[place(k / 8)][begin..] {
            tile.iter_mut().for_each(|column| column[k % 8] = 0.0);
        }
        let alpha = std::mem::replace(&mut diagonal[k / 8][k % 8], 1.0);
        width.run(Removal { l: self, k, alpha, diagonal });
    }
}

struct Forward<'a> {
    l: &'a Panels,
    z: &'a mut [Lane8],
    begin: usize,
}

impl Work for Forward<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Forward { l, z, begin } = self;
        for p in begin..z.len() {
            let tiles = &l.tiles[place(p)];
            let first = l.begin[p].max(begin);
            let (solved, rest) = z.split_at_mut(p);
            let mut sums = [V::splat(0.0); 4];
            for (tile, z) in tiles[first..p].iter().zip(&solved[first..]) {
                for c in 0..8 {
                    sums[c % 4] = sums[c % 4] + V::load(&tile[c]) * V::splat(z[c]);
                }
            }
            let [a, b, c, d] = sums;
            (V::load(&rest[0]) - ((a + b) + (c + d))).store(&mut rest[0]);
            let (tile, z) = (&tiles[p], &mut rest[0]);
            for c in 0..7 {
                for r in c + 1..8 {
                    z[r] -= tile[c][r] * z[c];
                }
            }
        }
    }
}

struct Backward<'a> {
    l: &'a Panels,
    z: &'a mut [Lane8],
    /// Σ l_rc z_r of each column c over the rows processed so far, in eight parts.
    sums: &'a mut [Tile],
}

impl Work for Backward<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Backward { l, z, sums } = self;
        for p in (0..z.len()).rev() {
            let (tiles, first) = (&l.tiles[place(p)], l.begin[p]);
            let z = &mut z[p];
            for c in 0..8 {
                z[c] -= sum(sums[p][c]);
            }
            for r in (1..8).rev() {
                for c in 0..r {
                    z[c] -= tiles[p][c][r] * z[r];
                }
            }
            let z = V::load(z);
            for (tile, sums) in tiles[first..p].iter().zip(&mut sums[first..]) {
                for c in 0..8 {
                    (V::load(&sums[c]) + V::load(&tile[c]) * z).store(&mut sums[c]);
                }
            }
        }
    }
}

/// L D Lᵀ + α v vᵀ, where v is the removed column k (method C1 of Gill, Golub, Murray & Saunders
/// 1974); stable because α > 0.
struct Removal<'a> {
    l: &'a mut Panels,
    k: usize,
    alpha: f64,
    diagonal: &'a mut [Lane8],
}

impl Work for Removal<'_> {
    type Output = ();

    #[inline(always)]
    fn run<V: Lanes>(self) {
        let Removal { l, k, mut alpha, diagonal } = self;
        let first = k / 8;
        // (p, β) by columns.
        let mut steps = vec![([0.0; 8], [0.0; 8]); diagonal.len() - first];
        for panel in first..diagonal.len() {
            let begin = l.begin[panel];
            let tiles = &mut l.tiles[place(panel)];
            let mut v = V::load(&std::mem::replace(&mut tiles[first][k % 8], [0.0; 8]));
            let from = begin.max(first);
            for (tile, (p, beta)) in tiles[from..panel].iter_mut().zip(&steps[from - first..]) {
                for c in 0..8 {
                    let l = V::load(&tile[c]);
                    v = v - V::splat(p[c]) * l;
                    (l + V::splat(beta[c]) * v).store(&mut tile[c]);
                }
            }
            let mut v = v.to_array();
            let (tile, d, (p, beta)) =
                (&mut tiles[panel], &mut diagonal[panel], &mut steps[panel - first]);
            for c in 0..8 {
                p[c] = v[c];
                let updated = d[c] + alpha * p[c] * p[c];
                beta[c] = alpha * p[c] / updated;
                alpha *= d[c] / updated;
                d[c] = updated;
                for r in c + 1..8 {
                    v[r] -= p[c] * tile[c][r];
                    tile[c][r] += beta[c] * v[r];
                }
            }
        }
    }
}

//! The columns of a problem that appear in some row, and its matrices restricted to them.

use crate::explain::step_units::of_motion;
use lcplab_mechanics::formulation::Problem;
use lcplab_mechanics::scene::Scene;
use lcplab_page::document::{Formula, SHOWN};

/// A problem without the columns that appear in no row.
pub(super) struct Columns<'a> {
    pub problem: &'a Problem,
    pub kept: Vec<usize>,
    /// Rows of J, dense, with only the kept columns; the first [`SHOWN`] rows.
    jacobian: Vec<Vec<f64>>,
    pub is_angular: bool,
}

impl<'a> Columns<'a> {
    pub fn of(problem: &'a Problem) -> Self {
        let assembly = &problem.assembly;
        let mut kept: Vec<usize> =
            assembly.jacobian_pattern().into_iter().map(|(_, column)| column).collect();
        kept.sort_unstable();
        kept.dedup();
        let dense = |i: usize| {
            let row = assembly.jacobian_row(i);
            let entry = |k: &usize| row.iter().find(|(column, _)| column == k).map_or(0.0, |e| e.1);
            kept.iter().map(entry).collect()
        };
        let jacobian = (0..assembly.rows.len().min(SHOWN)).map(dense).collect();
        let is_angular = kept.iter().any(|&column| component(problem, column).1 >= 3);
        Columns { problem, kept, jacobian, is_angular }
    }

    /// Whether J, M⁻¹ and A are those of another problem, so that they need not be shown again.
    pub fn has_matrices_of(&self, other: &Problem) -> bool {
        let (own, before) = (&self.problem.assembly, &other.assembly);
        let (lcp, known) = (&self.problem.lcp, &other.lcp);
        let rows = own.rows.len();
        let is_plain = |problem: &Problem| problem.slides.is_empty();
        rows == before.rows.len()
            && own.columns() == before.columns()
            && is_plain(self.problem)
            && is_plain(other)
            && (0..rows).all(|i| own.jacobian_row(i) == before.jacobian_row(i))
            && (0..rows).all(|i| lcp.matrix().row(i).iter().eq(known.matrix().row(i).iter()))
            && (lcp.lo(), lcp.hi()) == (known.lo(), known.hi())
    }

    pub fn pick(&self, values: &[f64]) -> Vec<f64> {
        self.kept.iter().map(|&column| values[column]).collect()
    }

    pub fn unit(&self) -> &'static str {
        of_motion(self.problem.stage, self.is_angular)
    }

    /// Adds J.
    pub fn j(&self, formula: Formula) -> Formula {
        let rows = self.problem.assembly.rows.len();
        formula.matrix(rows, self.kept.len(), |i, k| self.jacobian[i][k])
    }

    /// Adds M⁻¹.
    pub fn inverse_mass(&self, formula: Formula) -> Formula {
        let column = |&column: &usize| {
            let mut unit = vec![0.0; self.problem.assembly.columns()];
            unit[column] = 1.0;
            self.pick(&self.problem.assembly.accelerate(&unit))
        };
        let columns: Vec<Vec<f64>> = self.kept.iter().take(SHOWN).map(column).collect();
        formula.matrix(self.kept.len(), self.kept.len(), |i, j| columns[j][i])
    }

    /// u with the names of the kept columns, such as v_z of the body bottom.
    pub fn names(&self, scene: &Scene) -> Formula {
        let name = |&column: &usize| {
            let (body, k) = component(self.problem, column);
            let [letter, latex] = [["v", "v"], ["ω", "\\omega"]][k / 3];
            let axis = ["x", "y", "z"][k % 3];
            let body = &scene.bodies[body].name;
            let word: String =
                body.chars().filter(|c| c.is_alphanumeric() || " -.".contains(*c)).collect();
            (format!("{letter}_{axis} of {body}"), format!("{latex}_{axis} \\text{{ of {word}}}"))
        };
        let more = (self.kept.len() > SHOWN).then(|| ("…".into(), "\\vdots".into()));
        let (text, latex): (Vec<_>, Vec<_>) =
            self.kept.iter().take(SHOWN).map(name).chain(more).unzip();
        let rows = latex.join(" \\\\ ");
        Formula::default().symbols(
            &format!("u = [{}]", text.join(", ")),
            &format!("u = \\begin{{bmatrix}} {rows} \\end{{bmatrix}}"),
        )
    }
}

/// The body of a column, and the index of its velocity component.
fn component(problem: &Problem, column: usize) -> (usize, usize) {
    let blocks = &problem.assembly.blocks;
    let block = &blocks[blocks.partition_point(|block| block.offset <= column) - 1];
    (block.body, column - block.offset)
}

//! Compares a matrix dx/db from another program with the exact derivative, and names the mistake.
//!
//! A mistake is named if the derivative with this mistake is the given matrix up to the tolerance,
//! and no explanation with fewer mistakes exists.

use serde_json::{Value, json};

use super::linear::number;
use super::mistakes::{explained, is_near, places, set_fault, shapes, table};
use super::{Direction, Gradient, Status, failure};
use lcplab_lcp::error::{Error, Result};
use lcplab_page::number::readable;

/// Matrices are compared for up to this number of rows.
pub(super) const MOST_ROWS: usize = 50;

/// A matrix dx/db from another program.
#[derive(Debug, Clone, PartialEq)]
pub struct Theirs {
    /// The n rows of dx_i/db_j.
    pub dx_db: Vec<Vec<f64>>,
    /// The step, if the matrix comes from finite differences.
    pub h: Option<f64>,
    /// Differences of up to this fraction of the largest entry of a row and column are accepted.
    pub tolerance: f64,
}

/// What the comparison found.
#[derive(Debug, Clone, PartialEq)]
pub struct Comparison {
    /// Whether the matrix is the derivative, or at a kink one of the one-sided ones.
    pub is_right: bool,
    /// Each fault, as an identifier and as a sentence; none if the matrix is right.
    pub faults: Vec<(&'static str, String)>,
    /// The entry that differs most: row, column, theirs, exact.
    pub worst: Option<(usize, usize, f64, f64)>,
}

pub(super) type Table = Vec<Vec<f64>>;
/// A fault's identifier and its sentence.
pub(super) type Fault = (&'static str, String);

impl Theirs {
    /// The matrix under the key `dx_db` of a JSON object, and the optional keys `h` and
    /// `tolerance`.
    ///
    /// # Errors
    /// If the matrix is missing or is not n × n, or a number is impossible.
    pub fn read(text: &str, input: &str, n: usize) -> Result<Self> {
        let wrong = |key: &str, reason: String| Error::invalid(input, key, reason);
        let value = lcplab_lcp::json::read(text, input)?;
        let entry = |value: &Value| lcplab_lcp::file::as_number(value);
        let row = |row: &Value| row.as_array()?.iter().map(entry).collect::<Option<Vec<f64>>>();
        let rows = value["dx_db"].as_array().and_then(|rows| rows.iter().map(row).collect());
        let dx_db: Table =
            rows.ok_or_else(|| wrong("dx_db", "must be a list of rows of numbers".into()))?;
        let positive = |key: &str| match &value[key] {
            Value::Null => Ok(None),
            given => match entry(given).filter(|h| *h > 0.0 && h.is_finite()) {
                Some(h) => Ok(Some(h)),
                None => Err(wrong(key, "must be a positive number".into())),
            },
        };
        let tolerance = positive("tolerance")?.unwrap_or(Theirs::TOLERANCE);
        let theirs = Theirs { dx_db, h: positive("h")?, tolerance };
        theirs.check(n).map_err(|error| error.within(input))?;
        Ok(theirs)
    }

    /// The tolerance unless another is given.
    pub const TOLERANCE: f64 = 1e-4;

    fn check(&self, n: usize) -> Result<()> {
        if self.dx_db.len() != n || self.dx_db.iter().any(|row| row.len() != n) {
            let reason = format!(
                "must be {n} × {n}: dx_db[i][j] is the derivative of x_i with respect to b_j"
            );
            return Err(Error::invalid("theirs", "dx_db", reason));
        }
        Ok(())
    }
}

impl Gradient {
    /// dx/db after a small positive change of b_j, and after a negative one, column by column in j:
    /// entry (i, j) is dx_i/db_j.
    ///
    /// # Errors
    /// If x is not unique, or for more than 50 rows.
    pub fn dx_db(&self) -> Result<[Table; 2]> {
        let n = self.rows.len();
        if n > MOST_ROWS {
            return Err(failure(format!("the matrix dx/db is computed up to {MOST_ROWS} rows")));
        }
        if self.status == Status::Differentiable {
            let table = table(&self.rows, &self.rows, &self.rows.free());
            let table = table.ok_or_else(|| failure(self.refusal()))?;
            return Ok([table.clone(), table]);
        }
        let mut sides = [vec![vec![0.0; n]; n], vec![vec![0.0; n]; n]];
        for j in 0..n {
            let b = (0..n).map(|i| f64::from(i == j)).collect();
            let both = self.directional(&Direction { b, ..Direction::default() })?;
            for (side, derivative) in sides.iter_mut().zip(both) {
                let x = derivative.x.ok_or_else(|| failure(self.refusal()))?;
                x.iter().enumerate().for_each(|(i, x)| side[i][j] = number(x));
            }
        }
        Ok(sides)
    }

    /// Compares a matrix with dx/db, and names the mistakes that explain a difference.
    ///
    /// ```
    /// use lcplab_analysis::gradient::{Gradient, Theirs};
    /// use lcplab_lcp::file::Problem;
    ///
    /// let text = r#"{"A": {"dense": [[2, 1], [1, 2]]}, "b": [-1, -1]}"#;
    /// let problem = Problem::parse(text, "two.json")?;
    /// let gradient = Gradient::of(&problem, &[1.0 / 3.0; 2])?;
    /// let theirs = Theirs::read(r#"{"dx_db": [[0.6667, -0.3333], [-0.3333, 0.6667]]}"#, "", 2)?;
    /// let found = gradient.compare(&theirs)?;
    /// assert_eq!(found.faults[0].0, "sign");
    /// assert!(found.text().starts_with("theirs     wrong"));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If there is no matrix to compare with, or theirs is not n × n.
    pub fn compare(&self, theirs: &Theirs) -> Result<Comparison> {
        theirs.check(self.rows.len())?;
        let [right, left] = self.dx_db()?;
        let is_kink = matches!(self.status, Status::Kink(_));
        let d = &theirs.dx_db;
        if let Some((i, j)) = places(d).find(|&(i, j)| !d[i][j].is_finite()) {
            let text = format!("entry ({i}, {j}) is {}", d[i][j]);
            let worst = Some((i, j, d[i][j], right[i][j]));
            return Ok(Comparison { is_right: false, faults: vec![("not-finite", text)], worst });
        }
        let agrees = |own: &Table| is_near(d, own, theirs.tolerance);
        if !is_kink && agrees(&right) {
            return Ok(Comparison { is_right: true, faults: Vec::new(), worst: None });
        }
        if let Some(fault) = self.side_of_kink(d, [&right, &left], theirs.tolerance) {
            return Ok(Comparison { is_right: true, faults: vec![fault], worst: None });
        }
        let worst = places(d).max_by(|&(i, j), &(k, l)| {
            let away = |i: usize, j: usize| (d[i][j] - right[i][j]).abs();
            away(i, j).total_cmp(&away(k, l)).then((k, l).cmp(&(i, j)))
        });
        let worst = worst.map(|(i, j)| (i, j, d[i][j], right[i][j]));
        if places(d).all(|(i, j)| d[i][j] == 0.0) {
            let text = "all entries are 0: the forces are treated as constants";
            return Ok(Comparison { is_right: false, faults: vec![("zero", text.into())], worst });
        }
        let mut explanations = Vec::new();
        for base in if is_kink { vec![&right, &left] } else { vec![&right] } {
            explanations.extend(shapes(base));
        }
        let set = self.shown_set(d);
        if !(set.extra.is_empty() && set.missing.is_empty()) {
            let fault = set_fault(&self.lcp, &set.extra, &set.missing);
            explanations.extend(set.tables.into_iter().map(|table| (vec![fault.clone()], table)));
        }
        explanations.extend(self.uncoupled());
        let mut found: Vec<Vec<Fault>> = Vec::new();
        for (faults, table) in explanations {
            found.extend(explained(d, &table, faults, theirs.tolerance, self.dt));
        }
        if let Some(fault) = theirs.h.and_then(|h| self.of_step(theirs, &right, h)) {
            found.push(vec![fault]);
        }
        let fewest = found.iter().map(Vec::len).min().unwrap_or(0);
        found.retain(|faults| faults.len() == fewest);
        let mut faults: Vec<Fault> = Vec::new();
        for fault in found.into_iter().flatten() {
            if faults.iter().all(|(name, _)| *name != fault.0) {
                faults.push(fault);
            }
        }
        if faults.is_empty() {
            faults.push(("unknown", "no known mistake explains the difference".into()));
        }
        Ok(Comparison { is_right: false, faults, worst })
    }
}

impl Comparison {
    /// The lines of text that commands print.
    pub fn text(&self) -> String {
        let verdict = match (self.is_right, self.faults.is_empty()) {
            (true, true) => "right up to the tolerance",
            (true, false) => "accepted",
            (false, _) => "wrong",
        };
        let mut text = format!("theirs     {verdict}\n");
        for (name, sentence) in &self.faults {
            text += &format!("  {name}: {sentence}\n");
        }
        if let Some((i, j, theirs, exact)) = self.worst {
            let (theirs, exact) = (readable(theirs, 5), readable(exact, 5));
            text += &format!("  dx_{i}/db_{j} is {theirs}, exact: {exact}\n");
        }
        text
    }

    /// The value of the key `theirs`.
    ///
    /// ```
    /// use lcplab_analysis::gradient::Comparison;
    ///
    /// let right = Comparison { is_right: true, faults: Vec::new(), worst: None };
    /// assert_eq!(right.json()["right"], true);
    /// ```
    pub fn json(&self) -> Value {
        let fault = |(name, text): &Fault| json!({ "name": name, "text": text });
        let worst = self.worst.map(|(i, j, theirs, exact)| {
            let theirs = lcplab_lcp::file::number(theirs);
            json!({ "row": i, "column": j, "theirs": theirs, "exact": exact })
        });
        let faults: Vec<Value> = self.faults.iter().map(fault).collect();
        json!({ "right": self.is_right, "faults": faults, "worst": worst })
    }
}

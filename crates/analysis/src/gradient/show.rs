//! Derivatives as text and as JSON.

use serde_json::{Map, Value, json};

use super::linear::number;
use super::{Derivative, Gradient, Pullback, Status, listed};
use dashu_ratio::RBig;
use lcplab_lcp::file::number as in_json;
use lcplab_page::number::readable;

/// Matrices of up to this number of columns are printed.
const PRINTED: usize = 10;
/// Significant digits.
const DIGITS: usize = 5;

impl Gradient {
    /// The certificate: what derivative x has, and what proves it.
    pub fn certificate(&self) -> String {
        let mut text = match self.status() {
            Status::Differentiable => {
                "exact: every row is strictly on one side, and the equations of the free rows are regular".into()
            }
            Status::Kink(rows) => format!(
                "kink at {}, at a bound with w = 0: left and right derivatives, both exact", listed(rows)
            ),
            Status::NotUnique if self.is_of_motion() => {
                "x is not unique: derivatives are those of the motion, with respect to target and mass".into()
            }
            Status::NotUnique => "x is not unique: it has no derivative".into(),
            Status::NotExamined(why) => format!("not examined: {why}"),
        };
        if !self.near_kink().is_empty() {
            text += &format!("; within rounding of a kink at {}", listed(self.near_kink()));
        }
        text
    }

    /// The word for the status in JSON.
    pub fn word(&self) -> &'static str {
        match self.status() {
            Status::Differentiable => "differentiable",
            Status::Kink(_) => "kink",
            Status::NotUnique => "not_unique",
            Status::NotExamined(_) => "not_examined",
        }
    }

    /// The block of text that commands print: the certificate, the rows and, of a small problem,
    /// dx/db.
    pub fn text(&self) -> String {
        let mut text = format!("derivative {}\n", self.certificate());
        text += &format!("{:>5} {:>15} {:>15}  state\n", "row", "x", "w");
        for (i, state) in self.states().iter().enumerate() {
            let (x, w) = (shown(&self.rows.x[i]), shown(&self.rows.w[i]));
            text += &format!("{i:>5} {x:>15} {w:>15}  {}\n", state.name());
        }
        if self.states().len() > PRINTED {
            return text;
        }
        match self.dx_db() {
            Ok([right, left]) if right == left => text + &grid("dx_i/db_j", &right),
            Ok([right, left]) => {
                let text = text + &grid("dx_i/db_j for a small increase of b_j", &right);
                text + &grid("dx_i/db_j for a small decrease of b_j", &left)
            }
            Err(_) => text,
        }
    }

    /// The object that commands print: `status`, `certificate`, `rows`, `near_kink`, `x`, `w`, and
    /// up to 50 rows `dx_db`, with one-sided derivatives `dx_db_right` and `dx_db_left` instead at
    /// a kink.
    pub fn json(&self) -> Map<String, Value> {
        let mut object = Map::new();
        object.insert("status".into(), json!(self.word()));
        object.insert("certificate".into(), json!(self.certificate()));
        object.insert("of_motion".into(), json!(self.is_of_motion()));
        let kinks = match self.status() {
            Status::Kink(rows) => rows.as_slice(),
            _ => &[],
        };
        object.insert("kinks".into(), json!(kinks));
        object.insert("near_kink".into(), json!(self.near_kink()));
        let names: Vec<&str> = self.states().iter().map(|state| state.name()).collect();
        object.insert("states".into(), json!(names));
        object.insert("x".into(), list(&self.rows.x));
        object.insert("w".into(), list(&self.rows.w));
        if let Ok(motion) = &self.motion {
            object.insert("u".into(), list(motion.u()));
        }
        match self.dx_db() {
            Ok([right, left]) if right == left => {
                object.insert("dx_db".into(), json!(right));
            }
            Ok([right, left]) => {
                object.insert("dx_db_right".into(), json!(right));
                object.insert("dx_db_left".into(), json!(left));
            }
            Err(_) => {}
        }
        object
    }
}

impl Derivative {
    /// The keys `dx` and `du`.
    ///
    /// ```
    /// use lcplab_analysis::gradient::Derivative;
    ///
    /// let derivative = Derivative { x: Some(vec![1.into()]), u: None };
    /// assert_eq!(derivative.json(), serde_json::json!({ "dx": [1.0], "du": null }));
    /// ```
    pub fn json(&self) -> Value {
        let optional = |v: &Option<Vec<RBig>>| v.as_ref().map_or(Value::Null, |v| list(v));
        json!({ "dx": optional(&self.x), "du": optional(&self.u) })
    }
}

impl Pullback {
    /// The gradients as numbers: `b`, `A`, `mu`, `lo`, `hi`, and those with respect to `motion`.
    ///
    /// ```
    /// use lcplab_analysis::gradient::Gradient;
    /// use lcplab_lcp::file::Problem;
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// let lcp = Lcp::new(Matrix::from([[2.0]]), vec![-1.0], vec![0.0], vec![f64::INFINITY])?;
    /// let gradient = Gradient::of(&Problem::new("contact", lcp), &[0.5])?;
    /// let pullback = gradient.pullback(&[1.0], None)?.json();
    /// assert_eq!((&pullback["b"][0], &pullback["A"][0][0]), (&(-0.5).into(), &(-0.25).into()));
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    pub fn json(&self) -> Value {
        let row = |b: &RBig| self.x.iter().map(|x| in_json(number(&(b * x)))).collect::<Value>();
        let motion = self.motion.as_ref().map(|motion| {
            json!({
                "target": list(&motion.target),
                "bias": list(&motion.bias),
                "compliance": list(&motion.compliance),
                "mass": motion.mass.iter().map(|row| list(row)).collect::<Value>(),
                "jacobian": motion.jacobian.iter().map(|row| list(row)).collect::<Value>(),
            })
        });
        json!({
            "b": list(&self.b),
            "A": self.b.iter().map(row).collect::<Value>(),
            "mu": list(&self.mu),
            "lo": list(&self.lo),
            "hi": list(&self.hi),
            "motion": motion,
        })
    }
}

fn list(v: &[RBig]) -> Value {
    v.iter().map(|x| in_json(number(x))).collect()
}

fn shown(x: &RBig) -> String {
    readable(number(x), DIGITS)
}

fn grid(title: &str, table: &[Vec<f64>]) -> String {
    let heading: String = (0..table.len()).map(|j| format!(" {j:>11}")).collect();
    let mut text = format!("{title}\n{:>5}{heading}\n", "i \\ j");
    for (i, row) in table.iter().enumerate() {
        let cells: String =
            row.iter().map(|&entry| format!(" {:>11}", readable(entry, DIGITS))).collect();
        text += &format!("{i:>5}{cells}\n");
    }
    text
}

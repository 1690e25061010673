//! The friction models by name, and the problem that each of them states.

use std::fmt;
use std::str::FromStr;

use serde::{Deserialize, Serialize};

use super::{ConeProblem, FrictionProblem, Law, Polyhedral};
use crate::Lcp;
use crate::error::{Error, Result};

/// The largest number of polygon corners allowed in a name.
const MOST_DIRECTIONS: usize = 256;

/// A friction model: the set of friction impulses x_t allowed at a contact with the normal impulse
/// x_n.
///
/// Problem files, scenes and the judge use this type; it is printed as its name there and on the
/// command line. See [`friction`](crate::friction).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(try_from = "String", into = "String")]
pub enum Model {
    /// 1: a box frozen at known normal impulses.
    FrozenBox,
    /// 2: a box of half-width μ x_n.
    #[default]
    CoupledBox,
    /// 3: a polygon.
    Polyhedral {
        /// The number of corners.
        directions: usize,
    },
    /// 4a: the disk, as a convex problem.
    AssociatedCone,
    /// 4b: the disk, Coulomb's law.
    CoulombCone,
}

impl Model {
    /// All models, polygons with 4, 8 and 16 corners.
    pub const ALL: [Model; 7] = [
        Model::FrozenBox,
        Model::CoupledBox,
        Model::Polyhedral { directions: 4 },
        Model::Polyhedral { directions: 8 },
        Model::Polyhedral { directions: 16 },
        Model::AssociatedCone,
        Model::CoulombCone,
    ];

    /// The form of the problem that the model poses.
    ///
    /// ```
    /// use lcplab_lcp::friction::{Form, Law, Model};
    ///
    /// assert_eq!(Model::FrozenBox.form(), Form::Box);
    /// assert_eq!(Model::Polyhedral { directions: 8 }.form(), Form::Polygon { corners: 8 });
    /// assert_eq!(Model::CoulombCone.form(), Form::Cone(Law::Coulomb));
    /// ```
    pub fn form(self) -> Form {
        match self {
            Model::FrozenBox | Model::CoupledBox => Form::Box,
            Model::Polyhedral { directions } => Form::Polygon { corners: directions },
            Model::AssociatedCone => Form::Cone(Law::Associated),
            Model::CoulombCone => Form::Cone(Law::Coulomb),
        }
    }

    /// Why the model does not state contacts in the plane, with one tangent each, as the coupled
    /// box; `None` if it does.
    #[cfg(feature = "json")] // for questions
    pub(crate) fn refusal_in_plane(self) -> Option<&'static str> {
        match self {
            Model::CoupledBox | Model::Polyhedral { .. } | Model::CoulombCone => None,
            Model::AssociatedCone => Some(
                "is associated-cone, which is not defined here for contacts in the plane (one \
                 tangent each); coulomb-cone is",
            ),
            Model::FrozenBox => Some(
                "is frozen-box, which needs two tangents for each contact; state the frozen limits \
                 as bounds lo and hi",
            ),
        }
    }

    /// The problem that x solves under this model; model 1 freezes its boxes at the x_n of
    /// `frozen_at`, a vector with one entry per row.
    ///
    /// ```
    /// use lcplab_lcp::friction::{Contact, FrictionProblem, Model, ProblemForm};
    /// use lcplab_lcp::{Lcp, Matrix};
    ///
    /// // A point of 1 kg on the ground slides along t1: w = x + b.
    /// let (b, free) = (vec![-2.0, -3.0, 0.0], f64::INFINITY);
    /// let a = Matrix::from([[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]]);
    /// let lcp = Lcp::new(a, b, vec![0.0, -free, -free], vec![free; 3])?;
    /// let problem = FrictionProblem::new(lcp, vec![Contact { rows: [0, 1, 2], mu: 0.5 }])?;
    /// let ProblemForm::Boxed(boxes) = Model::CoupledBox.pose(&problem, None)? else { unreachable!() };
    /// assert_eq!(boxes.w(&[2.0, 1.0, 0.0]), [0.0, -2.0, 0.0]); // x_t1 = μ x_n, against the slip
    /// assert_eq!(
    ///     Model::FrozenBox.pose(&problem, None).unwrap_err().to_string(),
    ///     "problem: frozen_at: is missing: the frozen box needs the normal impulses x_n"
    /// );
    /// # Ok::<(), lcplab_lcp::error::Error>(())
    /// ```
    ///
    /// # Errors
    /// If the number of directions is not allowed, or model 1 has no `frozen_at`.
    pub fn pose(self, problem: &FrictionProblem, frozen_at: Option<&[f64]>) -> Result<ProblemForm> {
        let cone = |law| ProblemForm::Cone(ConeProblem::new(problem.clone(), law));
        Ok(match self {
            Model::FrozenBox => {
                let x = frozen_at.ok_or_else(|| {
                    let reason = "is missing: the frozen box needs the normal impulses x_n";
                    Error::invalid("problem", "frozen_at", reason)
                })?;
                ProblemForm::Boxed(problem.coupled_box().frozen_at(x))
            }
            Model::CoupledBox => ProblemForm::Boxed(problem.coupled_box()),
            Model::Polyhedral { directions } => {
                ProblemForm::Polyhedral(Polyhedral::new(problem, directions)?)
            }
            Model::AssociatedCone => cone(Law::Associated),
            Model::CoulombCone => cone(Law::Coulomb),
        })
    }
}

/// The form of a friction problem: [`ProblemForm`] without its data. Code that depends on the form
/// alone needs no change for a new model.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Form {
    /// Bounds for each friction row.
    Box,
    /// A regular polygon for each contact.
    Polygon {
        /// The number of corners.
        corners: usize,
    },
    /// A circular cone for each contact, under this law.
    Cone(Law),
}

/// A friction problem stated under a model; x means the same in all of them.
#[derive(Debug, Clone)]
pub enum ProblemForm {
    /// Models 1 and 2; also any LCP without friction.
    Boxed(Lcp),
    /// Model 3: its LCP has unknowns z, from which x is computed.
    Polyhedral(Polyhedral),
    /// Model 4.
    Cone(ConeProblem),
}

impl fmt::Display for Model {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Model::FrozenBox => f.pad("frozen-box"),
            Model::CoupledBox => f.pad("coupled-box"),
            Model::Polyhedral { directions } => f.pad(&format!("polygon-{directions}")),
            Model::AssociatedCone => f.pad("associated-cone"),
            Model::CoulombCone => f.pad("coulomb-cone"),
        }
    }
}

impl From<Model> for String {
    fn from(model: Model) -> Self {
        model.to_string()
    }
}

impl TryFrom<String> for Model {
    type Error = Error;

    fn try_from(name: String) -> Result<Self> {
        name.parse()
    }
}

/// ```
/// use lcplab_lcp::friction::Model;
///
/// assert_eq!("polygon-12".parse(), Ok(Model::Polyhedral { directions: 12 }));
/// assert!("polygon-6".parse::<Model>().unwrap_err().to_string().contains("multiple of 4"));
/// ```
impl FromStr for Model {
    type Err = Error;

    fn from_str(name: &str) -> Result<Self> {
        if let Some(model) = Model::ALL.into_iter().find(|model| model.to_string() == name) {
            return Ok(model);
        }
        let directions = name.strip_prefix("polygon-").and_then(|k| k.parse::<usize>().ok());
        if let Some(directions) = directions.filter(|k| name == format!("polygon-{k}")) {
            if (4..=MOST_DIRECTIONS).contains(&directions) && directions.is_multiple_of(4) {
                return Ok(Model::Polyhedral { directions });
            }
            let reason = format!("must be a multiple of 4 from 4 to {MOST_DIRECTIONS}");
            return Err(Error::invalid(name, "directions", reason));
        }
        Err(Error::Unknown {
            kind: "friction model",
            name: name.to_string(),
            known: [
                "frozen-box",
                "coupled-box",
                "polygon-K (K = 4, 8, … 256)",
                "associated-cone",
                "coulomb-cone",
            ]
            .map(str::to_string)
            .to_vec(),
        })
    }
}

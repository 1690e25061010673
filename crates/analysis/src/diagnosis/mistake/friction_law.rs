//! Variants of a problem with contacts under any friction law, each with one mistake.

use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Model, Polyhedral, ProblemForm};
use lcplab_lcp::merit::RowTerms;
use lcplab_lcp::number::readable;
use lcplab_lcp::{Coupling, Lcp, Matrix};
use lcplab_solver::{Options, Settings, Status, solve_by_sequence};

use super::MistakeKind;
use super::changed;
use super::contact_sweeps::{ContactSweeps, Rule, largest_use_of_mu};

/// The tolerance of a solution that answers are compared with, if it can be reached.
const TIGHT: f64 = 1e-12;
/// A factor of μ that differs from 1 by less is none.
const NO_FACTOR: f64 = 1e-6;

/// A problem that was solved instead of the given one.
pub(super) struct Variant {
    pub kind: MistakeKind,
    pub what: String,
    pub posed: ProblemForm,
    /// Its rows may be stretched: x_i is this multiple of its own x_i.
    pub stretch: Vec<f64>,
    /// The number of values that were fitted to x.
    pub fitted: usize,
}

impl Variant {
    /// Its solution, if one is found.
    pub fn solution(&self) -> Option<Vec<f64>> {
        let own = solution(&self.posed)?;
        Some(own.iter().zip(&self.stretch).map(|(x, part)| part * x).collect())
    }

    /// The scaled residual of each of its rows at x.
    pub fn residuals(&self, x: &[f64]) -> Vec<f64> {
        let own: Vec<f64> = x.iter().zip(&self.stretch).map(|(x, part)| x / part).collect();
        residuals(&self.posed, &own)
    }
}

/// The contacts of a problem. Where μ differs along t1 and t2, t2 is stretched by μ2/μ1: then μ1
/// limits both, a box remains a box, and an ellipse becomes a disk.
pub(super) struct Contacts {
    pub friction: FrictionProblem,
    /// x_i of the problem is this multiple of x_i of the contacts.
    pub stretch: Vec<f64>,
}

impl Contacts {
    /// The contacts, if friction is that of contacts.
    pub fn of(posed: &ProblemForm) -> Option<Self> {
        let unchanged = |friction: &FrictionProblem| Contacts {
            stretch: vec![1.0; friction.lcp().len()],
            friction: friction.clone(),
        };
        match posed {
            ProblemForm::Boxed(lcp) => Contacts::of_boxes(lcp),
            ProblemForm::Polyhedral(polygons) => Some(unchanged(polygons.friction())),
            ProblemForm::Cone(cones) => Some(unchanged(cones.friction())),
        }
    }

    fn of_boxes(lcp: &Lcp) -> Option<Self> {
        let mut stretch = vec![1.0; lcp.len()];
        let mut mu: Vec<f64> =
            (0..lcp.len()).map(|i| lcp.coupling().map_or(0.0, |own| own.mu(i))).collect();
        for rows in lcp.coupling().map_or_else(Vec::new, Coupling::tangents) {
            if let [t1, t2] = rows[..]
                && mu[t1] > 0.0
                && mu[t2] > 0.0
            {
                stretch[t2] = mu[t2] / mu[t1];
                mu[t2] = mu[t1];
            }
        }
        if stretch.iter().all(|part| *part == 1.0) {
            return Some(Contacts { friction: FrictionProblem::of(lcp).ok()?, stretch });
        }
        let n = lcp.len();
        let all = (0..n).flat_map(|i| lcp.matrix().row(i).iter().map(move |(j, a)| (i, j, a)));
        let entries: Vec<_> = all.map(|(i, j, a)| (i, j, stretch[i] * a * stretch[j])).collect();
        let b = lcp.b().iter().zip(&stretch).map(|(b, part)| part * b).collect();
        let index = (0..n).map(|i| lcp.coupling()?.index(i)).collect();
        let stretched = lcp.with_matrix(Matrix::sparse(n, &entries)).ok()?.with_b(b).ok()?;
        let stretched = stretched.with_coupling(Coupling::new(index, mu).ok()?).ok()?;
        Some(Contacts { friction: FrictionProblem::of(&stretched).ok()?, stretch })
    }
}

/// A, b and the bounds, whatever the friction law.
pub(super) fn rows(posed: &ProblemForm) -> &Lcp {
    match posed {
        ProblemForm::Boxed(lcp) => lcp,
        ProblemForm::Polyhedral(polygons) => polygons.friction().lcp(),
        ProblemForm::Cone(cones) => cones.friction().lcp(),
    }
}

/// The solution by the fallback sequence, as precise as it can be had.
pub(super) fn solution(posed: &ProblemForm) -> Option<Vec<f64>> {
    [TIGHT, Settings::default().tolerance].into_iter().find_map(|tolerance| {
        let settings = Settings::default().with_tolerance(tolerance);
        let options = Options::default().with_settings(settings);
        let solution = solve_by_sequence(posed, &options, &mut ()).solution;
        (solution.status == Status::Solved).then(|| refined(posed, solution.x))
    })
}

/// x after some sweeps, which take away what the tolerance of its solver left, unless they end
/// farther from a solution.
fn refined(posed: &ProblemForm, x: Vec<f64>) -> Vec<f64> {
    let Some(sweeps) = ContactSweeps::of(posed) else { return x };
    let largest = |x: &[f64]| sweeps.residuals(Rule::Right, x).into_iter().fold(0.0, f64::max);
    let y = sweeps.refined(Rule::Right, &x);
    if largest(&y) < largest(&x) { y } else { x }
}

/// The scaled residual of each row.
pub(super) fn residuals(posed: &ProblemForm, x: &[f64]) -> Vec<f64> {
    let lcp = rows(posed);
    let terms = || (0..x.len()).map(|i| RowTerms::at(lcp, i, x));
    if !matches!(posed, ProblemForm::Boxed(_))
        && let Some(sweeps) = ContactSweeps::of(posed)
    {
        return sweeps.residuals(Rule::Right, x);
    }
    match posed {
        ProblemForm::Cone(cones) => cones.residuals(&terms().collect::<Vec<_>>(), x),
        ProblemForm::Boxed(_) | ProblemForm::Polyhedral(_) => {
            terms().enumerate().map(|(i, own)| own.row_residual(lcp, i, x).residual).collect()
        }
    }
}

/// The rows in which x is strictly between its bounds.
pub(super) fn free_rows(posed: &ProblemForm, x: &[f64]) -> Vec<usize> {
    match posed {
        ProblemForm::Boxed(lcp) => changed::free_rows(lcp, x),
        ProblemForm::Polyhedral(_) | ProblemForm::Cone(_) => match ContactSweeps::of(posed) {
            Some(sweeps) => sweeps.free_rows(x),
            None => (0..x.len()).collect(),
        },
    }
}

/// The same contacts under the other friction laws.
pub(super) fn other_laws(posed: &ProblemForm, contacts: &Contacts) -> Vec<Variant> {
    let Contacts { friction, stretch } = contacts;
    let is_round = stretch.iter().all(|part| *part == 1.0);
    let own = match posed {
        ProblemForm::Boxed(_) => Model::CoupledBox,
        ProblemForm::Polyhedral(polygons) => {
            Model::Polyhedral { directions: polygons.directions() }
        }
        ProblemForm::Cone(cones) => match cones.law() {
            lcplab_lcp::friction::Law::Associated => Model::AssociatedCone,
            lcplab_lcp::friction::Law::Coulomb => Model::CoulombCone,
        },
    };
    let all = [
        Model::CoupledBox,
        Model::Polyhedral { directions: 4 },
        Model::Polyhedral { directions: 8 },
        Model::AssociatedCone,
        Model::CoulombCone,
    ];
    let variant = |model: Model| {
        let posed = model.pose(friction, None).ok()?;
        let ellipse = if is_round { "" } else { ", with both μ of each contact" };
        let what = format!("friction under the model {model}{ellipse}");
        let stretch = stretch.clone();
        Some(Variant { kind: MistakeKind::OtherLaw, what, posed, stretch, fitted: 0 })
    };
    all.into_iter().filter(|model| *model != own).filter_map(variant).collect()
}

/// The variants of a problem whose friction law is a cone or a polygon; boxes have their own.
pub(super) fn variants(
    posed: &ProblemForm,
    x: &[f64],
    solution: &[f64],
    is_redundant: bool,
) -> Vec<Variant> {
    let Some(Contacts { friction, stretch }) = Contacts::of(posed) else { return Vec::new() };
    let free = ContactSweeps::of(posed).map(|own| own.free_rows(x));
    let lcp = friction.lcp();
    let variant = |kind, what: &str, changed: Option<FrictionProblem>| {
        let posed = posed_alike(posed, &changed?)?;
        Some(Variant { kind, what: what.to_string(), posed, stretch: stretch.clone(), fitted: 0 })
    };
    let with_b = |factor: f64| {
        let lcp = lcp.with_b(lcp.b().iter().map(|b| factor * b).collect()).ok()?;
        FrictionProblem::new(lcp, friction.contacts().to_vec()).ok()
    };
    let with_mu = |change: &dyn Fn(f64) -> f64| {
        let contact = |own: &Contact| Contact { mu: change(own.mu), ..*own };
        let contacts = friction.contacts().iter().map(contact).collect();
        FrictionProblem::new(lcp.clone(), contacts).ok()
    };
    let mut all: Vec<Option<Variant>> = vec![
        variant(MistakeKind::SignOfB, "the opposite sign of b", with_b(-1.0)),
        variant(MistakeKind::FrictionLeftOut, "friction left out", with_mu(&|_| 0.0)),
        variant(MistakeKind::FactorOfMu, "μ squared", with_mu(&|mu| mu * mu)),
    ];
    let fitted = |own: Variant| Variant { fitted: 1, ..own };
    let is_factor = |factor: &f64| (factor - 1.0).abs() > NO_FACTOR && *factor > 0.0;
    let used = largest_use_of_mu(posed, x);
    if let Some(factor) = used.filter(is_factor).filter(|factor| factor.is_finite()) {
        let what = format!("μ times {}", readable(factor, 6));
        let changed = with_mu(&|mu| factor * mu);
        all.push(variant(MistakeKind::FactorOfMu, &what, changed).map(fitted));
    }
    let some = free.as_deref().filter(|_| is_redundant);
    if let Some(factor) = changed::factor_of_b(lcp, x, solution, some) {
        let what = format!("b times {} (check the time step and the unit)", readable(factor, 6));
        all.push(variant(MistakeKind::FactorOfB, &what, with_b(factor)).map(fitted));
    }
    let compliant = free.and_then(|free| changed::compliant(lcp, x, &free));
    if let Some((kind, what, changed)) = compliant {
        let changed = FrictionProblem::new(changed, friction.contacts().to_vec()).ok();
        all.push(variant(kind, &what, changed).map(fitted));
    }
    all.into_iter().flatten().collect()
}

/// Other contacts under the same law.
fn posed_alike(posed: &ProblemForm, friction: &FrictionProblem) -> Option<ProblemForm> {
    Some(match posed {
        ProblemForm::Boxed(_) => ProblemForm::Boxed(friction.coupled_box()),
        ProblemForm::Polyhedral(polygons) => {
            ProblemForm::Polyhedral(Polyhedral::new(friction, polygons.directions()).ok()?)
        }
        ProblemForm::Cone(cones) => {
            ProblemForm::Cone(ConeProblem::new(friction.clone(), cones.law()))
        }
    })
}

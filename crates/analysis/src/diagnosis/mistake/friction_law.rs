//! Variants of a problem with contacts under any friction law, each with one mistake.

use lcplab_lcp::Lcp;
use lcplab_lcp::friction::{ConeProblem, Contact, FrictionProblem, Model, Polyhedral, ProblemForm};
use lcplab_lcp::number::readable;
use lcplab_solver::{Options, Settings, Status, solve_by_sequence};

use super::MistakeKind;

/// The tolerance of a solution that answers are compared with, if it can be reached.
const TIGHT: f64 = 1e-12;
/// A factor of μ that differs from 1 by less is none.
const NO_FACTOR: f64 = 1e-6;

/// A problem that was solved instead of the given one.
pub(super) struct Variant {
    pub kind: MistakeKind,
    pub what: String,
    pub posed: ProblemForm,
    /// The number of values that were fitted to x.
    pub fitted: usize,
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
        (solution.status == Status::Solved).then_some(solution.x)
    })
}

/// The same contacts under the other friction laws.
pub(super) fn other_laws(posed: &ProblemForm, friction: &FrictionProblem) -> Vec<Variant> {
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
        let what = format!("friction under the model {model}");
        Some(Variant { kind: MistakeKind::OtherLaw, what, posed, fitted: 0 })
    };
    all.into_iter().filter(|model| *model != own).filter_map(variant).collect()
}

/// The variants of a problem whose friction law is a cone or a polygon; boxes have their own.
pub(super) fn variants(posed: &ProblemForm, x: &[f64], solution: &[f64]) -> Vec<Variant> {
    let Some(friction) = contacts_of(posed) else { return Vec::new() };
    let lcp = friction.lcp();
    let variant = |kind, what: &str, changed: Option<FrictionProblem>| {
        let posed = posed_alike(posed, &changed?)?;
        Some(Variant { kind, what: what.to_string(), posed, fitted: 0 })
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
    if let Some(factor) = factor_of_mu(&friction, x) {
        let what = format!("μ times {}", readable(factor, 6));
        let changed = with_mu(&|mu| factor * mu);
        all.push(variant(MistakeKind::FactorOfMu, &what, changed).map(fitted));
    }
    if let Some(factor) = super::changed::factor_of_b(lcp, x, solution) {
        let what = format!("b times {} (check the time step and the unit)", readable(factor, 6));
        all.push(variant(MistakeKind::FactorOfB, &what, with_b(factor)).map(fitted));
    }
    all.into_iter().flatten().collect()
}

/// The contacts of a problem, if its friction is that of contacts.
pub(super) fn contacts_of(posed: &ProblemForm) -> Option<FrictionProblem> {
    match posed {
        ProblemForm::Boxed(lcp) => FrictionProblem::of(lcp).ok(),
        ProblemForm::Polyhedral(polygons) => Some(polygons.friction().clone()),
        ProblemForm::Cone(cones) => Some(cones.friction().clone()),
    }
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

/// The factor of μ that allows the friction of x: the largest |x_t| / (μ x_n).
fn factor_of_mu(friction: &FrictionProblem, x: &[f64]) -> Option<f64> {
    let used = |contact: &Contact| {
        let [normal, t1, t2] = contact.of(x);
        (normal > 0.0 && contact.mu > 0.0).then(|| t1.hypot(t2) / (contact.mu * normal))
    };
    let factor = friction.contacts().iter().filter_map(used).fold(0.0, f64::max);
    ((factor - 1.0).abs() > NO_FACTOR && factor > 0.0 && factor.is_finite()).then_some(factor)
}

//! Textbook sweeps contact by contact under any friction law but the associated one, right or with
//! one mistake.
//!
//! ```text
//! x_n ← max(x_n − w_n/a_nn, 0)
//! x_t ← the point of the box, polygon or disk of radius μ x_n nearest to x_t − w_t/s
//! x_i ← Π(x_i − w_i/a_ii)                                    each other row
//! ```
//!
//! Solvers differ in the step 1/s of the two tangents; the common ones are all tried. The solution
//! does not depend on s.

use std::borrow::Cow;

use lcplab_lcp::Lcp;
use lcplab_lcp::friction::{Contact, FrictionProblem, Law, Polyhedral, ProblemForm};
use lcplab_lcp::hypot;
use lcplab_lcp::merit::RowTerms;

use super::flawed_sweep::Flaw;
use super::sweeps::{Nearest, SweepMatch};

/// Sweeps from x toward a solution of changed contacts that is as near to x as possible.
const REFINING_SWEEPS: usize = 50;
/// Friction this near to its limit, as a part of it, is at it.
const AT_LIMIT: f64 = 1e-6;

/// The set that contains the friction of a contact, for a radius.
#[derive(Clone, Copy)]
enum Shape<'a> {
    Box,
    Polygon(&'a Polyhedral),
    Disk,
}

impl<'a> Shape<'a> {
    /// The shape of a friction law with its contacts; `None` for boxes that are not contacts with
    /// two tangents and one μ.
    fn of(posed: &'a ProblemForm) -> Option<(Self, Cow<'a, FrictionProblem>)> {
        let borrowed = Cow::Borrowed;
        Some(match posed {
            ProblemForm::Boxed(lcp) => (Shape::Box, Cow::Owned(FrictionProblem::of(lcp).ok()?)),
            ProblemForm::Polyhedral(own) => (Shape::Polygon(own), borrowed(own.friction())),
            ProblemForm::Cone(own) => (Shape::Disk, borrowed(own.friction())),
        })
    }

    fn nearest(self, radius: f64, p: [f64; 2]) -> [f64; 2] {
        let (radius, length) = (radius.max(0.0), hypot(p[0], p[1]));
        match self {
            Shape::Box => p.map(|t| t.clamp(-radius, radius)),
            Shape::Polygon(polygons) => polygons.nearest(radius, p),
            Shape::Disk if length <= radius => p,
            Shape::Disk => p.map(|t| radius * (t / length)),
        }
    }

    /// The radius for which p is on the edge.
    fn radius(self, p: [f64; 2]) -> f64 {
        let polygons = match self {
            Shape::Box => return p[0].abs().max(p[1].abs()),
            Shape::Disk => return hypot(p[0], p[1]),
            Shape::Polygon(polygons) => polygons,
        };
        let half = std::f64::consts::PI / polygons.directions() as f64;
        // Edge j faces the angle of its middle.
        let reach = |j: usize| {
            let angle = (2 * j + 1) as f64 * half;
            libm::cos(angle) * p[0] + libm::sin(angle) * p[1]
        };
        (0..polygons.directions()).map(reach).fold(0.0, f64::max) / libm::cos(half)
    }
}

/// What the sweeps do.
#[derive(Debug, Clone, Copy)]
pub(super) enum Rule<'a> {
    Right,
    Flawed(Flaw),
    /// Friction is limited by the normal force of the contact this many places farther.
    OtherNormals(usize),
    /// Friction is limited by the normal forces of this x.
    NormalsOf(&'a [f64]),
    /// Normal forces may pull.
    WithoutNormalBound,
    /// Friction has no limit.
    WithoutFrictionLimit,
}

/// The s of the tangents of a contact.
#[derive(Debug, Clone, Copy)]
pub(super) enum Step {
    /// a_11 + a_22.
    Trace,
    /// The larger of a_11 and a_22.
    Diagonal,
    /// The largest absolute row sum of their block.
    RowSum,
}

impl Step {
    pub const ALL: [Step; 3] = [Step::Trace, Step::Diagonal, Step::RowSum];

    fn scale(self, lcp: &Lcp, [i, j]: [usize; 2]) -> f64 {
        let entry = |i, j| lcp.matrix().entry(i, j);
        let (first, second) = (entry(i, i), entry(j, j));
        match self {
            Step::Trace => first + second,
            Step::Diagonal => first.max(second),
            Step::RowSum => (first + entry(i, j).abs()).max(second + entry(j, i).abs()),
        }
    }
}

/// The contacts of a problem, and how their sweeps go.
pub(super) struct ContactSweeps<'a> {
    shape: Shape<'a>,
    friction: Cow<'a, FrictionProblem>,
}

impl<'a> ContactSweeps<'a> {
    /// `None` for the associated law, which couples normal and tangents; for boxes that are no
    /// contacts; and if a row does not move under its own force.
    pub fn of(posed: &'a ProblemForm) -> Option<Self> {
        if matches!(posed, ProblemForm::Cone(own) if own.law() == Law::Associated) {
            return None;
        }
        let (shape, friction) = Shape::of(posed)?;
        let moves = |i: usize| friction.lcp().matrix().diagonal(i) > 0.0;
        let own_rows = friction.contacts().iter().all(|own| own.rows.into_iter().all(moves));
        let others = friction.others().iter().all(|&i| moves(i));
        (own_rows && others).then_some(ContactSweeps { shape, friction })
    }

    /// Sweeps from a start, to where they come nearest to x.
    pub fn nearest(
        &self,
        (rule, step): (Rule<'_>, Step),
        start: &[f64],
        most: usize,
        x: &[f64],
    ) -> SweepMatch {
        let mut nearest = Nearest::to(x);
        let last = self.sweeps((rule, step), start, most, |sweep, x| nearest.look_at(sweep, x));
        nearest.swept(last)
    }

    /// This number of sweeps from a start; `look` sees the answer that each of them would give.
    pub fn sweeps(
        &self,
        (rule, step): (Rule<'_>, Step),
        start: &[f64],
        most: usize,
        mut look: impl FnMut(usize, &[f64]),
    ) -> Vec<f64> {
        let mut x = start.to_vec();
        let mut limits = x.clone();
        for sweep in 1..=most {
            let fixed = match rule {
                Rule::Flawed(Flaw::LateFriction) => true,
                Rule::Flawed(Flaw::FirstFriction) => sweep > 1,
                _ => false,
            };
            let before = x.clone();
            self.sweep(rule, step, fixed.then_some(&limits[..]), &mut x);
            if sweep == 1 || matches!(rule, Rule::Flawed(Flaw::LateFriction)) {
                limits.clone_from(&x);
            }
            if !x.iter().all(|x| x.is_finite()) {
                return before;
            }
            match rule {
                Rule::Flawed(Flaw::ClampAtEnd) => look(sweep, &self.clamped(&x)),
                _ => look(sweep, &x),
            }
            if x == before {
                break;
            }
        }
        x
    }

    fn sweep(&self, rule: Rule<'_>, step: Step, limits: Option<&[f64]>, x: &mut [f64]) {
        let lcp = self.friction.lcp();
        let is_free = matches!(rule, Rule::Flawed(Flaw::ClampAtEnd));
        let adds_clamped = matches!(rule, Rule::Flawed(Flaw::ClampedIncrements));
        let has_free_normals = is_free || matches!(rule, Rule::WithoutNormalBound);
        let has_free_friction = is_free || matches!(rule, Rule::WithoutFrictionLimit);
        for &i in self.friction.others() {
            let change = -lcp.row_w(i, x) / lcp.matrix().diagonal(i);
            x[i] = match adds_clamped {
                _ if is_free => x[i] + change,
                true => x[i] + lcp.project(i, change, x),
                false => lcp.project(i, x[i] + change, x),
            };
        }
        for (k, contact) in self.friction.contacts().iter().enumerate() {
            let [n, t1, t2] = contact.rows;
            let change = -lcp.row_w(n, x) / lcp.matrix().diagonal(n);
            x[n] = match adds_clamped {
                _ if has_free_normals => x[n] + change,
                true => x[n] + change.max(0.0),
                false => (x[n] + change).max(0.0),
            };
            let radius = contact.mu * self.normal(rule, k, limits, x);
            let s = step.scale(lcp, [t1, t2]);
            let change = [t1, t2].map(|t| -lcp.row_w(t, x) / s);
            let sum = [x[t1] + change[0], x[t2] + change[1]];
            [x[t1], x[t2]] = match adds_clamped {
                _ if has_free_friction => sum,
                true => {
                    let [first, second] = self.shape.nearest(radius, change);
                    [x[t1] + first, x[t2] + second]
                }
                false => self.shape.nearest(radius, sum),
            };
        }
    }

    /// The normal force that limits the friction of contact k.
    fn normal(&self, rule: Rule<'_>, k: usize, limits: Option<&[f64]>, x: &[f64]) -> f64 {
        let contacts = self.friction.contacts();
        let of = |k: usize| contacts[k % contacts.len()].rows[0];
        match (rule, limits) {
            (Rule::OtherNormals(by), _) => x[of(k + by)],
            (Rule::NormalsOf(last), _) => last[of(k)],
            (_, Some(limits)) => limits[of(k)],
            (_, None) => x[of(k)],
        }
    }

    /// x clamped to its bounds: each normal, then the friction that it limits.
    fn clamped(&self, x: &[f64]) -> Vec<f64> {
        let mut x = x.to_vec();
        for &i in self.friction.others() {
            x[i] = self.friction.lcp().project(i, x[i], &[]);
        }
        for contact in self.friction.contacts() {
            let [n, t1, t2] = contact.of(&x);
            let n = n.max(0.0);
            let [t1, t2] = self.shape.nearest(contact.mu * n, [t1, t2]);
            contact.put([n, t1, t2], &mut x);
        }
        x
    }

    /// The solution of the changed contacts next to x, if x nearly solves them.
    pub fn refined(&self, rule: Rule<'_>, x: &[f64]) -> Vec<f64> {
        self.sweeps((rule, Step::Trace), x, REFINING_SWEEPS, |_, _| ())
    }

    /// The change of x in a sweep in which every row uses this x, scaled by the terms of the row.
    pub fn residuals(&self, rule: Rule<'_>, x: &[f64]) -> Vec<f64> {
        let lcp = self.friction.lcp();
        let mut residuals = vec![0.0; x.len()];
        let relative = |moved: f64, terms: f64| if moved == 0.0 { 0.0 } else { moved / terms };
        let terms = |i: usize| RowTerms::at(lcp, i, x).magnitude;
        let single = |i: usize, is_free: bool| {
            let scale = lcp.matrix().diagonal(i);
            let aim = x[i] - lcp.row_w(i, x) / scale;
            let new = if is_free { aim } else { lcp.project(i, aim, x) };
            relative((x[i] - new).abs() * scale, terms(i))
        };
        for &i in self.friction.others() {
            residuals[i] = single(i, false);
        }
        for (k, contact) in self.friction.contacts().iter().enumerate() {
            let [n, t1, t2] = contact.rows;
            residuals[n] = single(n, matches!(rule, Rule::WithoutNormalBound));
            let s = Step::Trace.scale(lcp, [t1, t2]);
            let aim = [t1, t2].map(|t| x[t] - lcp.row_w(t, x) / s);
            let new = match rule {
                Rule::WithoutFrictionLimit => aim,
                _ => self.shape.nearest(contact.mu * self.normal(rule, k, None, x), aim),
            };
            for (t, new) in [t1, t2].into_iter().zip(new) {
                residuals[t] = relative((x[t] - new).abs() * s, hypot(terms(t1), terms(t2)));
            }
        }
        residuals
    }

    /// The contacts and the other rows.
    pub fn friction(&self) -> &FrictionProblem {
        &self.friction
    }

    /// The rows in which x is strictly between its bounds: normals that press, tangents that stick.
    pub fn free_rows(&self, x: &[f64]) -> Vec<usize> {
        let lcp = self.friction.lcp();
        let others = self.friction.others().iter().copied();
        let mut free: Vec<usize> =
            others.filter(|&i| super::changed::is_inside(lcp, i, x)).collect();
        for contact in self.friction.contacts() {
            let [n, t1, t2] = contact.rows;
            free.extend((super::changed::is_inside(lcp, n, x)).then_some(n));
            free.extend(self.sticks(contact, x).then_some([t1, t2]).into_iter().flatten());
        }
        free
    }

    /// Whether the friction of a contact is inside its limit at x, not at it.
    pub fn sticks(&self, contact: &Contact, x: &[f64]) -> bool {
        let [n, t1, t2] = contact.of(x);
        let inner = (1.0 - AT_LIMIT) * contact.mu * n;
        inner > 0.0 && self.shape.nearest(inner, [t1, t2]) == [t1, t2]
    }

    /// Whether friction at the limit is along the slip at x, or against it.
    pub fn is_along_slip(&self, contact: &Contact, x: &[f64]) -> bool {
        let lcp = self.friction.lcp();
        let [n, t1, t2] = contact.rows;
        let s = Step::Trace.scale(lcp, [t1, t2]);
        let own = [x[t1], x[t2]];
        let step = [t1, t2].map(|t| lcp.row_w(t, x) / s);
        let radius = contact.mu * x[n];
        [1.0, -1.0].into_iter().any(|sign| {
            let aim = [own[0] - sign * step[0], own[1] - sign * step[1]];
            let [first, second] = self.shape.nearest(radius, aim);
            hypot(first - own[0], second - own[1]) <= AT_LIMIT * radius
        })
    }
}

/// The factor of μ that allows the friction of x: the largest part of its
/// limit that a contact uses.
pub(super) fn largest_use_of_mu(posed: &ProblemForm, x: &[f64]) -> Option<f64> {
    let (shape, friction) = Shape::of(posed)?;
    let used = |contact: &Contact| {
        let [n, t1, t2] = contact.of(x);
        (n > 0.0 && contact.mu > 0.0).then(|| shape.radius([t1, t2]) / (contact.mu * n))
    };
    friction.contacts().iter().filter_map(used).reduce(f64::max)
}

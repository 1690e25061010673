//! Pendulums in reduced coordinates: angles instead of positions and rods, so that no constraint
//! can drift. An independent reference for the scenes `pendulum` and `double_pendulum`.
//!
//! ```text
//! one mass      φ'' = −(g/l) sin φ,   period 2π √(l/g)/agm(1, cos(φ0/2)) from rest at φ0
//! two masses    with Δ = φ1 − φ2 and the Lagrangian's mass matrix, ω = φ':
//!               | (m1+m2) l1        m2 l2 cos Δ | |φ1''|   | −m2 l2 ω2² sin Δ − (m1+m2) g sin φ1 |
//!               | l1 cos Δ          l2          | |φ2''| = | l1 ω1² sin Δ − g sin φ2             |
//! ```
//!
//! Angles are measured from the vertical, positive towards +x. The motion is integrated by the
//! classical Runge-Kutta method with steps of at most 10⁻⁴ s: its error is below 10⁻¹² s⁴ per
//! second.

use std::f64::consts::TAU;

/// The longest step (s).
const STEP: f64 = 1e-4;

/// A point mass on a massless rod.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Pendulum {
    /// l (m).
    pub length: f64,
    /// g (m/s²).
    pub gravity: f64,
}

/// A point mass on a rod that hangs from another one.
///
/// ```
/// use lcplab_mechanics::scene::catalogue::pendulum::{DoublePendulum, Swing};
///
/// // Two masses of 1 kg at the height of the pivot, at rest: no energy, and it stays so.
/// let pendulum = DoublePendulum { masses: [1.0; 2], lengths: [1.0; 2], gravity: 10.0 };
/// let start = Swing { angles: [std::f64::consts::FRAC_PI_2; 2], rates: [0.0; 2] };
/// assert!(pendulum.energy(&start).abs() < 1e-14);
/// let later = pendulum.after(0.5, start);
/// assert!(pendulum.energy(&later).abs() < 1e-9 && later.angles != start.angles);
/// // Hanging down: −m g l − m g 2 l = −30 J.
/// assert_eq!(pendulum.energy(&Swing { angles: [0.0; 2], rates: [0.0; 2] }), -30.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DoublePendulum {
    /// m1, m2 (kg), the upper one first.
    pub masses: [f64; 2],
    /// l1, l2 (m).
    pub lengths: [f64; 2],
    /// g (m/s²).
    pub gravity: f64,
}

/// A point mass that circles at constant height on a massless rod. The scene `conical_pendulum`.
///
/// ```text
/// ω² = g/(l cos θ),   the rod pulls with m g/cos θ
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conical {
    /// l (m).
    pub length: f64,
    /// θ from the vertical (rad).
    pub angle: f64,
    /// g (m/s²).
    pub gravity: f64,
}

impl Conical {
    /// The time of one revolution (s).
    pub fn period(&self) -> f64 {
        TAU * (self.length * self.angle.cos() / self.gravity).sqrt()
    }

    /// The tension (N) for a mass (kg).
    ///
    /// ```
    /// use lcplab_mechanics::scene::catalogue::pendulum::Conical;
    ///
    /// // At 60° from the vertical the rod pulls with twice the weight.
    /// let pendulum = Conical { length: 1.0, angle: std::f64::consts::FRAC_PI_3, gravity: 10.0 };
    /// assert!((pendulum.tension(1.0) - 20.0).abs() < 1e-13); // N
    /// ```
    pub fn tension(&self, mass: f64) -> f64 {
        mass * self.gravity / self.angle.cos()
    }
}

/// Angles (rad) and their rates (rad/s).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Swing<const N: usize> {
    /// φ, from the vertical.
    pub angles: [f64; N],
    /// φ'.
    pub rates: [f64; N],
}

impl Pendulum {
    /// The swing a time (s) later.
    ///
    /// ```
    /// use lcplab_mechanics::scene::catalogue::pendulum::{Pendulum, Swing};
    ///
    /// let pendulum = Pendulum { length: 1.0, gravity: 9.81 };
    /// let start = Swing { angles: [1.0], rates: [0.0] };
    /// let later = pendulum.after(pendulum.period(1.0), start);
    /// assert!((later.angles[0] - 1.0).abs() < 1e-10);
    /// ```
    pub fn after(&self, time: f64, start: Swing<1>) -> Swing<1> {
        follow(time, start, |swing| [-self.gravity / self.length * swing.angles[0].sin()])
    }

    /// The period (s) of swings with this amplitude (rad), below π.
    pub fn period(&self, amplitude: f64) -> f64 {
        let (mut a, mut b) = (1.0, (0.5 * amplitude).cos());
        while (a - b).abs() > 1e-15 * a {
            (a, b) = (0.5 * (a + b), (a * b).sqrt());
        }
        TAU * (self.length / self.gravity).sqrt() / a
    }
}

impl DoublePendulum {
    /// The swing a time (s) later.
    pub fn after(&self, time: f64, start: Swing<2>) -> Swing<2> {
        follow(time, start, |swing| self.accelerations(swing))
    }

    /// Kinetic and potential energy (J), the latter 0 at the height of the pivot.
    pub fn energy(&self, swing: &Swing<2>) -> f64 {
        let ([m1, m2], [l1, l2], g) = (self.masses, self.lengths, self.gravity);
        let ([a1, a2], [w1, w2]) = (swing.angles, swing.rates);
        let (v1, v2) = (l1 * w1, l2 * w2);
        let cross = 2.0 * v1 * v2 * (a1 - a2).cos();
        let kinetic = 0.5 * m1 * v1 * v1 + 0.5 * m2 * (v1 * v1 + v2 * v2 + cross);
        kinetic - (m1 + m2) * g * l1 * a1.cos() - m2 * g * l2 * a2.cos()
    }

    fn accelerations(&self, swing: &Swing<2>) -> [f64; 2] {
        let ([m1, m2], [l1, l2], g) = (self.masses, self.lengths, self.gravity);
        let ([a1, a2], [w1, w2]) = (swing.angles, swing.rates);
        let (sin, cos) = (a1 - a2).sin_cos();
        let (a, b) = ((m1 + m2) * l1, m2 * l2 * cos);
        let (c, d) = (l1 * cos, l2);
        let f1 = -m2 * l2 * w2 * w2 * sin - (m1 + m2) * g * a1.sin();
        let f2 = l1 * w1 * w1 * sin - g * a2.sin();
        let determinant = a * d - b * c;
        [(d * f1 - b * f2) / determinant, (a * f2 - c * f1) / determinant]
    }
}

/// The swing after this time, for φ'' = f(φ, φ').
fn follow<const N: usize>(
    time: f64,
    start: Swing<N>,
    f: impl Fn(&Swing<N>) -> [f64; N],
) -> Swing<N> {
    let steps = (time / STEP).ceil().max(1.0);
    let h = time / steps;
    let plus = |a: [f64; N], h: f64, b: [f64; N]| std::array::from_fn(|i| a[i] + h * b[i]);
    let moved = |y: &Swing<N>, h: f64, k: &Swing<N>| Swing {
        angles: plus(y.angles, h, k.angles),
        rates: plus(y.rates, h, k.rates),
    };
    let rate = |y: &Swing<N>| Swing { angles: y.rates, rates: f(y) };
    let mut y = start;
    for _ in 0..steps as usize {
        let k1 = rate(&y);
        let k2 = rate(&moved(&y, h / 2.0, &k1));
        let k3 = rate(&moved(&y, h / 2.0, &k2));
        let k4 = rate(&moved(&y, h, &k3));
        let sum = moved(&moved(&moved(&k1, 2.0, &k2), 2.0, &k3), 1.0, &k4);
        y = moved(&y, h / 6.0, &sum);
    }
    y
}

//! One body on the ground, at both levels, by hand.

use lcplab_mechanics::scene::Scheme;

use super::{explained, sections};

#[test]
fn figure_6_at_velocity_level_gives_two_newton_seconds() {
    // u* = −1 − 1·1 = −2 m/s, and a body of 1 kg needs 2 N s to stop.
    let document = explained("fig6", Scheme::Velocity, "pgs");
    let text = sections(
        &document,
        &["from 0 s", "constraints", "Newton", "row by row", "answer", "motion", "after"],
    );
    insta::assert_snapshot!(text, @r"
    1 Step 1, from 0 s to 1 s
      The moving bodies before the step: positions, velocities, masses and forces
        body   p (m)       v (m/s)      m (kg)   force (N)
        body   (0, 0, 0)   (0, 0, −1)        1   (0, 0, −1)

    Constraints
    Rows are numbered from 0. c is the gap of a contact or the position error of a joint, J u its
    rate, and J'u, with J' = dJ/dt, the part of its second derivative that the velocities alone
    cause.
      Impulses, the rows
        row   constraint             c (m)   J u (m/s)   J'u (m/s²)   bias (m/s)   bounds of x (N s)
          0   normal ground – body       0          −1            0            0   [0, ∞)
    The bias is the feedback of errors. A position error c is multiplied by β/dt = 0/(1 s) = 0 s⁻¹,
    and a gap c > 0 of a contact by 1/dt, so that the gap can close within the step but not become
    an overlap. The bias of a friction row is 0, that of a motor the negative target speed.

    From Newton's law to the LCP
    The velocity components that occur in a row; 2 others do not:
        u = [v_z of body]
    1. Newton's law over the step. Without constraints the velocities would be u*. The impulses x of
    the rows act along Jᵀ and change them.
        u⁺ = u* + M⁻¹Jᵀ x,   u* = u + dt M⁻¹F
        u* = [ −1 ] + 1 s · [ −1 ] = [ −2 ]   m/s
        M⁻¹ = [ 1 ]   1/kg
    2. Every row is a condition on the new velocities u⁺: w is J u⁺ plus the bias. A contact
    requires w ≥ 0 and pushes only if w = 0.
        w = J u⁺ + bias
        J = [ 1 ] ,   bias = [ 0 ]   m/s
    3. Equation 1 is substituted into equation 2.
        w = J M⁻¹Jᵀ x + J u* + bias
    4. The factor of x is A, and the rest is b: w = A x + b.
    Figure 4 of K&M (Kenwright & Morgan) prints b with the opposite sign, which would double the
    velocity of the body instead of stopping it (`lcplab chapter E22`).
        A = J M⁻¹Jᵀ = [ 1 ]   1/kg
        b = J u* + bias = [ −2 ] + [ 0 ] = [ −2 ]   m/s
    Every x ≥ 0 and w ≥ 0, and w > 0 only if x = 0.

    Projected Gauss-Seidel, row by row
    A sweep updates one row after another, always with the newest x. It sums the w of the row,
    divides it by the diagonal entry, and subtracts the result from x. Then it clamps x to its
    bounds, before the next row.
        xᵢ ← Πᵢ( xᵢ − ω wᵢ / aᵢᵢ ),   wᵢ = Σⱼ aᵢⱼ xⱼ + bᵢ
    The start is x = (0) N s.
      Impulses, sweep 1
        row   the sum w (m/s)   divided by a (N s)   x moved (N s)   clamped (N s)
          0   1·0 − 2 = −2      −2/1 = −2            0 − (−2) = 2    to [0, ∞): 2
    After sweep 1: x = (2) N s.
      Impulses, how x and its residual change over the sweeps
        sweep   x (N s)   max |x − Π(x − w)|   factor
            0   (0)                        2
            1   (2)                        0        0
    pgs ends after 1 iteration with x = (2) N s: solved.

    The answer
      Impulses, x and w, row by row
        row                      x            w = A x + b   condition
        0 normal ground – body   x₀ = 2 N s   w₀ = 0 m/s    x₀ > 0, so w₀ = 0
    The judge sees A, b, the bounds and x, but not the solver. Its verdict is proved: x is an exact
    solution. The error of the worst row relative to the size of its terms, the scaled residual, is
    0.

    The new motion
        u⁺ = u* + M⁻¹Jᵀ x = [ −2 ] + [ 2 ] = [ 0 ]   m/s

    3 The states after the step
    The bodies move with their new velocities, s⁺ = s + dt S u⁺ (S turns velocities into rates of
    positions and quaternions).
      The moving bodies after the step
        body   p (m)       v (m/s)
        body   (0, 0, 0)   (0, 0, 0)
    ");
}

#[test]
fn figure_6_at_acceleration_level_is_a_blow_and_then_the_weight() {
    // The impact takes 1 kg · 1 m/s, the weight is 1 kg · 1 m/s².
    let document = explained("fig6", Scheme::Acceleration, "dantzig");
    let text = sections(&document, &["Newton", "move by move", "answer", "motion"]);
    insta::assert_snapshot!(text, @r"
    From Newton's law to the LCP
    The velocity components that occur in a row; 2 others do not:
        u = [v_z of body]
    1. Newton's law over an instant. Only the impulses x of the rows matter; forces have no time to
    act.
        u⁺ = u* + M⁻¹Jᵀ x
        u* = [ −1 ]   m/s
        M⁻¹ = [ 1 ]   1/kg
    2. Every row is a condition on the new velocities u⁺: w is J u⁺ plus the bias. A contact
    requires w ≥ 0 and pushes only if w = 0.
        w = J u⁺ + bias
        J = [ 1 ] ,   bias = [ 0 ]   m/s
    3. Equation 1 is substituted into equation 2.
        w = J M⁻¹Jᵀ x + J u* + bias
    4. The factor of x is A, and the rest is b: w = A x + b.
        A = J M⁻¹Jᵀ = [ 1 ]   1/kg
        b = J u* + bias = [ −1 ] + [ 0 ] = [ −1 ]   m/s
    Every x ≥ 0 and w ≥ 0, and w > 0 only if x = 0.

    Dantzig's method, move by move
    Dantzig's method satisfies the rows one after another. To bring wₖ to 0, it changes xₖ, and the
    free rows F change with it so that their w stays 0. The move ends when wₖ is 0, when some x
    reaches a bound, or when the w of a row at a bound reaches 0. The row that ends it enters or
    leaves F, or changes its bound: this is a pivot. d and Δw are the changes of x and w per unit of
    the length t of the move.
        d_k = 1,   d_F = −A_FF⁻¹ A_Fk,   Δw = A d
    The start is x = (0) N s, and F is empty.
    Move 1: row 0. At x = (0) N s it has w₀ = −1 m/s, so x₀ increases. The free rows are F = {}.
        d = [ 1 ] ,   Δw = [ 1 ]
      Impact, move 1, lengths at which it may end
        what           t (N s)
        w₀ reaches 0   1/1 = 1
    The move ends at t = 1 N s: row 0 enters F.
    Now x = (1) N s.
    dantzig ends after 1 iteration with x = (1) N s: solved.

    The answer
      Impact, x and w, row by row
        row                      x            w = A x + b   condition
        0 normal ground – body   x₀ = 1 N s   w₀ = 0 m/s    x₀ > 0, so w₀ = 0
    The judge sees A, b, the bounds and x, but not the solver. Its verdict is proved: x is an exact
    solution. The error of the worst row relative to the size of its terms, the scaled residual, is
    0.

    The new motion
        u⁺ = u* + M⁻¹Jᵀ x = [ −1 ] + [ 1 ] = [ 0 ]   m/s

    From Newton's law to the LCP
    J, M⁻¹ and A are those of the impact above.
    1. Newton's law. Without constraints the accelerations would be a*. The forces x of the rows act
    along Jᵀ and change them.
        u' = a* + M⁻¹Jᵀ x,   a* = M⁻¹F
        a* = [ −1 ]   m/s²
    2. Every row is a condition on the accelerations u': w is J u' plus the bias. A contact requires
    w ≥ 0 and pushes only if w = 0.
        w = J u' + bias
        b = J a* + bias = [ −1 ] + [ 0 ] = [ −1 ]   m/s²

    Dantzig's method, move by move
    The start is x = (0) N, and F is empty.
    Move 1: row 0. At x = (0) N it has w₀ = −1 m/s², so x₀ increases. The free rows are F = {}.
        d = [ 1 ] ,   Δw = [ 1 ]
      Forces, move 1, lengths at which it may end
        what           t (N)
        w₀ reaches 0   1/1 = 1
    The move ends at t = 1 N: row 0 enters F.
    Now x = (1) N.
    dantzig ends after 1 iteration with x = (1) N: solved.

    The answer
      Forces, x and w, row by row
        row                      x          w = A x + b   condition
        0 normal ground – body   x₀ = 1 N   w₀ = 0 m/s²   x₀ > 0, so w₀ = 0
    The judge sees A, b, the bounds and x, but not the solver. Its verdict is proved: x is an exact
    solution. The error of the worst row relative to the size of its terms, the scaled residual, is
    0.

    The new motion
        u' = a* + M⁻¹Jᵀ x = [ −1 ] + [ 1 ] = [ 0 ]   m/s²
        u + dt u' = [ 0 ] + 1 s · [ 0 ] = [ 0 ]   m/s
    ");
}

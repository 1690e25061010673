//! Three bodies in a stack, by sweeps, moves and pivots, by hand.

use lcplab_mechanics::scene::Scheme;

use super::{explained, sections};

#[test]
fn figure_7_at_velocity_level_by_sweeps() {
    // A and b of the chapter; x after each sweep by hand.
    let document = explained("fig7", Scheme::Velocity, "pgs");
    let text = sections(&document, &["constraints", "Newton", "row by row"]);
    insta::assert_snapshot!(text, @r"
    Constraints
    Rows are numbered from 0. c is the gap of a contact or the position error of a joint, J u its
    rate, and J'u, with J' = dJ/dt, the part of its second derivative that the velocities alone
    cause.
      Impulses, the rows
        row   constraint               c (m)   J u (m/s)   J'u (m/s²)   bias (m/s)   bounds of x (N s)
          0   normal ground – bottom       0           0            0            0   [0, ∞)
          1   normal bottom – middle       0          −1            0            0   [0, ∞)
          2   normal middle – top          0           1            0            0   [0, ∞)
    The bias is the feedback of errors. A position error c is multiplied by β/dt = 0/(1 s) = 0 s⁻¹,
    and a gap c > 0 of a contact by 1/dt, so that the gap can close within the step but not become
    an overlap. The bias of a friction row is 0, that of a motor the negative target speed.

    From Newton's law to the LCP
    The velocity components that occur in a row; 15 others do not:
        u = [v_z of bottom, v_z of middle, v_z of top]
    1. Newton's law over the step. Without constraints the velocities would be u*. The impulses x of
    the rows act along Jᵀ and change them.
        u⁺ = u* + M⁻¹Jᵀ x,   u* = u + dt M⁻¹F
             ⎡  0 ⎤         ⎡ −1 ⎤   ⎡ −1 ⎤
        u* = ⎢ −1 ⎥ + 1 s · ⎢ −1 ⎥ = ⎢ −2 ⎥   m/s
             ⎣  0 ⎦         ⎣ −1 ⎦   ⎣ −1 ⎦
              ⎡ 1  0  0 ⎤
        M⁻¹ = ⎢ 0  1  0 ⎥   1/kg
              ⎣ 0  0  1 ⎦
    2. Every row is a condition on the new velocities u⁺: w is J u⁺ plus the bias. A contact
    requires w ≥ 0 and pushes only if w = 0.
        w = J u⁺ + bias
            ⎡  1   0  0 ⎤            ⎡ 0 ⎤
        J = ⎢ −1   1  0 ⎥ ,   bias = ⎢ 0 ⎥   m/s
            ⎣  0  −1  1 ⎦            ⎣ 0 ⎦
    3. Equation 1 is substituted into equation 2.
        w = J M⁻¹Jᵀ x + J u* + bias
    4. The factor of x is A, and the rest is b: w = A x + b.
    Figure 4 of K&M (Kenwright & Morgan) prints b with the opposite sign, which would double the
    velocity of the body instead of stopping it (`lcplab chapter E22`).
                      ⎡  1  −1   0 ⎤
        A = J M⁻¹Jᵀ = ⎢ −1   2  −1 ⎥   1/kg
                      ⎣  0  −1   2 ⎦
                          ⎡ −1 ⎤   ⎡ 0 ⎤   ⎡ −1 ⎤
        b = J u* + bias = ⎢ −1 ⎥ + ⎢ 0 ⎥ = ⎢ −1 ⎥   m/s
                          ⎣  1 ⎦   ⎣ 0 ⎦   ⎣  1 ⎦
    Every x ≥ 0 and w ≥ 0, and w > 0 only if x = 0.

    Projected Gauss-Seidel, row by row
    A sweep updates one row after another, always with the newest x. It sums the w of the row,
    divides it by the diagonal entry, and subtracts the result from x. Then it clamps x to its
    bounds, before the next row.
        xᵢ ← Πᵢ( xᵢ − ω wᵢ / aᵢᵢ ),   wᵢ = Σⱼ aᵢⱼ xⱼ + bᵢ
    The start is x = (0, 0, 0) N s.
      Impulses, sweep 1
        row   the sum w (m/s)             divided by a (N s)   x moved (N s)   clamped (N s)
          0   1·0 − 1·0 − 1 = −1          −1/1 = −1            0 − (−1) = 1    to [0, ∞): 1
          1   −1·1 + 2·0 − 1·0 − 1 = −2   −2/2 = −1            0 − (−1) = 1    to [0, ∞): 1
          2   −1·1 + 2·0 + 1 = 0          0/2 = 0              0 − 0 = 0       to [0, ∞): 0
    After sweep 1: x = (1, 1, 0) N s.
      Impulses, sweep 2
        row   the sum w (m/s)             divided by a (N s)   x moved (N s)        clamped (N s)
          0   1·1 − 1·1 − 1 = −1          −1/1 = −1            1 − (−1) = 2         to [0, ∞): 2
          1   −1·2 + 2·1 − 1·0 − 1 = −1   −1/2 = −0.5          1 − (−0.5) = 1.5     to [0, ∞): 1.5
          2   −1·1.5 + 2·0 + 1 = −0.5     −0.5/2 = −0.25       0 − (−0.25) = 0.25   to [0, ∞): 0.25
    After sweep 2: x = (2, 1.5, 0.25) N s.
      Impulses, sweep 3
        row   the sum w (m/s)                       divided by a (N s)   x moved (N s)               clamped (N s)
          0   1·2 − 1·1.5 − 1 = −0.5                −0.5/1 = −0.5        2 − (−0.5) = 2.5            to [0, ∞): 2.5
          1   −1·2.5 + 2·1.5 − 1·0.25 − 1 = −0.75   −0.75/2 = −0.375     1.5 − (−0.375) = 1.875      to [0, ∞): 1.875
          2   −1·1.875 + 2·0.25 + 1 = −0.375        −0.375/2 = −0.1875   0.25 − (−0.1875) = 0.4375   to [0, ∞): 0.4375
    After sweep 3: x = (2.5, 1.875, 0.4375) N s.
      Impulses, how x and its residual change over the sweeps
        sweep   x (N s)                        max |x − Π(x − w)|   factor
            0   (0, 0, 0)                                       1
            1   (1, 1, 0)                                       1        1
            2   (2, 1.5, 0.25)                                0.5      0.5
            3   (2.5, 1.875, 0.4375)                        0.375     0.75
            4   (2.875, 2.15625, 0.578125)                0.28125     0.75
            5   (3.15625, 2.36719, 0.683594)             0.210938     0.75
            6   (3.36719, 2.52539, 0.762695)             0.158203     0.75
            7   (3.52539, 2.64404, 0.822021)             0.118652     0.75
            8   (3.64404, 2.73303, 0.866516)            0.0889893     0.75
            9   (3.73303, 2.79977, 0.899887)            0.0667419     0.75
           10   (3.79977, 2.84983, 0.924915)            0.0500565     0.75
           57   (4, 3, 1)                            6.71954×10⁻⁸
    pgs ends after 57 iterations with x = (4, 3, 1) N s: solved.
    ");
}

#[test]
fn figure_7_by_the_moves_of_dantzig() {
    // d_F = −A_FF⁻¹A_Fk by hand: (1), then (1, 1); each s is 1.
    let document = explained("fig7", Scheme::Velocity, "dantzig");
    let text = sections(&document, &["move by move", "answer", "motion", "after"]);
    insta::assert_snapshot!(text, @r"
    Dantzig's method, move by move
    Dantzig's method satisfies the rows one after another. To bring wₖ to 0, it changes xₖ, and the
    free rows F change with it so that their w stays 0. The move ends when wₖ is 0, when some x
    reaches a bound, or when the w of a row at a bound reaches 0. The row that ends it enters or
    leaves F, or changes its bound: this is a pivot. d and Δw are the changes of x and w per unit of
    the length t of the move.
        d_k = 1,   d_F = −A_FF⁻¹ A_Fk,   Δw = A d
    The start is x = (0, 0, 0) N s, and F is empty.
    Move 1: row 0. At x = (0, 0, 0) N s it has w₀ = −1 m/s, so x₀ increases. The free rows are F =
    {}.
            ⎡ 1 ⎤          ⎡ 1 ⎤
        d = ⎢ 0 ⎥ ,   Δw = ⎢ 0 ⎥
            ⎣ 0 ⎦          ⎣ 0 ⎦
      Impulses, move 1, lengths at which it may end
        what           t (N s)
        w₀ reaches 0   1/1 = 1
    The move ends at t = 1 N s: row 0 enters F.
    Now x = (1, 0, 0) N s.
    Move 2: row 1. At x = (1, 0, 0) N s it has w₁ = −2 m/s, so x₁ increases. The free rows are F =
    {0}.
            ⎡ 1 ⎤          ⎡ 0 ⎤
        d = ⎢ 1 ⎥ ,   Δw = ⎢ 1 ⎥
            ⎣ 0 ⎦          ⎣ 0 ⎦
      Impulses, move 2, lengths at which it may end
        what           t (N s)
        w₁ reaches 0   2/1 = 2
    The move ends at t = 2 N s: row 1 enters F.
    Now x = (3, 2, 0) N s.
    Move 3: row 2. At x = (3, 2, 0) N s it has w₂ = −1 m/s, so x₂ increases. The free rows are F =
    {0, 1}.
            ⎡ 1 ⎤          ⎡ 0 ⎤
        d = ⎢ 1 ⎥ ,   Δw = ⎢ 0 ⎥
            ⎣ 1 ⎦          ⎣ 1 ⎦
      Impulses, move 3, lengths at which it may end
        what           t (N s)
        w₂ reaches 0   1/1 = 1
    The move ends at t = 1 N s: row 2 enters F.
    Now x = (4, 3, 1) N s.
    dantzig ends after 3 iterations with x = (4, 3, 1) N s: solved.

    The answer
      Impulses, x and w, row by row
        row                        x            w = A x + b   condition
        0 normal ground – bottom   x₀ = 4 N s   w₀ = 0 m/s    x₀ > 0, so w₀ = 0
        1 normal bottom – middle   x₁ = 3 N s   w₁ = 0 m/s    x₁ > 0, so w₁ = 0
        2 normal middle – top      x₂ = 1 N s   w₂ = 0 m/s    x₂ > 0, so w₂ = 0
    The judge sees A, b, the bounds and x, but not the solver. Its verdict is proved: x is an exact
    solution. The error of the worst row relative to the size of its terms, the scaled residual, is
    0.

    The new motion
                            ⎡ −1 ⎤   ⎡ 1 ⎤   ⎡ 0 ⎤
        u⁺ = u* + M⁻¹Jᵀ x = ⎢ −2 ⎥ + ⎢ 2 ⎥ = ⎢ 0 ⎥   m/s
                            ⎣ −1 ⎦   ⎣ 1 ⎦   ⎣ 0 ⎦

    3 The states after the step
    The bodies move with their new velocities, s⁺ = s + dt S u⁺ (S turns velocities into rates of
    positions and quaternions).
      The moving bodies after the step
        body     p (m)         v (m/s)
        bottom   (0, 0, 0.5)   (0, 0, 0)
        middle   (0, 0, 1.5)   (0, 0, 0)
        top      (0, 0, 2.5)   (0, 0, 0)
    ");
}

#[test]
fn figure_7_by_the_pivots_of_lemke() {
    // Each tableau by hand. Of the tied rows 0 and 1 the second is less when b is perturbed by (ε,
    // ε², ε³).
    let document = explained("fig7", Scheme::Velocity, "lemke");
    let text = sections(&document, &["tableau by tableau"]);
    insta::assert_snapshot!(text, @r"
    Lemke's method, tableau by tableau
    A covering variable z makes every w nonnegative. Each tableau expresses the basic variables by
    the others, which are 0. z enters first and increases until no w is negative: the largest ratio,
    −value / entry in the column of z. Then the complement of the variable that has just left
    enters, and increases until a basic variable reaches 0: the smallest ratio, −value / entry in
    its column. When z leaves, x is the solution. ← marks the leaving variable, brackets the pivot.
    In a tie z leaves first; other ties are broken lexicographically.
        w = A x + b + z e,   x, w, z ≥ 0,   xᵢ wᵢ = 0
      Impulses, tableau 1: z enters, w₁ leaves
        basic   value   x₀   x₁   x₂     z   ratio
        w₀         −1    1   −1    0     1   1
        w₁         −1   −1    2   −1   [1]   1 ←
        w₂          1    0   −1    2     1   −1
      Impulses, tableau 2: x₁ enters, w₀ leaves
        basic   value   x₀     x₁   x₂   w₁   ratio
        w₀          0    2   [−3]    1    1   0 ←
        z           1    1     −2    1    1   1/2
        w₂          2    1     −3    3    1   2/3
      Impulses, tableau 3: x₀ enters, w₂ leaves
        basic   value     x₀     w₀    x₂    w₁   ratio
        x₁          0    2/3   −1/3   1/3   1/3
        z           1   −1/3    2/3   1/3   1/3   3
        w₂          2   [−1]      1     2     0   2 ←
      Impulses, tableau 4: x₂ enters, z leaves
        basic   value     w₂    w₀       x₂    w₁   ratio
        x₁        4/3   −2/3   1/3      5/3   1/3
        z         1/3    1/3   1/3   [−1/3]   1/3   1 ←
        x₀          2     −1     1        2     0
      Impulses, tableau 5: z is 0: solved
        basic   value   w₂   w₀    z   w₁
        x₁          3    1    2   −5    2
        x₂          1    1    1   −3    1
        x₀          4    1    3   −6    2
    lemke ends after 4 iterations with x = (4, 3, 1) N s: solved.
    ");
}

#[test]
fn figure_7_at_acceleration_level_is_a_blow_and_then_the_weights() {
    // The impact stops the middle body, x = (1, 1, 0); then each row supports the weight above, (3,
    // 2, 1) N.
    let document = explained("fig7", Scheme::Acceleration, "dantzig");
    let text = sections(&document, &["forces: constraints", "Newton", "answer", "motion"]);
    insta::assert_snapshot!(text, @r"
    From Newton's law to the LCP
    The velocity components that occur in a row; 15 others do not:
        u = [v_z of bottom, v_z of middle, v_z of top]
    1. Newton's law over an instant. Only the impulses x of the rows matter; forces have no time to
    act.
        u⁺ = u* + M⁻¹Jᵀ x
             ⎡  0 ⎤
        u* = ⎢ −1 ⎥   m/s
             ⎣  0 ⎦
              ⎡ 1  0  0 ⎤
        M⁻¹ = ⎢ 0  1  0 ⎥   1/kg
              ⎣ 0  0  1 ⎦
    2. Every row is a condition on the new velocities u⁺: w is J u⁺ plus the bias. A contact
    requires w ≥ 0 and pushes only if w = 0.
        w = J u⁺ + bias
            ⎡  1   0  0 ⎤            ⎡ 0 ⎤
        J = ⎢ −1   1  0 ⎥ ,   bias = ⎢ 0 ⎥   m/s
            ⎣  0  −1  1 ⎦            ⎣ 0 ⎦
    3. Equation 1 is substituted into equation 2.
        w = J M⁻¹Jᵀ x + J u* + bias
    4. The factor of x is A, and the rest is b: w = A x + b.
                      ⎡  1  −1   0 ⎤
        A = J M⁻¹Jᵀ = ⎢ −1   2  −1 ⎥   1/kg
                      ⎣  0  −1   2 ⎦
                          ⎡  0 ⎤   ⎡ 0 ⎤   ⎡  0 ⎤
        b = J u* + bias = ⎢ −1 ⎥ + ⎢ 0 ⎥ = ⎢ −1 ⎥   m/s
                          ⎣  1 ⎦   ⎣ 0 ⎦   ⎣  1 ⎦
    Every x ≥ 0 and w ≥ 0, and w > 0 only if x = 0.

    The answer
      Impact, x and w, row by row
        row                        x            w = A x + b   condition
        0 normal ground – bottom   x₀ = 1 N s   w₀ = 0 m/s    x₀ > 0, so w₀ = 0
        1 normal bottom – middle   x₁ = 1 N s   w₁ = 0 m/s    x₁ > 0, so w₁ = 0
        2 normal middle – top      x₂ = 0 N s   w₂ = 0 m/s    x₂ = 0, so w₂ ≥ 0
    The judge sees A, b, the bounds and x, but not the solver. Its verdict is proved: x is an exact
    solution. The error of the worst row relative to the size of its terms, the scaled residual, is
    0.

    The new motion
                            ⎡  0 ⎤   ⎡ 0 ⎤   ⎡ 0 ⎤
        u⁺ = u* + M⁻¹Jᵀ x = ⎢ −1 ⎥ + ⎢ 1 ⎥ = ⎢ 0 ⎥   m/s
                            ⎣  0 ⎦   ⎣ 0 ⎦   ⎣ 0 ⎦

    Constraints
    c, J u, J'u and the bias of every row are now 0.

    From Newton's law to the LCP
    J, M⁻¹ and A are those of the impact above.
    1. Newton's law. Without constraints the accelerations would be a*. The forces x of the rows act
    along Jᵀ and change them.
        u' = a* + M⁻¹Jᵀ x,   a* = M⁻¹F
             ⎡ −1 ⎤
        a* = ⎢ −1 ⎥   m/s²
             ⎣ −1 ⎦
    2. Every row is a condition on the accelerations u': w is J u' plus the bias. A contact requires
    w ≥ 0 and pushes only if w = 0.
        w = J u' + bias
                          ⎡ −1 ⎤   ⎡ 0 ⎤   ⎡ −1 ⎤
        b = J a* + bias = ⎢  0 ⎥ + ⎢ 0 ⎥ = ⎢  0 ⎥   m/s²
                          ⎣  0 ⎦   ⎣ 0 ⎦   ⎣  0 ⎦

    The answer
      Forces, x and w, row by row
        row                        x          w = A x + b   condition
        0 normal ground – bottom   x₀ = 3 N   w₀ = 0 m/s²   x₀ > 0, so w₀ = 0
        1 normal bottom – middle   x₁ = 2 N   w₁ = 0 m/s²   x₁ > 0, so w₁ = 0
        2 normal middle – top      x₂ = 1 N   w₂ = 0 m/s²   x₂ > 0, so w₂ = 0
    The judge sees A, b, the bounds and x, but not the solver. Its verdict is proved: x is an exact
    solution. The error of the worst row relative to the size of its terms, the scaled residual, is
    0.

    The new motion
                            ⎡ −1 ⎤   ⎡ 1 ⎤   ⎡ 0 ⎤
        u' = a* + M⁻¹Jᵀ x = ⎢ −1 ⎥ + ⎢ 1 ⎥ = ⎢ 0 ⎥   m/s²
                            ⎣ −1 ⎦   ⎣ 1 ⎦   ⎣ 0 ⎦
                    ⎡ 0 ⎤         ⎡ 0 ⎤   ⎡ 0 ⎤
        u + dt u' = ⎢ 0 ⎥ + 1 s · ⎢ 0 ⎥ = ⎢ 0 ⎥   m/s
                    ⎣ 0 ⎦         ⎣ 0 ⎦   ⎣ 0 ⎦
    ");
}

#[test]
fn the_residual_of_figure_7_falls_by_three_quarters_a_sweep() {
    // cos²(π/2n) for a column of n = 3 bodies
    let text = sections(&explained("fig7", Scheme::Velocity, "pgs"), &["row by row"]);
    let factors: Vec<&str> =
        text.lines().filter(|line| line.contains("   0.75")).map(str::trim).collect();
    assert_eq!(factors.len(), 8, "{text}");
}

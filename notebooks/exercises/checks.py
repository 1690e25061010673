"""What a right answer to each exercise has to obey: a closed form, a law, or an independent method.

A check calls the student's function with several inputs. It names the input on which the function fails and the law
that is broken there.
"""

import numpy as np
from checking import Wrong, number, numbers, parts, require, show, truth_value, whole

G = 9.81  # m/s²
INFINITY = np.inf
# Three balls in a line; a plank, whose ends lift each other; two contacts that do not feel each other.
BALLS, PLANK, APART = ([[2.0, -1], [-1, 2]], [[2.0, 1], [1, 2]], [[2.0, 0], [0, 1]])
COLUMN = [[2.0, -1, 0], [-1, 2, -1], [0, -1, 2]]


def satisfies(A, b, x, at, tolerance=1e-9):
    """Requires x >= 0, w >= 0 and x w = 0."""
    w = np.array(A) @ x + b
    for i in range(len(b)):
        require(x[i] >= -tolerance, f"{at}: contact {i} pulls, x = {show(x)}")
        require(w[i] >= -tolerance, f"{at}: contact {i} still closes at {-w[i]:.4g} m/s, x = {show(x)}")
        one_is_zero = x[i] <= tolerance or w[i] <= tolerance
        require(one_is_zero, f"{at}: contact {i} opens at {w[i]:.4g} m/s, yet it pushes, x = {show(x)}")


def e01_1_hand(answer):
    thrown = [0.0, 40, 40, 0, 0, 0, 0, 0, 0, 0, -5, 0]
    caught = [12.0, 12, 0, 7, -3, 0, 0, 0, 0]
    heavy = [500.0, 980, 1200, 0, 0, 0]
    for m, dt, pull in [
        (2.0, 0.01, [0.0, -30, 10, 0]),
        (2.0, 0.01, thrown),
        (0.8, 0.05, caught),
        (100.0, 0.1, heavy),
    ]:
        got = numbers(answer(m, list(pull), dt), (len(pull),), f"{len(pull)} impulses, one for each step")
        z, v = 0.0, 0.0
        for k, (x, force) in enumerate(zip(got, pull)):
            after = v + dt * (force / m - G) + x / m
            at = (
                f"m = {m:g} kg, dt = {dt} s, pull = {show(pull)} N: before step {k} the box is at z = {z:.6f} m with "
                f"v = {v:.4f} m/s; with x = {x:.6f} N s it then moves at {after:.4f} m/s"
            )
            require(x >= 0, f"{at}, but the ground cannot pull")
            require(z < 1e-9 or x == 0, f"{at}, but the ground does not touch the box")
            require(z >= 1e-9 or after >= -1e-9, f"{at}, into the ground")
            require(x <= 1e-9 or after <= 1e-9, f"{at}: it leaves, yet the ground pushes")
            v = after
            z += dt * v


def e01_2_one_row(answer):
    for a, b, lo, hi in [
        (2.0, -3.0, 0.0, INFINITY),
        (0.5, 1.0, 0.0, INFINITY),
        (4.0, -12.0, -1.0, 2.0),
        (3.0, 6.0, -1.0, 2.0),
        (3.0, 1.5, -1.0, 2.0),
        (4.0, 2.0, -INFINITY, INFINITY),
        (4.0, -2.0, -INFINITY, 0.25),
        (1.0, 0.0, 0.0, 2.0),
        (1.0, -5.0, 6.0, 8.0),
    ]:
        x = number(answer(a, b, lo, hi), "one number")
        w = a * x + b
        at = f"a = {a}, b = {b}, bounds [{lo}, {hi}]: x = {show(x)} gives w = {show(w)}"
        require(lo <= x <= hi, f"{at}, and x lies outside its bounds")
        require(w <= 1e-12 or x == lo, f"{at}, and w > 0 is allowed at the lower bound only")
        require(w >= -1e-12 or x == hi, f"{at}, and w < 0 is allowed at the upper bound only")


def e01_3_two_rows(answer):
    problems = [
        (APART, [-1, -1]),
        (APART, [-1, 1]),
        (BALLS, [-1, 2]),
        (BALLS, [2, -1]),
        (BALLS, [-1, -1]),
        (BALLS, [1, 3]),
        (BALLS, [-4, 1]),
        (BALLS, [-1, 1]),
        (BALLS, [0.5, -3]),
        (PLANK, [0.5, 0.25]),
        (PLANK, [0.25, 2]),
        (PLANK, [-4, -1]),
        (PLANK, [-1, -6]),
        (PLANK, [-3, -3]),
        ([[1.0, -1], [-1, 3]], [-2, 1]),
        ([[5.0, 2], [2, 1]], [0, 0]),
    ]
    for A, b in problems:
        A, b = np.array(A), np.array(b, dtype=float)
        x = numbers(answer(A.copy(), b.copy()), (2,), "x, two impulses")
        satisfies(A, b, x, f"A = {show(A)}, b = {show(b)}", 1e-11)


e01_b_two_contacts = e01_3_two_rows


def e02_1_rod(answer):
    for p, v in [([3, 4, 0], [2, -1, 0]), ([0, 0, -1], [1.5, 0, 0]), ([1, -2, 2], [0.3, 0.7, -1.1])]:
        p, v = np.array(p, dtype=float), np.array(v, dtype=float)
        J, product = parts(answer(p.copy(), v.copy()), 2, "J and J'u")
        J, product = numbers(J, (3,), "J, three numbers"), number(product, "J'u, one number")
        for k, axis in enumerate(np.eye(3)):
            slope = (np.linalg.norm(p + 1e-5 * axis) - np.linalg.norm(p - 1e-5 * axis)) / 2e-5
            at = f"bob at {show(p)}: J[{k}] = {show(J[k])}"
            require(
                abs(J[k] - slope) < 1e-6,
                f"{at}, but moving the bob along axis {k} changes its distance by another amount per meter",
            )
        before, now, after = (np.linalg.norm(p + t * v) for t in (-1e-4, 0, 1e-4))
        require(
            abs(product - (after - 2 * now + before) / 1e-8) < 1e-5,
            f"bob at {show(p)}, velocity {show(v)}: J'u = {show(product)}, but the distance of a bob that flies straight "
            "on is bent otherwise",
        )


AXES = ["v_x", "v_y", "v_z", "ω_x", "ω_y", "ω_z"]


def moved(k, arm):
    """The velocity of the point at the arm of a body that moves at 1 along, or about, one axis alone."""
    axis = np.eye(3)[k % 3]
    return axis if k < 3 else np.cross(axis, arm)


def e02_2_nail(answer):
    for r in [1, 0, 0], [0.3, -0.7, 0.2], [-1.5, 0.4, 2]:
        r = np.array(r, dtype=float)
        J = numbers(answer(r.copy()), (3, 6), "J, three rows of six numbers")
        for k, name in enumerate(AXES):
            right = abs(J[:, k] - moved(k, r)).max() < 1e-12
            at = f"arm r = {show(r)}: if the body has {name} = 1 alone, the point"
            require(right, f"{at} does not move at {show(J[:, k])}")


def rows_of_two(J, opens, at):
    """Requires that each entry of a row is how fast the gap opens if one body moves along one axis alone."""
    for k in range(12):
        body, name = k // 6, AXES[k % 6]
        motion = f"if body {body} has {name} = 1 and nothing else moves"
        right = abs(J[k] - opens(body, k % 6)) < 1e-9
        require(right, f"{at}: {motion}, c does not grow at J[{k}] = {show(J[k])} m/s")


def e02_3_two_ends(answer):
    for p, r in [
        ([[0, 0, 0], [3, 0, 4]], np.zeros((2, 3))),
        ([[0, 0, 0], [2, 0, 0]], [[0.5, 0.3, 0], [-0.5, 1.1, 0]]),
        ([[0.2, -0.1, 0.4], [1.1, 1.9, -0.3]], [[0.5, 0.1, -0.2], [-0.3, 0.4, 0.6]]),
    ]:
        p, r = np.array(p, dtype=float), np.array(r, dtype=float)
        J = numbers(answer(p.copy(), r.copy()), (12,), "J, twelve numbers")
        apart = p[1] + r[1] - p[0] - r[0]
        # The rate of |d| is d · ḋ / |d|.
        rate = lambda body, k: (1 if body else -1) * apart @ moved(k, r[body]) / np.sqrt(apart @ apart)
        rows_of_two(J, rate, f"centers {show(p)}, arms {show(r)}")


def e02_b_contact(answer):
    for centers, point, normal in [
        ([[0, 0, 0], [0, 0, 2]], [0, 0, 1], [0, 0, 1]),
        ([[0, 0, -1], [0.5, 0, 1]], [0, 0, 0], [0, 0, 3]),
        ([[0.4, -0.2, 0.1], [1.3, 0.9, 1.5]], [1, 0.2, 0.7], [1, 2, 2]),
    ]:
        centers, point, normal = (np.array(value, dtype=float) for value in (centers, point, normal))
        J = numbers(answer(centers.copy(), point.copy(), normal.copy()), (12,), "J, twelve numbers")
        n = normal / np.sqrt(normal @ normal)
        opens = lambda body, k: (1 if body else -1) * n @ moved(k, point - centers[body])
        rows_of_two(J, opens, f"centers {show(centers)}, touching at {show(point)}, normal {show(normal)}")


def e03_1_column(answer):
    for m, u in [
        ([1, 1, 1], [-1, -2, -1]),
        ([3, 0.5, 2], [-0.25, -0.25, -0.25]),
        ([1, 1, 1], [0, 1, 0]),
        ([1, 1], [-2, 3]),
        ([1, 1], [3, -1]),
        ([1, 1, 1], [1, 2, -4]),
        ([2, 1, 4], [2, 1, -1]),
        ([1, 2, 1, 5, 0.5], [3, 1, 2, 0.5, 5]),
        ([1, 1, 3, 1, 1], [-5, 2, 1, -0.5, 4]),
        ([2], [1.5]),
    ]:
        m, u, n = np.array(m, dtype=float), np.array(u, dtype=float), len(m)
        x = numbers(answer(m.copy(), u.copy()), (n,), f"{n} impulses, one for each contact")
        J = np.eye(n) - np.eye(n, k=-1)
        satisfies(J @ np.diag(1 / m) @ J.T, J @ u, x, f"masses {show(m)}, u* = {show(u)}")


def e03_2_delassus(answer):
    stack, other = np.array([[1.0, 0, 0], [-1, 1, 0], [0, -1, 1]]), np.array([[1.0, -1, 0], [0, 1, -1], [1, 0, 2]])
    for J, inverse_mass in [(stack, [1, 1, 1]), (stack, [1, 0.5, 0.1]), (other, [2, 0, 0.25])]:
        inverse_mass = np.array(inverse_mass, dtype=float)
        A = numbers(answer(J.copy(), inverse_mass.copy()), (3, 3), "A, three rows of three numbers")
        for k in range(3):
            opens = J @ (inverse_mass * J[k])  # the velocities after 1 N s in row k
            for i in range(3):
                require(
                    abs(A[i, k] - opens[i]) < 1e-12,
                    f"J = {show(J)}, inverse masses {show(inverse_mass)}: 1 N s in row {k} does not open gap {i} at "
                    f"A[{i}, {k}] = {show(A[i, k])} m/s",
                )


def e03_3_two_levels(answer):
    for m, l, phi, omega, dt in [
        (1.0, 1.0, 0.7, 1.3, 0.01),
        (2.0, 0.5, -1.0, 3.0, 0.02),
        (1.0, 1.0, 0.0, 0.0, 0.1),
    ]:
        x, force = parts(answer(m, l, G, phi, omega, dt), 2, "the impulse and the force")
        x, force = number(x, "the impulse, one number"), number(force, "the force, one number")
        place = f"m = {m} kg, l = {l} m, φ = {phi}, ω = {omega} rad/s, dt = {dt} s"
        n = np.array([np.sin(phi), -np.cos(phi)])
        v = l * omega * np.array([np.cos(phi), np.sin(phi)])
        along = n @ (v + dt * np.array([0, -G]) + n * x / m)
        require(
            abs(along) < 1e-9,
            f"{place}: with the impulse {show(x)} N s the bob moves along n at {along:.4g} m/s after the step, which the "
            "velocity level does not allow",
        )
        # On a circle the acceleration along n is v²/l, towards the pivot.
        bent = n @ (np.array([0, -G]) + n * force / m)
        right = abs(bent + v @ v / l) < 1e-9
        require(right, f"{place}: with the force {show(force)} N the bob's path is not bent into the circle")


def e03_b_step(answer):
    for name, inverse_mass, u, force, dt in [
        ("a book on a table, dt = 1 s", [0.0, 1], [0, 0], [0, -9.81], 1.0),
        ("two balls meet", [1, 0.5], [1, -1], [0, 0], 0.01),
        ("two balls fall, the upper one flies off", [1, 1], [0, 1], [-9.81, -9.81], 0.01),
        ("a book on a table, dt = 0.01 s", [0.0, 1], [0, 0], [0, -9.81], 0.01),
        ("a book that is lifted", [0.0, 2], [0, 0.1], [0, 20], 0.01),
        ("a press", [0.25, 2], [0, 0], [30, -50], 0.02),
    ]:
        inverse_mass, u, force = (np.array(value, dtype=float) for value in (inverse_mass, u, force))
        after = answer(inverse_mass.copy(), u.copy(), force.copy(), dt)
        after = numbers(after, (2,), "two velocities")
        free = u + dt * inverse_mass * force
        change = after - free
        at = f"{name}: without contact the velocities would be {show(free)} m/s, the program says {show(after)}"
        given = inverse_mass[1] * change[0] + inverse_mass[0] * change[1]
        require(abs(given) < 1e-12, f"{at}: the impulses on the two bodies are not equal and opposite")
        w, push = after[1] - after[0], change[1] - change[0]
        require(push >= -1e-12, f"{at}: the contact pulls the bodies together")
        require(w >= -1e-12, f"{at}: the contact still closes at {-w:.4g} m/s")
        require(push <= 1e-12 or w <= 1e-12, f"{at}: the contact pushes, and the bodies part at {w:.4g} m/s")


def at_its_turn(A, b, lo, hi, x, i, at):
    """Requires that row i alone is satisfied: x holds the new impulses up to row i, and the old ones after it."""
    w = A[i] @ x + b[i]
    at = f"{at}: when row {i} is done, x = {show(x)} and w[{i}] = {show(w)}"
    require(lo[i] <= x[i] <= hi[i], f"{at}, and x[{i}] lies outside [{lo[i]:g}, {hi[i]:g}]")
    fits = abs(w) < 1e-9 or (w > 0 and x[i] == lo[i]) or (w < 0 and x[i] == hi[i])
    require(fits, f"{at}, so this row alone is not satisfied")


def e04_1_sweep(answer):
    A, lo, hi = np.array([[2.0, -1, 0], [-1, 4, 1], [0, 1, 3]]), np.array([0.0, -1, 0]), np.array([INFINITY, 1, 2])
    for b, old in [
        ([-1, -1, 2], [0, 0, 0]),
        ([3, -2, -1], [1, 0.5, 2]),
        ([-4, -9, -20], [0, 0, 0]),
        ([-1, 8, -1], [0.5, 1, 0]),
        ([-1, 2, -1], [0.5, 0.5, 0]),
    ]:
        b, old = np.array(b, dtype=float), np.array(old, dtype=float)
        new = answer(A.copy(), b.copy(), lo.copy(), hi.copy(), old.copy())
        new = numbers(new, (3,), "x after the sweep, three numbers")
        for i in range(3):
            at_its_turn(
                A, b, lo, hi, np.append(new[: i + 1], old[i + 1 :]), i, f"b = {show(b)}, from x = {show(old)}"
            )


def e04_2_impulse(answer):
    for v, inverse_mass, total in [
        (-2.0, 0.5, 0.0),
        (-2.0, 0.5, 3.0),
        (1.0, 0.5, 3.0),
        (4.0, 0.5, 3.0),
        (1.0, 2.0, 0.0),
    ]:
        after, new = parts(answer(v, inverse_mass, total), 2, "the velocity and the total impulse")
        after, new = number(after, "the velocity, one number"), number(new, "the total impulse, one number")
        at = f"v = {v} m/s, 1/m = {inverse_mass}, {total} N s so far: now v = {show(after)} m/s, {show(new)} N s in all"
        fits = abs(after - v - inverse_mass * (new - total)) < 1e-12
        require(fits, f"{at}: the change of the velocity does not belong to the change of the impulse")
        require(new >= 0, f"{at}: all in all the contact has pulled")
        require(after >= -1e-12, f"{at}: the body still closes in")
        require(new <= 1e-12 or after <= 1e-12, f"{at}: the body leaves, yet the contact keeps what it has pushed")


def e04_b_projected(answer):
    three = [[3.0, 1, 2], [1, 4, 3], [2, 3, 3]]
    for name, A, b in [
        ("a column, all contacts push", COLUMN, [-1, -1, -1]),
        ("three balls, the first is hit", BALLS, [-1, 2]),
        ("three balls, the middle one moves", BALLS, [1, -1]),
        ("a plank on two supports", PLANK, [-4, -5]),
        ("a plank, one end leaves", PLANK, [1, -2]),
        ("a plank, one end is lifted", PLANK, [-1, -6]),
        ("one body, three contacts", three, [0, 0, -1]),
    ]:
        A, b = np.array(A), np.array(b, dtype=float)
        x = numbers(answer(A.copy(), b.copy(), 200), (len(b),), f"x, {len(b)} impulses")
        at = f"{name}, A = {show(A)}, b = {show(b)}, 200 sweeps"
        require(abs(x).max() < 100, f"{at}: x = {show(x)}, but no impulse of the answer is larger than 5 N s")
        satisfies(A, b, x, at)


def swept_column(n, sweeps):
    """A column of equal bodies, m g dt = 1 N s, after some sweeps from 0, ground first."""
    x = np.zeros(n + 1)
    for _ in range(sweeps):
        for i in range(n):
            x[i] = (x[i - 1] + x[i + 1]) / 2 if i else x[1] + 1
    return x[:n]


def e05_1_extrapolate(answer):
    def run(sweeps):
        found = answer([sweep.copy() for sweep in sweeps])
        try:
            return numbers(found, sweeps[0].shape, "x, one impulse for each row")
        except Wrong as wrong:
            still = np.flatnonzero(sweeps[0] == sweeps[2])
            why = f"; x[{still[0]}] has not changed in these sweeps" if len(still) else ""
            raise Wrong(f"sweeps {show(sweeps)}: {wrong}{why}") from None

    for end, error, rho in [
        ([4, 3, 1], [-1, -1.5, -0.5], 0.75),
        ([0.5, 0], [0.25, 0.125], 0.25),
        ([2, 1], [1, -0.5], -0.5),
        ([3, 7, 2], [-2, 0, 1], 0.9),
        ([1, 5], [0, 0], 0.5),
    ]:
        end, error = np.array(end, dtype=float), np.array(error, dtype=float)
        sweeps = [end + error * rho**k for k in range(3)]
        off = abs(run(sweeps) - end).max()
        at = f"sweeps {show(sweeps)}, whose errors shrink by {rho} a sweep"
        require(off < 1e-9, f"{at}: the answer is {off:.4g} N s away from where they end")
    for n, first in [(3, 3), (5, 8), (10, 40)]:
        end, sweeps = np.arange(n, 0, -1.0), [swept_column(n, first + k) for k in range(3)]
        off, before = abs(run(sweeps) - end).max(), abs(sweeps[2] - end).max()
        at = f"a column of {n} bodies, sweeps {first} to {first + 2}: the last one is {before:.4g} N s away from the end"
        require(off < 0.1 * before, f"{at}, the answer {off:.4g}; it should be ten times nearer")
    sweeps = [np.array(sweep) for sweep in ([3, 0.02], [2.1, 0.01], [1.29, 0.005])]
    x = run(sweeps)
    require((x >= 0).all(), f"sweeps {show(sweeps)}: x = {show(x)}, and a contact pulls")


def e06_1_active_set(answer):
    for A, b in [(BALLS, [-1, 2]), (PLANK, [-5, -6]), ([[4.0, 1], [1, 1]], [3, -1])]:
        A, b = np.array(A), np.array(b, dtype=float)
        for free in [False, False], [True, False], [False, True], [True, True]:
            x = numbers(answer(A.copy(), b.copy(), np.array(free)), (2,), "x, two numbers")
            w = A @ x + b
            for i in range(2):
                at = f"A = {show(A)}, b = {show(b)}, free = {free}: x = {show(x)}, w[{i}] = {show(w[i])}"
                require(not free[i] or abs(w[i]) < 1e-9, f"{at}, but row {i} is free")
                require(free[i] or x[i] == 0, f"{at}, but row {i} is not free")


def e06_b_dantzig_step(answer):
    for x, w, dx, dw in [
        ([0], [-1], [1], [1]),
        ([0], [-1], [1], [2]),
        ([1, 0], [0, -2], [0, 1], [0, 1]),
        ([0.25, 0], [0, -2.75], [-0.5, 1], [0, 1.5]),
        ([1, 0], [0, -2], [1, 1], [0, 1]),
        ([3, 2, 0], [0, 0, -1], [1, 1, 1], [0, 0, 1]),
        ([0.5, 0, 0], [0, 3, -4], [0.5, 0, 1], [0, -2, 1.5]),
        ([2, 0, 0.5, 0], [0, 1, 0, -6], [-1, 0, 0.25, 1], [0, 0.5, 0, 2]),
        ([2, 0, 0.5, 0], [0, 1, 0, -6], [-1, 0, -0.125, 1], [0, -4, 0, 1]),
    ]:
        x, w, dx, dw = (np.array(value, dtype=float) for value in (x, w, dx, dw))
        last = len(x) - 1
        length, row = parts(answer(x.copy(), w.copy(), dx.copy(), dw.copy()), 2, "the length and the row")
        length, row = number(length, "the length, one number"), whole(row, "the number of a row")
        at = (
            f"x = {show(x)}, w = {show(w)}, changing by dx = {show(dx)}, dw = {show(dw)} for each N s: the program "
            f"moves by {show(length)} N s, until row {row} stops it"
        )
        require(0 <= row <= last, f"{at}, but there is no such row")
        require(length > 0, f"{at}, but row {last} closes and has to push more, not less")
        at_x, at_w = x + length * dx, w + length * dw
        for r in range(last):
            require(at_x[r] >= -1e-12, f"{at}; then row {r} pulls with {-at_x[r]:.4g} N s")
            require(at_w[r] >= -1e-12, f"{at}; then row {r} closes at {-at_w[r]:.4g} m/s")
        require(at_w[last] <= 1e-12, f"{at}; then row {last} opens at {at_w[last]:.4g} m/s, yet it pushes")
        left = at_x[row] if row < last and x[row] > 0 else at_w[row]
        require(abs(left) < 1e-12, f"{at}, but this row does not stop it there: {left:.4g} is left")


def e07_1_murty(answer):
    for x, w in [
        ([0, 1, 0], [2, 0, -1]),
        ([0, -0.5, 0], [2, 0, -1]),
        ([3, 0, -9, 0], [0, -1, 0, -20]),
        ([1, 0], [0, 0]),
        ([0, 2, -1], [0, 0, 0]),
        ([-1, 0], [0, 3]),
        ([0], [0]),
    ]:
        x, w = np.array(x, dtype=float), np.array(w, dtype=float)
        wrong = np.flatnonzero((x < 0) | (w < 0))
        row, at = answer(x.copy(), w.copy()), f"x = {show(x)}, w = {show(w)}"
        if row is None:
            require(len(wrong) == 0, f"{at}: the program finds no wrong row, but there is one")
            continue
        row = whole(row, "the number of a row, or None")
        require(0 <= row < len(x), f"{at}: there is no row {row}")
        require(row in wrong, f"{at}: row {row} is not wrong")
        require(row == wrong[0], f"{at}: row {row} is wrong, but the rule takes another one")


def e07_2_ratio(answer):
    for constant, rate in [
        ([4, 3], [-1, -3]),
        ([1, 9, 2], [-0.5, -4, -0.25]),
        ([1, 6], [2, -1]),
        ([5, 1, 8], [-1, 0, -4]),
        ([1, 2], [0, 3]),
        ([9, 2, 4, 1], [-1, -1, -2, -0.5]),
        ([3, 0.5, 6], [-1, 1, -2]),
    ]:
        constant, rate = np.array(constant, dtype=float), np.array(rate, dtype=float)
        row, at = answer(constant.copy(), rate.copy()), f"constants {show(constant)}, rates {show(rate)}"
        if row is None:
            require((rate >= 0).all(), f"{at}: this is no ray, some variable becomes 0")
            continue
        row = whole(row, "the number of a row, or None")
        require(0 <= row < len(rate), f"{at}: there is no row {row}")
        require(rate[row] < 0, f"{at}: variable {row} never falls to 0")
        t = -constant[row] / rate[row]
        below = np.flatnonzero(constant + rate * t < -1e-12)
        require(len(below) == 0, f"{at}: when variable {row} becomes 0, another one is negative already")
        earlier = [r for r in range(row) if rate[r] < 0 and -constant[r] / rate[r] == t]
        require(not earlier, f"{at}: row {row} is one of several that become 0 together, and not the first of them")


def e08_1_scaled(answer):
    chain, apart = [[2.0, -1, 0], [-1, 5, 3], [0, 3, 4]], [[0.5, 0], [0, 2]]
    contacts, both = ([0, 0], [INFINITY, INFINITY]), ([-2, -2], [2, 2])
    mixed = ([0, -INFINITY, -0.5], [INFINITY, INFINITY, 0.5])
    for A, b, (lo, hi), x in [
        (BALLS, [-1, 3], contacts, [0.5, 0]),
        (BALLS, [-1, 3], contacts, [0.501, 0]),
        (BALLS, [-1, 3], contacts, [0.5, 0.25]),
        (BALLS, [-9, 3], both, [2, -0.5]),
        (BALLS, [-9, 3], both, [1.5, -0.75]),
        (chain, [-4, 1, 2], mixed, [2, 0.125, -0.5]),
        (chain, [8, -1, -6], mixed, [0.25, 0.5, 0.75]),
        (apart, [0, -3], contacts, [0, 1]),
        (apart, [0, 0], contacts, [0, 0]),
        (BALLS, [-0.001, 0.003], contacts, [0.0006, 0]),
    ]:
        A, b, lo, hi, x = (np.array(value, dtype=float) for value in (A, b, lo, hi, x))
        at = f"A = {show(A)}, b = {show(b)}, bounds {show(lo)} to {show(hi)}, x = {show(x)}"
        got = number(answer(A.copy(), b.copy(), lo.copy(), hi.copy(), x.copy()), "one number")
        w, terms, a = A @ x + b, abs(A) @ abs(x) + abs(b), np.diag(A)
        # The step as a velocity is the middle one of these three.
        middle = abs(np.sort([a * (x - lo), w, a * (x - hi)], axis=0)[1])
        worst = max([m / t for m, t in zip(middle, terms) if t > 0], default=0.0)
        is_solution = f"{at}: the program says {show(got)}, but this x is a solution"
        require(worst > 0 or abs(got) < 1e-15, is_solution)
        require(worst == 0 or got != 0, f"{at}: the program says 0, but this x is no solution")
        unit = np.array([10.0, 0.1, 10.0])[: len(b)]  # impulses in other units, velocities in mm/s
        other = (1e3 * A * np.outer(unit, unit), 1e3 * unit * b, lo / unit, hi / unit, x / unit)
        again = number(answer(*other), "one number")
        same = abs(again - got) <= 1e-9 * abs(got) + 1e-12
        require(same, f"{at}: the program says {show(got)}, and {show(again)} for the same problem in other units")
        right = abs(got - worst) < 1e-12
        require(
            right,
            f"{at}: the program says {show(got)}, which is not the part of its velocities that the worst row misses",
        )


def e08_2_repair(answer):
    thirds = [[3.0, 1], [1, 3]]
    for A, b, x, why in [
        (thirds, [-1, 2], [0.334, 0.0001], None),
        (thirds, [-4, -4], [1.01, 0.98], None),
        (BALLS, [1, 3], [0.02, 0.001], None),
        (BALLS, [-1, 2], [0, 0], None),
        (BALLS, [-1, 2], [1, 1], None),
        (BALLS, [-4, 1], [2.4, 0.6], None),
        (PLANK, [-1, -6], [0, 2.9], None),
        ([[4.0, 1], [1, 2]], [-4, 1], [0.7, 0], None),
        (PLANK, [-4, -1], [0, 0], "contact 1 would pull"),
        (BALLS, [-4, 1], [0.2, 0], "contact 1 would close"),
    ]:
        A, b, x = np.array(A), np.array(b, dtype=float), np.array(x)
        free = np.diag(A) * x > A @ x + b
        at = f"A = {show(A)}, b = {show(b)}, x = {show(x)}, free rows {np.flatnonzero(free).tolist()}"
        got = answer(A.copy(), b.copy(), x.copy())
        if why:
            require(got is None, f"{at}: the program returned {show(got)}, but in this set {why}")
            continue
        require(got is not None, f"{at}: the signs of this set fit, but the program returned None")
        exact, distance = parts(got, 2, "the exact answer and the distance")
        exact, distance = numbers(exact, (2,), "the exact answer, two numbers"), number(distance, "one number")
        w = A @ exact + b
        for i in range(2):
            row = f"{at}: the answer {show(exact)} has w[{i}] = {show(w[i])}"
            require(free[i] or exact[i] == 0, f"{row}, but row {i} is not free")
            require(not free[i] or abs(w[i]) < 1e-12, f"{row}, but row {i} is free")
        off = abs(distance - abs(exact - x).max()) < 1e-12
        require(
            off, f"{at}: no entry moves by {show(distance)} from x to {show(exact)}, or another one moves farther"
        )


def e08_b_stop(answer):
    column = [[1.0, -1, 0], [-1, 2, -1], [0, -1, 2]]
    for name, A, b, tolerance in [
        ("three contacts, all push", column, [-1, 0, 0], 1e-6),
        ("two contacts, both push", BALLS, [-1, -1], 1e-10),
        ("two contacts, one opens", BALLS, [-1, 3], 1e-8),
        ("two contacts, both open", BALLS, [1, 2], 1e-8),
        ("a plank, one end opens", PLANK, [-4, -5], 1e-3),
        ("three balls, the last one hits", BALLS, [1, -4], 1e-4),
        ("a column, its top is thrown up", column, [-2, -1, 4], 1e-6),
    ]:
        A, b = np.array(A), np.array(b, dtype=float)
        residual = lambda x: abs(np.minimum(x, A @ x + b)).max()
        x, needed = np.zeros(len(b)), 0
        while residual(x) > tolerance:
            for i in range(len(b)):
                x[i] = max(0.0, x[i] - (A[i] @ x + b[i]) / A[i, i])
            needed += 1
        got, sweeps = parts(answer(A.copy(), b.copy(), tolerance), 2, "x and the number of sweeps")
        got, sweeps = numbers(got, (len(b),), f"x, {len(b)} impulses"), whole(sweeps, "the number of sweeps")
        at = f"{name}, A = {show(A)}, b = {show(b)}, tolerance {tolerance}: it stops after {sweeps} sweeps at {show(got)}"
        left = residual(got)
        require(left <= tolerance, f"{at}, where the natural residual is still {left:.4g}")
        require(sweeps <= max(needed, 1), f"{at}, and x was good enough before")
        require(sweeps >= needed, f"{at}, and so few sweeps cannot have led there")


def e09_1_farkas(answer):
    ring, skewed, one = [[1.0, -1], [-1, 1]], [[0.0, -1], [1, 0]], [[1.0, 0], [0, 1]]
    falls = [[-1.0, 0], [0, 1]]
    for A, b, d, truth, why in [
        (ring, [-1, -1], [1, 1], True, "dᵀw = −2 for every x"),
        (ring, [1, -2], [1, 1], True, "dᵀw = −1 for every x"),
        (ring, [2, -1], [1, 1], False, "x = (0, 1) solves the problem"),
        (ring, [1, -1], [1, 1], False, "x = (0, 1) solves the problem"),
        (ring, [-1, 1], [-1, -2], False, "x = (1, 0) solves the problem"),
        (one, [-1, -1], [1, 1], False, "x = (1, 1) solves the problem"),
        (one, [1, 1], [-1, -1], False, "x = (0, 0) solves the problem"),
        (falls, [-1, -1], [1, 0], True, "w₀ = −x₀ − 1 for every x"),
        (skewed, [-1, 2], [1, 0], True, "w₀ = −x₁ − 1 for every x"),
        (skewed, [1, -1], [0, 1], False, "x = (1, 1) solves the problem"),
        (falls, [1, -1], [2, 1], False, "x = (1, 1) solves the problem"),
    ]:
        A, b, d = np.array(A), np.array(b, dtype=float), np.array(d, dtype=float)
        got = truth_value(answer(A.copy(), b.copy(), d.copy()))
        require(got == truth, f"A = {show(A)}, b = {show(b)}, d = {show(d)}: the program says {got}, but {why}")


def e10_1_tangent(answer):
    for l, v, dt in [(1.0, 3.0, 1.0), (2.0, 4.4, 1 / 60), (0.5, -1.0, 0.1), (1.0, 0.0, 1.0), (5.0, 12.0, 1.0)]:
        grown = number(answer(l, v, dt), "one number")
        right = abs((l + grown) ** 2 - l**2 - (v * dt) ** 2) < 1e-10 and grown >= -1e-12
        at = f"l = {l} m, v = {v} m/s, dt = {dt:.4g} s"
        require(right, f"{at}: the end of the tangent is not {show(grown)} m farther out")


def e10_2_bias(answer):
    for c, dt, beta, slop in [
        (0.02, 0.01, 0.2, 0.005),
        (0.3, 1 / 60, 0.5, 0.0),
        (0.0, 0.01, 0.2, 0.005),
        (-0.004, 0.01, 0.2, 0.005),
        (-0.1, 0.02, 0.2, 0.0),
        (-0.1, 0.02, 0.4, 0.01),
    ]:
        after = c - dt * number(answer(c, dt, beta, slop), "one number")  # w = 0: ċ = −bias
        beyond = lambda gap: -min(gap + slop, 0.0)
        at = f"gap {c} m, dt = {dt:.4g} s, β = {beta}, slop = {slop} m"
        if c > 0:
            touches = abs(after) < 1e-12
            require(
                touches, f"{at}: closing as fast as they may, the bodies are {show(after)} m apart after the step"
            )
        elif beyond(c) == 0:
            require(abs(after - c) < 1e-15, f"{at}: an overlap within the slop becomes {show(-after)} m")
        else:
            left = beyond(after) / beyond(c)
            right = abs(left - (1 - beta)) < 1e-9
            part = f"the part {show(left)} of the overlap beyond the slop is left, not 1 − β = {show(1 - beta)}"
            require(right, f"{at}: after the step {part}")


def e10_3_spring(answer):
    for k, d, dt in [(400.0, 20.0, 0.01), (50.0, 0.0, 0.1), (0.0, 3.0, 0.5), (1e4, 1.0, 1 / 60)]:
        gamma, beta = parts(answer(k, d, dt), 2, "γ and β")
        gamma, beta = number(gamma, "γ, one number"), number(beta, "β, one number")
        for m, c, v in [(1.0, 0.1, 0.0), (100.0, -0.2, 1.5)]:
            x = -(v + beta / dt * c) / (1 / m + gamma)
            after = v + x / m
            spring = -dt * (k * (c + dt * after) + d * after)
            require(
                abs(x - spring) < 1e-9 * (1 + abs(spring)),
                f"k = {k:g} N/m, d = {d:g} N s/m, dt = {dt:.4g} s, a mass of {m:g} kg: the row gives {show(x)} N s, at the "
                f"end of that step spring and damper would give {show(spring)} N s",
            )


def e10_b_feedback(answer):
    def length(start, l, g, beta, dt, steps):
        return np.linalg.norm(numbers(answer(start, l, g, beta, dt, steps), (2,), "the place, two numbers"))

    for l, beta, dt, steps in [
        (1.0, 0.5, 1.0, 3),
        (1.0, 0.2, 0.1, 10),
        (2.0, 0.2, 1 / 60, 10),
        (0.5, 1.0, 0.01, 1),
    ]:
        now = length([0.6 * (l + 0.1), -0.8 * (l + 0.1)], l, 0.0, beta, dt, steps) - l
        at = f"without gravity, l = {l} m, β = {beta}, dt = {dt:.4g} s: the rod starts 0.1 m too long"
        right = abs(now - 0.1 * (1 - beta) ** steps) < 1e-9
        require(
            right, f"{at} and is {now:.4g} m too long after {steps} steps, but β of the rest should go in each step"
        )
    for l, beta, dt in [(1.0, 0.2, 1 / 60), (1.0, 0.2, 0.005), (3.0, 0.5, 0.01)]:
        # It starts level, so that v² = 2 g l at the bottom, where v² dt²/(2 l β) is left.
        largest = G * dt**2 / beta
        worst = max(abs(length([l, 0.0], l, G, beta, dt, steps) - l) for steps in range(7, int(2 / dt), 7))
        at = f"a pendulum released level, l = {l} m, β = {beta}, dt = {dt:.4g} s: the rod gets {worst:.4g} m too long"
        require(worst < 1.5 * largest, f"{at}, but feedback should leave less than {1.5 * largest:.2g} m")


SIZES = {
    "square": (lambda p: abs(p).max(), lambda p: abs(p).sum()),
    "disc": (np.linalg.norm, np.linalg.norm),
    "diamond": (lambda p: abs(p).sum(), lambda p: abs(p).max()),
}


def e11_1_nearest(answer):
    for wanted, limit in [
        ([0.3, -0.2], 1.0),
        ([3 * np.cos(np.pi / 6), 1.5], 1.0),
        ([0.9, -0.6], 1.0),
        ([-0.2, 4.0], 0.5),
        ([-1.5, -1.25], 2.0),
        ([0.75, 0.75], 1.0),
        ([0.0, -7.0], 3.0),
        ([0.0, 0.0], 0.0),
        ([-2.0, 1.0], 0.0),
    ]:
        wanted = np.array(wanted)
        points = parts(answer(wanted.copy(), limit), 3, "three points: of the square, the disc and the diamond")
        for (name, (size, dual)), point in zip(SIZES.items(), points):
            point = numbers(point, (2,), f"a point of the {name}, two numbers")
            at = f"wanted {show(wanted)}, limit {limit}: for the {name} the program says {show(point)}"
            require(size(point) <= limit + 1e-12, f"{at}, which lies outside of it")
            # No point of the figure lies farther than the nearest one in the direction towards `wanted`.
            away = wanted - point
            require(limit * dual(away) <= away @ point + 1e-12, f"{at}, and another point of it is nearer")


def e11_2_cone(answer):
    for p, mu in [
        ([2.0, 0.3, -0.4], 0.5),
        ([1.0, 3.0, 4.0], 0.5),
        ([-1.0, 0.6, 0.8], 0.7),
        ([-1.0, 3.0, 0.0], 0.7),
        ([0.0, -1.0, 2.0], 1.0),
        ([-2.0, 0.0, 0.0], 0.3),
        ([0.5, -0.2, 0.0], 2.0),
        ([-3.0, 1.0, 1.0], 2.5),
    ]:
        p = np.array(p)
        x = numbers(answer(p.copy(), mu), (3,), "a point, three numbers")
        at = f"p = {show(p)}, μ = {mu}: the program says {show(x)}"
        require(np.hypot(*x[1:]) <= mu * x[0] + 1e-12, f"{at}, which lies outside of the cone")
        # The way from the nearest point to p is at a right angle to it, and leads out of the cone.
        way = x - p
        nearest = abs(x @ way) < 1e-9 and mu * np.hypot(*way[1:]) <= way[0] + 1e-9
        require(nearest, f"{at}, {np.linalg.norm(way):.4g} away, and another point of the cone is nearer")


def e11_3_uphill(answer):
    for degrees, mu, v0 in [(20, 0.2, 2.0), (20, 0.6, 2.0), (35, 0.1, 0.0), (30, 0.0, 1.0), (10, 0.0, 0.0)]:
        theta, dt, v = np.radians(degrees), 1e-3, v0
        for k in range(800):
            if k % 20 == 0:
                got = number(answer(theta, mu, v0, k * dt), "one velocity")
                state = "moves uphill" if v > 0 else "slides back" if v < 0 else "rests"
                at = f"θ = {degrees}°, μ = {mu}, v0 = {v0} m/s, t = {k * dt:.2f} s"
                right = abs(got - v) < 0.02
                require(
                    right,
                    f"{at}: the program says {show(got)} m/s, small steps say otherwise; the block {state} then",
                )
            free, limit = v - dt * G * np.sin(theta), dt * mu * G * np.cos(theta)
            v = free + min(max(-free, -limit), limit)


def e11_b_pressed(answer):
    steady = [(0, 0), (0, 0), (4, 0), (4, 0)]
    slides = [(0, 0), (30, 0), (30, 0), (0, 0), (0, 0), (0, 0)]
    held = [(0, 0), (25, 60), (25, 60), (25, 0), (25, 0), (0, 80), (0, 80)]
    first, back = [(3, 0), (-3, 0)], [(-30, 0), (-30, 0), (30, 0), (5, 5)]
    for m, mu, forces in [
        (1.0, 0.5, steady),
        (2.0, 0.5, slides),
        (2.0, 0.4, held),
        (1.0, 0.5, first),
        (1.0, 0.5, back),
    ]:
        dt, before = 0.01, 0.0
        got = numbers(answer(m, mu, dt, list(forces)), (len(forces),), f"{len(forces)} speeds, one for each step")
        for k, (v, (push, press)) in enumerate(zip(got, forces)):
            friction, limit = m * (v - before) - dt * push, mu * dt * (m * G + press)
            at = (
                f"m = {m:g} kg, μ = {mu}, [push, press] = {show(forces)} N: in step {k} the speed goes from {before:.4f} "
                f"to {v:.4f} m/s, so friction gives {friction:.4f} N s"
            )
            require(abs(friction) <= limit + 1e-12, f"{at}, more than it can with this load")
            against = abs(v) <= 1e-12 or friction * np.sign(v) <= -limit + 1e-12
            require(against, f"{at}; the block slides, and with this load friction gives more against it")
            before = v


def e12_1_two_balls(answer):
    for m, v, e in [
        ((1.0, 1.0), (1.0, 0.0), 1.0),
        ((2.0, 3.0), (4.0, -1.0), 0.5),
        ((5.0, 0.5), (1.0, 0.0), 0.0),
        ((1.0, 2.0), (-1.0, 1.0), 0.8),
        ((1.0, 1e6), (3.0, 0.0), 1.0),
        ((2.0, 1.0), (1.0, 1.0), 0.5),
    ]:
        after = numbers(answer(m, v, e), (2,), "two velocities")
        at = f"masses {show(m)} kg, velocities {show(v)} m/s, e = {e}: the program says {show(after)}"
        size = np.dot(m, np.abs(v))
        require(abs(np.dot(m, after) - np.dot(m, v)) <= 1e-9 * size, f"{at}, and the momentum has changed")
        closing, parting = v[0] - v[1], after[1] - after[0]
        if closing <= 0:
            require(abs(after - v).max() < 1e-12, f"{at}, but these balls do not approach")
        else:
            right = abs(parting - e * closing) <= 1e-9 * closing
            require(right, f"{at}: they approach with {closing:g} m/s and part with {show(parting)} m/s")


def e12_b_bounce(answer):
    for height, e, dt, steps in [
        (0.0, 0.5, 0.01, 3),
        (1.0, 1.0, 0.01, 150),
        (1.0, 0.5, 0.01, 300),
        (0.3, 0.8, 0.02, 100),
        (2.0, 0.0, 0.03, 40),
    ]:
        states = numbers(answer(height, e, dt, steps), (steps, 2), f"{steps} pairs [height, velocity]")
        z, v = height, 0.0
        for k, (now, after) in enumerate(states):
            free = v - G * dt
            at = (
                f"from {height} m, e = {e}, dt = {dt} s: in step {k} the ball comes from z = {z:.4f} m with {v:.4f} m/s "
                f"and has {after:.4f} m/s after it, at z = {now:.4f} m"
            )
            require(abs(now - z - dt * after) < 1e-9, f"{at}, where this velocity does not lead")
            require(now >= -1e-9, f"{at}, in the ground")
            require(after >= free - 1e-9, f"{at}, so the ground has pulled")
            if after > free + 1e-9:
                require(z + dt * free <= 1e-9, f"{at}; the ground is out of reach, yet it has pushed")
                right = abs(after - e * max(0.0, -v)) < 1e-9
                require(right, f"{at}; it has hit the ground, and does not leave it with e times its speed")
            z, v = now, after


def e13_1_all_answers(answer):
    for a, b in [(2.0, -3.0), (2.0, 3.0), (-0.8, 0.5), (-0.8, -0.5), (-4.0, 1.0), (0.5, -0.1)]:
        count = 1 if a > 0 else 2 if b > 0 else 0
        got = answer(a, b)
        values = np.array([number(x, "a list of numbers") for x in parts(got, None, "a list of numbers")])
        for x in values:
            w = a * x + b
            at = f"a = {a}, b = {b}: x = {show(x)} gives w = {show(w)}"
            require(x >= 0 and w >= -1e-12, f"{at}, and neither may be negative")
            require(x <= 1e-12 or w <= 1e-12, f"{at}, and one of them must be 0")
        require(len(set(values.round(9))) == len(values), f"a = {a}, b = {b}: {show(values)} lists an answer twice")
        require(len(values) == count, f"a = {a}, b = {b}: {show(values)} are not all answers")


def e13_2_critical_friction(answer):
    for k in 1 / 3, 1.0:
        for degrees in 20.0, 45.0, 63.435, 80.0:
            theta = np.radians(degrees)
            mu = number(answer(theta, k), "one number")
            J_n, J_t = np.array([0, 1, -np.cos(theta)]), np.array([1, 0, np.sin(theta)])
            a = lambda mu: J_n @ np.diag([1, 1, 1 / k]) @ (J_n + mu * J_t)
            right = a(0.999 * mu) > 0 > a(1.001 * mu)
            require(right, f"θ = {degrees}°, k = {k:.3g}: a does not change its sign at μ = {show(mu)}")


def e14_1_bodies(answer):
    column = [(None, 0), (0, 1), (1, 2)]
    mixed = [(2, 0), (1, None), (0, 1), (2, 0), (None, 2)]
    for rows, inverse_mass, b, old in [
        ([(None, 0)], [0.5], [-2], [0]),
        ([(0, 1)], [1, 0.25], [-2], [0]),
        (column, [1, 1, 1], [-1, -1, 1], [0, 0, 0]),
        (column, [1, 0.5, 0.01], [-1, -1, 1], [4, 3, 1]),
        (mixed, [1, 2, 4], [-1, 0.5, -3, 2, -1], [0, 0, 0, 0, 0]),
        (mixed, [1, 2, 0.5], [-1, 0.5, 3, -2, -1], [1, 0.5, 2, 0.25, 3]),
    ]:
        n, inverse_mass, b, old = len(rows), *(np.array(value, dtype=float) for value in (inverse_mass, b, old))
        new = answer(list(rows), inverse_mass.copy(), b.copy(), old.copy())
        new = numbers(new, (n,), f"x after the sweep, {n} numbers")
        J = np.zeros((n, len(inverse_mass)))
        for i, ends in enumerate(rows):
            for body, sign in zip(ends, (-1, 1)):
                if body is not None:
                    J[i, body] = sign
        A = J @ np.diag(inverse_mass) @ J.T
        at = f"rows {rows}, inverse masses {show(inverse_mass)}, b = {show(b)}, from x = {show(old)}"
        for i in range(n):
            x = np.append(new[: i + 1], old[i + 1 :])
            at_its_turn(A, b, np.zeros(n), np.full(n, INFINITY), x, i, at)


def e14_2_colors(answer):
    for rows in [
        [(None, 0), (None, 1), (None, 2)],
        [(None, 0), (0, 1), (1, 2), (2, 3), (3, 4)],
        [(0, 1), (1, 2), (2, 0), (3, None)],
        [(0, 1), (0, 1), (0, 1), (2, 1)],
        [(0, 1), (2, 3), (1, 2), (4, 0), (3, 4)],
        [],
    ]:
        got = answer(list(rows))
        colors = [whole(c, "a color") for c in parts(got, len(rows), f"{len(rows)} colors, one for each row")]
        at = f"rows {rows}, colors {colors}"
        shares = lambda i, j: any(body is not None and body in rows[j] for body in rows[i])
        for i in range(len(rows)):
            require(colors[i] >= 0, f"{at}: colors are 0, 1, 2, …")
            for j in range(i):
                different = not shares(i, j) or colors[i] != colors[j]
                require(different, f"{at}: rows {j} and {i} share a body and a color")
            taken = {colors[j] for j in range(i) if shares(i, j)}
            smallest = all(color in taken for color in range(colors[i]))
            require(smallest, f"{at}: at its turn row {i} could have had a smaller color")


def e14_3_pattern(answer):
    for rows in [
        [(None, 0)],
        [(None, 0), (None, 1)],
        [(None, 0), (0, 1), (1, 2)],
        [(0, 1), (0, 1), (2, 3)],
        [(0, None), (1, 0), (None, 1)],
    ]:
        # J with powers of two as entries: no sum of their products is zero.
        J = [[2.0 ** (4 * i + k) if k in row else 0.0 for k in range(4)] for i, row in enumerate(rows)]
        count, got = np.count_nonzero(np.array(J) @ np.array(J).T), whole(answer(list(rows)), "a whole number")
        require(got <= count, f"rows {rows}: {got} entries are more than A has")
        require(got >= count, f"rows {rows}: {got} entries are fewer than A has")


def e14_b_assembled(answer):
    for name, rows, inverse_mass in [
        ("a ball on the ground, body 0", [(0, 1)], [0, 0.5]),
        ("two balls on the ground, body 0", [(0, 1), (0, 2)], [0, 0.5, 2]),
        ("a ball on a ball on the ground", [(0, 1), (1, 2)], [0, 1, 0.25]),
        ("a chain", [(0, 1), (1, 2), (2, 3)], [1, 0.5, 2, 0.25]),
        ("two bodies with two contacts", [(1, 0), (1, 0)], [1, 0.5]),
    ]:
        entries, n = answer(list(rows), list(inverse_mass)), len(rows)
        require(isinstance(entries, dict), f"the program returned {show(entries)} instead of a dict of entries")
        outside = [place for place in entries if not (0 <= place[0] < n and 0 <= place[1] < n)]
        require(not outside, f"{name}, rows {rows}: A has no entry {outside}")
        for j, (first, second) in enumerate(rows):
            velocity = np.zeros(len(inverse_mass))  # after 1 N s in row j
            velocity[first], velocity[second] = -inverse_mass[first], inverse_mass[second]
            for i in range(n):
                opens = velocity[rows[i][1]] - velocity[rows[i][0]]
                entry = number(entries.get((i, j), 0.0), f"the entry {(i, j)}")
                at = f"{name}, rows {rows}, inverse masses {inverse_mass}: 1 N s in row {j}"
                require(abs(entry - opens) < 1e-12, f"{at} does not open gap {i} at {show(entry)} m/s")


def e15_1_layers(answer):
    for masses in [2.0], [1.0, 1.0, 1.0], [1.0, 100.0], [5.0, 0.5, 3.0, 0.25]:
        n, g, dt = len(masses), 9.81, 0.02
        x = numbers(answer(list(masses), g, dt), (n,), f"{n} impulses, one for each body")
        for k, mass in enumerate(masses):
            change = x[k] - (x[k + 1] if k + 1 < n else 0.0) - mass * g * dt
            way = "upwards" if change > 0 else "downwards"
            at = f"masses {masses} kg, dt = {dt} s, impulses {show(x)} N s"
            require(abs(change) < 1e-12 * sum(masses), f"{at}: body {k} would move {way}")


def e15_2_tower(answer):
    def harmonic(part):
        """Six boxes, each at this part of the farthest that it can stand out: 1/2, 1/4, 1/6, … m from the top."""
        return np.append(0, np.cumsum([part * 0.5 / k for k in range(5, 0, -1)]))

    for name, x, m, stands in [
        ("one box", [0.25], [3], True),
        ("a straight tower", [0.5, 0.5, 0.5], [1, 2, 0.5], True),
        ("two boxes", [0, 0.375], [1, 1], True),
        ("two boxes, the upper one too far out", [0, 0.55], [1, 1], False),
        ("the farthest tower of six, nearly", harmonic(0.98), np.ones(6), True),
        ("the farthest tower of six, too far", harmonic(1.02), np.ones(6), False),
        ("a box held by a heavy one on its end", [0, 0.6, 0.2], [1, 1, 5], True),
        ("a stair to the left", [0, -0.3, -0.6, -0.9], np.ones(4), False),
        ("two stairs to the left", [0, -0.3, -0.6], [4, 2, 1], True),
    ]:
        x, m, dt, n = np.array(x, dtype=float), np.array(m, dtype=float), 0.02, len(x)
        at, got = f"{name}, middles {show(x)} m, masses {show(m)} kg", answer(x.copy(), m.copy(), dt)
        if not stands:
            require(got is None, f"{at}: this tower falls, but the program returned impulses")
            continue
        require(got is not None, f"{at}: this tower stands, but the program returned None")
        layers = numbers(got, (n, 2), f"{n} layers of two impulses")
        ends = [(max(x[k], x[k - 1]) - 0.5, min(x[k], x[k - 1]) + 0.5) for k in range(1, n)]
        ends = np.array([(x[0] - 0.5, x[0] + 0.5)] + ends)
        at = f"{at}: impulses {show(layers)} N s"
        require((layers >= 0).all(), f"{at}, and a layer pulls")
        for k in range(n):
            force, turn = layers[k].sum() - m[k] * G * dt, layers[k] @ (ends[k] - x[k])
            if k + 1 < n:
                force, turn = force - layers[k + 1].sum(), turn - layers[k + 1] @ (ends[k + 1] - x[k])
            require(abs(force) < 1e-9, f"{at}: box {k} moves {'up' if force > 0 else 'down'}")
            require(abs(turn) < 1e-9, f"{at}: box {k} tips, its {'right' if turn > 0 else 'left'} end goes up")


def e15_3_sweeps(answer):
    for below, above, reduction in [
        (1.0, 1.0, 1e-3),
        (1.0, 100.0, 0.5),
        (1.0, 30.0, 1e-2),
        (100.0, 1.0, 1e-3),
        (2.0, 3.0, 1e-6),
    ]:
        a = 1 / below
        low, high, counted = 1.0, 1.0, 0  # the errors of the two rows
        while high > reduction:
            low = high
            high = a * low / (a + 1 / above)
            counted += 1
        got = whole(answer(below, above, reduction), "a whole number")
        at = f"{above:g} kg on {below:g} kg, down to {reduction:g}: {got} sweeps"
        require(got <= counted, f"{at} are more than it takes")
        require(got >= counted, f"{at} are too few")


def e15_b_kept(answer):
    for masses, sweeps, steps in [
        ([2], 1, 1000),
        ([1, 1], 3, 1000),
        ([1, 1, 1, 1, 1], 10, 1000),
        ([4, 2, 1], 4, 1000),
        ([1, 3, 2], 8, 1000),
        ([4, 2, 1], 1000, 1),
    ]:
        masses, dt, n = np.array(masses, dtype=float), 0.01, len(masses)
        x, z = parts(answer(masses.copy(), dt, sweeps, steps), 2, "the impulses and how far the balls have moved")
        x, z = numbers(x, (n,), f"{n} impulses"), numbers(z, (n,), f"{n} distances")
        at = f"masses {show(masses)} kg, {sweeps} sweeps in each of {steps} step{'s' * (steps > 1)}"
        for k in range(n):
            require(
                abs(z[k]) < 0.02,
                f"{at}: ball {k} is {abs(z[k]):.4g} m {'above' if z[k] > 0 else 'below'} its place",
            )
            load = masses[k:].sum() * G * dt
            right = abs(x[k] - load) < 1e-6 * load
            require(
                right, f"{at}: contact {k} gives {show(x[k])} N s in a step, the balls on it weigh something else"
            )


def e17_1_skier(answer):
    hills = [
        ("h = cos x", np.cos, lambda x: (-np.sin(x), -np.cos(x))),
        ("h = x²/20", lambda x: x * x / 20, lambda x: (x / 10, 0.1)),
        ("h = −x/2", lambda x: -0.5 * x, lambda x: (-0.5, 0.0)),
        ("h = 3 sin(x/3)", lambda x: 3 * np.sin(x / 3), lambda x: (np.cos(x / 3), -np.sin(x / 3) / 3)),
    ]
    places = [(0.3, 0.0, 80.0), (0.3, 2.0, 60.0), (1.2, 8.0, 1.0), (3.0, -5.0, 70.0), (-2.0, 20.0, 70.0)]
    for name, height, shape in hills:
        for x, speed, m in places:
            slope, bend = shape(x)
            force = numbers(answer(m, slope, bend, speed), (2,), "the force, two numbers")
            at = f"hill {name}, {m:g} kg at x = {x} m with v_x = {speed:g} m/s: the force is {show(force)} N"
            across = abs(force[0] + force[1] * slope) < 1e-9 * m * G * (1 + abs(slope))
            require(across, f"{at}, which is not perpendicular to the snow")
            require(force[1] >= -1e-9, f"{at}, which pulls her down")
            a_x, a_z = force[0] / m, force[1] / m - G
            # The gap on the path that this force and gravity give, shortly before, now, and after.
            z = lambda t: height(x) + slope * speed * t + a_z * t * t / 2
            gap = lambda t: z(t) - height(x + speed * t + a_x * t * t / 2)
            opens = (gap(1e-4) - 2 * gap(0.0) + gap(-1e-4)) / 1e-8
            size = 1e-5 * (G + speed**2)
            require(opens > -size, f"{at}, and she goes into the snow, c̈ = {opens:.4g} m/s²")
            require(force[1] <= 1e-9 or opens < size, f"{at}, and she takes off, c̈ = {opens:.4g} m/s²")


def e17_2_tested(answer):
    rod, sphere = (
        lambda p: np.sqrt(p[0] ** 2 + p[1] ** 2 + p[2] ** 2) - 5,
        lambda p: p[0] ** 2 + p[1] ** 2 + p[2] ** 2 - 25,
    )
    wire, washboard = lambda p: p[2] - np.cos(p[0]), lambda p: p[2] - 0.1 * np.sin(30 * p[0])
    far = lambda p: np.sqrt((p[0] - 800) ** 2 + p[1] ** 2 + (p[2] + 600) ** 2) - 1e3
    product, large = lambda p: p[0] * p[1] - p[2], lambda p: 1e6 + np.sin(p[0]) * p[1] + p[2] ** 2
    bead, comb, slope = [0.3, 0, 0.955], [0.11, 0.5, 0], -3 * np.cos(3.3)
    reasons = {
        "a washboard": ": if the point moves too far, the bend of c counts as an error",
        "a difference of large numbers": ": if the point moves too little, rounding in c counts as an error",
    }
    for name, c, p, j, wrong in [
        ("a rod", rod, [3, 4, 0], [0.6, 0.8, 0], None),
        ("a rod, turned round", rod, [3, 4, 0], [-0.6, 0.8, 0], 0),
        ("a rod, not a unit vector", rod, [3, 4, 0], [3, 4, 0], 0),
        ("a sphere", sphere, [3, 0, -4], [6, 0, -8], None),
        ("a sphere, half of it", sphere, [3, 0, -4], [6, 0, -4], 2),
        ("a large sphere, within the tolerance", sphere, [30, 0, -40], [60.0005, 0, -80], None),
        ("a wire", wire, bead, [np.sin(0.3), 0, 1], None),
        ("a wire, wrong sign", wire, bead, [-np.sin(0.3), 0, 1], 0),
        ("a wire, a made-up y", wire, bead, [np.sin(0.3), 0.01, 1], 1),
        ("a washboard", washboard, comb, [slope, 0, 1], None),
        ("a washboard, a little off", washboard, comb, [slope, 0, 1.001], 2),
        ("a rod of a kilometer", far, [0, 0, 0], [-0.8, 0, 0.6], None),
        ("a rod of a kilometer, z missing", far, [0, 0, 0], [-0.8, 0, 0], 2),
        ("c = x y − z", product, [2, 7, 14], [7, 2, -1], None),
        ("c = x y − z, exchanged", product, [2, 7, 14], [2, 7, -1], 0),
        ("a difference of large numbers", large, [0.3, 1.2, -0.7], [1.2 * np.cos(0.3), np.sin(0.3), -1.4], None),
    ]:
        p, j = np.array(p, dtype=float), np.array(j, dtype=float)
        got = answer(c, p.copy(), j.copy())
        got = None if got is None else whole(got, "the number of an entry, or None")
        right = f"this row is right{reasons.get(name, '')}"
        truth = right if wrong is None else f"entry {wrong} is the first wrong one"
        require(got == wrong, f"{name}, p = {show(p)}, J = {show(j)}: the program says {got}, but {truth}")


def e17_b_bead(answer):
    for slope, mu, m, steps in [
        (0.0, 0.5, 1.0, 10),
        (0.75, 0.0, 1.0, 100),
        (0.577, 0.6, 1.0, 100),
        (0.75, 0.5, 1.0, 100),
        (-0.75, 0.5, 3.0, 50),
        (2.0, 1.9, 0.1, 100),
        (2.0, 2.1, 0.1, 100),
    ]:
        dt, angle = 0.01, np.arctan(slope)
        law = -G * max(0.0, abs(np.sin(angle)) - mu * np.cos(angle)) * dt * steps * np.sign(slope)
        got = number(answer(slope, mu, m, dt, steps), "one speed")
        at = f"slope {slope} ({np.degrees(angle):.1f}°), μ = {mu}, m = {m:g} kg: after {dt * steps:g} s the bead has {show(got)} m/s"
        words = (
            "it should stay" if law == 0 else "g (sin θ − μ cos θ) t is another speed, or it points the other way"
        )
        require(abs(got - law) < 1e-9, f"{at}, but {words}")

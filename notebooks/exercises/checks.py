"""What a right answer to each exercise has to obey: a closed form, a law, or an independent method."""

import numpy as np
from numpy.testing import assert_allclose

G = 9.81  # m/s²


def definite(generator, n):
    """A symmetric positive definite matrix."""
    J = generator.normal(size=(n, n + 2))
    return J @ J.T


def problems(n, count=30):
    """Definite problems of n rows."""
    generator = np.random.default_rng(n)
    return [(definite(generator, n), generator.normal(size=n)) for _ in range(count)]


def solves(A, b, x, tolerance=1e-9):
    """x >= 0, w >= 0 and x w = 0."""
    w = A @ np.asarray(x) + b
    assert min(x) >= -tolerance, f"a contact pulls: x = {x}"
    assert min(w) >= -tolerance, f"a contact closes: w = {w}"
    assert abs(x * w).max() < 10 * tolerance, f"x = {x} pushes what opens, w = {w}"


def e01_1_hand(answer):
    x = answer(2.0, [0.0, -10.0, 15.0, 30.0, 0.0], 0.01)
    assert_allclose(x[:3], [0.1962, 0.2962, 0.0462])  # weight, weight and hand, weight less hand
    assert x[3] == 0 and x[4] == 0, "a box in the air gets nothing"


def e01_2_one_row(answer):
    for b, x in [(1, 0), (-1, 0.5), (-9, 2), (0, 0)]:
        assert_allclose(answer(2.0, b, 0.0, 2.0), x, atol=1e-15)
    assert_allclose(answer(4.0, -2.0, -np.inf, np.inf), 0.5)


def e01_3_two_rows(answer):
    for A, b in problems(2):
        solves(A, b, answer(A, b))


e01_b_two_contacts = e01_3_two_rows


def e02_1_rod(answer):
    generator = np.random.default_rng(1)
    for _ in range(10):
        p, v = generator.normal(size=(2, 3))
        J, product = answer(p, v)
        h = 1e-4
        before, now, after = (np.linalg.norm(p + k * h * v) for k in (-1, 0, 1))
        assert_allclose(J @ v, (after - before) / (2 * h), atol=1e-5)
        assert_allclose(product, (after - 2 * now + before) / h**2, rtol=1e-3, atol=1e-4)


def e02_2_nail(answer):
    generator = np.random.default_rng(2)
    for r, v, omega in generator.normal(size=(10, 3, 3)):
        assert_allclose(answer(r) @ np.concatenate([v, omega]), v + np.cross(omega, r))


def e02_3_two_ends(answer):
    generator = np.random.default_rng(3)
    for _ in range(10):
        p, r = generator.normal(size=(2, 2, 3))
        u = generator.normal(size=(2, 2, 3))  # v and ω of each body
        ends = p + r
        rates = [u[k, 0] + np.cross(u[k, 1], r[k]) for k in range(2)]
        h = 1e-6
        distance = lambda t: np.linalg.norm(ends[1] + t * rates[1] - ends[0] - t * rates[0])
        assert_allclose(answer(p, r) @ u.ravel(), (distance(h) - distance(-h)) / (2 * h), atol=1e-6)


def e02_b_contact(answer):
    generator = np.random.default_rng(4)
    for _ in range(10):
        centers, (point, normal), u = (generator.normal(size=(k, 3)) for k in (2, 2, 4))
        n = normal / np.linalg.norm(normal)
        rate = n @ (u[2] + np.cross(u[3], point - centers[1]) - u[0] - np.cross(u[1], point - centers[0]))
        assert_allclose(answer(centers, point, normal) @ u.ravel(), rate)


def e03_1_column(answer):
    generator = np.random.default_rng(5)
    for n in 1, 2, 3, 5:
        for _ in range(10):
            m, u = generator.uniform(0.1, 5, n), generator.normal(size=n)
            J = np.eye(n) - np.eye(n, k=-1)
            solves(J @ np.diag(1 / m) @ J.T, J @ u, np.array(answer(m, u)))


def e03_2_delassus(answer):
    J, inverse_mass = np.array([[1.0, 0, 0], [-1, 1, 0], [0, -1, 1]]), np.array([0.5, 1, 4])
    A = answer(J, inverse_mass)
    for k in range(3):
        for i in range(3):
            velocities = inverse_mass * J[k]  # after 1 N s in row k
            assert_allclose(A[i][k], J[i] @ velocities)


def e03_3_two_levels(answer):
    m, l, g, phi, omega = 2.0, 1.5, G, 0.4, 0.9
    for dt in 0.1, 0.001:
        x, force = answer(m, l, g, phi, omega, dt)
        n, along = np.array([np.sin(phi), -np.cos(phi)]), np.array([np.cos(phi), np.sin(phi)])
        after = l * omega * along + dt * np.array([0, -g]) + n * x / m
        assert_allclose(n @ after, 0, atol=1e-12)
        acceleration = np.array([0, -g]) + n * force / m
        assert_allclose(n @ acceleration, -l * omega**2)  # what bends the path into the circle


def e03_b_step(answer):
    for inverse, u, force, dt in [
        ([0, 0.5], [0, 0], [0, -20], 0.01),
        ([1, 2], [1, -3], [0, -5], 0.1),
        ([1, 2], [-1, 3], [0, 0], 1.0),
    ]:
        inverse, u, force = (np.array(v, dtype=float) for v in (inverse, u, force))
        free, after = u + dt * inverse * force, np.array(answer(inverse, u, force, dt))
        gap = free[1] - free[0]
        common = (free / inverse).sum() / (1 / inverse).sum() if inverse.all() else free[inverse == 0][0]
        assert_allclose(after, free if gap >= 0 else [common, common], atol=1e-12)


def e04_1_sweep(answer):
    A, hi = np.array([[2.0, -1, 0], [-1, 4, 1], [0, 1, 3]]), np.array([np.inf, 1, 2])
    lo = np.array([0.0, -1, 0])
    for b, old in [([-1, -1, 2], [0, 0, 0]), ([3, -2, -1], [1, 0.5, 2]), ([-4, -9, -20], [0, 0, 0])]:
        b, old = np.array(b, dtype=float), np.array(old, dtype=float)
        new = answer(A, b, lo, hi, old.copy())
        for i in range(3):
            w = A[i] @ np.append(new[: i + 1], old[i + 1 :]) + b[i]  # at the turn of row i
            fits = abs(w) < 1e-12 or (w > 0 and new[i] == lo[i]) or (w < 0 and new[i] == hi[i])
            assert fits and lo[i] <= new[i] <= hi[i], f"row {i} could do better: w = {w}, x = {new}"


def e04_2_impulse(answer):
    for v, inverse_mass, total in [(-2, 0.5, 0), (-2, 0.5, 3), (1, 0.5, 3), (4, 0.5, 3), (1, 2, 0)]:
        after, new = answer(v, inverse_mass, total)
        assert_allclose(after - v, inverse_mass * (new - total), err_msg="velocity and impulse do not fit")
        assert new >= 0 and after >= -1e-12 and new * after < 1e-12


def e04_b_projected(answer):
    for A, b in problems(3) + [(np.array([[3.0, 1, 2], [1, 4, 3], [2, 3, 3]]), np.array([0.1, 0, -1]))]:
        solves(A, b, answer(A, b, 20000), 1e-6)


def e05_1_extrapolate(answer):
    for end, error, rho in [([4, 3, 1], [-1, -1.5, -0.5], 0.75), ([2, 1], [1, -0.5], -0.5), ([1, 5], [0, 0], 0.5)]:
        end, error = np.array(end, dtype=float), np.array(error)
        assert_allclose(answer([end + error * rho**k for k in range(3)]), end)
    assert (answer([np.array([1.0]), np.array([0.5]), np.array([0.2])]) >= 0).all()


def e06_1_active_set(answer):
    for A, b in problems(2, 10):
        for free in [(0, 0), (0, 1), (1, 0), (1, 1)]:
            x = answer(A, b, free)
            w = A @ x + b
            assert_allclose([w[i] if free[i] else x[i] for i in range(2)], 0, atol=1e-9)


def e06_b_dantzig_step(answer):
    generator = np.random.default_rng(6)
    for _ in range(50):
        n = 4
        pushes = generator.integers(0, 2, n - 1)
        x = np.append(generator.uniform(0.1, 1, n - 1) * pushes, 0)
        w = np.append(generator.uniform(0.1, 1, n - 1) * (1 - pushes), -1)
        dx = np.append(generator.normal(size=n - 1) * pushes, 1)
        dw = np.append(generator.normal(size=n - 1) * (1 - pushes), generator.uniform(0.5, 2))
        length, row = answer(x, w, dx, dw)
        at_x, at_w = x + length * dx, w + length * dw
        assert length > 0 and (at_x > -1e-12).all() and (at_w[:-1] > -1e-12).all() and at_w[-1] < 1e-12
        assert abs(at_w[row] if row == n - 1 or not pushes[row] else at_x[row]) < 1e-12


def e07_1_murty(answer):
    for x, w, row in [([1, 0], [0, 1], None), ([-1, 0], [0, -2], 0), ([1, 0, 0], [0, -1, -5], 1), ([0], [0], None)]:
        assert answer(np.array(x), np.array(w)) == row


def e07_2_ratio(answer):
    for constant, rate, row in [([1, 2], [-1, -4], 1), ([1, 2], [1, 0], None), ([1, 2, 3], [-1, -2, -1], 0)]:
        assert answer(np.array(constant, dtype=float), np.array(rate, dtype=float)) == row


def e08_1_scaled(answer):
    A, lo, hi = np.array([[2.0, -1], [-1, 2]]), np.zeros(2), np.full(2, np.inf)
    b = np.array([-1.0, 3])
    assert_allclose(answer(A, b, lo, hi, np.array([0.5, 0])), 0, atol=1e-15)
    assert_allclose(answer(A, b, lo, hi, np.array([1.0, 0])), 1 / 3)  # w = 1 of 2 + 1
    assert_allclose(answer(A, b, lo, np.array([0.2, 9]), np.array([0.2, 0])), 0, atol=1e-15)
    assert answer(A, 0 * b, lo, hi, np.zeros(2)) == 0
    S = np.diag([1000.0, 0.01])  # other units
    for x in np.random.default_rng(7).uniform(0, 1, (5, 2)):
        other = answer(S @ A @ S, S @ b, lo, hi, np.linalg.solve(S, x))
        assert_allclose(other, answer(A, b, lo, hi, x))


def e08_2_repair(answer):
    A, b = np.array([[3.0, 1], [1, 3]]), np.array([-1.0, 2])
    exact, distance = answer(A, b, np.array([1 / 3 + 1e-6, 1e-9]))
    assert_allclose(exact, [1 / 3, 0])
    assert_allclose(distance, 1e-6, rtol=1e-6)
    A, b = np.array([[2.0, -1], [-1, 2]]), np.array([-1.0, 2])
    assert answer(A, b, np.array([3.0, 4])) is None  # both rows look free, and row 1 would pull


def e08_b_stop(answer):
    for A, b in problems(2):
        x, sweeps = answer(A, b, 1e-6)
        solves(A, b, x, 1e-5)
        assert sweeps < 1000, "it does not see that it is done"


def e09_1_farkas(answer):
    ring, b = np.array([[1.0, -1], [-1, 1]]), np.array([-1.0, -1])
    for A, b, d, proves in [
        (ring, b, [1, 1], True),
        (ring, b, [-1, -1], False),  # d must not be negative
        (ring, -b, [1, 1], False),
        (np.eye(2), b, [1, 1], False),
        (np.array([[0.0, -1], [0, 0]]), np.array([-1.0, 0]), [1, 0], True),  # Aᵀ d, not A d
    ]:
        assert answer(A, b, np.array(d, dtype=float)) is proves


def e10_1_tangent(answer):
    for l, v, dt in [(1, 1, 1), (2, 3, 0.5), (5, 12, 1)]:
        assert_allclose((l + answer(l, v, dt)) ** 2, l**2 + (v * dt) ** 2)
    assert_allclose(answer(5, 12, 1), 8)


def e10_2_bias(answer):
    for c, bias in [(0.02, 2.0), (0.0, 0.0), (-0.005, 0.0), (-0.01, 0.0), (-0.03, -0.4)]:
        assert_allclose(answer(c, 0.01, 0.2, 0.01), bias, atol=1e-12)


def e10_3_spring(answer):
    k, d, dt, c, v, m = 400.0, 20.0, 0.01, 0.1, -0.3, 2.0
    gamma, beta = answer(k, d, dt)
    x = -(v + beta / dt * c) / (1 / m + gamma)
    after = v + x / m
    assert_allclose(x, -dt * (k * (c + dt * after) + d * after))


def e10_b_feedback(answer):
    p = answer([0.0, -1.1], 1.0, G, 0.2, 1 / 60, 30)  # it hangs still, 0.1 m too long
    assert_allclose(np.linalg.norm(p) - 1, 0.1 * 0.8**30, atol=1e-9)


def e11_1_nearest(answer):
    angles = np.linspace(0, 2 * np.pi, 20001)
    circle = np.column_stack([np.cos(angles), np.sin(angles)])
    edges = [1 / abs(circle).max(axis=1), np.ones(len(angles)), 1 / abs(circle).sum(axis=1)]
    for wanted in np.random.default_rng(8).normal(size=(20, 2)) * 2:
        for point, edge in zip(answer(wanted, 1.0), edges):
            border = circle * edge[:, None]
            at = np.arctan2(wanted[1], wanted[0]) % (2 * np.pi)
            inside = np.linalg.norm(wanted) <= np.interp(at, angles, edge)
            least = 0 if inside else np.linalg.norm(border - wanted, axis=1).min()
            assert_allclose(np.linalg.norm(point - wanted), least, atol=1e-3)
            if not inside:
                assert np.linalg.norm(border - point, axis=1).min() < 1e-3


def e11_2_cone(answer):
    generator = np.random.default_rng(9)
    for p in generator.normal(size=(40, 3)):
        mu = generator.uniform(0.1, 2)
        x = answer(p, mu)
        rest = x - p  # lies in the dual cone, at a right angle to x
        assert np.linalg.norm(x[1:]) <= mu * x[0] + 1e-12
        assert mu * np.linalg.norm(rest[1:]) <= rest[0] + 1e-12 and abs(x @ rest) < 1e-12


def e11_3_uphill(answer):
    theta, v0 = 0.5, 3.0
    for mu in 0.0, 0.3, 0.8:
        v, dt = v0, 1e-4
        for k in range(20000):
            if k % 4000 == 0:
                assert_allclose(answer(theta, mu, v0, k * dt), v, atol=2e-3)
            free, limit = v - dt * G * np.sin(theta), dt * mu * G * np.cos(theta)
            v = free + min(max(-free, -limit), limit)


def e11_b_pressed(answer):
    speeds = answer(2.0, 0.5, 0.01, [(20, 0), (20, 0), (20, 100), (0, 0)])
    free = 0.01 * (10 - 0.5 * G)
    assert_allclose(speeds[:2], [free, 2 * free])
    third = max(0.0, 2 * free + 0.1 - 0.005 * (G + 50))
    assert_allclose(speeds[2:], [third, max(0.0, third - 0.005 * G)], atol=1e-12)


def e12_1_two_balls(answer):
    for m, v, e in [((1, 2), (3, -1), 0.5), ((5, 1), (2, 1), 1.0), ((1, 1), (0, 1), 1.0)]:
        after = answer(m, v, e)
        assert_allclose(m[0] * after[0] + m[1] * after[1], m[0] * v[0] + m[1] * v[1])
        approach = v[0] - v[1]
        assert_allclose(after[1] - after[0], e * approach if approach > 0 else -approach)


def e12_b_bounce(answer):
    states = np.array(answer(1.0, 1.0, 0.001, 4000))
    assert states[:, 0].min() > -1e-9
    for k in range(1, 4):  # it comes back every 2 √(2 h / g)
        at = int(2 * k * np.sqrt(2 / G) / 0.001)
        assert states[at - 60 : at + 60, 0].max() > 0.95
    states = np.array(answer(1.0, 0.5, 0.001, 3000))
    assert_allclose(states[470:1000, 0].max(), 0.25, atol=0.01)


def e13_1_all_answers(answer):
    for a, b, expected in [(2, -1, [0.5]), (2, 1, [0]), (-2, 1, [0, 0.5]), (-2, -1, [])]:
        assert_allclose(sorted(answer(a, b)), expected)


def e13_2_critical_friction(answer):
    for theta in 0.3, 0.9, 1.3:
        for k in 1 / 3, 1.0:
            mu, sin, cos = answer(theta, k), np.sin(theta), np.cos(theta)
            J_n, J_t, M_inverse = np.array([0, 1, -cos]), np.array([1, 0, sin]), np.diag([1, 1, 1 / k])
            assert_allclose(J_n @ M_inverse @ (J_n + mu * J_t), 0, atol=1e-12)


def e14_1_bodies(answer):
    rows, inverse_mass = [(None, 0), (0, 1), (1, 2), (0, 2)], np.array([1.0, 0.5, 2])
    J = np.zeros((4, 3))
    for i, (first, second) in enumerate(rows):
        if first is not None:
            J[i, first] = -1
        J[i, second] = 1
    A, b, old = J @ np.diag(inverse_mass) @ J.T, np.array([-1.0, 0.5, -2, 1]), np.array([0.1, 0.2, 0, 0.3])
    new = answer(rows, inverse_mass, b, old.copy())
    for i in range(4):
        w = A[i] @ np.append(new[: i + 1], old[i + 1 :]) + b[i]
        assert new[i] >= 0 and w > -1e-12 and abs(new[i] * w) < 1e-12, f"row {i}: w = {w}, x = {new}"


def e14_2_colors(answer):
    assert answer([(None, 0), (0, 1), (1, 2), (None, 2), (None, 3)]) == [0, 1, 0, 1, 0]
    assert answer([(0, 1), (0, 2), (0, 3)]) == [0, 1, 2]


def e14_3_pattern(answer):
    assert answer([(0, 1), (1, 2), (2, 3)]) == 7  # three diagonals
    assert answer([(None, 0), (None, 1)]) == 2  # the ground joins nobody
    assert answer([(0, 1), (0, 1)]) == 4


def e14_b_assembled(answer):
    rows, inverse_mass = [(0, 1), (1, 2), (1, 2)], [0.0, 1.0, 0.5]
    J = np.array([[-1.0, 1, 0], [0, -1, 1], [0, -1, 1]])
    A = J @ np.diag(inverse_mass) @ J.T
    entries = answer(rows, inverse_mass)
    for i in range(3):
        for k in range(3):
            assert_allclose(entries.get((i, k), 0.0), A[i, k])


def e15_1_layers(answer):
    assert_allclose(answer([2.0, 2, 2], 10.0, 0.01), [0.6, 0.4, 0.2])
    assert_allclose(answer([1.0, 100], 10.0, 0.01), [10.1, 10])


def e15_2_tower(answer):
    x, m, dt = np.array([0.0, 0.2, 0.3]), np.array([1.0, 2, 1]), 0.01
    layers = np.array(answer(x, m, dt))
    for k in range(3):
        below = x[k - 1] if k else x[0]
        ends = np.array([max(x[k], below) - 0.5, min(x[k], below) + 0.5])
        assert (layers[k] >= 0).all()
        assert_allclose(layers[k].sum(), dt * G * m[k:].sum())  # forces
        assert_allclose(layers[k] @ ends, dt * G * m[k:] @ x[k:])  # moments
    assert answer(np.array([0.0, 0.6]), np.array([1.0, 1]), dt) is None


def e15_3_sweeps(answer):
    for below, above, reduction in [(1, 1, 0.1), (1, 100, 0.1), (2, 3, 1e-6)]:
        error, sweeps = 1.0, 0
        while error > reduction:  # a sweep: the upper error goes down, and a part of it comes back
            error *= (1 / below) / (1 / below + 1 / above)
            sweeps += 1
        assert answer(below, above, reduction) == sweeps


def e15_b_kept(answer):
    x, _ = answer(np.array([1.0, 2, 1]), 0.01, 20, 200)
    assert_allclose(x, [0.3924, 0.2943, 0.0981], atol=1e-6)
    masses = np.array([1.0, 10])
    assert_allclose(answer(masses, 0.01, 1, 400)[1], -10 * G * 1e-4, rtol=1e-3)  # (m₂/m₁) g dt²


def e17_1_skier(answer):
    assert_allclose(answer(70.0, 0.0, 0.0, 3.0), [0, 70 * G])  # level snow
    force = answer(70.0, -0.75, 0.0, 5.0)  # a straight slope: m g cos θ across it
    assert_allclose(np.linalg.norm(force), 70 * G * 0.8)
    assert_allclose(answer(70.0, 0.0, -0.1, np.sqrt(G / 0.1) + 1e-6), [0, 0])  # she takes off
    assert_allclose(answer(70.0, 0.0, 0.1, 2.0), [0, 70 * (G + 0.4)])


def e17_2_tested(answer):
    c = lambda p: 1e6 + np.sin(p[0]) * p[1] + p[2] ** 2
    p = np.array([0.3, 1.2, -0.7])
    J = np.array([np.cos(0.3) * 1.2, np.sin(0.3), -1.4])
    bend = lambda p: p[0] ** 3 - p[1] * p[2]
    row = np.array([3 * 0.09, 0.7, -1.2])
    assert answer(bend, p, row) is None
    for k in range(3):
        assert answer(bend, p, row + 0.01 * np.eye(3)[k]) == k
    assert answer(lambda p: c(p) - 1e6, p, J) is None


def e17_b_bead(answer):
    for slope, mu in [(0.0, 0.3), (1.0, 0.3), (-1.0, 0.2), (np.tan(np.radians(30)), 0.6)]:
        theta = np.arctan(abs(slope))
        speed = max(0.0, G * (np.sin(theta) - mu * np.cos(theta)))
        assert_allclose(abs(answer(slope, mu, 2.0, 0.001, 1000)), speed, atol=1e-6)

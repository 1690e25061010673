"""The engine of the lessons: from one contact to a stack of boxes, in NumPy alone.

It grows from lesson to lesson; each part is written in the lesson that its heading names, and later
lessons import it from here. Signs are those of all lessons: w = A x + b is a velocity after the step,
x >= 0 is an impulse that pushes. Units are SI.

>>> one_contact(1 / 2, -1.1635)  # 2 kg, 1.1635 m/s downwards without the ground
2.327
"""

import numpy as np


# Lesson 1: one contact, and several by trying all cases


def one_contact(a, b, lo=0.0, hi=np.inf):
    """The x (N s) of the row w = a x + b with a > 0: where w = 0, or at the bound in the way."""
    return min(max(-b / a, lo), hi)


def all_cases(A, b):
    """Each x >= 0 with w = A x + b >= 0 and x w = 0, of a line its ends; A symmetric semidefinite."""
    n, found = len(b), []
    for case in range(2**n):
        F = [i for i in range(n) if case >> i & 1]  # the rows that push
        x = np.zeros(n)
        try:
            x[F] = np.linalg.solve(A[np.ix_(F, F)], -b[F])  # their w = 0
        except ValueError:
            continue  # a singular set has no x, or a whole line of them
        fits = (x >= 0).all() and (A @ x + b > -1e-12).all()  # -1e-12 is 0, rounded
        if fits and all(abs(x - other).max() > 1e-12 for other in found):
            found.append(x)
    return found


# Lesson 2: from a sentence about places to a row


def rod(p, v, l):
    """c, J and J'u of a rod of length l from the origin to a point at p with velocity v."""
    n = p / np.linalg.norm(p)
    return np.linalg.norm(p) - l, n, (v @ v - (n @ v) ** 2) / np.linalg.norm(p)


def skew(r):
    """The matrix of "r cross": skew(r) @ a = r × a."""
    return np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])


# Lesson 3: from Newton's law to the LCP


def assemble(J, M_inverse, u_star):
    """A = J M⁻¹ Jᵀ (1/kg) and b = J u* (m/s)."""
    return J @ M_inverse @ J.T, J @ u_star


# Lesson 4: sweeps


def gauss_seidel(A, b, lo, hi, sweeps):
    """x after this number of sweeps from 0: each row in turn makes its own w zero, within its bounds."""
    x = np.zeros(len(b))
    for _ in range(sweeps):
        for i in range(len(b)):
            w = A[i] @ x + b[i]  # with the x of this sweep where there is one
            x[i] = min(max(x[i] - w / A[i, i], lo[i]), hi[i])
    return x


# Lesson 5: how fast, and faster


def sor(A, b, lo, hi, omega, sweeps, x):
    """x after this number of sweeps from x, each row going omega times as far."""
    x = x.copy()
    for _ in range(sweeps):
        for i in range(len(b)):
            x[i] = min(max(x[i] - omega * (A[i] @ x + b[i]) / A[i, i], lo[i]), hi[i])
    return x


def radius(G):
    """The largest modulus of an eigenvalue of G: the k-th root of the size of Gᵏ, for k = 2³⁹."""
    root = 1.0
    for k in range(40):
        size = abs(G).max()
        root, G = root * size ** (1 / 2**k), G / (size or 1) @ (G / (size or 1))
    return root


def rate(A, omega=1.0):
    """The factor by which a sweep over free rows shrinks the error in the long run."""
    lower = np.tril(A, -1) + np.diag(np.diag(A)) / omega
    return radius(np.eye(len(A)) - np.linalg.solve(lower, A))


# Lesson 6: pivoting


def point(A, b, F):
    """The point of a set F of free rows: A_FF x_F = -b_F, and x = 0 elsewhere."""
    x = np.zeros(len(b))
    x[F] = np.linalg.solve(A[np.ix_(F, F)], -b[F])
    return x


def dantzig(A, b):
    """The x of x >= 0, w = A x + b >= 0, x w = 0; A symmetric and definite, no ties.

    The rows before k are satisfied and stay so while row k moves: free rows keep w = 0.
    """
    n = len(b)
    x, w = np.zeros(n), b.astype(float)
    F = np.zeros(n, dtype=bool)
    for k in range(n):
        while w[k] < 0:
            d = point(A, A[:, k], F)  # A_FF d_F = -A_Fk
            d[k] = 1
            v = A @ d  # how fast w changes along d
            ends = [(-w[k] / v[k], k)]  # w_k is 0
            for i in range(k):
                if F[i] and d[i] < 0:
                    ends.append((-x[i] / d[i], i))  # x_i is 0
                elif not F[i] and v[i] < 0:
                    ends.append((-w[i] / v[i], i))  # w_i is 0
            length, i = min(ends)
            x, w = x + length * d, w + length * v
            F[i] = not F[i]  # this row changes sides
            (w if F[i] else x)[i] = 0.0  # exactly, without rounding
    return x


# Lesson 7: other pivots


def murty(A, b):
    """The x of x >= 0, w = A x + b >= 0, x w = 0; A a P-matrix."""
    F = np.zeros(len(b), dtype=bool)
    while True:
        x = point(A, b, F)
        wrong = np.flatnonzero(np.where(F, x < 0, A @ x + b < 0))
        if len(wrong) == 0:
            return x
        F[wrong[0]] ^= True  # the first wrong row changes sides


def lemke(A, b):
    """The x of x >= 0, w = A x + b >= 0, x w = 0; None where the path ends on a ray; no ties.

    The tableau says w = A x + z0 e + b. Variable i is w_i, n + i is x_i, 2n is the cover z0.
    """
    n = len(b)
    T = np.column_stack([np.eye(n), -A, -np.ones(n), b])
    basis = list(range(n))
    if (b >= 0).all():
        return np.zeros(n)  # nothing to cover
    row, entering = int(np.argmin(b)), 2 * n  # z0 enters with the least value that covers all
    while True:
        T[row] /= T[row, entering]
        for i in range(n):
            if i != row:
                T[i] -= T[i, entering] * T[row]
        leaving, basis[row] = basis[row], entering
        if leaving == 2 * n:
            break  # z0 is gone
        entering = leaving + n if leaving < n else leaving - n  # the partner
        rows = [i for i in range(n) if T[i, entering] > 0]
        if not rows:
            return None
        row = min(rows, key=lambda i: T[i, -1] / T[i, entering])
    x = np.zeros(2 * n + 1)
    x[basis] = T[:, -1]
    return x[n : 2 * n]


# Lesson 8: is it solved?


def natural(A, b, x):
    """The largest |x - Π(x - w)| of contacts; 0 at a solution and nowhere else."""
    return np.abs(np.minimum(x, A @ x + b)).max()


def scaled(A, b, x):
    """The largest part of its terms by which a row misses; 0/0 counts as 0."""
    terms = np.abs(A) @ np.abs(x) + np.abs(b)
    missing = np.abs(np.minimum(x, (A @ x + b) / np.diag(A))) * np.diag(A)
    return (missing / np.where(terms > 0, terms, 1)).max()


# Lesson 10: feedback and springs


def spring(k, d, dt):
    """γ (1/kg) and β of a row that is a spring of stiffness k (N/m) with a damper d (N s/m)."""
    return 1 / (dt * (d + dt * k)), dt * k / (d + dt * k)


# Lesson 11: friction


def disc(wanted, radius):
    """The point of a disc around 0 that is nearest to the wanted one."""
    size = np.linalg.norm(wanted)
    return wanted if size <= radius else wanted * (radius / size)


# Lesson 15: a stack of boxes in the plane. A body has p = (x, z, angle) and u = (v_x, v_z, ω).


class Box:
    """A square of side h (m) and mass m (kg) at p; a mass of 0 means that it is fixed."""

    def __init__(self, p, h, m):
        self.p, self.u, self.h = np.array(p, dtype=float), np.zeros(3), h
        self.M_inverse = np.array([1 / m, 1 / m, 6 / (m * h * h)]) if m else np.zeros(3)

    def turned(self, r):
        """A vector of the body, seen from outside."""
        cos, sin = np.cos(self.p[2]), np.sin(self.p[2])
        return np.array([cos * r[0] - sin * r[1], sin * r[0] + cos * r[1]])


def contacts(boxes, margin):
    """Ends of the lower side of a box over the upper side of another: boxes, name, point, normal, gap."""
    found, signs = [], [(-1, -1), (1, -1), (1, 1), (-1, 1)]
    for i, lower in enumerate(boxes):
        n, t = lower.turned([0, 1]), lower.turned([1, 0])
        for j, upper in enumerate(boxes):
            d = upper.p[:2] - lower.p[:2]
            if i == j or not 0 < n @ d < 0.8 * (lower.h + upper.h):
                continue
            corners = [d + upper.turned(np.multiply(sign, upper.h / 2)) for sign in signs]
            left, right = sorted(sorted(corners, key=lambda r: n @ r)[:2], key=lambda r: t @ r)
            if t @ left > lower.h / 2 or t @ right < -lower.h / 2:
                continue
            for side, end, other in [("left", left, right), ("right", right, left)]:
                cut = np.clip(t @ end, -lower.h / 2, lower.h / 2)  # no farther than the face
                r = end + (other - end) * (cut - t @ end) / (t @ (other - end))
                gap = n @ r - lower.h / 2
                if -lower.h / 4 < gap < margin:
                    found.append((i, j, (i, j, side), lower.p[:2] + r, n, gap))
    return found


def row(boxes, i, j, q, n):
    """The row of the velocity along n of the point q of box j, seen from box i: numbers for u_i and u_j."""
    arm_i, arm_j = q - boxes[i].p[:2], q - boxes[j].p[:2]
    turn = lambda r: r[0] * n[1] - r[1] * n[0]
    return np.array([-n[0], -n[1], -turn(arm_i)]), np.array([n[0], n[1], turn(arm_j)])


def step(boxes, dt, sweeps, mu, kept, soft=None, g=9.81):
    """One step with the given number of sweeps; returns the impulses by name, for the next step.

    `kept` are those of the last step. `soft` is (frequency in Hz, damping ratio) of lesson 16.
    """
    rows = []
    for i, j, name, q, n, gap in contacts(boxes, margin=0.02):
        for along, direction in [("n", n), ("t", np.array([n[1], -n[0]]))]:
            J = row(boxes, i, j, q, direction)
            a = sum(Jk @ (box.M_inverse * Jk) for Jk, box in zip(J, (boxes[i], boxes[j])))
            gamma, beta = (0.0, 0.2) if soft is None or along == "t" else softness(a, *soft, dt)
            bias = beta / dt * gap if along == "n" else 0.0
            if along == "n" and gap > 0:
                gamma, bias = 0.0, gap / dt  # it may close, and no more
            rows.append((i, j, (name, along), J, a, gamma, bias))
    x = {name: kept.get(name, 0.0) for _, _, name, *_ in rows}

    def push(i, j, J, impulse):
        for Jk, box in zip(J, (boxes[i], boxes[j])):
            box.u += box.M_inverse * Jk * impulse

    for box in boxes:
        box.u[1] -= dt * g * (box.M_inverse[0] > 0)
    for i, j, name, J, *_ in rows:
        push(i, j, J, x[name])
    for _ in range(sweeps):
        for i, j, name, J, a, gamma, bias in rows:
            w = J[0] @ boxes[i].u + J[1] @ boxes[j].u + bias + gamma * x[name]
            limit = mu * x[name[0], "n"]
            lo, hi = (0, np.inf) if name[1] == "n" else (-limit, limit)
            new = min(max(x[name] - w / (a + gamma), lo), hi)
            push(i, j, J, new - x[name])
            x[name] = new
    for box in boxes:
        box.p += dt * box.u
    return x


# Lesson 16: soft rows and substeps


def softness(a, frequency, damping, dt):
    """γ and β of a row with A_ii = a that swings with this frequency (Hz) and damping ratio."""
    omega = 2 * np.pi * frequency
    return spring(omega**2 / a, 2 * damping * omega / a, dt)

"""Derivatives of solutions, compared with exact difference quotients.

    gradients.py LCPLAB [NUMBER]     LCPLAB: the program; 1,000 problems
    gradients.py --self-test         wrong derivatives are found

Each problem is made from its solution: the sides of the rows, x and w are drawn first, b = w - A x follows, and all numbers
are small binary fractions. Rows have one or two bounds, are equations, are fixed or have friction; rows of kinks are at a
bound with w = 0; joints are redundant. The quotient (x(p + h dp) - x(p)) / h, h = 2^-40, comes from linear systems in
fractions, whose solution is checked by the definition of the problem. With respect to b it is the derivative itself, unless
the program is wrong; with respect to other data it differs by less than 1e-6. Exit code: 1 if anything differs.
"""
import itertools
import json
import random
import subprocess
import sys
import tempfile
from collections import Counter
from fractions import Fraction as F
from pathlib import Path

H = F(1, 2**40)
FREE, LOWER, UPPER, WEAK_LOWER, WEAK_UPPER, WEAK_BOTH = range(6)
CHOICES = {WEAK_LOWER: (LOWER, FREE), WEAK_UPPER: (UPPER, FREE), WEAK_BOTH: (LOWER, UPPER, FREE)}


def eliminated(rows):
    """Gauss-Jordan: the pivot columns, and the rows; None if the equations contradict each other."""
    rows, pivots = [list(row) for row in rows], []
    for c in range(len(rows[0]) - 1 if rows else 0):
        at = next((r for r in range(len(pivots), len(rows)) if rows[r][c] != 0), None)
        if at is None:
            continue
        k = len(pivots)
        rows[k], rows[at] = rows[at], rows[k]
        rows[k] = [v / rows[k][c] for v in rows[k]]
        for r in range(len(rows)):
            if r != k and rows[r][c] != 0:
                factor = rows[r][c]
                rows[r] = [a - factor * b for a, b in zip(rows[r], rows[k])]
        pivots.append(c)
    return None if any(row[-1] != 0 for row in rows[len(pivots):]) else (pivots, rows)


def product(A, v):
    return [sum((a * x for a, x in zip(row, v)), F(0)) for row in A]


class Case:
    """A problem with its solution x and the sides of its rows."""

    def __init__(self, A, x, w, sides, lo, hi, normal, mu, motion=None):
        self.A, self.x, self.sides, self.lo, self.hi, self.normal, self.mu = A, x, sides, lo, hi, normal, mu
        self.b = [w - ax for w, ax in zip(w, product(A, x))]
        self.motion = motion
        self.n = len(x)

    def data(self):
        number = lambda v: None if v is None else float(v)
        bound = lambda v, none: none if v is None else float(v)
        data = {"A": {"dense": [[float(a) for a in row] for row in self.A]}, "b": [float(b) for b in self.b]}
        data["lo"] = [bound(v, "-inf") for v in self.lo]
        data["hi"] = [bound(v, "inf") for v in self.hi]
        if any(k is not None for k in self.normal):
            data["friction_index"] = [-1 if k is None else k for k in self.normal]
            data["mu"] = [float(m) for m in self.mu]
        if self.motion:
            M, J, bias, gamma, target = self.motion
            triplets = lambda T, upper: [[i, j, float(v)] for i, r in enumerate(T) for j, v in enumerate(r) if v and (i <= j or not upper)]
            data["motion"] = {"mass": triplets(M, True), "jacobian": triplets(J, False), "bias": list(map(float, bias)),
                              "compliance": list(map(float, gamma)), "target": list(map(float, target))}
        return data

    def moved(self, d, t):
        """The data at p + t d."""
        add = lambda v, name: [None if a is None else a + t * c for a, c in zip(v, d.get(name, [F(0)] * len(v)))]
        matrix = lambda T, name: [[a + t * d.get(name, {}).get((i, j), 0) for j, a in enumerate(row)] for i, row in enumerate(T)]
        A, b, motion = matrix(self.A, "A"), add(self.b, "b"), None
        if self.motion:
            M, J, bias, gamma, target = self.motion
            both = {**d.get("mass", {}), **{(j, i): v for (i, j), v in d.get("mass", {}).items()}}
            M = [[a + t * both.get((i, j), 0) for j, a in enumerate(row)] for i, row in enumerate(M)]
            motion = M, matrix(J, "jacobian"), add(bias, "bias"), add(gamma, "compliance"), add(target, "target")
            change = lambda new, old: t * 0 + new - old
            before, after = delassus(*self.motion), delassus(*motion)
            A = [[a + change(p, q) for a, p, q in zip(*rows)] for rows in zip(A, after[0], before[0])]
            b = [a + change(p, q) for a, p, q in zip(b, after[1], before[1])]
        return A, b, add(self.lo, "lo"), add(self.hi, "hi"), add(self.mu, "mu"), motion

    def solved(self, d, t):
        """x and u at p + t d, next to the solution at p."""
        A, b, lo, hi, mu, motion = self.moved(d, t)
        for side in itertools.product(*(CHOICES.get(s, (s,)) for s in self.sides)):
            rows = []
            for i in range(self.n):
                unit = [F(int(i == j)) for j in range(self.n)]
                if side[i] == FREE:
                    rows.append(A[i] + [-b[i]])
                elif self.normal[i] is not None:
                    unit[self.normal[i]] -= mu[i] if side[i] == UPPER else -mu[i]
                    rows.append(unit + [F(0)])
                else:
                    rows.append(unit + [lo[i] if side[i] == LOWER else hi[i]])
            found = eliminated(rows)
            if found is None:
                continue
            # Entries that the equations leave open keep their value.
            pivots, rows = found
            x = list(self.x)
            for k, c in enumerate(pivots):
                x[c] = rows[k][-1] - sum((rows[k][j] * x[j] for j in range(self.n) if j not in pivots), F(0))
            if is_solution(A, b, lo, hi, mu, self.normal, x):
                return x, motion and motion_of(motion, x)
        raise AssertionError("no solution next to this one")

    def quotient(self, d, sign):
        x, u = self.solved(d, sign * H)
        x0, u0 = self.x, self.motion and motion_of(self.motion, self.x)
        slope = lambda new, old: [sign * (a - b) / H for a, b in zip(new, old)]
        return slope(x, x0), u and slope(u, u0)


def inverse_times(M, columns):
    """M^-1 times each column."""
    _, rows = eliminated([row + [c[i] for c in columns] + [F(0)] for i, row in enumerate(M)])
    return [[row[len(M) + k] for row in rows] for k in range(len(columns))]


def delassus(M, J, bias, gamma, target):
    G = inverse_times(M, J)
    A = [[sum(a * g for a, g in zip(row, column)) for column in G] for row in J]
    for i, g in enumerate(gamma):
        A[i][i] += g
    return A, [a + c for a, c in zip(product(J, target), bias)]


def motion_of(motion, x):
    M, J, _, _, target = motion
    (g,) = inverse_times(M, [product(list(zip(*J)), x)])
    return [a + c for a, c in zip(target, g)]


def is_solution(A, b, lo, hi, mu, normal, x):
    for i, w in enumerate(a + c for a, c in zip(product(A, x), b)):
        low, high = (lo[i], hi[i]) if normal[i] is None else (-mu[i] * max(x[normal[i]], F(0)), mu[i] * max(x[normal[i]], F(0)))
        if (low is not None and x[i] < low) or (high is not None and x[i] > high):
            return False
        if (w > 0 and x[i] != low) or (w < 0 and x[i] != high):
            return False
    return True


def drawn(draw, kind):
    """A problem: contacts and boxes, friction, welds, kinks, or bodies."""
    small = lambda most=8: F(draw.randint(-most, most), 4)
    n, normal, mu = draw.randint(1, 7), [], []
    has_friction = kind in ("friction", "kinks") and draw.random() < 0.8
    if has_friction:
        n = 3 * draw.randint(1, 2) + draw.randint(0, 1)
    for i in range(n):
        is_tangent = has_friction and i % 3 and i // 3 < n // 3
        normal.append(i - i % 3 if is_tangent else None)
        mu.append(F(draw.randint(1, 3), 8) if is_tangent else F(0))
    motion = None
    if kind in ("bodies", "redundant"):
        k = draw.randint(2, 4)
        M = [[F(2 ** draw.randint(-1, 2)) if i == j else F(0) for j in range(k)] for i in range(k)]
        J = [[F(draw.randint(-2, 2)) for _ in range(k)] for _ in range(min(n, k - 1))]
        J = [row if any(row) else [F(1)] * k for row in J]
        gamma = [F(draw.randint(1, 4), 4) if kind == "bodies" else F(0) for _ in J]
        if kind == "redundant":
            # A row that is listed twice, and the sum of two.
            J += [[2 * v for v in J[0]], [a + c for a, c in zip(J[0], J[-1])]]
            gamma += [F(0), F(0)]
        n = len(J)
        normal, mu = [None] * n, [F(0)] * n
        motion = [M, J, None, gamma, [small() for _ in range(k)]]
        A = delassus(M, J, [F(0)] * n, gamma, motion[4])[0]
    elif kind == "friction" or draw.random() < 0.3:
        # Not symmetric; the diagonal dominates.
        A = [[F(0) if i == j else F(draw.randint(-2, 2), 4) for j in range(n)] for i in range(n)]
        for i in range(n):
            A[i][i] = sum(map(abs, A[i]), F(2))
    else:
        G = [[small(4) for _ in range(n)] for _ in range(n)]
        A = [[sum(a * c for a, c in zip(p, q)) + (i == j) for j, q in enumerate(G)] for i, p in enumerate(G)]
        if has_friction:
            for i in range(n):
                A[i][i] += sum(map(abs, A[i]), F(0))
    x, w, sides, lo, hi = [], [], [], [], []
    for i in range(n):
        side = draw.choice([FREE, FREE, LOWER, UPPER] + [WEAK_LOWER, WEAK_UPPER] * (kind == "kinks"))
        size, push = F(draw.randint(1, 8), 4), F(draw.randint(1, 8), 4)
        if normal[i] is not None:
            limit = mu[i] * x[normal[i]]
            if limit == 0:
                # Open, or about to close: the tangents slide in one direction, or do not slip.
                is_about_to_close = sides[normal[i]] == WEAK_LOWER
                side = WEAK_BOTH if is_about_to_close and draw.random() < 0.5 else LOWER if side % 2 else UPPER
            value = {FREE: limit * F(draw.randint(-3, 3), 4), LOWER: -limit, UPPER: limit, WEAK_BOTH: F(0)}[CHOICES.get(side, (side,))[0] if side != WEAK_BOTH else side]
            low = high = None
        else:
            low, high = draw.choice([(F(0), None), (F(0), None), (-size, size), (None, None), (size, size)])
            if kind == "redundant":
                low, high = draw.choice([(F(0), None), (None, None)]) if i < n - 1 else (F(0), None)
            if has_friction and i % 3 == 0 and i // 3 < n // 3:
                low, high = F(0), draw.choice([None, size])
            if low is None or (low == high and side >= WEAK_LOWER):
                side = FREE if low is None else LOWER
            if low == high and low is not None:
                side = draw.choice([LOWER, UPPER])
            if high is None and side in (UPPER, WEAK_UPPER):
                side -= 1  # the lower bound instead
            inside = size if high is None else low + (high - low) * F(draw.randint(1, 3), 4) if low is not None else small()
            value = {FREE: inside, LOWER: low, UPPER: high}[CHOICES.get(side, (side,))[0]]
        x.append(value)
        sides.append(side)
        lo.append(low)
        hi.append(high)
        w.append({LOWER: push, UPPER: -push}.get(side, F(0)))
    case = Case(A, x, w, sides, lo, hi, normal, mu)
    if motion:
        motion[2] = [b - c for b, c in zip(case.b, product(motion[1], motion[4]))]
        case.motion = motion
    return case


def direction(draw, case, kind):
    """A change of all data that may change."""
    n, small = case.n, lambda: F(draw.randint(-4, 4), 4)
    if kind == "redundant":
        k = len(case.motion[4])
        return {"target": [small() for _ in range(k)], "mass": {(i, i): F(draw.randint(-1, 1), 8) for i in range(k)}}
    d = {"b": [small() for _ in range(n)]}
    if case.motion:
        k = len(case.motion[4])
        d |= {"target": [small() for _ in range(k)], "bias": [small() for _ in range(n)]}
        d |= {"compliance": [small() for _ in range(n)], "mass": {(0, 0): F(1, 8), (0, 1): F(1, 8)}}
        d["jacobian"] = {(draw.randrange(n), draw.randrange(k)): small() for _ in range(2)}
        return d
    d["A"] = {(draw.randrange(n), draw.randrange(n)): small() for _ in range(n)}
    if any(k is not None for k in case.normal):
        d["mu"] = [small() if k is not None else F(0) for k in case.normal]
    normals = {k for k in case.normal if k is not None}
    bound = lambda v, i: F(0) if v is None or i in normals else small()
    d["lo"], d["hi"] = ([bound(v, i) for i, v in enumerate(side)] for side in (case.lo, case.hi))
    for i in range(n):
        if case.lo[i] == case.hi[i]:
            d["hi"][i] = d["lo"][i]
    return d


def written(d):
    entries = lambda v: [[i, j, float(a)] for (i, j), a in v.items()]
    return {key: entries(v) if isinstance(v, dict) else list(map(float, v)) for key, v in d.items()}


def differences(case, kind, d, found):
    """What is wrong with the program's answer."""
    near = lambda a, b, part: all(abs(F(p) - q) <= part * (1 + max(map(abs, b), default=0)) for p, q in zip(a, b)) and len(a) == len(b)
    weak = [i for i, s in enumerate(case.sides) if s >= WEAK_LOWER]
    status = "not_unique" if kind == "redundant" and is_singular(case) else "kink" if weak else "differentiable"
    if found["status"] != status or found["kinks"] != (weak if status == "kink" else []):
        return [f"status {found['status']} {found['kinks']}, not {status} {weak}"]
    wrong = []
    for sign, side in ((1, "right"), (-1, "left")):
        dx, du = case.quotient(d, sign)
        if status != "not_unique" and not near(found[side]["dx"], dx, F(1, 10**6)):
            wrong.append(f"{side}: dx {found[side]['dx']}, not {list(map(float, dx))}")
        if du and not near(found[side]["du"], du, F(1, 10**6)):
            wrong.append(f"{side}: du {found[side]['du']}, not {list(map(float, du))}")
        if status == "not_unique":
            continue
        table = found.get(f"dx_db_{side}") or found.get("dx_db")
        for j in range(case.n):
            column, _ = case.quotient({"b": [F(int(i == j)) for i in range(case.n)]}, sign)
            if not near([row[j] for row in table], column, F(1, 10**14)):
                wrong.append(f"{side}: column {j} {[row[j] for row in table]}, not {list(map(float, column))}")
    return wrong + (adjoint(case, d, found["gradient_of_x"]["0"]) if "gradient_of_x" in found else [])


def adjoint(case, d, gradient):
    """The gradient of x_0 times the direction is the change of x_0."""
    total = F(0)
    for key, change in d.items():
        own = gradient[key] if key in gradient else gradient["motion"][key]
        if isinstance(change, dict):
            total += sum((F(own[i][j]) * v for (i, j), v in change.items()), F(0))
        else:
            total += sum((F(g) * v for g, v in zip(own, change)), F(0))
    known = case.quotient(d, 1)[0][0]
    size = 1 + abs(known) + sum((abs(F(g)) for g in gradient["b"]), F(0))
    return [] if abs(total - known) <= size / 10**5 else [f"gradient of x_0: {float(total)}, not {float(known)}"]


def is_singular(case):
    free = [i for i, s in enumerate(case.sides) if s == FREE]
    if not free:
        return False
    pivots, _ = eliminated([[case.A[i][j] for j in free] + [F(0)] for i in free])
    return len(pivots) < len(free)


def main(program, number=1000):
    draw, seen, bad = random.Random(59), Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        file, answer, change = (Path(folder, name) for name in ("problem.json", "answer.json", "change.json"))
        for k in range(int(number)):
            kind = ["boxes", "friction", "kinks", "bodies", "redundant"][k % 5]
            case = drawn(draw, kind)
            d = direction(draw, case, kind)
            file.write_text(json.dumps(case.data()))
            answer.write_text(json.dumps({"x": list(map(float, case.x))}))
            change.write_text(json.dumps(written(d)))
            command = [program, "gradient", file, answer, "--direction", change, "--json"]
            is_smooth = all(s < WEAK_LOWER for s in case.sides) and not (kind == "redundant" and is_singular(case))
            run = subprocess.run(command + ["--row", "0"] * is_smooth, capture_output=True, text=True)
            wrong = [run.stderr.strip()] if run.returncode else differences(case, kind, d, found := json.loads(run.stdout))
            seen[found["status"] if not run.returncode else "error"] += 1
            if wrong:
                bad += 1
                print(f"{k}, {kind}: {wrong}")
    print(f"{number} problems: {dict(seen)}; {bad} differ")
    return bool(bad)


def self_test():
    """The checks find a reversed sign, a wrong column, a kink that is not reported, and a wrong adjoint."""
    case = Case([[F(2), F(0)], [F(0), F(2)]], [F(1), F(0)], [F(0), F(0)], [FREE, WEAK_LOWER], [F(0)] * 2, [None] * 2, [None] * 2, [F(0)] * 2)
    d = {"b": [F(1), F(1)]}
    right = [[-0.5, 0.0], [0.0, 0.0]]
    left = [[-0.5, 0.0], [0.0, -0.5]]
    good = {"status": "kink", "kinks": [1], "right": {"dx": [-0.5, 0.0]}, "left": {"dx": [-0.5, -0.5]}, "dx_db_right": right, "dx_db_left": left}
    assert differences(case, "kinks", d, good) == []
    assert differences(case, "kinks", d, good | {"right": {"dx": [0.5, 0.0]}})
    assert differences(case, "kinks", d, good | {"left": {"dx": [-0.5, 0.0]}})
    assert differences(case, "kinks", d, good | {"dx_db_left": right})
    assert differences(case, "kinks", d, good | {"status": "differentiable", "kinks": []})
    assert adjoint(case, d, {"b": [-0.5, 0.0]}) == [] and adjoint(case, d, {"b": [0.5, 0.0]})
    print("self-test passed")


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else main(*sys.argv[1:]))

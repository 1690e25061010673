"""Checks claims about friction cones without the boxes that prove them: by the zero itself, to 400 bits.

    cargo run -p lcplab-proof --example cone_proofs -- 1000 | python3 cone_proofs.py     # or files of such lines
    python3 cone_proofs.py --self-test

Of a proof it reads the claim only: the states, the center and radius of each entry, the answer with its distance, and how much the bias may
differ. From the center, Newton's method in 125 decimal digits finds a point that obeys the law, written with square roots,

    w_n = 0, or w_n = mu |w_t| (associated);   x_t |w_t| + mu x_n w_t = 0           with  w = A x + b,  A = (a_ij) of the file
                                                            or, of bodies,          w = J u + bias + gamma x,  M (u - u*) = J' x

where redundant rows keep their x, and their equations are left out. Then every row of the point must obey the law as the problem states it, redundant rows too, to 60 digits;
the point must lie in the box, and each entry of the answer within the distance. One contact with a diagonal A has a closed form,
which must be the point. The point of a proof of kind solution is judged in fractions, and a bound on the motion with a closed form.
"""
import json
import sys
from decimal import Decimal, getcontext
from fractions import Fraction as Q

getcontext().prec = 125
TINY = Decimal("1e-60")


def dec(q):
    q = Q(q)
    return Decimal(q.numerator) / Decimal(q.denominator)


def norm(p, q):
    return (p * p + q * q).sqrt()


def solve(rows, right):
    """rows y = right, by elimination with row exchanges; rows are {column: value}. None if singular."""
    rows, n = [dict(row) | {-1: value} for row, value in zip(rows, right)], len(rows)
    size = [max([abs(v) for k, v in row.items() if k >= 0], default=0) for row in rows]
    for c in range(n):
        p = max(range(c, n), key=lambda i: abs(rows[i].get(c, 0)) / (size[i] or 1))
        if not rows[p].get(c):
            return None
        rows[c], rows[p], size[c], size[p] = rows[p], rows[c], size[p], size[c]
        for row in rows[c + 1:]:
            factor = row.pop(c, 0)
            if factor:
                factor /= rows[c][c]
                for k, v in rows[c].items():
                    if k != c:
                        row[k] = row.get(k, 0) - factor * v
    out = [Decimal(0)] * n
    for i in reversed(range(n)):
        rest = sum(v * out[k] for k, v in rows[i].items() if k > i)
        out[i] = (rows[i].get(-1, 0) - rest) / rows[i][i]
    return out


class Problem:
    """w = A z + b with z = x, or z = (x, u) of the bodies; all numbers exact."""

    def __init__(self, data, of_bodies):
        self.n = n = len(data["b"])
        self.law, owners = data["model"], data["friction_index"]
        self.A = [{} for _ in range(n)]
        if "dense" in data["A"]:
            entries = [(i, j, v) for i, row in enumerate(data["A"]["dense"]) for j, v in enumerate(row)]
        else:
            entries = data["A"]["triplets"]
        for i, j, v in entries:
            if v:
                self.A[i][j] = self.A[i].get(j, 0) + Q(v)
        self.b = [Q(v) for v in data["b"]]
        if of_bodies:
            self.of_bodies(data["motion"])
        self.contacts = [(k, *[i for i in range(n) if owners[i] == k]) for k in range(n) if k in owners]
        self.mu = {k: Q(data["mu"][t]) for k, t, _ in self.contacts}
        assert len(self.contacts) * 3 == n, "every row must belong to a contact"

    def of_bodies(self, motion):
        target, n = [Q(v) for v in motion["target"]], self.n
        self.b = [Q(v) for v in motion["bias"]] + [Q(0)] * len(target)
        self.A = [{i: Q(v)} if v else {} for i, v in enumerate(motion["compliance"])] + [{} for _ in target]
        for i, j, v in motion["jacobian"]:
            self.A[i][n + j], self.A[n + j][i] = Q(v), -Q(v)
        for i, j, v in motion["mass"]:
            for p, q in {(i, j), (j, i)}:
                self.A[n + p][n + q] = Q(v)
                self.b[n + p] -= Q(v) * target[q]

    def decimals(self):
        return [{j: dec(v) for j, v in row.items()} for row in self.A], [dec(v) for v in self.b]

    def zero(self, start, states, given):
        """The zero of the equations of these states near the start, by Newton's method; given rows keep their values."""
        A, b, z = *self.decimals(), list(start)
        size, last = max(map(abs, z), default=Decimal(0)) or Decimal(1), None
        for _ in range(60):
            w = [sum((a * z[j] for j, a in row.items()), b[i]) for i, row in enumerate(A)]
            rows = {i: (w[i], A[i]) for i in range(self.n, len(z))}
            for k, t1, t2 in self.contacts:
                mu = dec(self.mu[k])
                if states[k] == "sticks" or states[k] == "slides" and not mu:
                    rows.update({i: (w[i], A[i]) for i in ((k, t1, t2) if mu else (k,))})
                elif states[k] == "slides":
                    slip = norm(w[t1], w[t2])
                    if not slip:
                        return None
                    columns, lift = {*A[t1], *A[t2]}, mu if self.law == "associated-cone" else 0
                    grow = {j: (w[t1] * A[t1].get(j, 0) + w[t2] * A[t2].get(j, 0)) / slip for j in columns}
                    rows[k] = w[k] - lift * slip, {j: A[k].get(j, 0) - lift * grow.get(j, 0) for j in {*A[k], *columns}}
                    for t in (t1, t2):
                        slope = {j: z[t] * grow[j] + mu * z[k] * A[t].get(j, 0) for j in columns}
                        slope[t] = slope.get(t, 0) + slip
                        slope[k] = slope.get(k, 0) + mu * w[t]
                        rows[t] = z[t] * slip + mu * z[k] * w[t], slope
            unknown = [i for i in sorted(rows) if i not in given]
            position = {i: p for p, i in enumerate(unknown)}
            slopes = [{position[j]: v for j, v in rows[i][1].items() if j in position} for i in unknown]
            step = solve(slopes, [rows[i][0] for i in unknown])
            if step is None:
                return None
            for i, d in zip(unknown, step):
                z[i] -= d
            longest = max(map(abs, step), default=Decimal(0))
            if longest <= size * Decimal("1e-110") or last is not None and longest <= size * Decimal("1e-95") and longest >= last:
                return z
            last = longest
        return None

    def broken(self, z, bias_change, redundant):
        """The first row that violates the law at z by more than TINY of its terms, or None."""
        A, b = self.decimals()
        w = [sum((a * z[j] for j, a in row.items()), b[i]) for i, row in enumerate(A)]
        load = [sum((abs(a * z[j]) for j, a in row.items()), abs(b[i])) for i, row in enumerate(A)]
        slack = [TINY * v + (dec(bias_change) if i in redundant else 0) for i, v in enumerate(load)]
        for i in range(self.n, len(z)):
            if abs(w[i]) > slack[i]:
                return i
        small = TINY * max(map(abs, z[:self.n]), default=Decimal(0))
        for k, t1, t2 in self.contacts:
            mu, friction, slip = dec(self.mu[k]), norm(z[t1], z[t2]), norm(w[t1], w[t2])
            rest = slack[t1] + slack[t2]
            lift = w[k] - (mu * slip if self.law == "associated-cone" else 0)
            more = slack[k] + mu * rest
            if z[k] < -small or friction > mu * z[k] + small * (1 + mu) or lift < -more or z[k] > small and lift > more:
                return k
            # x_t = -mu x_n w_t / |w_t|, up to what the slack of w changes in the direction
            if slip > rest and norm(*(z[t] + mu * z[k] * w[t] / slip for t in (t1, t2))) > small * (1 + mu) + 4 * mu * z[k] * rest / slip:
                return t1
        return None

    def closed_form(self):
        """The solution of one contact whose A is diagonal, alike along both tangents, or None."""
        if len(self.contacts) != 1 or len(self.b) != 3:
            return None
        (n, t1, t2), = self.contacts
        if any(len(row) != 1 or i not in row for i, row in enumerate(self.A)) or self.A[t1][t1] != self.A[t2][t2]:
            return None
        a, c, mu = dec(self.A[n][n]), dec(self.A[t1][t1]), dec(self.mu[n])
        b = [dec(v) for v in self.b]
        if a <= 0 or c <= 0:
            return None
        push, normal, x = norm(b[t1], b[t2]), max(-b[n] / a, Decimal(0)), [Decimal(0)] * 3
        if push <= mu * normal * c:
            x[n], x[t1], x[t2] = normal, -b[t1] / c, -b[t2] / c
            return x
        if self.law == "associated-cone":
            normal = max((mu * push - b[n]) / (a + mu * mu * c), Decimal(0))
        x[n], x[t1], x[t2] = normal, -mu * normal * b[t1] / push, -mu * normal * b[t2] / push
        return x


def point(data, lo):
    """The fractions of a point; only normals have a bound, which is 0."""
    d = int(data["denominator"], 16)
    return [Q(0) if v == "lo" else Q(int(v, 16), d) for v in data["numerators"]], d


def wrong(record):
    """What is false about the claim of a record; None if nothing is."""
    proof = record["proof"]
    kind = proof["kind"]
    problem = Problem(record["problem"], kind == "body-solution")
    if kind == "motion":
        return wrong_motion(record["problem"], proof)
    if kind == "no-solution":
        return "no solution exists" if problem.closed_form() is not None else None
    answer, distance = proof.get("answer"), proof.get("distance")
    if kind == "solution":
        x, _ = point(proof["x"], 0)
        if rational_break(problem, x) is not None:
            return f"the contact of row {rational_break(problem, x)} breaks its law"
        z = [dec(v) for v in x]
    else:
        center, d = point(proof["center"], 0)
        radius = [Q(int(r, 16), d) for r in proof["radius"]]
        redundant = {int(i) for i in proof.get("redundant", {})}
        given = {i for i in range(problem.n) if not radius[i]}
        z = problem.zero([dec(c) for c in center], proof["states"], given)
        if z is None:
            return "there is no zero near the center"
        row = problem.broken(z, proof.get("bias_change", 0), redundant)
        if row is not None:
            return f"the zero violates row {row}"
        size = max(map(abs, z))
        outside = [i for i, (v, c, r) in enumerate(zip(z, center, radius)) if abs(v - dec(c)) > dec(r) + size * Decimal("1e-90")]
        if outside:
            return f"the zero is outside the box in row {outside[0]}"
    truth = problem.closed_form()
    if truth is not None and any(abs(p - q) > Decimal("1e-50") * max(map(abs, truth)) for p, q in zip(z, truth)):
        return "the closed form is another"
    if answer is not None and any(abs(dec(v) - y) > dec(distance) + TINY * max(map(abs, z)) for v, y in zip(answer, z)):
        return "the answer is farther away"
    return None


def wrong_motion(data, proof):
    """What is false about a bound on the motion of a body on contacts with one normal, under the law of the associated cone.

    Its exact motion is a translation: it stops if |u*_t| <= mu |u*_n|, otherwise N = m (mu |u*_t| - u*_n) / (1 + mu^2) with friction mu N.
    """
    motion, mu = data["motion"], dec(data["mu"][1])
    if any(motion["bias"]) or any(motion["compliance"]):
        return None
    weights, target = [dec(m) for _, _, m in motion["mass"]], [dec(v) for v in motion["target"]]
    push, fall = norm(target[0], target[1]), -target[2]
    exact = [Decimal(0)] * 6
    if push > mu * fall:
        normal = (mu * push + fall) / (1 + mu * mu)
        exact = [v * (1 - mu * normal / push) for v in target[:2]] + [normal - fall] + exact[3:]
    u = list(target)
    for i, j, v in motion["jacobian"]:
        u[j] += dec(v) * dec(proof["answer"][i]) / weights[j]
    error = sum(m * (p - q) ** 2 for m, p, q in zip(weights, u, exact)).sqrt()
    scale = sum(m * q * q for m, q in zip(weights, target)).sqrt()
    # The rows of J are rounded, so the closed form holds to about 15 digits.
    return "the motion is farther away" if error > dec(proof["bound"]) + scale * Decimal("1e-14") else None


def rational_break(problem, x):
    """The first contact that breaks its law at a rational point, or None."""
    w = [sum((a * x[j] for j, a in row.items()), b) for row, b in zip(problem.A, problem.b)]
    for k, t1, t2 in problem.contacts:
        mu, power = problem.mu[k], x[t1] * w[t1] + x[t2] * w[t2]
        friction, slip, limit = x[t1] ** 2 + x[t2] ** 2, w[t1] ** 2 + w[t2] ** 2, (problem.mu[k] * x[k]) ** 2
        if x[k] < 0 or friction > limit or w[k] < 0:
            return k
        if problem.law == "associated-cone":
            holds = w[k] ** 2 >= mu * mu * slip and x[k] * w[k] + power == 0
        else:
            holds = (not x[k] or not w[k]) and (not slip or friction == limit and x[t1] * w[t2] == x[t2] * w[t1] and power <= 0)
        if not holds:
            return k
    return None


def self_test():
    """A block of 1 kg on two equal contacts: a true claim, and false ones that must be found."""
    rows = [[1, 0, 0], [0, 1, 0], [0, 0, 1]] * 2
    motion = {"mass": [[i, i, 1.0] for i in range(3)], "bias": [0.0] * 6, "compliance": [0.0] * 6, "target": [-2.0, -3.0, -4.0],
              "jacobian": [[i, j, float(v)] for i, row in enumerate(rows) for j, v in enumerate(row) if v]}
    problem = {"A": {"dense": [[float(p == q) for q in (0, 1, 2, 0, 1, 2)] for p in (0, 1, 2, 0, 1, 2)]}, "b": [-2.0, -3.0, -4.0] * 2,
               "friction_index": [-1, 0, 0, -1, 3, 3], "mu": [0, 0.5, 0.5, 0, 0.5, 0.5], "model": "coulomb-cone", "motion": motion}
    x = [0.5, 0.15, 0.2, 1.5, 0.45, 0.6]
    numerators = [format(round(v * 10**6), "x") for v in x + [0, 2.4, 3.2]]
    numerators[7:] = ["-" + v for v in numerators[7:]]
    proof = {"kind": "body-solution", "states": ["slides"] * 6 + ["free"] * 3, "center": {"denominator": format(10**6, "x"), "numerators": numerators},
             "radius": ["1", "1", "1", "0"] + ["1"] * 5, "redundant": {"3": {"0": "1", "3": "-1"}}, "answer": x, "distance": 1e-12}
    other = lambda **keys: wrong({"problem": problem, "proof": proof | keys})
    assert other() is None, other()
    false = [other(answer=[0.5 + 1e-11] + x[1:]), other(states=["sticks"] * 3 + ["slides"] * 3 + ["free"] * 3), other(center={"denominator": "1", "numerators": ["0"] * 9}),
             wrong({"problem": problem | {"motion": motion | {"bias": [0, 0, 0, 1e-3, 0, 0]}}, "proof": proof}),
             wrong({"problem": problem | {"motion": motion | {"target": [-2.001, -3, -4]}}, "proof": proof}),
             wrong({"problem": problem | {"model": "associated-cone"}, "proof": proof})]
    assert all(false), false
    print(f"self-test: 1 true claim accepted, {len(false)} false ones found")
    return 0


def main(names):
    if names == ["--self-test"]:
        return self_test()
    counts, false = {}, 0
    for source in [open(name) for name in names] or [sys.stdin]:
        for line in source:
            record = json.loads(line)
            what = wrong(record)
            kind = record["proof"]["kind"] + (", changed bias" if record["proof"].get("bias_change") else "")
            counts[kind] = counts.get(kind, 0) + 1
            if what is not None:
                false += 1
                print(f"FALSE: {what}: {line[:20000]}")
    print(f"{sum(counts.values())} claims ({', '.join(f'{kind}: {count}' for kind, count in sorted(counts.items()))}), {false} false")
    return 1 if false else 0 if counts else 2


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/env python3
"""Checks proofs about linear complementarity problems. Written from docs/proofs.md alone; calculates with integers.

    lcpcheck.py PROBLEM PROOF      one proof: prints what it proves, or why it is refused
    lcpcheck.py FOLDER             every *.proof.json of a folder, about the problem of its hash in another *.json

Exit code: 0 if every proof proves its claim, 1 if one is refused, 2 if a problem cannot be read.
"""
import hashlib, json, re, struct, sys
from fractions import Fraction as Q
from itertools import combinations
from pathlib import Path

INF, INTEGER = float("inf"), re.compile(r"0|-?[1-9a-f][0-9a-f]*")
KEYS = {"solution": [{"x"}, {"x", "answer", "distance"}], "unique": [{"x", "by"}], "not-unique": [{"x", "y"}],
        "no-solution": [{"tree"}], "within": [{"answer", "residual"}],
        "motion": [{"answer", "motion", "bound"}], "frozen-motion": [{"answer", "motion", "bound"}]}


class Refused(Exception):
    pass


def need(holds, reason):
    if not holds:
        raise Refused(reason)


def number(v):
    need(type(v) in (int, float) and abs(v) < INF, "a number")
    return float(v) + 0.0


def integer(v):
    need(type(v) is str and INTEGER.fullmatch(v) is not None, "an integer")
    return int(v, 16)


def entries(v, n):
    need(type(v) is list and len(v) == n, "a list of another length")
    return v


def whole(values):
    """Integers and s: the floats times 2^s."""
    ratios = [v.as_integer_ratio() for v in values]
    s = max((q.bit_length() for _, q in ratios), default=1)
    return [p << s - q.bit_length() for p, q in ratios], s - 1


def only_once(pairs):
    need(len(dict(pairs)) == len(pairs), "a key twice")
    return dict(pairs)


def read(path):
    return json.loads(path.read_text(encoding="utf-8"), object_pairs_hook=only_once)


def sparse(triplets, rows, columns):
    """The rows of a matrix, each {column: value} by rising column, without zeros."""
    need(all(type(i) is type(j) is int and 0 <= i < rows and 0 <= j < columns for i, j, _ in triplets), "a triplet")
    need(len({(i, j) for i, j, _ in triplets}) == len(triplets), "two triplets at one place")
    matrix = [{} for _ in range(rows)]
    for i, j, v in sorted(triplets):
        if number(v):
            matrix[i][j] = number(v)
    return matrix


def packed(matrix):
    return b"".join(struct.pack(">I", len(row)) + b"".join(struct.pack(">Id", j, v) for j, v in row.items()) for row in matrix)


class Problem:
    def __init__(self, data):
        b, a = [number(v) for v in data["b"]], data["A"]
        n = self.n = len(b)
        if "dense" in a:
            triplets = [(i, j, v) for i, row in enumerate(entries(a["dense"], n)) for j, v in enumerate(entries(row, n))]
        else:
            need(a["rows"] == a["cols"] == n, "A has another size")
            triplets = a["triplets"]
        rows = sparse(triplets, n, n)
        index, mu = entries(data.get("friction_index", [-1] * n), n), entries(data.get("mu", [0] * n), n)
        self.owner = [k if k >= 0 else None for k in index]
        bound = lambda v: {"inf": INF, "-inf": -INF}[v] if type(v) is str else number(v)
        self.lo = [bound(v) for v in entries(data.get("lo", [0 if k is None else "-inf" for k in self.owner]), n)]
        self.hi = [bound(v) for v in entries(data.get("hi", ["inf"] * n), n)]
        self.scale = number(data.get("scale", 0))
        need(self.scale > 0 or "scale" not in data, "scale")
        need("mu" in data or all(k is None for k in self.owner), "mu")
        mu = [0.0 if k is None else number(m) for k, m in zip(self.owner, mu)]
        for i, k in enumerate(self.owner):
            need(self.lo[i] <= self.hi[i] and self.lo[i] < INF and self.hi[i] > -INF, f"the bounds of row {i}")
            need(k is None or type(k) is int and k < n and self.owner[k] is None and self.lo[k] >= 0 and mu[i] >= 0
                 and (self.lo[i], self.hi[i]) == (-INF, INF), f"the friction of row {i}")
        # All numbers times 2^s are integers; None for an infinite bound.
        both = self.lo + self.hi
        ints, self.s = whole([v for row in rows for v in row.values()] + b + mu + [v if abs(v) < INF else 0.0 for v in both])
        ints = iter(ints)
        self.A = [[(j, next(ints)) for j in row] for row in rows]
        self.B, self.mu = [next(ints) for _ in b], [next(ints) for _ in mu]
        ends = [v if abs(end) < INF else None for v, end in zip(ints, both)]
        self.ends = list(zip(ends[:n], ends[n:]))
        h = hashlib.sha256(b"lcplab problem 1\n" + struct.pack(">Id", n, self.scale) + packed(rows))
        h.update(struct.pack(f">{3 * n}d", *b, *self.lo, *self.hi))
        h.update(b"".join(struct.pack(">Id", 0 if k is None else k + 1, m) for k, m in zip(self.owner, mu)))
        h.update(self.bodies(data["motion"]) if "motion" in data else bytes(4))
        self.hash = h.hexdigest()

    def bodies(self, data):
        """Reads the key motion; its canonical bytes."""
        need(type(data) is dict and set(data) == {"mass", "jacobian", "bias", "compliance", "target"}, "motion")
        target, k = [number(v) for v in data["target"]], len(data["target"])
        bias, soft = ([number(v) for v in entries(data[key], self.n)] for key in ("bias", "compliance"))
        mass, jacobian = sparse(data["mass"], k, k), sparse(data["jacobian"], self.n, k)
        need(all(v >= 0 for v in soft) and all(j >= i for i, j, _ in data["mass"]), "compliance and mass")
        self.motion = [[{j: Q(v) for j, v in row.items()} for row in matrix] for matrix in (mass, jacobian)]
        self.motion += [[Q(v) for v in values] for values in (bias, soft, target)]
        return struct.pack(">II", 1, k) + packed(mass) + packed(jacobian) + struct.pack(f">{2 * self.n + k}d", *bias, *soft, *target)

    def point(self, data):
        """(X, D): x times D, both integers."""
        need(type(data) is dict and set(data) == {"denominator", "numerators"}, "a point")
        d, given, X = integer(data["denominator"]), entries(data["numerators"], self.n), [0] * self.n
        need(d > 0, "a denominator")
        for i in sorted(range(self.n), key=lambda i: self.owner[i] is not None):
            if given[i] not in ("lo", "hi"):
                X[i] = integer(given[i]) << 2 * self.s
            elif self.owner[i] is None:
                end = self.ends[i][given[i] == "hi"]
                need(end is not None, f"row {i} has no such bound")
                X[i] = end * d << self.s
            else:
                X[i] = (self.mu[i] * max(X[self.owner[i]], 0) >> self.s) * (1 if given[i] == "hi" else -1)
        return X, d << 2 * self.s

    def solution(self, data):
        """The point of a proof, which must be a solution."""
        X, D = self.point(data)
        for i, (row, b, k) in enumerate(zip(self.A, self.B, self.owner)):
            w, x = sum([a * X[j] for j, a in row]) + b * D, X[i] << self.s
            if k is None:
                lo, hi = (None if end is None else end * D for end in self.ends[i])
            else:
                hi = self.mu[i] * max(X[k], 0)
                lo = -hi
            need((lo is None or lo <= x) and (hi is None or x <= hi), f"x of row {i} is beyond a bound")
            need((w <= 0 or x == lo) and (w >= 0 or x == hi), f"w of row {i} has the wrong sign")
        return X, D

    def unique(self, by):
        need(all(k is None for k in self.owner), "rows are coupled")
        full = [dict(row) for row in self.A]
        if by == "definite":
            need(self.n <= 500, "more than 500 rows")
            need(positive([[row.get(j, 0) + full[j].get(i, 0) for j in range(self.n)] for i, row in enumerate(full)]),
                 "A + A' is not positive definite")
        else:
            need(by == "p-matrix" and self.n <= 12, "more than 12 rows")
            for rows in (rows for size in range(1, self.n + 1) for rows in combinations(range(self.n), size)):
                need(positive([[full[i].get(j, 0) for j in rows] for i in rows]), f"the minor of the rows {rows}")

    def tree(self, data, sides):
        need(type(data) is dict, "a tree")
        if set(data) == {"d"}:
            return self.leaf(data["d"], sides)
        i = data.get("row")
        need(type(i) is int and 0 <= i < self.n and i not in sides, "a branch")
        there = {"free"} | {side for side, end in zip(("lo", "hi"), self.ends[i]) if end is not None or self.owner[i] is not None}
        need(set(data) == {"row"} | there, f"the sides of row {i}")
        for side in there:
            self.tree(data[side], {**sides, i: side})

    def leaf(self, data, sides):
        c, total = [0] * self.n, 0              # c times 2^2s, the total times 2^3s
        need(type(data) is dict, "a d")
        for key, value in data.items():
            need(re.fullmatch(r"0|[1-9][0-9]*", key) is not None and int(key) < self.n, "a row of d")
            i, d = int(key), integer(value)
            side, bounded = sides.get(i), [self.owner[i] is not None or end is not None for end in self.ends[i]]
            need(d >= 0 or side in ("hi", "free") or side is None and not bounded[0], f"the sign of d in row {i}")
            need(d <= 0 or side in ("lo", "free") or side is None and not bounded[1], f"the sign of d in row {i}")
            for j, a in self.A[i]:
                c[j] += a * d << self.s
            total += self.B[i] * d << 2 * self.s
        for j, k in enumerate(self.owner):
            if k is not None:                   # c_j is a multiple of 2^s
                c[k] += self.mu[j] * {"lo": -c[j], "hi": c[j]}.get(sides.get(j), abs(c[j])) >> self.s
        for j, k in enumerate(self.owner):
            side = sides.get(j) if sides.get(j) in ("lo", "hi") else "hi" if c[j] > 0 else "lo"
            end = self.ends[j][side == "hi"]
            if k is None and c[j]:
                need(end is not None, f"nothing bounds the product in row {j}")
                total += c[j] * end
        need(total < 0, "the vector of a case shows nothing")

    def residual(self, x):
        """The scaled residual of an answer, as a fraction."""
        exact = lambda v: None if v is None else Q(v, 1 << self.s)
        x, least, w, T, s, reach = [Q(v) for v in x], Q(self.scale), [], [], [], []
        for i, (row, b) in enumerate(zip(self.A, self.B)):
            terms = [exact(a) * x[j] for j, a in row] + [exact(b)]
            size = exact(abs(dict(row).get(i, 0)) or max([abs(a) for _, a in row], default=0))
            w.append(sum(terms))
            T.append(max(sum(map(abs, terms)), size * least))
            s.append(size or Q(1))
            end = max((abs(end) for end in self.ends[i] if end is not None), default=0)
            reach.append(max(exact(end), least) if end else None)
        unit = lambda i, r: T[i] / s[i] if r is None else min(T[i] / s[i], r)
        worst = Q(0)
        for i, k in enumerate(self.owner):
            own, (lo, hi), r = x[i], map(exact, self.ends[i]), reach[i]
            if k is not None:
                mu = exact(self.mu[i])
                hi, r = mu * max(x[k], 0), mu * max(x[k], unit(k, reach[k])) or None
                lo = -hi
                own = next((end for end in (lo, hi) if abs(own - end) <= hi / 2**50), own)
            e = unit(i, r)
            target = own - (e * w[i] / T[i] if T[i] else 0)
            target = target if lo is None else max(target, lo)
            target = target if hi is None else min(target, hi)
            need(e > 0 or own == target, "the residual is not finite")
            worst = max(worst, abs(own - target) / e if own != target else Q(0))
        return worst

    def gap(self, x, data):
        """2 (P + D) of an answer and a motion, as a fraction."""
        mass, jacobian, bias, soft, target = self.motion
        need(type(data) is dict and set(data) == {"denominator", "numerators"}, "a motion")
        d, x, gap = integer(data["denominator"]), [Q(v) for v in x], Q(0)
        need(d > 0, "a denominator")
        v = [Q(integer(p), d) for p in entries(data["numerators"], len(target))]
        f, rows = [Q(0)] * len(v), [dict(row) for row in mass]
        for i, row in enumerate(mass):
            for j, m in row.items():
                f[i] += m * (v[j] - target[j])
                f[j] += m * (v[i] - target[i]) if i != j else 0
        for i, (row, k) in enumerate(zip(jacobian, self.owner)):
            lo, hi = (None if end is None else Q(end, 1 << self.s) for end in self.ends[i])
            if k is not None:
                hi = Q(self.mu[i], 1 << self.s) * max(x[k], 0)
                lo = -hi
            need((lo is None or lo <= x[i]) and (hi is None or x[i] <= hi), f"the answer of row {i} is beyond a bound")
            w = sum([a * v[j] for j, a in row.items()]) + bias[i] + soft[i] * x[i]
            end = lo if w > 0 else hi
            costs = [abs((x[i] - end) * w)] if end is not None else []
            costs += [w * w / (2 * soft[i])] if soft[i] else []
            need(costs or w == 0, f"the motion breaks row {i}")
            gap += 2 * min(costs) if w else 0
            for j, a in row.items():
                f[j] -= a * x[i]
        for c, row in enumerate(rows):          # M = L D L', and f becomes its L^-1 f
            need(row.get(c, 0) > 0, "the mass matrix is not positive definite")
            gap += f[c] ** 2 / row[c]
            for r in (r for r in row if r > c):
                f[r] -= row[r] / row[c] * f[c]
                for s in (s for s in row if s >= r):
                    rows[r][s] = rows[r].get(s, 0) - row[r] / row[c] * row[s]
        return gap


def positive(m):
    """Whether all leading principal minors of an integer matrix are positive: they are the pivots of Bareiss."""
    last = 1
    for c, own in enumerate(m):
        p = own[c]
        if p <= 0:
            return False
        for row in m[c + 1:]:
            f = row[c]
            row[c:] = [(v * p - f * t) // last for v, t in zip(row[c:], own[c:])]
        last = p
    return True


def check(problem, proof):
    """What a proof proves of a problem; Refused if it proves nothing."""
    need(type(proof) is dict and proof.get("format") == "lcplab-proof-1", "another format")
    kind = proof.get("kind")
    need(type(kind) is str and set(proof) - {"format", "problem", "kind"} in KEYS.get(kind, []), "the keys of its kind")
    need(proof.get("problem") == problem.hash, "it is about another problem")
    answer = [number(v) for v in entries(proof["answer"], problem.n)] if "answer" in proof else None
    if kind == "no-solution":
        problem.tree(proof["tree"], {})
        return "no solution exists"
    if kind == "within":
        given, own = proof["residual"], problem.residual(answer)
        need(type(given) is dict and set(given) == {"numerator", "denominator"}, "a fraction")
        p, q = integer(given["numerator"]), integer(given["denominator"])
        need(q > 0 and p * own.denominator == q * own.numerator, "the residual is another")
        return "the scaled residual of the answer is the fraction that it states"
    if kind in ("motion", "frozen-motion"):
        need((kind == "motion") == all(k is None for k in problem.owner), "the kind for rows that are coupled is another")
        need(hasattr(problem, "motion"), "the problem says nothing of bodies")
        bound = number(proof["bound"])
        need(bound >= 0 and problem.gap(answer, proof["motion"]) <= Q(bound) ** 2, "the motion shows a larger bound only")
        return f"the motion of the answer is within {bound} of the exact one" + ", with frozen friction" * (kind != "motion")
    X, D = problem.solution(proof["x"])
    if kind == "unique":
        problem.unique(proof["by"])
        return "exactly one solution exists"
    if kind == "not-unique":
        Y, E = problem.solution(proof["y"])
        need(any(x * E != y * D for x, y in zip(X, Y)), "both solutions are one")
        return "two different solutions exist"
    if answer is None:
        return "a solution exists"
    distance, (near, s) = number(proof["distance"]), whole(answer)
    p, q = distance.as_integer_ratio()
    need(all(abs(v * D - (x << s)) * q <= p * D << s for v, x in zip(near, X)), "the answer is farther away")
    return f"a solution exists within {distance} of the answer"


WRONG = (Refused, OSError, ValueError, LookupError, ArithmeticError, TypeError, AttributeError, RecursionError)


def main(arguments):
    folder = Path(arguments[0]) if len(arguments) == 1 else None
    if folder is not None and folder.is_dir():
        proofs = sorted(folder.glob("*.proof.json"))
        paths = sorted(set(folder.glob("*.json")) - set(proofs))
    elif len(arguments) == 2:
        paths, proofs = [[Path(argument)] for argument in arguments]
    else:
        print(__doc__)
        return 2
    problems, refused = {}, 0
    for path in paths:
        try:
            problem = Problem(read(path))
            problems[problem.hash] = problem
        except WRONG as error:
            print(f"{path}: cannot be read: {error!r}")
            return 2
    for path in proofs:
        try:
            proof = read(path)
            need(type(proof) is dict and type(proof.get("problem")) is str, "it is about no problem")
            need(proof["problem"] in problems, "it is about another problem")
            print(f"{path}: proved: {check(problems[proof['problem']], proof)}")
        except WRONG as error:
            refused += 1
            print(f"{path}: refused: {error}")
    if folder is not None:
        print(f"{len(proofs) - refused} of {len(proofs)} proofs prove their claims")
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

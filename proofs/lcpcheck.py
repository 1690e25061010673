#!/usr/bin/env python3
"""Checks proofs about linear complementarity problems: written from docs/proofs.md alone, integers only.

    lcpcheck.py PROBLEM PROOF      one proof; prints what it proves, or why it is refused
    lcpcheck.py FOLDER             every NAME.proof.json in a folder, about NAME.json beside it

Exit code: 0 if every proof proves its claim, 1 if one is refused, 2 if a problem cannot be read.
"""
import hashlib, json, re, struct, sys
from itertools import combinations
from fractions import Fraction as Q
from pathlib import Path

INF, INTEGER = float("inf"), re.compile(r"0|-?[1-9a-f][0-9a-f]*")
KEYS = {"solution": [{"x"}, {"x", "answer", "distance"}], "unique": [{"x", "by"}], "not-unique": [{"x", "y"}],
        "no-solution": [{"tree"}], "within": [{"answer", "residual"}]}


class Refused(Exception):
    pass


def need(holds, reason):
    if not holds:
        raise Refused(reason)


def exact(v, shift):
    """The float v times 2^shift, which must be an integer."""
    p, q = v.as_integer_ratio()
    return (p << shift) // q


def shift_of(values):
    """The least s for which all of these floats times 2^s are integers."""
    return max((v.as_integer_ratio()[1].bit_length() - 1 for v in values), default=0)


def number(v):
    need(type(v) in (int, float) and abs(v) < INF, "a number that is none")
    return float(v) + 0.0


def integer(v):
    need(type(v) is str and INTEGER.fullmatch(v) is not None, "an integer that is none")
    return int(v, 16)


class Problem:
    def __init__(self, data):
        self.b = [number(v) for v in data["b"]]
        n = self.n = len(self.b)
        a = data["A"]
        if "dense" in a:
            need(len(a["dense"]) == n and all(len(row) == n for row in a["dense"]), "A has another size")
            self.rows = [[(j, number(v)) for j, v in enumerate(row) if v] for row in a["dense"]]
        else:
            need(a["rows"] == a["cols"] == n, "A has another size")
            entries = {}
            for i, j, v in a["triplets"]:
                need(type(i) is type(j) is int and 0 <= i < n and 0 <= j < n and (i, j) not in entries, "a triplet")
                entries[i, j] = number(v)
            self.rows = [[] for _ in range(n)]
            for (i, j), v in sorted(entries.items()):
                if v:
                    self.rows[i].append((j, v))
        index = data.get("friction_index") or [-1] * n
        mu = data.get("mu") or [0.0] * n
        ends = {"inf": INF, "-inf": -INF}
        bound = lambda v: ends[v] if type(v) is str else number(v)
        lo = data.get("lo") or [0.0 if k < 0 else -INF for k in index]
        hi = data.get("hi") or [INF] * n
        need(n == len(index) == len(mu) == len(lo) == len(hi), "sizes differ")
        self.lo, self.hi, self.scale = [bound(v) for v in lo], [bound(v) for v in hi], number(data.get("scale") or 0)
        self.owner = [(k, number(m)) if k >= 0 else None for k, m in zip(index, mu)]
        for i, owner in enumerate(self.owner):
            need(self.lo[i] <= self.hi[i] and self.lo[i] < INF and self.hi[i] > -INF, f"bounds of row {i}")
            if owner:
                k, m = owner
                need(k != i and k < n and not self.owner[k] and self.lo[k] >= 0 and m >= 0, f"friction of row {i}")
                need((self.lo[i], self.hi[i]) == (-INF, INF), f"bounds of row {i}")
        self.sa = shift_of([v for row in self.rows for _, v in row])        # A times 2^sa, b times 2^sb, bounds 2^sl,
        self.sb, self.sm = shift_of(self.b), shift_of([o[1] for o in self.owner if o])             # mu times 2^sm
        self.sl = shift_of([v for v in self.lo + self.hi if abs(v) < INF])
        self.A = [[(j, exact(v, self.sa)) for j, v in row] for row in self.rows]
        self.B = [exact(v, self.sb) for v in self.b]

    def hash(self):
        h = hashlib.sha256(b"lcplab problem 1\n" + struct.pack(">Id", self.n, self.scale))
        for row in self.rows:
            h.update(struct.pack(">I", len(row)) + b"".join(struct.pack(">Id", j, v) for j, v in row))
        for vector in self.b, self.lo, self.hi:
            h.update(struct.pack(f">{self.n}d", *(v + 0.0 for v in vector)))
        h.update(b"".join(struct.pack(">Id", *((o[0] + 1, o[1]) if o else (0, 0.0))) for o in self.owner))
        h.update(struct.pack(">I", 0))      # no motion
        return h.hexdigest()

    def point(self, data):
        """(X, D): x times D, D a positive integer, from a point of a proof; D is made so large that bounds are integers."""
        need(type(data) is dict and set(data) == {"denominator", "numerators"}, "a point")
        d, entries = integer(data["denominator"]), data["numerators"]
        need(d > 0 and type(entries) is list and len(entries) == self.n, "a point of another size")
        up, X = self.sl + self.sm, [0] * self.n
        for i in sorted(range(self.n), key=lambda i: self.owner[i] is not None):
            if entries[i] not in ("lo", "hi"):
                X[i] = integer(entries[i]) << up
            elif self.owner[i]:
                k, mu = self.owner[i]
                reach = exact(mu, self.sm) * max(X[k], 0)
                X[i] = (reach >> self.sm) * (1 if entries[i] == "hi" else -1)
            else:
                bound = self.lo[i] if entries[i] == "lo" else self.hi[i]
                need(abs(bound) < INF, f"row {i} has no such bound")
                X[i] = d * exact(bound, up)
        return X, d << up

    def solution(self, data):
        """The point of a proof, if it is a solution."""
        X, D = self.point(data)
        for i, (row, b) in enumerate(zip(self.A, self.B)):
            w = (sum(a * X[j] for j, a in row) << self.sb) + (b * D << self.sa)
            if self.owner[i]:
                k, mu = self.owner[i]
                x, hi = X[i] << self.sm, exact(mu, self.sm) * max(X[k], 0)
                lo = -hi
            else:
                x = X[i] << self.sl
                lo, hi = (v if abs(v) == INF else exact(v, self.sl) * D for v in (self.lo[i], self.hi[i]))
            need(lo <= x <= hi, f"x of row {i} is beyond a bound")
            need((w <= 0 or x == lo) and (w >= 0 or x == hi), f"w of row {i} has the wrong sign")
        return X, D

    def minors_are_positive(self, m):
        """Whether all leading principal minors of an integer matrix are positive."""
        last = 1
        for c, own in enumerate(m):
            if own[c] <= 0:
                return False
            for row in m[c + 1:]:
                f = row[c]
                row[c:] = [(v * own[c] - f * t) // last for v, t in zip(row[c:], own[c:])]
            last = own[c]
        return True

    def unique(self, by):
        need(not any(self.owner), "rows are coupled")
        full = [[0] * self.n for _ in range(self.n)]
        for i, row in enumerate(self.A):
            for j, a in row:
                full[i][j] = a
        if by == "definite":
            sums = [[full[i][j] + full[j][i] for j in range(self.n)] for i in range(self.n)]
            need(self.minors_are_positive(sums), "A + A' is not positive definite")
        else:
            need(by == "p-matrix" and self.n <= 12, "by")
            for size in range(1, self.n + 1):
                for rows in combinations(range(self.n), size):      # smaller minors are positive: no exchange is needed
                    need(self.minors_are_positive([[full[i][j] for j in rows] for i in rows]), "a minor")

    def ends(self, i):
        """Whether row i has a lower and an upper side."""
        return (True, True) if self.owner[i] else (self.lo[i] > -INF, self.hi[i] < INF)

    def tree(self, data, sides):
        need(type(data) is dict, "a tree")
        if set(data) == {"d"}:
            return self.leaf(data["d"], sides)
        i = data.get("row")
        need(type(i) is int and 0 <= i < self.n and i not in sides, "a branch")
        ends = {side for side, has in zip(("lo", "hi"), self.ends(i)) if has}
        need(set(data) == {"row", "free"} | ends, f"the sides of row {i}")
        for side in ends | {"free"}:
            self.tree(data[side], {**sides, i: side})

    def leaf(self, data, sides):
        c, total = [0] * self.n, 0              # c times 2^(sa + sm), the total times 2^(sa + sb + sl + sm)
        need(type(data) is dict, "a d")
        for key, value in data.items():
            need(re.fullmatch(r"0|[1-9][0-9]*", key) is not None and int(key) < self.n, "a row of d")
            i, d = int(key), integer(value)
            side = sides.get(i, "none")
            has_lo, has_hi = self.ends(i)
            need(d >= 0 or not (side == "lo" or side == "none" and has_lo), f"the sign of d in row {i}")
            need(d <= 0 or not (side == "hi" or side == "none" and has_hi), f"the sign of d in row {i}")
            for j, a in self.A[i]:
                c[j] += a * d << self.sm
            total += self.B[i] * d << self.sa + self.sl + self.sm
        for j, owner in enumerate(self.owner):
            if owner:
                own, mu = c[j], exact(owner[1], self.sm)
                c[owner[0]] += (mu * {"lo": -own, "hi": own}.get(sides.get(j), abs(own))) >> self.sm
        for j, owner in enumerate(self.owner):
            if not owner:
                best = self.hi[j] if c[j] > 0 else self.lo[j] if c[j] < 0 else 0.0
                at = {"lo": self.lo[j], "hi": self.hi[j]}.get(sides.get(j), best)
                need(abs(at) < INF, f"nothing bounds the product in row {j}")
                total += c[j] * exact(at, self.sl) << self.sb
        need(total < 0, "the vector of a case shows nothing")

    def residual(self, x):
        """The scaled residual of an answer, as a fraction."""
        rows, worst = [], Q(0)
        for row, b in zip(self.rows, self.b):
            terms = [Q(a) * Q(x[j]) for j, a in row] + [Q(b)]
            rows.append((sum(terms), sum(map(abs, terms)), dict(row)))
        scale = [Q(abs(row.get(i, 0)) or max(map(abs, row.values()), default=0) or 1) for i, (*_, row) in enumerate(rows)]
        terms = [max(t, s * Q(self.scale)) if row else t for s, (_, t, row) in zip(scale, rows)]
        finite = [max((abs(v) for v in ends if abs(v) < INF), default=0) for ends in zip(self.lo, self.hi)]
        reach = [Q(max(v, self.scale)) if v else None for v in finite]
        size = lambda i, r: terms[i] / scale[i] if r is None else min(terms[i] / scale[i], r)
        for i, (w, *_) in enumerate(rows):
            own, lo, hi, r = Q(x[i]), self.lo[i], self.hi[i], reach[i]
            if self.owner[i]:
                k, mu = self.owner[i]
                hi = Q(mu) * max(Q(x[k]), 0)
                lo, r = -hi, Q(mu) * max(Q(x[k]), size(k, reach[k])) or None
                own = next((end for end in (lo, hi) if abs(own - end) <= hi / 2**50), own)
            e = size(i, r)
            target = own - (e * w / terms[i] if terms[i] else 0)
            target = target if lo == -INF else max(target, Q(lo))
            target = target if hi == INF else min(target, Q(hi))
            need(e > 0 or own == target, "the residual is not finite")
            worst = max(worst, abs(own - target) / e if own != target else Q(0))
        return worst


def answer(proof, n):
    need(type(proof["answer"]) is list and len(proof["answer"]) == n, "the answer has another size")
    return [number(v) for v in proof["answer"]]


def check(problem, proof):
    """What a proof proves of a problem; Refused if it proves nothing."""
    need(type(proof) is dict and proof.get("format") == "lcplab-proof-1", "another format")
    kind = proof.get("kind")
    need(type(kind) is str and set(proof) - {"format", "problem", "kind"} in KEYS.get(kind, []), "the keys of its kind")
    need(proof.get("problem") == problem.hash(), "it is about another problem")
    if kind == "no-solution":
        problem.tree(proof["tree"], {})
        return "no solution exists"
    if kind == "within":
        given, own = proof["residual"], problem.residual(answer(proof, problem.n))
        need(type(given) is dict and set(given) == {"numerator", "denominator"}, "a fraction")
        p, q = integer(given["numerator"]), integer(given["denominator"])
        need(q > 0 and p * own.denominator == q * own.numerator, "the residual is another")
        return f"the scaled residual of the answer is {float(own):.17g}, rounded"
    X, D = problem.solution(proof["x"])
    if kind == "unique":
        problem.unique(proof["by"])
        return "exactly one solution exists"
    if kind == "not-unique":
        Y, E = problem.solution(proof["y"])
        need(any(x * E != y * D for x, y in zip(X, Y)), "both solutions are one")
        return "two different solutions exist"
    if "answer" not in proof:
        return "a solution exists"
    distance, near = Q(number(proof["distance"])), answer(proof, problem.n)
    need(all(abs(Q(v) * D - x) <= distance * D for v, x in zip(near, X)), "the answer is farther away")
    return f"a solution exists within {float(distance):.3g} of the answer"


def main(arguments):
    if len(arguments) == 1 and Path(arguments[0]).is_dir():
        proofs = sorted(Path(arguments[0]).glob("*.proof.json"))
        pairs = [(path.with_name(path.name[:-11] + ".json"), path) for path in proofs]
    elif len(arguments) == 2:
        pairs = [tuple(map(Path, arguments))]
    else:
        print(__doc__)
        return 2
    refused = 0
    for problem, proof in pairs:
        try:
            read = Problem(json.loads(problem.read_text()))
        except (Refused, OSError, ValueError, KeyError, TypeError) as error:
            print(f"{problem}: cannot be read: {error!r}")
            return 2
        try:
            print(f"{proof}: proved: {check(read, json.loads(proof.read_text()))}")
        except (Refused, OSError, ValueError, KeyError, TypeError, AttributeError, RecursionError) as error:
            refused += 1
            print(f"{proof}: refused: {error}")
    print(f"{len(pairs) - refused} of {len(pairs)} proofs prove their claims") if len(pairs) != 1 else None
    return 1 if refused else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

#!/usr/bin/env python3
"""Checks proofs about linear complementarity problems. Written from docs/proofs.md alone; calculates with integers.

    lcpcheck.py PROBLEM PROOF [MODEL]   one proof: prints what it proves, or why it is rejected; MODEL is
                                        the friction model to ask about, if not the problem's
    lcpcheck.py FOLDER                  every *.proof.json of a folder, about the problem of its hash in
                                        another *.json

Exit code: 0 if every proof proves its claim, 1 if one is rejected, 2 if a problem cannot be read.
"""
import hashlib, json, re, struct, sys
from copy import copy
from fractions import Fraction as Q
from itertools import combinations
from operator import mul
from pathlib import Path

INF, INTEGER = float("inf"), re.compile(r"0|-?[1-9a-f][0-9a-f]*")
BOXES = ("coupled-box", "frozen-box")
CONES = ("associated-cone", "coulomb-cone")
POLYGONS = {f"polygon-{k}" for k in range(4, 257, 4)}
MODELS = {*BOXES, *CONES, *POLYGONS}
PLANE = {*POLYGONS, "coupled-box", "coulomb-cone"}
REGION = ("states", "center", "radius", "inverse")
REGIONS = [{*REGION, *more, *near} for more in ((), ("redundant",)) for near in ((), ("answer", "distance"))]
KEYS = {"solution": [{"x"}, {"x", "answer", "distance"}], "unique": [{"x", "by"}], "not-unique": [{"x", "y"}],
        "no-solution": [{"tree"}], "within": [{"answer", "residual"}],
        "cone-solution": REGIONS, "body-solution": REGIONS + [{*keys, "bias_change"} for keys in REGIONS],
        "motion": [{"answer", "motion", "bound"}, {"answer", "motion", "bound", "force"}], "frozen-motion": [{"answer", "motion", "bound"}]}


class Refused(Exception):
    pass


def need(holds, reason):
    if not holds:
        raise Refused(reason)


def number(v):
    need(type(v) in (int, float), "a number")
    return float(v) + 0.0


def size(v):
    need(number(v) >= 0, "a number that is not negative")
    return number(v)


def index(v, n):
    need(type(v) is int and 0 <= v < n, "an index")
    return v


def integer(v):
    need(type(v) is str and INTEGER.fullmatch(v) is not None, "an integer")
    return int(v, 16)


def entries(v, n=None):
    need(type(v) is list and n in (None, len(v)), "a list of another length")
    return v


def whole(values):
    """Integers and s: the floats times 2^s."""
    ratios = [v.as_integer_ratio() for v in values]
    s = max((q.bit_length() for _, q in ratios), default=1)
    return [p << s - q.bit_length() for p, q in ratios], s - 1


def only_once(pairs):
    need(len(dict(pairs)) == len(pairs), "a key twice")
    return dict(pairs)


def finite(text):
    need(abs(float(text)) < INF, "a number that is not finite")
    return float(text)


def whole_number(text):
    return int(text) if finite(text) or text == "0" else -0.0   # "-0" is a number, but no index


def depth(v):
    inner = v.values() if type(v) is dict else v if type(v) is list else None
    return 0 if inner is None else 1 + max(map(depth, inner), default=0)


def read(text):
    value = json.loads(text, object_pairs_hook=only_once, parse_float=finite,
                       parse_int=whole_number, parse_constant=finite)
    need(depth(value) <= 127, "more than 127 brackets within each other")
    json.dumps(value, ensure_ascii=False).encode()              # half of a surrogate pair is no text
    return value


def sparse(triplets, rows, columns):
    """The rows of a matrix, each {column: value} by rising column, without zeros; and whether no place is there twice."""
    places = {}
    for triplet in entries(triplets):
        i, j, v = entries(triplet, 3)
        places.setdefault((index(i, rows), index(j, columns)), []).append(number(v))
    matrix = [{} for _ in range(rows)]
    for (i, j), values in sorted(places.items()):
        v = values[0] if len(values) == 1 else float(sum(map(Q, values)))
        if v:
            matrix[i][j] = v
    return matrix, len(places) == len(triplets)


def packed(matrix):
    return b"".join(struct.pack(">I", len(row)) + b"".join(struct.pack(">Id", j, v) for j, v in row.items()) for row in matrix)


class Problem:
    def __init__(self, data, model=None):
        need(type(data) is dict and "A" in data and "b" in data, "A or b is missing")
        need(type(data["A"]) is dict and ("dense" in data["A"]) != ("triplets" in data["A"]), "A")
        b, a = [number(v) for v in entries(data["b"])], data["A"]
        n = self.n = self.biased = len(b)
        need(set(a) <= {"dense", "triplets", "rows", "cols"}, "A has an unknown key")
        need(all(index(a[key], n + 1) == n for key in ("rows", "cols") if key in a), "A has another size")
        if "dense" in a:
            triplets = [[i, j, v] for i, row in enumerate(entries(a["dense"], n)) for j, v in enumerate(entries(row, n))]
        else:
            need("rows" in a and "cols" in a, "A has no size")
            triplets = a["triplets"]
        rows, _ = sparse(triplets, n, n)
        need(("friction_index" in data) == ("mu" in data), "friction_index and mu belong together")
        mu = [number(v) for v in entries(data.get("mu", [0] * n), n)]
        self.owner = [None if type(k) is int and k == -1 else index(k, n) for k in entries(data.get("friction_index", [-1] * n), n)]
        mu = [0.0 if k is None else m for k, m in zip(self.owner, mu)]
        bound = lambda v: {"inf": INF, "+inf": INF, "-inf": -INF}[v] if type(v) is str else number(v)
        lo = [bound(v) for v in entries(data.get("lo", [0 if k is None else "-inf" for k in self.owner]), n)]
        hi = [bound(v) for v in entries(data.get("hi", ["inf"] * n), n)]
        self.scale = number(data.get("scale", 0))
        need(self.scale > 0 or "scale" not in data, "scale")
        for i, k in enumerate(self.owner):
            need(lo[i] <= hi[i] and lo[i] < INF and hi[i] > -INF, f"the bounds of row {i}")
            need(k is None or self.owner[k] is None and lo[k] >= 0 and mu[i] >= 0
                 and (lo[i], hi[i]) == (-INF, INF), f"the friction of row {i}")
        frozen = [number(v) for v in entries(data.get("frozen_at", [0] * n), n)]
        self.model = data.get("model", "coupled-box") if model is None else model
        for name in (self.model, data.get("model", self.model)):
            need(type(name) is str and name in MODELS, "a model that is not known")
        normals = [k for k in self.owner if k is not None]
        if normals and len(set(normals)) == len(normals) and self.model in PLANE:
            # One tangent a contact: in the plane the cone is the box.
            self.model = "coupled-box"
        elif model is not None or "model" in data:
            need(normals, "a friction model without friction")
            for k in normals:
                tangents = [m for m, own in zip(mu, self.owner) if own == k]
                need(len(tangents) == 2 and tangents[0] == tangents[1] and (lo[k], hi[k]) == (0, INF), f"the contact of row {k}")
        if self.model == "frozen-box":
            need("frozen_at" in data, "frozen_at")
            for i, k in enumerate(self.owner):
                if k is not None:
                    hi[i] = mu[i] * max(frozen[k], 0.0)
                    lo[i] = 0.0 - hi[i]
            self.owner, mu = [None] * n, [0.0] * n
        # The contacts of a cone: the rows n, t1, t2 of each.
        normals = sorted({k for k in self.owner if k is not None}) if self.model in CONES else []
        self.contacts = [[k, *[i for i, own in enumerate(self.owner) if own == k]] for k in normals]
        self.others = sorted(set(range(n)) - {i for contact in self.contacts for i in contact})
        # All numbers times 2^s are integers; None for an infinite bound.
        both = lo + hi
        ints, self.s = whole([v for row in rows for v in row.values()] + b + mu + [v if abs(v) < INF else 0.0 for v in both])
        ints = iter(ints)
        self.A = [[(j, next(ints)) for j in row] for row in rows]
        self.B, self.mu = [next(ints) for _ in b], [next(ints) for _ in mu]
        ends = [v if abs(end) < INF else None for v, end in zip(ints, both)]
        self.ends = list(zip(ends[:n], ends[n:]))
        h = hashlib.sha256(b"lcplab problem 1\n" + struct.pack(">Id", n, self.scale) + packed(rows))
        h.update(struct.pack(f">{3 * n}d", *b, *lo, *hi))
        h.update(b"".join(struct.pack(">Id", 0 if k is None else k + 1, m) for k, m in zip(self.owner, mu)))
        h.update(self.bodies(data["motion"]) if "motion" in data else bytes(4))
        h.update(b"" if self.model == "coupled-box" else struct.pack(">I", len(self.model)) + self.model.encode())
        self.hash = h.hexdigest()

    def bodies(self, data):
        """Reads the key motion; its canonical bytes."""
        need(type(data) is dict and set(data) - {"level"} == {"mass", "jacobian", "bias", "compliance", "target"}, "motion")
        need("level" not in data or data["level"] in ("velocity", "acceleration"), "level")
        target, k = [number(v) for v in entries(data["target"])], len(data["target"])
        bias, soft = ([number(v) for v in entries(data[key], self.n)] for key in ("bias", "compliance"))
        (mass, is_once), (jacobian, too) = sparse(data["mass"], k, k), sparse(data["jacobian"], self.n, k)
        need(is_once and too and all(v >= 0 for v in soft) and all(j >= i for i, j, _ in data["mass"]), "mass, jacobian or compliance")
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
        W = [sum([a * X[j] for j, a in row]) + b * D for row, b in zip(self.A, self.B)]
        for contact in self.contacts:
            self.law(contact, [X[i] for i in contact], [W[i] for i in contact])
        for i in self.others:
            w, x, k = W[i], X[i] << self.s, self.owner[i]
            if k is None:
                lo, hi = (None if end is None else end * D for end in self.ends[i])
            else:
                hi = self.mu[i] * max(X[k], 0)
                lo = -hi
            need((lo is None or lo <= x) and (hi is None or x <= hi), f"x of row {i} is beyond a bound")
            need((w <= 0 or x == lo) and (w >= 0 or x == hi), f"w of row {i} has the wrong sign")
        return X, D

    def law(self, contact, x, w):
        """The law of a contact with a cone, at its x times D and its w times D 2^s."""
        (n, t1, _), mu = contact, self.mu[contact[1]]
        friction, limit = x[1] ** 2 + x[2] ** 2 << 2 * self.s, (mu * x[0]) ** 2
        power = x[1] * w[1] + x[2] * w[2]
        need(x[0] >= 0 and friction <= limit and w[0] >= 0, f"the contact of row {n} is outside its cone, or penetrates")
        if self.model == "coulomb-cone":
            is_opposite = friction == limit and x[1] * w[2] == x[2] * w[1] and power <= 0
            need((x[0] == 0 or w[0] == 0) and (w[1] == w[2] == 0 or is_opposite), f"the contact of row {n} breaks Coulomb's law")
        else:
            is_dual = (w[0] << self.s) ** 2 >= mu * mu * (w[1] ** 2 + w[2] ** 2)
            need(is_dual and x[0] * w[0] + power == 0, f"the contact of row {n} breaks the law of its cone")

    def equations(self, states, X):
        """The equation of each unknown row of a cone problem in these states: {row: (kind, contact)}."""
        unknown = {}
        for i in self.others:
            need(states[i] in ("lo", "free", "hi"), f"the state of row {i}")
            if states[i] == "free":
                unknown[i] = "still", [i]
        for contact in self.contacts:
            n, t1, t2 = contact
            need(states[n] in ("open", "sticks", "slides") and states[n] == states[t1] == states[t2], f"the state of row {n}")
            need(states[n] != "sticks" or self.mu[t1] > 0, f"the state of row {n}, which has no friction")
            if states[n] == "sticks":
                unknown.update({i: ("still", contact) for i in contact})
            elif states[n] == "slides":
                is_power = self.model == "associated-cone" and self.mu[t1] > 0
                unknown[n] = "power" if is_power else "still", contact
                if self.mu[t1] > 0:
                    unknown.update({t1: ("limit", contact), t2: ("parallel", contact)})
        return unknown

    def augmented(self):
        """The problem of the exact bodies, whose unknowns are x and the motion u; its numbers have another 2^s."""
        need(hasattr(self, "motion"), "the problem says nothing of bodies")
        mass, jacobian, bias, soft, target = self.motion
        full, n, k = [dict(row) for row in mass], self.n, len(target)
        for i, row in enumerate(mass):
            for j, v in row.items():
                full[j][i] = v
        b = bias + [-sum([v * target[j] for j, v in row.items()], Q(0)) for row in full]
        rows = [{**({i: soft[i]} if soft[i] else {}), **{n + j: v for j, v in row.items()}} for i, row in enumerate(jacobian)]
        rows += [{n + j: v for j, v in row.items()} for row in full]
        for i, row in enumerate(jacobian):
            for j, v in row.items():
                rows[n + j][i] = -v
        other = copy(self)
        numbers = [v for row in rows for v in row.values()] + b
        other.s = max([self.s] + [v.denominator.bit_length() - 1 for v in numbers])
        scaled = lambda v: v.numerator * (1 << other.s) // v.denominator
        other.A, other.B = [[(j, scaled(v)) for j, v in row.items()] for row in rows], list(map(scaled, b))
        more = other.s - self.s
        other.mu = [m << more for m in self.mu] + [0] * k
        other.ends = [tuple(None if end is None else end << more for end in ends) for ends in self.ends] + [(None, None)] * k
        other.n, other.biased, other.owner, other.others = n + k, n, self.owner + [None] * k, self.others + list(range(n, n + k))
        return other

    def redundant(self, data, unknown, change):
        """Takes the redundant rows from the unknown ones: each must depend on rows that remain, up to a change of b."""
        need(type(data) is dict, "redundant")
        decimal = lambda key: need(re.fullmatch(r"0|[1-9][0-9]*", key) is not None, "a row") or int(key)
        still = {i for i, (kind, _) in unknown.items() if kind == "still"}
        rows = {decimal(key) for key in data}
        need(rows <= still, "a redundant row without the equation w = 0")
        for key, factors in data.items():
            need(type(factors) is dict and key in factors, f"the dependence of row {key}")
            total, sums = 0, {}
            for own, value in factors.items():
                j, f = decimal(own), integer(value)
                need(f != 0 and (own == key or j in still and j not in rows), f"the dependence of row {key} on row {j}")
                total += f * self.B[j]
                for column, a in self.A[j]:
                    sums[column] = sums.get(column, 0) + f * a
            need(not any(sums.values()), f"row {key} does not depend on the others")
            most = Q(change) if decimal(key) < self.biased else 0
            need(abs(total) <= (most * abs(integer(factors[key])) * (1 << self.s)), f"b of row {key} does not depend on the others")
        return {i: equation for i, equation in unknown.items() if i not in rows}, rows

    def region(self, proof):
        """The box of a proof, which must contain a solution: center X and radii R times D."""
        states, (X, D), T = entries(proof["states"], self.n), self.point(proof["center"]), 1 << self.s
        R = [integer(r) << 2 * self.s for r in entries(proof["radius"], self.n)]
        change = size(proof.get("bias_change", 0))
        unknown, redundant = self.redundant(proof.get("redundant", {}), self.equations(states, X), change)
        for i in range(self.n):
            need(R[i] > 0 if i in unknown else R[i] == 0, f"the radius of row {i}")
            end = self.ends[i][states[i] == "hi"] if states[i] in ("lo", "hi") else 0
            need(i in unknown or i in redundant or end is not None and X[i] << self.s == end * D, f"the center of row {i}")
        # Times T D, like every w below; F and the curvature are times T^2 D^2, F' times T^2 D.
        W = [sum([a * X[j] for j, a in row]) + b * D for row, b in zip(self.A, self.B)]
        P = [sum([abs(a) * R[j] for j, a in row]) for row in self.A]
        rows, F, J, curved = sorted(unknown), [], [], []
        for i in rows:
            kind, contact = unknown[i]
            n, t1, t2 = contact if len(contact) == 3 else (i, i, i)
            mm = self.mu[t1] ** 2
            if kind == "still":
                f, parts, own, q = W[i] * T * D, [(D, i)], {}, 0
            elif kind == "power":
                f, parts = sum([X[k] * W[k] for k in contact]) * T, [(X[k], k) for k in contact]
                own, q = {k: W[k] * T for k in contact}, sum([R[k] * P[k] for k in contact]) * T
            elif kind == "limit":
                f, parts = (X[t1] ** 2 + X[t2] ** 2) * T * T - mm * X[n] ** 2, []
                own = {n: -2 * mm * X[n], t1: 2 * X[t1] * T * T, t2: 2 * X[t2] * T * T}
                q = (R[t1] ** 2 + R[t2] ** 2) * T * T + mm * R[n] ** 2
            else:
                f, parts = (X[t1] * W[t2] - X[t2] * W[t1]) * T, [(X[t1], t2), (-X[t2], t1)]
                own, q = {t1: W[t2] * T, t2: -W[t1] * T}, (R[t1] * P[t2] + R[t2] * P[t1]) * T
            for factor, k in parts:
                for j, a in self.A[k]:
                    own[j] = own.get(j, 0) + factor * a * T
            F, J, curved = F + [f], J + [[own.get(j, 0) for j in rows]], curved + [q]
        columns = [[(k, v) for k, v in enumerate(column) if v] for column in zip(*J)]
        for k, (i, row) in enumerate(zip(rows, entries(proof["inverse"], len(rows)))):
            C, e = whole([number(v) for v in entries(row, len(rows))])
            image = abs(sum(map(mul, C, F))) + 2 * sum(map(mul, map(abs, C), curved))
            for m, column in enumerate(columns):
                rest = (T * T * D << e if m == k else 0) - sum([C[l] * v for l, v in column])
                image += abs(rest) * R[rows[m]]
            need(image < R[i] * T * T * D << e, f"the box is not mapped into itself in row {i}")
        for i in self.others:
            lo, hi = self.ends[i]
            holds = {"lo": W[i] >= P[i], "hi": W[i] <= -P[i],
                     "free": (lo is None or X[i] - R[i] << self.s >= lo * D) and (hi is None or X[i] + R[i] << self.s <= hi * D)}
            need(holds[states[i]], f"row {i} breaks an inequality of its state")
        for contact in self.contacts:
            n, t1, t2 = contact
            mu, least, w_least = self.mu[t1], X[n] - R[n], W[n] - P[n]
            if states[n] == "open":
                slip = sum([(abs(W[t]) + P[t]) ** 2 for t in (t1, t2)])
                holds = w_least >= 0 and (self.model == "coulomb-cone" or (w_least << self.s) ** 2 >= mu * mu * slip)
            elif states[n] == "sticks":
                friction = sum([(abs(X[t]) + R[t]) ** 2 for t in (t1, t2)]) << 2 * self.s
                holds = least >= 0 and friction <= (mu * least) ** 2
            elif mu == 0:
                holds = least >= 0
            else:
                power = sum([X[t] * W[t] + abs(X[t]) * P[t] + R[t] * abs(W[t]) + R[t] * P[t] for t in (t1, t2)])
                holds = least > 0 and power <= 0
            need(holds, f"the contact of row {n} breaks an inequality of its state")
        return X, R, D

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
        need(index(i, self.n) not in sides and len(sides) < 100, "a branch")
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

    def forces(self, data):
        """The forces of a proof about cones, as fractions; each is inside its cone or its bounds."""
        need(type(data) is dict and all(type(v) is str and v not in ("lo", "hi") for v in entries(data.get("numerators"))), "forces")
        X, D = self.point(data)
        for n, t1, t2 in self.contacts:
            mu = self.mu[t1]
            need(X[n] >= 0 and X[t1] ** 2 + X[t2] ** 2 << 2 * self.s <= (mu * X[n]) ** 2, f"the force of row {n} is outside its cone")
        for i in self.others:
            lo, hi = self.ends[i]
            need((lo is None or lo * D <= X[i] << self.s) and (hi is None or X[i] << self.s <= hi * D), f"the force of row {i}")
        return [Q(v, D) for v in X]

    def cone_gap(self, contact, p, w, soft):
        """g of a contact."""
        mu, costs = Q(self.mu[contact[1]], 1 << self.s), []
        w, p, soft = ([v[i] for i in contact] for v in (w, p, soft))
        if not any(w):
            return 0
        if w[0] >= 0 and w[0] ** 2 >= mu ** 2 * (w[1] ** 2 + w[2] ** 2):
            costs.append(sum(map(mul, p, w)))
        if all(soft):
            costs.append(sum(v * v / (2 * k) for v, k in zip(w, soft)))
        need(costs, f"the motion breaks the contact of row {contact[0]}")
        return min(costs)

    def squares(self, x, data, force=None):
        """S and G of an answer and a motion, as fractions; force replaces the projected answer."""
        mass, jacobian, bias, soft, target = self.motion
        need(type(data) is dict and set(data) == {"denominator", "numerators"}, "a motion")
        d, x, gaps = integer(data["denominator"]), [Q(v) for v in x], Q(0)
        need(d > 0, "a denominator")
        v = [Q(integer(p), d) for p in entries(data["numerators"], len(target))]
        rows, beyond, within = [dict(row) for row in mass], [Q(0)] * len(v), [Q(0)] * len(v)
        for i, row in enumerate(mass):
            for j, m in row.items():
                within[i] += m * (v[j] - target[j])
                within[j] += m * (v[i] - target[i]) if i != j else 0
        of_contact, slip = {i for contact in self.contacts for i in contact}, {}
        for i, (row, k) in enumerate(zip(jacobian, self.owner)):
            if i in of_contact:
                slip[i] = sum([a * v[j] for j, a in row.items()]) + bias[i] + soft[i] * force[i]
                for j, a in row.items():
                    within[j] -= a * force[i]
                    beyond[j] += a * (x[i] - force[i])
                continue
            lo, hi = (None if end is None else Q(end, 1 << self.s) for end in self.ends[i])
            if k is not None:
                hi = Q(self.mu[i], 1 << self.s) * max(x[k], 0)
                lo = -hi
            p = x[i] if lo is None else max(x[i], lo)
            p = p if hi is None else min(p, hi)
            p = p if force is None else force[i]
            w = sum([a * v[j] for j, a in row.items()]) + bias[i] + soft[i] * p
            end = lo if w > 0 else hi
            costs = [abs((p - end) * w)] if end is not None else []
            costs += [w * w / (2 * soft[i])] if soft[i] else []
            need(costs or w == 0, f"the motion breaks row {i}")
            gaps += min(costs) if w else 0
            for j, a in row.items():
                within[j] -= a * p
                beyond[j] += a * (x[i] - p)
        gaps += sum(self.cone_gap(contact, force, slip, soft) for contact in self.contacts)
        S, G = Q(0), 2 * gaps
        for c, row in enumerate(rows):          # M = L D L', and both vectors become their L^-1 f
            need(row.get(c, 0) > 0, "the mass matrix is not positive definite")
            S += beyond[c] ** 2 / row[c]
            G += within[c] ** 2 / row[c]
            for r in (r for r in row if r > c):
                beyond[r] -= row[r] / row[c] * beyond[c]
                within[r] -= row[r] / row[c] * within[c]
                for s in (s for s in row if s >= r):
                    rows[r][s] = rows[r].get(s, 0) - row[r] / row[c] * row[s]
        return S, G


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
    need(type(kind) is str and set(proof) - {"format", "problem", "model", "kind"} in KEYS.get(kind, []), "the keys of its kind")
    need(proof.get("model", "coupled-box") == problem.model, f"it is about another model than the problem's, {problem.model}")
    need(proof.get("problem") == problem.hash, "it is about another problem")
    is_leaf = kind == "no-solution" and type(proof["tree"]) is dict and set(proof["tree"]) == {"d"}
    is_region = kind in ("cone-solution", "body-solution")
    of_cone = (is_region or kind in ("solution", "not-unique")) and problem.model in CONES or kind == "motion" and problem.model == "associated-cone"
    need(is_leaf or of_cone or problem.model in BOXES and not is_region, f"of {problem.model} this is no proof")
    answer = [number(v) for v in entries(proof["answer"], problem.n)] if "answer" in proof else None
    if kind == "no-solution":
        problem.tree(proof["tree"], {})
        return "no solution exists"
    if kind == "within":
        given, own = proof["residual"], problem.residual(answer)
        need(type(given) is dict and set(given) == {"numerator", "denominator"}, "a fraction")
        p, q = integer(given["numerator"]), integer(given["denominator"])
        need(p >= 0 and q > 0 and p * own.denominator == q * own.numerator, "the residual is another")
        return "the scaled residual of the answer is the fraction that it states"
    if kind in ("motion", "frozen-motion"):
        is_cone = problem.model == "associated-cone"
        need(is_cone == ("force" in proof), "the keys of its kind")
        need(is_cone or (kind == "motion") == all(k is None for k in problem.owner), "the kind for rows that are coupled is another")
        need(hasattr(problem, "motion"), "the problem says nothing of bodies")
        bound, (S, G) = size(proof["bound"]), problem.squares(answer, proof["motion"], problem.forces(proof["force"]) if is_cone else None)
        rest = Q(bound) ** 2 - S - G
        need(rest >= 0 and 4 * S * G <= rest ** 2, "the motion shows a larger bound only")
        return f"the motion of the answer is within {bound} of the exact one" + ", with frozen friction" * (kind != "motion")
    if is_region:
        X, R, D = (problem if kind == "cone-solution" else problem.augmented()).region(proof)
    else:
        (X, D), R = problem.solution(proof["x"]), [0] * problem.n
    if kind == "unique":
        problem.unique(proof["by"])
        return "exactly one solution exists"
    if kind == "not-unique":
        Y, E = problem.solution(proof["y"])
        need(any(x * E != y * D for x, y in zip(X, Y)), "both solutions are one")
        return "two different solutions exist"
    exists = "a solution exists" + " for the exact numbers of the bodies" * (kind == "body-solution")
    if "bias_change" in proof:
        exists += f", with a bias that differs by at most {size(proof['bias_change'])},"
    if answer is None:
        return exists
    distance, (near, s) = size(proof["distance"]), whole(answer)
    p, q = distance.as_integer_ratio()
    need(all((abs(v * D - (x << s)) + (r << s)) * q <= p * D << s for v, x, r in zip(near, X, R)), "the answer is farther away")
    return f"{exists} within {distance} of the answer"


WRONG = (Refused, OSError, ValueError, LookupError, ArithmeticError, TypeError, AttributeError, RecursionError)


def main(arguments):
    folder = Path(arguments[0]) if len(arguments) == 1 else None
    if folder is not None and folder.is_dir():
        proofs = sorted(folder.glob("*.proof.json"))
        paths = sorted(set(folder.glob("*.json")) - set(proofs))
    elif len(arguments) in (2, 3):
        paths, proofs = [[Path(argument)] for argument in arguments[:2]]
    else:
        print(__doc__)
        return 2
    if not proofs:
        print(f"{folder}: there is no *.proof.json in it")
        return 2
    problems, rejected = {}, 0
    for path in paths:
        try:
            problem = Problem(read(path.read_text(encoding="utf-8")), *arguments[2:])
            problems[problem.hash] = problem
        except WRONG as error:
            print(f"{path}: cannot be read: {error!r}")
            return 2
    for path in proofs:
        try:
            proof = read(path.read_text(encoding="utf-8"))
            need(type(proof) is dict and type(proof.get("problem")) is str, "it is about no problem")
            need(proof["problem"] in problems, "it is about another problem or another friction model")
            under = f", under the friction model {proof['model']}" if "model" in proof else ""
            print(f"{path}: proved: {check(problems[proof['problem']], proof)}{under}")
        except WRONG as error:
            rejected += 1
            print(f"{path}: rejected: {error}")
    if folder is not None:
        print(f"{len(proofs) - rejected} of {len(proofs)} proofs prove their claims")
    return 1 if rejected else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

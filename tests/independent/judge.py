#!/usr/bin/env python3
"""An independent judge of answers to linear complementarity problems. Python's standard library only.

    judge.py [--jobs N] [FILE ...]      one JSON record a line, from the files or from standard input
    judge.py --self-test                planted lies must be caught, true records must pass

PROBLEM.  Find x with w = A x + b and lo <= x <= hi so that w_i > 0 only where x_i = lo_i, and w_i < 0
only where x_i = hi_i (lo_i = hi_i leaves w_i free).  A row i with friction_index[i] = k >= 0 is coupled:
its bounds are -+ mu_i max(x_k, 0); row k is not coupled and has lo_k >= 0.  Every floating-point number
is an exact rational, and all arithmetic below is exact.
RESIDUALS.  P_i clamps to the bounds of row i at x.  s_i = |a_ii|, else max_j |a_ij|, else 1.
    T_i = sum_j |a_ij x_j| + |b_i|;   e_i = min(T_i/s_i, R_i);   r_i = |x_i - P_i(x_i - e_i w_i/T_i)| / e_i, 0/0 = 0;
    scaled_residual = max r_i.   R_i = mu_i max(x_k, e_k) in a coupled row, elsewhere the
    largest of the finite |lo_i|, |hi_i| (but at least the key `scale`); infinity if that is 0 or infinite.
    An x_i of a coupled row within 2^-50 mu_i x_k of a bound, a rounded product, is at it.
    A problem with the key `scale` has at least s_i scale as that sum (of a row of zeros: no more than |b_i|).
    natural_residual = max_i |x_i - P_i(x_i - w_i)|;       e(x) = max_i |x_i - P_i(x_i - w_i/s_i)| sqrt(s_i)
    x is worth something if e(x) <= e(P(0))/10 or scaled_residual(P(0)) <= tolerance.
VERDICTS.  proved: scaled_residual <= tolerance, an exact solution within `distance` of x (max norm) exists,
    and distance <= 1e-6 max|x|.   within_tolerance: scaled_residual <= tolerance and x is worth something.
    not_a_solution (with the worst row and its r_i): otherwise, or if a certificate says there is none.
ROUNDING.  The size of row i is the largest |x_j| of the rows that it is connected with through A or friction, of all
    rows if it is connected with none. An x that misses counts as proved if a solution differs in no entry by more than
    64 2^-52 of that size; else the verdict is that of its rounded neighbor x', whose entries within 16 2^-52 of that size of a bound (of x', in
    coupled rows) or of 0 are moved there. The key `rounded_by` is at least the distance from that solution or from x'.
CERTIFICATES.  no_solution: d with d_i > 0 only where hi_i = inf, d_i < 0 only where lo_i = -inf, d_i = 0 in
    coupled rows; so d_i w_i >= 0 at every solution.  But max over the box of d.w = (A'd).x + b.d is < 0.
    With the key `scale` it proves nothing if -max(d.w) <= tolerance sum |d_i| s_i scale: a change of each b_i by up to
    tolerance s_i scale removes the contradiction. no_exact_solution is then a d that proves only that b as it is
    written allows no solution, with the verdict within_tolerance (or a number of pieces, as in case_split).
    case_split: no piece (below) holds a solution, even if each w_i may differ from 0 by tolerance s_i scale where it
    must be 0, or have the wrong sign by as much.     far_solution: a solution is within this of x (others may
    be nearer).     not_unique: d != 0 with A d = 0, along which a solution can move inside its bounds.
PIECES.  In a solution every row is at its lower side ("<": x_i = lo_i, w_i >= 0), at its upper side (">"), or
    inside ("=": w_i = 0).  Such a choice for all rows is a piece: linear equations and inequalities in x.
    Trying all pieces decides whether there is a solution.
EXIT CODE.  1 if anything contradicts, else 2 if some input is malformed, else 0.
"""
import argparse, fileinput, json, math, multiprocessing, sys
from collections import Counter
from fractions import Fraction as Q
from operator import mul
from types import SimpleNamespace

INF = math.inf
SLACK = Q(1, 10**9)     # forgiven where a claim compares with a threshold; never for a distance or a proof
NEAR = Q(1, 10**6)      # a proof's distance, relative to max|x|
PIECES = 6561           # with this number of pieces or fewer, a problem is always decided ...
WORK = 3 * 10**5        # ... with more, only if it takes no more than so many updates of table cells
NOT, WITHIN, PROVED = "not_a_solution", "within_tolerance", "proved"
STATUSES = ("solved", "iteration_limit", "infeasible", "failed")
CERTIFICATES = {"no_solution", "no_exact_solution", "case_split", "far_solution", "not_unique"}


def number(v, finite=True):
    """A JSON number, or "inf", "-inf", "nan". Exact if it is finite, else a float."""
    if isinstance(v, bool) or not isinstance(v, (int, float)) and v not in ("inf", "-inf", "nan"):
        raise ValueError(f"not a number: {v!r}")
    if math.isfinite(float(v)):
        return Q(float(v))
    if finite:
        raise ValueError(f"not finite: {v!r}")
    return float(v)


def common(values):
    """Integers and one denominator for all of them: sums of products are much faster so."""
    den = math.lcm(*(v.denominator for v in values))
    return [v.numerator * (den // v.denominator) for v in values], den


def clamp(v, lo, hi):
    return max(lo, min(hi, v))


def distance(x, y):
    return max((abs(a - b) for a, b in zip(x, y)), default=Q(0))


def eliminate(m, columns):
    """Bareiss' elimination of a matrix of integers, in place; returns the pivot columns and the last pivot. Every
    entry stays a determinant of a part of the first matrix, so the divisions leave no remainder."""
    det, pivots = 1, []
    for c in range(columns):
        r = len(pivots)
        found = next((i for i in range(r, len(m)) if m[i][c]), None)
        if found is None:
            continue        # no equation is left for this unknown
        m[r], m[found] = m[found], m[r]
        top, p = m[r], m[r][c]
        for i in range(r + 1, len(m)):
            f = m[i][c]
            m[i][c:] = [(p * a - f * t) // det for a, t in zip(m[i][c:], top[c:])]
        det = p
        pivots.append(c)
    return pivots, det


class Problem:
    def __init__(self, data):
        a, b = data["A"], [number(v) for v in data["b"]]
        self.n = n = len(b)
        if "dense" in a:
            A = [[number(v) for v in row] for row in a["dense"]]
        else:
            A = [[Q(0)] * a["cols"] for _ in range(a["rows"])]
            for i, j, v in a["triplets"]:
                if not (0 <= i < n and 0 <= j < n):
                    raise ValueError("a triplet outside the matrix")
                A[i][j] += number(v)
        self.owner = data.get("friction_index") or [-1] * n
        lo, hi, mu = data.get("lo") or [None] * n, data.get("hi") or [None] * n, data.get("mu") or 0
        mu = mu if isinstance(mu, list) else [mu] * n
        if any(len(v) != n for v in (A, *A, self.owner, mu, lo, hi)):
            raise ValueError("sizes do not agree")
        self.lo, self.hi, self.mu = [-INF] * n, [INF] * n, [None] * n
        for i, k in enumerate(self.owner):
            if k < 0:
                self.lo[i] = Q(0) if lo[i] is None else number(lo[i], False)
                self.hi[i] = INF if hi[i] is None else number(hi[i], False)
                if not self.lo[i] <= self.hi[i] or self.lo[i] == INF or self.hi[i] == -INF:
                    raise ValueError(f"no number is within the bounds of row {i}")
                continue
            self.mu[i] = number(mu[i])
            if self.mu[i] < 0 or any(v is not None and math.isfinite(number(v, False)) for v in (lo[i], hi[i])):
                raise ValueError(f"row {i} is coupled, but has bounds or a negative mu")
        for k in set(self.owner) - {-1}:
            if not 0 <= k < n or self.owner[k] != -1 or self.lo[k] < 0:
                raise ValueError(f"rows are coupled to row {k}, which is coupled or may be negative")
        # Row i of [A b], times a positive number that makes it whole.
        self.rows, self.den = zip(*(common([*row, v]) for row, v in zip(A, b))) if n else ((), ())
        self.scale = [abs(row[i]) or max(map(abs, row)) or Q(1) for i, row in enumerate(A)]
        self.least = rest = number(data.get("scale") or 0)
        self.rest = [rest * s if any(row) else Q(0) for s, row in zip(self.scale, A)]
        self.reduced, self.points = {}, {}      # what `point_on` has worked out already
        self.start = self.look([Q(0) if k >= 0 else clamp(Q(0), self.lo[i], self.hi[i])
                                for i, k in enumerate(self.owner)])

    def rows_at(self, x):
        """For every row: w_i, the sum of the sizes of its terms, and the bounds of x_i, at this x."""
        X, dx = common(x)
        for i, (row, den, k) in enumerate(zip(self.rows, self.den, self.owner)):
            terms = list(map(mul, row, [*X, dx]))
            reach = self.mu[i] * max(x[k], 0) if k >= 0 else None
            lo, hi = (self.lo[i], self.hi[i]) if k < 0 else (-reach, reach)
            yield Q(sum(terms), den * dx), Q(sum(map(abs, terms)), den * dx), lo, hi

    def look(self, x):
        """All numbers about x: w, the sizes of its terms, r, both residuals and the square of e(x)."""
        at = SimpleNamespace(w=[], size=[], r=[], natural=Q(0), e2=Q(0))
        rows = [(w, max(size, rest), lo, hi) for rest, (w, size, lo, hi) in zip(self.rest, self.rows_at(x))]
        for i, (v, s, (w, size, lo, hi)) in enumerate(zip(x, self.scale, rows)):
            if self.owner[i] >= 0:
                v = next((bound for bound in (lo, hi) if abs(v - bound) <= hi / 2**50), v)
            gap = abs(v - clamp(v - w / s, lo, hi))
            at.w.append(w)
            at.size.append(size)
            unit = min(size / s, self.reach(i, x, rows))
            at.r.append(abs(v - clamp(v - unit * w / size, lo, hi)) / unit if unit else (INF if gap else Q(0)))
            at.natural = max(at.natural, abs(v - clamp(v - w, lo, hi)))
            at.e2 = max(at.e2, gap * gap * s)
        at.scaled = max(at.r, default=Q(0))
        return at

    def reach(self, i, x, rows):
        """R_i: the largest x_i that the bounds of row i speak of."""
        k = self.owner[i]
        if k >= 0:
            natural = max(x[k], min(rows[k][1] / self.scale[k], self.reach(k, x, rows)))
            return self.mu[i] * natural or INF
        largest = max([abs(v) for v in (self.lo[i], self.hi[i]) if abs(v) != INF], default=Q(0))
        return max(largest, self.least) if largest else INF

    def sizes(self, x):
        """The size of x where each row is."""
        group = list(range(self.n))
        links = [(i, j) for i, row in enumerate(self.rows) for j in range(self.n) if row[j] and i != j]
        links += [(i, k) for i, k in enumerate(self.owner) if k >= 0]
        for i, j in links:
            old, new = group[i], group[j]
            if old != new:
                group = [new if g == old else g for g in group]
        linked = {i for link in links for i in link}
        largest = max(map(abs, x), default=Q(0))
        return [max(abs(x[j]) for j in range(self.n) if group[j] == group[i]) if i in linked else largest
                for i in range(self.n)]

    def rounded(self, x):
        """The rounded neighbor of x."""
        out, limits = list(x), [size * 16 / 2**52 for size in self.sizes(x)]
        for i in sorted(range(self.n), key=lambda i: self.owner[i] >= 0):
            k = self.owner[i]
            reach = self.mu[i] * max(out[k], 0) if k >= 0 else None
            targets = (self.lo[i], self.hi[i], Q(0)) if k < 0 else (-reach, reach, Q(0))
            out[i] = next((t for t in targets if abs(t) != INF and abs(x[i] - t) <= limits[i]), x[i])
        return out

    def differs_by_rounding(self, x, y):
        """Is no entry of y farther from x than 64 2^-52 of its size?"""
        return all(abs(a - b) <= size * 64 / 2**52 for a, b, size in zip(x, y, self.sizes(x)))

    def is_solution(self, x, tolerance=0):
        return all(lo <= v <= hi and (w <= tolerance * rest or v == lo) and (w >= -tolerance * rest or v == hi)
                   for v, rest, (w, _, lo, hi) in zip(x, self.rest, self.rows_at(x)))

    def piece_of(self, x):
        """The piece that x seems to be on: where does x_i - w_i/s_i lie?"""
        steps = ((v - w / s, lo, hi) for v, s, (w, _, lo, hi) in zip(x, self.scale, self.rows_at(x)))
        return "".join("<" if v <= lo else ">" if v >= hi else "=" for v, lo, hi in steps)

    def reduce(self, piece):
        """The equations of a piece, solved for as many of its inside unknowns as possible."""
        inside = [i for i, side in enumerate(piece) if side == "="]
        fixed = {i: self.lo[i] if side == "<" else self.hi[i]
                 for i, side in enumerate(piece) if side != "=" and self.owner[i] < 0}
        tied = {}       # a coupled row at a side: x_i = g x_k
        for i, k in enumerate(self.owner):
            if k >= 0 and piece[i] != "=":
                g = self.mu[i] if piece[i] == ">" else -self.mu[i]
                if k in fixed:
                    fixed[i] = g * fixed[k]
                else:
                    tied[i] = k, g
        m = []
        for a in (self.rows[i] for i in inside):
            factor = {k: a[k] for k in inside}
            for i, (k, g) in tied.items():
                factor[k] += g * a[i]
            m.append(common([*factor.values(), -a[-1] - sum(a[i] * v for i, v in fixed.items() if a[i] and v)])[0])
        pivots, det = eliminate(m, len(inside))
        return inside, fixed, tied, m, pivots, det

    def point_on(self, piece, x):
        """The point of a piece, and whether it is a solution. Unknowns that the equations leave open stay as
        in x (then the equations may have no solution at all: is_solution sees it)."""
        if piece not in self.reduced:
            self.reduced[piece] = self.reduce(piece)
        inside, fixed, tied, m, pivots, det = self.reduced[piece]
        kept = [c for c in range(len(inside)) if c not in pivots]
        key = piece, *(x[inside[c]] for c in kept)
        if key not in self.points:
            # Back substitution, for whole numbers Y = den * det * y (they are whole by Cramer's rule).
            Y, den = common([x[inside[c]] if c in kept else Q(0) for c in range(len(inside))] + [Q(-1)])
            Y = [v * det for v in Y]
            for row, c in zip(m[len(pivots) - 1::-1], pivots[::-1]):
                Y[c] = -sum(map(mul, row, Y)) // row[c]
            y = fixed | {i: Q(v, den * det) for i, v in zip(inside, Y)}
            y |= {i: g * y[k] for i, (k, g) in tied.items()}
            y = [y[i] for i in range(self.n)]
            self.points[key] = y, self.is_solution(y)
        return self.points[key]

    def guess(self, x, rounds=12):
        """A solution near x or None: solve the piece of x; if that fails, the piece of the point found; ..."""
        y, seen = x, set()
        for _ in range(rounds):
            piece = self.piece_of(y)
            if piece in seen:
                return None
            seen.add(piece)
            y, solves = self.point_on(piece, x)
            if solves:
                return y
        return None

    def nearby(self, x):
        """Solutions on the pieces that x may be on: by its steps, by its rounded neighbor, by where it lies itself, and
        by both sides of the rows where rounding decides."""
        yield from (y for y in (self.guess(x), self.guess(self.rounded(x))) if y is not None)
        rows = list(self.rows_at(x))
        own = "".join("<" if v <= lo else ">" if v >= hi else "=" for v, (_, _, lo, hi) in zip(x, rows))
        first = self.piece_of(x)
        pieces = [first, own]
        tied = []
        for i, (v, s, (w, size, lo, hi)) in enumerate(zip(x, self.scale, rows)):
            near = [side for side, bound in (("<", lo), (">", hi))
                    if abs(bound) != INF and lo < hi and abs(v - w / s - bound) <= (size / s + abs(v)) * 64 / 2**52]
            tied += [(i, side) for side in near[:1]]
        if len(tied) <= 6:
            for choice in range(1 << len(tied)):
                piece = list(first)
                for k, (i, side) in enumerate(tied):
                    piece[i] = side if choice >> k & 1 else "="
                pieces.append("".join(piece))
        for piece in pieces:        # and from a point that is no solution on to the piece of that point
            y, solves = self.point_on(piece, x)
            if solves:
                yield y
            elif len(pieces) < 100 and (following := self.piece_of(y)) not in pieces:
                pieces.append(following)

    def solution_near(self, x, far):
        """A solution no farther than `far` from x, or None if none was found (for small problems: exists)."""
        y = next((y for y in self.nearby(x) if distance(x, y) <= far), None)
        return y if y is not None and distance(x, y) <= far else CaseSplit(self, x, far).decide()[1]

    def excludes(self, d, tolerance=0):
        """Is d a certificate that there is no solution, even if each b_i changes by tolerance s_i scale?"""
        if any(v and (k >= 0 or self.hi[i] < INF and v > 0 or self.lo[i] > -INF and v < 0)
               for i, (v, k) in enumerate(zip(d, self.owner))):
            return False
        *slope, top = (sum(v * Q(row[j], den) for v, row, den in zip(d, self.rows, self.den) if v)
                       for j in range(self.n + 1))
        for j, g in enumerate(slope):
            bound = self.hi[j] if g > 0 else self.lo[j]     # infinite in coupled rows
            if g and abs(bound) == INF:
                return False
            top += g * bound if g else 0
        return top + tolerance * sum(abs(v) * rest for v, rest in zip(d, self.rest)) < 0

    def moves(self, y, d):
        """Can the solution y move along d or against it, with A d = 0?  Rows at a coupled bound may follow it."""
        if not any(d) or any(sum(map(mul, row, d)) for row in self.rows):
            return False
        bounds = [(lo, hi, 0) if k < 0 else (lo, hi, self.mu[i] * d[k])
                  for i, ((_, _, lo, hi), k) in enumerate(zip(self.rows_at(y), self.owner))]
        gaps = [pair for v, dv, (lo, hi, dh) in zip(y, d, bounds) for pair in ((v - lo, dv + dh), (hi - v, dh - dv))]
        step = min((g / abs(rate) / 2 for g, rate in gaps if rate and 0 < g < INF), default=Q(1))
        for t in (step, -step):
            z = [v + t * dv for v, dv in zip(y, d)]
            if self.is_solution(z):
                return True
        return False

    def is_monotone(self):
        """No coupled row, and A + A' is positive definite (its leading minors, by Bareiss, are positive):
        then there is exactly one solution. For two, x and y: 0 >= (x-y).(w_x-w_y) = (x-y).A(x-y) > 0."""
        if max(self.owner, default=-1) >= 0:
            return False
        D = math.lcm(*self.den)
        full = [[v * (D // den) for v in row] for row, den in zip(self.rows, self.den)]
        m, det = [[full[i][j] + full[j][i] for j in range(self.n)] for i in range(self.n)], 1
        for c in range(self.n):
            p = m[c][c]
            if p <= 0:
                return False
            for i in range(c + 1, self.n):      # symmetric: the upper half is enough
                m[i][i:] = [(p * a - m[c][i] * t) // det for a, t in zip(m[i][i:], m[c][i:])]
            det = p
        return True


class CaseSplit:
    """All pieces, tried by splitting row after row; a branch ends where its inequalities contradict.

    Variables: x_0 .. x_{n-1}; then w_0 .. w_{n-1} (times a positive number); then mu x_k + x_i and mu x_k - x_i for
    each coupled row i. A piece is a choice of bounds on them. `table` writes the variables in `basic` as
    combinations of those in `others` (and of 1, in its last column), all times `det`. With a tolerance, each w_i may
    differ by tolerance s_i scale from what a side requires."""

    def __init__(self, p, x=None, far=INF, tolerance=0):
        n = self.n = p.n
        self.p, self.det, self.tolerance = p, 1, tolerance
        self.table = [list(row) for row in p.rows]
        self.low, self.high = p.lo + [-INF] * n, p.hi + [INF] * n
        self.choices = []       # a row's sides: for each, the bounds that it puts on variables
        for i, k in enumerate(p.owner):
            error = tolerance * p.rest[i] * p.den[i]
            w, inside = n + i, {n + i: (-error, error)}
            if k >= 0:
                lower = len(self.low)
                for sign in (1, -1):
                    row = [0] * (n + 1)
                    row[k], row[i] = p.mu[i].numerator, sign * p.mu[i].denominator
                    self.table.append(row)
                    self.low.append(0)
                    self.high.append(INF)
                if p.mu[i]:     # else x_i = 0 and w is free
                    self.choices.append([{lower: (0, 0), w: (-error, INF)}, {lower + 1: (0, 0), w: (-INF, error)}, inside])
            elif p.lo[i] < p.hi[i]:
                self.low[w] = -error if p.hi[i] == INF else -INF
                self.high[w] = error if p.lo[i] == -INF else INF
                lower, upper = {i: (p.lo[i], p.lo[i]), w: (-error, INF)}, {i: (p.hi[i], p.hi[i]), w: (-INF, error)}
                self.choices.append([lower] * (p.lo[i] > -INF) + [upper] * (p.hi[i] < INF) + [inside])
        for i, v in enumerate(x or ()):
            self.low[i], self.high[i] = max(self.low[i], v - far), min(self.high[i], v + far)
        self.others, self.basic = list(range(n)), list(range(n, len(self.low)))
        self.value = list(x or [Q(0)] * n) + [Q(0)] * len(self.basic)
        self.work = INF if math.prod(map(len, self.choices)) <= PIECES else WORK

    def pivot(self, r, c):
        """Exchange the variables of row r and column c. As in Bareiss' elimination, all divisions are exact."""
        self.work -= len(self.table) * self.n * (1 + self.det.bit_length() // 512)
        if self.work < 0:
            raise TimeoutError
        top, p, det = self.table[r], self.table[r][c], self.det
        for i, row in enumerate(self.table):
            f = row[c]
            if i != r:
                self.table[i] = [(p * a - f * t) // det for a, t in zip(row, top)]
                self.table[i][c] = f
        self.table[r] = [-t for t in top]
        self.table[r][c] = det
        self.det = p
        self.basic[r], self.others[c] = self.others[c], self.basic[r]

    def feasible(self, low, high, constant=1):
        """Values of all variables within these bounds, or None if there are none. Simplex: move the first basic
        variable that is out of bounds to its bound, by the first other variable that can be moved the right
        way; if no other can, the row itself shows a contradiction. "First" is Bland's rule: it never cycles."""
        if any(l > h for l, h in zip(low, high)):
            return None
        for v in self.others:
            self.value[v] = clamp(self.value[v], low[v], high[v])
        while True:
            whole, den = common([self.value[v] for v in self.others])
            for v, row in zip(self.basic, self.table):
                self.value[v] = Q(sum(map(mul, row, [*whole, constant * den])), den * self.det)
            outside = [(v, r) for r, v in enumerate(self.basic) if not low[v] <= self.value[v] <= high[v]]
            if not outside:
                return self.value[:]
            v, r = min(outside)
            up = (self.value[v] < low[v]) == (self.det > 0)
            usable = [(q, c) for c, q in enumerate(self.others) if (t := self.table[r][c]) and
                      (self.value[q] < high[q] if (t > 0) == up else self.value[q] > low[q])]
            if not usable:
                return None
            target = clamp(self.value[v], low[v], high[v])
            self.pivot(r, min(usable)[1])
            self.value[v] = target

    def pieces(self, low, high, rows):
        """Every piece that is not empty, as (a point of it, low, high)."""
        point = self.feasible(low, high)
        if point is None:
            return
        if not rows:
            yield point, low, high
            return
        holds = lambda side: all(a <= point[v] <= b for v, (a, b) in side.items())
        row = next((c for c in rows if not any(map(holds, self.choices[c]))), rows[0])
        for side in sorted(self.choices[row], key=holds, reverse=True):
            l, h = low[:], high[:]
            for v, (a, b) in side.items():
                l[v], h[v] = max(l[v], a), min(h[v], b)
            yield from self.pieces(l, h, [c for c in rows if c != row])

    def is_point(self, point, low, high):
        """Is this piece a single point? Else one can leave the point: there are changes d of all variables, not
        against a bound that holds with equality, with some d_j = 1 or -1 for an x_j."""
        if all(low[v] == high[v] for v in self.others):
            return True
        rise = [-INF if v > l else 0 for v, l in zip(point, low)]
        fall = [INF if v < h else 0 for v, h in zip(point, high)]
        for j in range(self.n):
            for d in (1, -1):
                if rise[j] <= d <= fall[j] and self.feasible(
                        rise[:j] + [d] + rise[j + 1:], fall[:j] + [d] + fall[j + 1:], constant=0):
                    return False
        return True

    def holds(self, x):
        return self.p.is_solution(x, self.tolerance)

    def decide(self, how_many=False):
        """(number of solutions, one of them): 0, 1 (where how_many: exactly, else: or more), 2 (or more). (None, None)
        if that is too much work."""
        one = None
        try:
            for point, low, high in self.pieces(self.low, self.high, list(range(len(self.choices)))):
                x = point[:self.n]
                assert self.holds(x)
                if how_many and (one not in (None, x) or not self.is_point(point, low, high)):
                    return 2, x
                one = x
                if not how_many:
                    break
        except TimeoutError:
            return None, None
        return (0 if one is None else 1), one


def show(v):
    return f"{float(v):.6g}" if abs(v) <= sys.float_info.max else str(INF if v > 0 else -INF)


def agrees(output, exact, relative, absolute):
    if isinstance(output, float):     # not finite: right where a float can hardly hold the number, or its parts
        return output == (INF if exact > 0 else -INF) and abs(exact) > 1e300
    return abs(exact) < INF and abs(output - exact) <= max(relative * abs(exact), absolute)


def read_answer(raw, p):
    """Check the form of an answer; numbers become exact. x is None if it is not finite."""
    get = lambda key: None if raw.get(key) is None else number(raw[key], False)
    listed = lambda key: [number(v, False) for v in raw[key]]
    numbers = {key: get(key) for key in ("scaled_residual", "natural_residual", "distance", "amount", "rounded_by")}
    a = SimpleNamespace(solver=str(raw["solver"]), status=raw["status"], verdict=raw["verdict"], row=raw.get("row"),
                        exit_code=raw.get("exit_code"), x=listed("x"), w=listed("w") if raw.get("w") else None,
                        certificate=dict(raw.get("certificate") or {}), **numbers)
    cert = a.certificate
    for key in {"no_solution", "no_exact_solution", "not_unique"} & set(cert):
        cert[key] = [Q(v) for v in cert[key]] if key != "no_exact_solution" or isinstance(cert[key], list) else cert[key]
    if "far_solution" in cert:
        cert["far_solution"] = number(cert["far_solution"])
    pieces = [cert.get("case_split", 1), cert.get("no_exact_solution", 1)]
    pieces = [v for v in pieces if not isinstance(v, list)]
    if any(type(v) is not int or v < 1 for v in pieces):
        raise ValueError("not a number of pieces")
    exact = cert.get("no_exact_solution")
    exact = exact if isinstance(exact, list) else a.x
    if (a.status not in STATUSES or a.verdict not in (NOT, WITHIN, PROVED) or set(cert) - CERTIFICATES or
            any(len(v) != p.n for v in (a.x, exact, a.w or a.x, cert.get("no_solution", a.x), cert.get("not_unique", a.x)))):
        raise ValueError(f"answer of {a.solver}: unknown word or wrong length")
    a.x = a.x if all(isinstance(v, Q) for v in a.x) else None
    a.says_none = bool(cert.keys() & {"no_solution", "case_split"})
    a.needs_none = False        # set where the verdict can be right only if there is no solution
    return a


def check_alone(p, tolerance, a, known, count):
    """Yield all that is wrong with an answer by itself. Solutions and proofs found go into `known`."""
    cert, good = a.certificate, a.verdict != NOT
    if a.status == "infeasible" and not a.says_none:
        yield "status infeasible without a certificate"
    if a.status == "infeasible" and good:
        yield f"status infeasible beside verdict {a.verdict}"
    if a.says_none and good:  # a solver may claim "solved" of such a problem; the judge may not
        yield f"a certificate of no solution beside verdict {a.verdict}, status {a.status}"
    if a.exit_code not in (None, 0 if good else 1):
        yield f"exit code {a.exit_code} beside verdict {a.verdict}"
    if "far_solution" in cert and a.verdict != WITHIN:
        yield f"far_solution beside verdict {a.verdict}"
    if "no_solution" in cert:
        if p.excludes(cert["no_solution"], tolerance):
            known.excluded = known.exactly_none = True
            count["certificates"] += 1
        else:
            yield "the vector no_solution does not prove that there is no solution"
    if "no_exact_solution" in cert and a.verdict != WITHIN:
        yield f"no_exact_solution beside verdict {a.verdict}"
    if isinstance(exact := cert.get("no_exact_solution"), list):
        if p.excludes(exact) and not p.excludes(exact, tolerance):
            known.exactly_none = True
            count["certificates"] += 1
        else:
            yield "the vector no_exact_solution is no proof, or one of more than it says"
    if a.x is None:
        if good or a.status == "solved":
            yield f"x is not finite, but verdict {a.verdict}, status {a.status}"
        if cert.keys() & {"far_solution", "not_unique"}:
            yield "x is not finite, but has a certificate about solutions near it"
        return
    at, size = p.look(a.x), max(map(abs, a.x), default=Q(0))
    # The numbers told.
    for name, output, exact, absolute in (
            ("scaled_residual", a.scaled_residual, at.scaled, Q(1, 10**15)),
            ("natural_residual", a.natural_residual, at.natural, max([size, *map(abs, at.w)]) / 10**12)):
        if output is not None and not agrees(output, exact, NEAR, absolute):
            yield f"{name} is {show(exact)}, not {show(output)}"
    for i, (output, exact, terms) in enumerate(zip(a.w or (), at.w, at.size)):
        if not agrees(output, exact, 0, terms / 10**12 + Q(1, 10**300)):      # (10^-300: where floats get coarse)
            yield f"w[{i}] is {show(exact)}, not {show(output)}"
    # The verdict.
    allowed = tolerance * (1 + SLACK), tolerance * (1 - SLACK)
    fits, misses = at.scaled <= allowed[0], at.scaled > allowed[1]
    worth = 100 * at.e2 <= p.start.e2 * (1 + 2 * SLACK) or p.start.scaled <= allowed[0]
    worthless = 100 * at.e2 > p.start.e2 * (1 - 2 * SLACK) and p.start.scaled > allowed[1]
    neighbor = p.rounded(a.x)
    at_neighbor = p.look(neighbor)
    neighbor_fits = at_neighbor.scaled <= allowed[0] and (
        100 * at_neighbor.e2 <= p.start.e2 * (1 + 2 * SLACK) or p.start.scaled <= allowed[0])
    if good and a.rounded_by is not None:
        y = p.solution_near(a.x, a.distance) if a.verdict == PROVED and isinstance(a.distance, Q) else None
        accepted = [neighbor] if neighbor_fits else []
        accepted += [y] if y is not None and p.differs_by_rounding(a.x, y) else []
        if not accepted:
            yield f"{a.verdict} by rounding, but no solution is that close, and of its neighbor {show(at_neighbor.scaled)} is left"
        elif not isinstance(a.rounded_by, Q) or all(a.rounded_by < distance(a.x, z) * (1 - SLACK) for z in accepted):
            yield f"rounded_by is {show(min(distance(a.x, z) for z in accepted))}"
    elif good and not fits:
        yield f"{a.verdict}, but its scaled residual is {show(at.scaled)}"
    if a.status == "solved" and not good and at.scaled > tolerance * Q(1001, 1000):
        yield f"solved, but its scaled residual is {show(at.scaled)}"
    if a.verdict == WITHIN and a.rounded_by is None and not worth:
        yield f"{a.verdict}, but x is not worth anything: e(x)^2 = {show(at.e2)}, at P(0) {show(p.start.e2)}"
    if a.verdict == NOT:
        if type(a.row) is not int or not 0 <= a.row < p.n or at.r[a.row] < at.scaled * (1 - NEAR) - Q(1, 10**15):
            yield f"row {a.row} is not the worst one: that is row {at.r.index(at.scaled) if at.r else None}"
        elif a.amount is None or not agrees(a.amount, at.r[a.row], NEAR, Q(1, 10**15)):
            yield f"the amount in row {a.row} is {show(at.r[a.row])}"
        strictly = at_neighbor.scaled <= allowed[1] and neighbor_fits
        a.needs_none = not misses and not worthless or strictly
    if a.verdict == PROVED:
        if not isinstance(a.distance, Q) or a.distance > NEAR * size * (1 + SLACK):
            yield "proved without a distance, or with one above 1e-6 max|x|"
        elif (y := p.solution_near(a.x, a.distance)) is not None:
            known.solutions.append(y)
            count["proved"] += 1
        else:
            yield f"could not confirm the proof: no exact solution found within {float(a.distance):.17g} of x"
    # Certificates about solutions. (Those that there is none need more than this answer: see judge_lcp.)
    if "far_solution" in cert:
        y = p.solution_near(a.x, cert["far_solution"])
        if y is not None:
            known.solutions.append(y)
            count["certificates"] += 1
        else:
            yield "could not confirm far_solution"
    if "not_unique" in cert:
        near = p.solution_near(a.x, INF)
        if any(p.moves(y, cert["not_unique"]) for y in [near, *known.solutions] if y is not None):
            known.solutions += [near] if near is not None else []
            known.several, count["certificates"] = True, count["certificates"] + 1
        else:
            yield "could not confirm not_unique"


def read_lcp(record, answers, diagnosis):
    """Everything that may be malformed is read here."""
    p, tolerance = Problem(record["problem"]), number(record["tolerance"])
    sound, unique = diagnosis.get("is_sound") is not False, diagnosis.get("unique")
    impossible = any(c["name"] == "impossible" and (c.get("is_proved") or c.get("is_fatal") and not sound)
                     for c in diagnosis.get("causes", []))
    if unique not in (True, False, None):
        raise ValueError("unique is neither true, false nor null")
    return p, tolerance, [read_answer(raw, p) for raw in answers], impossible, unique


def judge_lcp(p, tolerance, answers, impossible, unique, count):
    """Judge the answers to one problem, and what its diagnosis says; yields (solver, what is wrong)."""
    known = SimpleNamespace(solutions=[], excluded=False, exactly_none=False, several=False)
    for a in answers:
        yield from ((a.solver, what) for what in check_alone(p, tolerance, a, known, count))
    # The truth: is there a solution, and only one?
    some = True if known.solutions else False if known.exactly_none else None
    several = known.several or any(y != known.solutions[0] for y in known.solutions) or None
    says_none = [a.solver for a in answers if a.says_none or a.status == "infeasible"] + ["diagnosis"] * impossible
    says_some = [a.solver for a in answers if a.verdict == PROVED or a.certificate.keys() & {"far_solution", "not_unique"}]
    says_some += ["diagnosis"] * (unique is True)
    says_inexact = [a.solver for a in answers if "no_exact_solution" in a.certificate]
    hopes = [a for a in answers if a.verdict != PROVED and (a.verdict == WITHIN or a.status == "solved")]
    how_many = unique is not None and some is not False and several is None
    if how_many or some is None and (says_none or says_some or says_inexact or hopes):
        split = CaseSplit(p)
        if split.work == INF or says_none or says_inexact or unique is True:    # (else it would cost much and decide little)
            if not how_many and any(a.x is not None and p.guess(a.x) is not None for a in answers):
                number_of = 1
            else:
                number_of = 1 if p.is_monotone() else split.decide(how_many)[0]
            assert number_of is None or some in (None, number_of > 0), "the judge contradicts itself"
            if number_of is not None:
                some, several = number_of > 0, number_of > 1 if how_many else several
                count["truths"] += 1
    assert not (some and known.exactly_none), "the judge contradicts itself"
    # Is there none even if b changes by what the tolerance ignores?
    none = True if known.excluded else False if some else None
    if none is None and some is False:
        number_of = CaseSplit(p, tolerance=tolerance).decide()[0] if p.least else 0
        none = None if number_of is None else number_of == 0
    # What the claims are worth.
    for who in says_none:
        if some:
            yield who, "says that there is no solution, but there is one"
        elif none is False:
            yield who, "says that there is no solution, but only rounding contradicts it: a change of b below the scale"
        elif none is None:
            yield who, "undecided: says that there is no solution; too large to check"
    for who in says_inexact:
        if some:
            yield who, "says that there is no exact solution, but there is one"
    for who in says_some:
        if some is False:
            yield who, "says that there is a solution, but there is none"
    for a in answers:
        if none and a in hopes:
            yield a.solver, f"unsupported: verdict {a.verdict}, status {a.status}, but there is no solution"
        if none and "case_split" in a.certificate:
            count["certificates"] += 1
        if a.needs_none and (none is False or not (impossible or any(other.says_none for other in answers))):
            yield a.solver, (f"{NOT}, but its residual is within tolerance, x is worth something, and nothing proves "
                             "that there is no solution")
    if unique is True and several:
        yield "diagnosis", "says that the solution is unique, but there are several"
    if unique is True and some is not False and several is None:
        yield "diagnosis", "undecided: says that the solution is unique; too large to check"
    if unique is False and some and several is False:
        yield "diagnosis", "unsupported: unique is false, but there is exactly one solution"


MODELS = {"lcp": (read_lcp, judge_lcp)}     # answers of other models are skipped; no model means "lcp"


def judge_line(line):
    """Judge one record; returns the lines to print and the counts."""
    count, lines, name = Counter(records=1), [], "?"
    try:
        record = json.loads(line)
        name, main = str(record["name"]), record.get("model") or "lcp"
        by_model = {main: []}
        for raw in record["answers"]:
            by_model.setdefault(raw.get("model") or main, []).append(raw)
        read = {model: MODELS[model][0](record, answers, (record.get("diagnosis") or {}) if model == main else {})
                for model, answers in by_model.items() if model in MODELS}
    except (ValueError, KeyError, TypeError, AttributeError, IndexError, ArithmeticError) as error:
        return [f"{name}: malformed: {type(error).__name__}: {error}"], count + Counter(malformed=1)
    for model, answers in by_model.items():
        count["answers" if model in MODELS else "skipped"] += len(answers)
    for model, parts in read.items():
        for solver, what in MODELS[model][1](*parts, count):
            kind = what.split(":")[0] if what.startswith(("unsupported:", "undecided:")) else "contradictions"
            count[kind] += 1
            lines.append(f"{name}: {solver}: " + ("CONTRADICTION: " if kind == "contradictions" else "") + what)
    return lines, count


def self_test():
    """Every record here with its lie (a part of the message expected), or None if it is true."""
    def answer(problem, x, verdict, status="solved", **more):
        x = [number(v, False) for v in x]
        output = {"solver": "s", "x": [float(v) for v in x], "verdict": verdict, "status": status}
        output["exit_code"] = int(verdict == NOT)
        if all(isinstance(v, Q) for v in x):
            at = Problem(problem).look(x)
            output |= {"w": [float(v) for v in at.w], "natural_residual": float(at.natural)}
            output["scaled_residual"] = float(at.scaled)
            output |= {"row": at.r.index(at.scaled), "amount": float(at.scaled)} if verdict == NOT else {}
        return json.loads(json.dumps(output | more).replace("NaN", '"nan"'))

    def lcp(A, b, **more):
        return {"A": {"dense": A}, "b": b} | more

    a = lcp([[1, -1], [-1, 1]], [-1, -5], friction_index=[-1, 0], mu=[0, 0.5])
    b = a | {"b": [-1, -0.5], "mu": 1}
    c = lcp([[0, 1], [1, 1]], [-1.000000001, 0], lo=[0, 1], hi=["inf", 1])
    d = lcp([[27, 21, 21], [21, 17, 17], [21, 17, 17]], [-1, -1, -2], friction_index=[-1, 0, 0], mu=2)
    e = lcp([[10, 8], [8, 8]], [1, 3], friction_index=[-1, 0], mu=2)
    f, third = lcp([[3]], [-1]), 1 / 3
    i = lcp([[2, 0], [0, 3]], [-1, 0], lo=[0, "-inf"])     # an equation without load
    g = lcp([[1, 1], [1, 1]], [-2, -2])
    h = lcp([[1, 1], [1, 1 + 2**-27]], [-2, -2 - 2**-27])       # solution (1, 1); nearly as good: (1 + t, 1 - t)
    # Two equations for one motion, as of a door on two hinges: they agree but for rounding, so nothing solves both.
    j = lcp([[2, 2], [2, 2]], [-2, math.nextafter(-2, -3)], lo=["-inf"] * 2, scale=1e-3)
    only, both = {"no_exact_solution": ["-1", "1"]}, {"no_solution": ["-1", "1"]}
    # The same with a gap of 1e-6, far from the origin: small beside the terms of x, but not beside the scale.
    k = j | {"b": [-2, -2 - 1e-6]}
    # Painleve's trouble in two rows, 1.5 v apart: solvable if w may be off by e = 1e-8 and v <= 4/3 e.
    near, l, m = ({**b, "b": [-v, -v / 2], "scale": 1} for v in (0.9e-8, 1.3e-8, 1.4e-8))
    tiny = float(abs(Q(third) - Q(1, 3)))
    tiny = tiny if Q(tiny) >= abs(Q(third) - Q(1, 3)) else math.nextafter(tiny, 1)
    no, yes = {"no_solution": ["1", "0"]}, {"is_sound": True, "unique": True, "causes": []}
    never = {"is_sound": False, "causes": [{"name": "impossible", "is_fatal": True, "is_proved": True, "rows": [0]}]}
    tests = [
        ("a true", a, [answer(a, [2, 1], PROVED, distance=0)], None, None),
        ("a", a, [answer(a, [2, 1], PROVED, distance=0)], never, "says that there is no solution, but"),
        ("a, of x = 0", a, [answer(a, [0, 0], NOT, "failed")], never, "says that there is no solution, but"),
        ("b true", b, [answer(b, [0, 0], NOT, "infeasible", certificate={"case_split": 9})], never, None),
        ("b", b, [answer(b, [1e9, 1e9], PROVED, distance=1.0)], None, "could not confirm the proof"),
        ("b within", b, [answer(b, [1e9, 1e9], WITHIN)], None, "not worth anything"),
        ("c true", c, [answer(c, [0, 1], NOT, "infeasible", certificate=no)], never, None),
        ("c", c, [answer(c, [0, 1], WITHIN, "infeasible", certificate=no)], None, "beside verdict within_tolerance"),
        ("c wrong sign", c, [answer(c, [0, 1], NOT, "infeasible", certificate={"no_solution": ["-1", "0"]})],
         None, "does not prove"),
        ("c unsupported", c, [answer(c, [0, 1], WITHIN)], None, None),
        ("c contradict", c, [answer(c, [0, 1], NOT, "infeasible", certificate=no), answer(c, [0, 1], PROVED, distance=1e-7)],
         None, "says that there is a solution, but"),
        ("d", d, [answer(d, [0, 0, 0], NOT, "failed")], never, "says that there is no solution, but"),
        ("d true", d, [answer(d, [1 / 111, 2 / 111, 2 / 111], PROVED, distance=1e-17)], None, None),
        ("e", e, [answer(e, [0, 0], PROVED, distance=0)], yes, "there are several"),
        ("e true", e, [answer(e, [1, -1.375], PROVED, distance=0)], yes | {"unique": False}, None),
        ("f true", f, [answer(f, [third], PROVED, distance=tiny)], yes, None),
        ("f one ulp", f, [answer(f, [third], PROVED, distance=math.nextafter(tiny, 0))], None, "could not confirm"),
        ("f wrong row", a, [answer(a, [9, 2], NOT, "failed", row=1)], None, "not the worst one"),
        ("f nan", f, [answer(f, ["nan"], PROVED, distance=0)], None, "x is not finite"),
        ("f nan true", f, [answer(f, ["nan"], NOT, "failed")], None, None),
        ("f far", f, [answer(f, [third * 1.001], PROVED, distance=1e-3)], None, "scaled residual is"),
        ("f too good", f, [answer(f, [third], NOT, "failed")], None, "nothing proves"),
        ("f residual", f, [answer(f, [0.3], NOT, "failed", scaled_residual=1e-9)], None, "scaled_residual is 0.0526316"),
        ("f w", f, [answer(f, [0.3], NOT, "failed", w=[1])], None, "w[0] is"),
        ("f solved", f, [answer(f, [0.3], NOT)], None, "solved, but"),
        ("f exit code", f, [answer(f, [third], WITHIN, exit_code=1)], None, "exit code"),
        ("f infeasible", f, [answer(f, [0], NOT, "infeasible")], None, "without a certificate"),
        ("g true", g, [answer(g, [1, 1], PROVED, distance=0, certificate={"not_unique": ["1", "-1"]})], None, None),
        ("g", g, [answer(g, [1, 1], PROVED, distance=0, certificate={"not_unique": ["1", "1"]})], None, "not_unique"),
        ("g unique", g, [answer(g, [1, 1], PROVED, distance=0)], yes, "there are several"),
        ("g case split", g, [answer(g, [1, 3], NOT, "infeasible", certificate={"case_split": 4})], None, "but there is one"),
        ("h true", h, [answer(h, [1.001, 0.999], WITHIN, certificate={"far_solution": 0.0011})], yes, None),
        ("h", h, [answer(h, [1.001, 0.999], WITHIN, certificate={"far_solution": 0.0009})], None, "confirm far_solution"),
        ("h proved", h, [answer(h, [1.001, 0.999], PROVED, distance=0.0011)], None, "above 1e-6"),
        ("i rounding", i, [answer(i, [0.5, 2e-17], PROVED, distance=2e-17, rounded_by=2e-17)], yes, None),
        ("i untold", i, [answer(i, [0.5, 2e-17], PROVED, distance=2e-17)], yes, "but its scaled residual is"),
        ("i neighbor", i, [answer(i, [0.5, 2e-17], WITHIN, rounded_by=2e-17)], yes, None),
        ("i too far", i, [answer(i, [0.5, 2e-13], PROVED, distance=2e-13, rounded_by=2e-13)], yes, "by rounding, but"),
        ("i refused", i, [answer(i, [0.5, 2e-17], NOT, "failed")], yes, "nothing proves"),
        ("j true", j, [answer(j, [0.5, 0.5], WITHIN)], None, None),
        ("j wrong", j, [answer(j, [0.5, 0.500001], WITHIN)], None, "its scaled residual is"),
        ("j refused", j, [answer(j, [0.5, 0.5], NOT, "failed")], None, "nothing proves"),
        ("j output", j, [answer(j, [0.5, 0.5], WITHIN, certificate=only)], None, None),
        ("j output, wrong d", j, [answer(j, [0.5, 0.5], WITHIN, certificate={"no_exact_solution": ["1", "1"]})], None, "is no proof"),
        ("j no solution", j, [answer(j, [0.5, 0.5], NOT, "failed", certificate=both)], None, "does not prove"),
        ("j infeasible", j, [answer(j, [0.5, 0.5], NOT, "infeasible", certificate={"case_split": 1})], None, "only rounding"),
        ("k true", k, [answer(k, [1e4, 1 - 1e4], NOT, "failed", certificate=both)], None, None),
        ("k", k, [answer(k, [1e4, 1 - 1e4], WITHIN, certificate=only)], None, "is no proof, or one of more"),
        ("l", l, [answer(l, [0, 0], NOT, "infeasible", certificate={"case_split": 3})], None, "only rounding"),
        ("near true", near, [answer(near, [0, 0], WITHIN, certificate={"no_exact_solution": 3})], None, None),
        ("m", m, [answer(m, [0, 0], NOT, "infeasible", certificate={"case_split": 3})], None, None),
        ("a exact", a, [answer(a, [2, 1], WITHIN, certificate={"no_exact_solution": 3})], None, "but there is one"),
        ("j proved", j, [answer(j, [0.5, 0.5], PROVED, distance=1e-9)], None, "could not confirm the proof"),
        ("malformed", g | {"b": [1]}, [], None, "malformed"),
        ("cone", f, [{"model": "coulomb-cone"}], None, None)]
    failed = 0
    for name, problem, answers, diagnosis, expected in tests:
        lines, _ = judge_line(json.dumps({"name": name, "problem": problem, "tolerance": 1e-8,
                                          "answers": answers, "diagnosis": diagnosis}))
        lies = [line for line in lines if "CONTRADICTION" in line or "malformed" in line]
        if bool(lies) != (expected is not None) or expected and not any(expected in line for line in lies):
            failed += 1
            print(f"self-test {name!r} failed: expected {expected!r}, got {lines}")
    if CaseSplit(Problem(d)).decide(True) != (1, [Q(1, 111), Q(2, 111), Q(2, 111)]) or CaseSplit(Problem(e)).decide(True)[0] != 2:
        failed += 1
        print("self-test of the case split failed")
    print(f"self-test: {len(tests) + 1} cases, {failed} failed")
    return 1 if failed else 0


def main():
    options = argparse.ArgumentParser(description="An independent judge of answers to linear complementarity problems.")
    options.add_argument("files", nargs="*")
    options.add_argument("--jobs", type=int, default=multiprocessing.cpu_count())
    options.add_argument("--self-test", action="store_true")
    options = options.parse_args()
    if options.self_test:
        return self_test()
    total = Counter()
    try:
        with (fileinput.input(options.files or "-", encoding="utf-8") as source,
              multiprocessing.Pool(max(1, options.jobs)) as pool):
            for lines, count in pool.imap(judge_line, (line for line in source if line.strip())):
                total += count
                print(*lines, sep="\n", end="\n" if lines else "")
    except (OSError, UnicodeError) as error:
        print(error)
        return 2
    texts = {"proved": "proved confirmed", "certificates": "certificates confirmed", "truths": "truths decided"}
    print("; ".join(f"{texts.get(key, key)}: {total[key]}" for key in (
        "records", "answers", *texts, "undecided", "unsupported", "skipped", "malformed", "contradictions")))
    return 1 if total["contradictions"] else 2 if total["malformed"] or not total["records"] else 0


if __name__ == "__main__":
    sys.exit(main())

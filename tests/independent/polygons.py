#!/usr/bin/env python3
"""The second judge for contacts whose friction is a polygon, from the definitions alone.

    polygons.py FILE ...      judges the records (as judge.py takes them) of models `polygon-K`
    polygons.py --self-test   closed forms must pass, planted lies must be caught

PROBLEM.  A contact has rows n, t1, t2 (t1 and t2 name n in `friction_index`) and mu; w = A x + b,

    x_n >= 0,  w_n >= 0,  x_n w_n = 0,    x_t in mu x_n P,    x_t.w_t <= y.w_t for y in mu x_n P.

P is the polygon with the corners d_j = (cos 2 pi j/K, sin 2 pi j/K), j < K, each coordinate
rounded to the nearest double. So friction dissipates as much as the polygon permits. Without
friction x_t = 0. Other rows are as in judge.py. Every double is an exact rational number, and all
arithmetic is exact.
STATES.  A contact is in one of 2 + 2K states: open (x_n = x_t = 0), sticking (w = 0 and x_t in
    mu x_n P), sliding at a corner (x_t = mu x_n d_j, w_n = 0) or on an edge (x_t on edge j,
    w_n = 0, w_t.(d_j+1 - d_j) = 0), each with its inequalities. All states of all contacts and
    rows are tried: this decides whether there is a solution, and whether one is within a given
    distance of x.
UNKNOWNS.  x_t = sum_j beta_j d_j with beta >= 0 for the two d_j that x_t lies between. With gamma,
    the speed of slip, z = (other rows, x_n, beta, gamma) solves the LCP

    x_n _|_ w_n      beta_j _|_ d_j.w_t + gamma      gamma _|_ mu x_n - sum_j beta_j

    where x_t = 0 in contacts without friction. gamma is 0, max_j -d_j.w_t or, of a j with
    beta_j > 0, -d_j.w_t: whichever leaves the smallest residual.
RESIDUAL.  The largest of: r (see judge.py) of the rows x_n and of the other rows in that LCP; the
    same of each beta with R = mu max(x_n, T_n/s_n), infinite if 0; for each contact
    |min((mu x_n - sum beta)/R, gamma/T_beta)|, with sum beta as R if that is infinite, and T_beta
    of the beta whose d_j.w_t + gamma is nearest to 0; |x_t| s/T for x_t of contacts without
    friction. lcplab may report a larger number, since z can be measured in other ways, but must not
    reject an answer because of that. With another gamma it may report half as much, no less.
    x is worth something if e(z), without gamma, is at most e(P(0))/10, or the residual of P(0) is
    at most the tolerance.
BACKWARD ERROR.  Measures x without z: for each contact the state that fits best, and by how much x
    violates it, relative to the terms of w, to T_n/s_n (for x_n) and to min(R, T_t/s_t) (for x_t).
    An answer whose residual is accepted has a backward error of at most 100 times the tolerance,
    relative to the larger terms of both tangents; one whose residual is rejected, of at least a
    hundredth of it, relative to the smaller ones.
VERDICTS.  As in judge.py. proved: only with four corners, whose d_j are exact. Rounding as in
    judge.py; the rounded neighbor moves x_n to its bound 0 and x_t to 0. If a solution differs in
    no entry by more than 64 2^-52 of its size, the answer is right: rejecting it is a contradiction
    with four corners, and counts as `unproved` with more.

Output as in judge.py. `unsupported`: accepted with more than four corners, with a `scale`, or with more cases than
lcplab splits, although there is no solution. `undecided`: too many states to try.
"""
import fileinput
import json
import math
import multiprocessing
import sys
from collections import Counter
from decimal import Decimal, localcontext
from functools import cache
from itertools import islice, product
from operator import mul
from random import Random
from types import SimpleNamespace

from judge import (INF, NOT, PIECES, PROVED, WITHIN, WORK, CaseSplit, Problem, Q, agrees, common, distance,
                   eliminate, number, show)

CLOSE, TINY = Q(1, 10**6), Q(1, 10**15)      # a reported residual is a float, summed with care
FACTOR = 100                                 # between a residual and the backward error


@cache
def corners(k):
    """The d_j, rounded to doubles from 50 digits."""
    with localcontext() as context:
        context.prec = 50
        arctan = lambda d: sum(Decimal((-1) ** i) / ((2 * i + 1) * Decimal(d) ** (2 * i + 1)) for i in range(60))
        pi = 16 * arctan(5) - 4 * arctan(239)

        def cos_sin(angle):         # by its power series
            parts, term = [Decimal(0)] * 4, Decimal(1)
            for i in range(1, 120):
                parts[(i - 1) % 4] += term
                term *= angle / i
            return parts[0] - parts[2], parts[1] - parts[3]

        def corner(j):
            quarter, rest = divmod(j, k // 4)
            c, s = (Q(float(v)) for v in cos_sin(2 * pi * rest / k)) if rest else (Q(1), Q(0))
            return [(c, s), (-s, c), (-c, -s), (s, -c)][quarter]

        return [corner(j) for j in range(k)]


def cross(p, q):
    return p[0] * q[1] - p[1] * q[0]


def part(v, unit):
    """v in parts of a unit, 0/0 = 0."""
    return v / unit if unit else (INF if v > 0 else Q(0))


def directions(model):
    """K, or None for another model."""
    name, _, k = str(model).partition("-")
    if name != "polygon":
        return None
    if not k.isdecimal() or str(int(k)) != k or int(k) % 4 or not 4 <= int(k) <= 256:
        raise ValueError(f"no friction model: {model}")
    return int(k)


class Unknowns(Problem):
    """The LCP in z: others, normals, K beta of each contact with friction, their gamma."""

    def __init__(self, polygon):
        p, box, k = polygon, polygon.box, polygon.k
        self.normals = {c[0]: len(p.others) + i for i, c in enumerate(p.contacts)}
        units = [{i: Q(1)} for i in [*p.others, *self.normals]]
        self.belongs = [*p.others, *self.normals]         # the row of x that an unknown belongs to
        self.first = len(units)
        for _, t1, t2, _ in p.rubbing:
            units += [{t1: d[0], t2: d[1]} for d in p.d]
            self.belongs += [t1] * k
        self.gamma = len(units)
        self.belongs += [c[0] for c in p.rubbing]
        n = self.n = len(self.belongs)
        along = lambda u, v: sum(c * v[i] for i, c in u.items())
        M, self.b = [[Q(0)] * n for _ in range(n)], [along(u, p.b) for u in units] + [Q(0)] * (n - self.gamma)
        self.doubtful = [0.0] * n       # sizes of all products, before any cancels
        self.products = [[0.0] * n for _ in range(n)]
        for r, u in enumerate(units):
            row = [sum(c * p.A[i][j] for i, c in u.items()) for j in range(box.n)]
            sizes = [sum(abs(float(c) * float(p.A[i][j])) for i, c in u.items()) for j in range(box.n)]
            for q, v in enumerate(units):
                M[r][q] = along(v, row)
                self.products[r][q] = sum(abs(float(c)) * sizes[i] for i, c in v.items())
            self.doubtful[r] = sum(abs(float(c) * float(p.b[i])) for i, c in u.items())
        for c, (i, _, _, mu) in enumerate(p.rubbing):
            gamma = self.gamma + c
            M[gamma][self.normals[i]] = mu
            for beta in self.betas(c, k):
                M[beta][gamma], M[gamma][beta] = Q(1), Q(-1)
        self.lo = [box.lo[i] for i in p.others] + [Q(0)] * (n - len(p.others))
        self.hi = [box.hi[i] for i in p.others] + [INF] * (n - len(p.others))
        self.owner, self.mu = [-1] * n, [None] * n
        self.rows, self.den = zip(*(common([*row, v]) for row, v in zip(M, self.b))) if n else ((), ())
        self.scale = [abs(row[i]) or max(map(abs, row)) or Q(1) for i, row in enumerate(M)]
        self.least = box.least
        self.rest = [self.least * s if any(row) else Q(0) for s, row in zip(self.scale, M)]
        self.reduced, self.points = {}, {}
        self.start = self.look([max(lo, min(hi, Q(0))) for lo, hi in zip(self.lo, self.hi)])

    def betas(self, c, k):
        return range(self.first + c * k, self.first + (c + 1) * k)

    def rounding(self, z, at):
        """By how much rounding the entries of the LCP may change the largest residual: 1e-10 at most."""
        size = [abs(float(v)) for v in z]
        sums = [d + sum(m * v for m, v in zip(row, size)) for d, row in zip(self.doubtful, self.products)]
        parts = [s / float(t) for s, t in zip(sums, at.size) if t]
        return Q(min(16 * max(parts, default=0) / 2**52, 1e-10))


class Polygons:
    def __init__(self, data, k):
        self.k, self.d, self.box = k, corners(k), Problem(data)
        n = self.n = self.box.n
        self.A = [[Q(v, den) for v in row[:n]] for row, den in zip(self.box.rows, self.box.den)]
        self.b = [Q(row[n], den) for row, den in zip(self.box.rows, self.box.den)]
        owners = {}
        for i, owner in enumerate(self.box.owner):
            if owner >= 0:
                owners.setdefault(owner, []).append(i)
        for i, tangents in owners.items():
            if len(tangents) != 2 or len({self.box.mu[t] for t in tangents}) > 1:
                raise ValueError(f"row {i} is no contact: it needs two tangents with one mu")
            if self.box.lo[i] != 0 or self.box.hi[i] != INF:
                raise ValueError(f"the normal {i} has other bounds than 0 and infinity")
        self.contacts = [(i, *t, self.box.mu[t[0]]) for i, t in owners.items()]
        self.contacts.sort(key=lambda c: c[1:3])
        self.rubbing = [c for c in self.contacts if c[3]]
        self.smooth = [c for c in self.contacts if not c[3]]
        self.owned = {i for c in self.contacts for i in c[:3]}
        self.others = [i for i in range(n) if i not in self.owned]
        self.sides = [(b[0] - a[0], b[1] - a[1]) for a, b in zip(self.d, [*self.d[1:], self.d[0]])]
        self.z = Unknowns(self)
        self.split = math.prod([2 + 2 * k] * len(self.rubbing) + [2] * len(self.smooth) + [
            1 + (self.box.lo[i] > -INF) + (self.box.hi[i] < INF) for i in self.others])
        self.count = self.exists = self.start = None

    def w(self, x):
        return [sum(a * v for a, v in zip(row, x) if a and v) + b for row, b in zip(self.A, self.b)]

    def terms(self, x):
        return [sum(abs(a * v) for a, v in zip(row, x) if a and v) + abs(b) for row, b in zip(self.A, self.b)]

    def is_solution(self, x):
        """The definition, as it stands at the top."""
        w = self.w(x)
        for i in self.others:
            lo, hi = self.box.lo[i], self.box.hi[i]
            if not lo <= x[i] <= hi or w[i] > 0 and x[i] != lo or w[i] < 0 and x[i] != hi:
                return False
        for n, t1, t2, mu in self.contacts:
            reach, t, slip = mu * x[n], (x[t1], x[t2]), (w[t1], w[t2])
            if x[n] < 0 or w[n] < 0 or x[n] * w[n] or not mu and any(t):
                return False
            for d, side in zip(self.d, self.sides):
                if cross(side, (t[0] - reach * d[0], t[1] - reach * d[1])) < 0:
                    return False        # outside
                if t[0] * slip[0] + t[1] * slip[1] > reach * (d[0] * slip[0] + d[1] * slip[1]):
                    return False        # this corner would brake more
        return True

    def rounded(self, x):
        """The rounded neighbor of x: of a contact only the normal has a bound."""
        tangents = {t for c in self.contacts for t in c[1:3]}
        out = list(x)
        for i, (v, size) in enumerate(zip(x, self.box.sizes(x))):
            targets = [Q(0)] if i in tangents else [self.box.lo[i], self.box.hi[i], Q(0)]
            out[i] = next((t for t in targets if abs(t) != INF and abs(v - t) <= size * 16 / 2**52), v)
        return out

    def unknowns(self, x):
        """The z of x, with all gamma = 0."""
        z = [x[i] for i in self.others] + [x[c[0]] for c in self.contacts]
        for _, t1, t2, _ in self.rubbing:
            t, beta = (x[t1], x[t2]), [Q(0)] * self.k
            for j, d in enumerate(self.d):
                e = self.d[(j + 1) % self.k]
                ahead, behind = cross(d, t), cross(t, e)
                if any(t) and ahead >= 0 and behind >= 0:
                    beta[j], beta[(j + 1) % self.k] = behind / cross(d, e), ahead / cross(d, e)
                    break
            z += beta
        return z + [Q(0)] * len(self.rubbing)

    def look(self, x):
        """All about the residuals of x."""
        z = self.unknowns(x)
        at, raw = self.z.look(z), [size for _, size, _, _ in self.z.rows_at(z)]
        r = [Q(0)] * self.n
        put = lambda row, v: r.__setitem__(row, max(r[row], v))
        for row, v in zip(self.z.belongs[:self.z.first], at.r):
            put(row, v)
        least = r[:]        # what no gamma can change
        step = lambda v, w, s, lo, hi: (v - min(max(v - w / s, lo), hi)) ** 2 * s
        steps = list(islice(map(step, z, at.w, self.z.scale, self.z.lo, self.z.hi), self.z.first))
        for c, (n, t1, _, mu) in enumerate(self.rubbing):
            own, betas = self.z.normals[n], self.z.betas(c, self.k)
            reach = mu * max(x[n], at.size[own] / self.z.scale[own]) or INF
            left, total = at.w[self.z.gamma + c], sum(z[beta] for beta in betas)
            left = left / reach if reach != INF else left / total if total else Q(0)
            speeds = [-at.w[beta] for beta in betas]
            options = []
            for gamma in {Q(0), max(speeds), *(v for v, beta in zip(speeds, betas) if z[beta])}:
                if gamma < 0:
                    continue
                pushes, sizes, of_betas = [], {}, []
                for beta in betas:
                    w, size, s = at.w[beta] + gamma, max(raw[beta] + gamma, self.z.rest[beta]), self.z.scale[beta]
                    unit = min(size / s, reach)
                    pushes.append(abs(min(z[beta], unit * w / size)) / unit if unit else Q(0))
                    sizes[beta] = size
                    of_betas.append(min(z[beta], w / s) ** 2 * s)
                nearest = min(betas, key=lambda beta: abs(at.w[beta] + gamma))
                slip = abs(min(left, part(gamma, sizes[nearest])))
                options.append((max(max(pushes), slip), max(pushes), slip, max(of_betas)))
            _, push, slip, of_beta = min(options)
            put(t1, push)
            put(n, slip)
            steps.append(of_beta)
        T = self.terms(x) if self.smooth else []
        for _, t1, t2, _ in self.smooth:
            for t in (t1, t2):
                put(t, part(abs(x[t]) * self.box.scale[t], max(T[t], self.box.rest[t])))
                least.append(r[t])
        largest = lambda values: max(values, default=Q(0))
        return SimpleNamespace(r=r, worst=largest(r), least=largest(least), e2=largest(steps),
                               doubt=TINY + self.z.rounding(z, at))

    def worst_beside(self, row, at):
        """The largest residual of the contact of a row, or of the row."""
        return max(at.r[i] for i in next((c[:3] for c in self.contacts if row in c[:3]), [row]))

    def is_worth(self, at, most):
        """Is x, with these residuals, ten times nearer than P(0)? `most` is a tolerance."""
        if self.start is None:
            self.start = self.look([Q(0) if i in self.owned else min(max(Q(0), self.box.lo[i]), self.box.hi[i])
                                    for i in range(self.n)])
        return 100 * at.e2 <= self.start.e2 or self.start.worst <= most

    def fits(self, x, strictly=False):
        """Of each other row and each contact: its states, each with how badly x fits it."""
        tangents = {t for c in self.smooth for t in c[1:3]}
        still = [Q(0) if i in tangents else v for i, v in enumerate(x)]
        w, T = self.w(still), self.terms(still)
        T = [max(t, rest) for t, rest in zip(T, self.box.rest)]
        rows = list(zip(w, T, self.box.lo, self.box.hi))
        for i in self.others:
            lo, hi = self.box.lo[i], self.box.hi[i]
            unit = min(T[i] / self.box.scale[i], self.box.reach(i, x, rows))
            of_w = lambda v: part(v, T[i])
            inside = max(part(lo - x[i], unit), part(x[i] - hi, unit), Q(0))
            states = [(max(inside, of_w(abs(w[i]))), ("=", i))]
            if lo > -INF:
                pushed = -w[i] if lo < hi else Q(0)
                states.append((max(inside, part(abs(x[i] - lo), unit), of_w(pushed)), ("<", i)))
            if hi < INF:
                pushed = w[i] if lo < hi else Q(0)
                states.append((max(inside, part(abs(x[i] - hi), unit), of_w(pushed)), (">", i)))
            yield states
        for contact in self.contacts:
            plane = (min if strictly else max)(T[t] for t in contact[1:3])
            yield list(self.states(contact, x, w, T, plane))

    def states(self, contact, x, w, T, plane):
        n, t1, t2, mu = contact
        most, of_n = mu * x[n], T[n] / self.box.scale[n]
        reach = mu * max(x[n], of_n) or INF
        units = [min(reach, plane / self.box.scale[i]) for i in (t1, t2)]
        t, slip = (x[t1], x[t2]), (w[t1], w[t2])
        size = lambda v: max(part(abs(a), unit) for a, unit in zip(v, units))
        if not mu:
            own = self.terms(x)
            rests = max(part(abs(x[i]) * self.box.scale[i], max(own[i], self.box.rest[i])) for i in (t1, t2))
            yield max(part(abs(x[n]), of_n), rests, part(-w[n], T[n])), ("open", contact)
            yield max(part(-x[n], of_n), part(abs(w[n]), T[n]), rests), ("smooth", contact)
            return
        yield max(part(abs(x[n]), of_n), size(t), part(-w[n], T[n])), ("open", contact)
        closed = max(part(-x[n], of_n), part(abs(w[n]), T[n]))
        # How far x_t lies beyond edge j, and how fast the contact slips along it.
        beyond, along = [], []
        for d, side in zip(self.d, self.sides):
            out = -cross(side, (t[0] - most * d[0], t[1] - most * d[1]))
            beyond.append(part(abs(out), abs(side[1]) * units[0] + abs(side[0]) * units[1]) * (1 if out > 0 else -1))
            speed = side[0] * slip[0] + side[1] * slip[1]
            along.append(part(abs(speed), max(map(abs, side)) * plane) * (1 if speed > 0 else -1))
        outside, size_w = max(*beyond, Q(0)), part(max(map(abs, slip)), plane)
        yield max(closed, outside, size_w), ("stick", contact)
        for j, d in enumerate(self.d):
            at_corner = size((t[0] - most * d[0], t[1] - most * d[1]))
            yield max(closed, at_corner, along[j - 1], -along[j]), ("corner", contact, j)
            after = -along[(j + 1) % self.k]
            yield (max(closed, outside, abs(beyond[j]), abs(along[j]), along[j - 1], after),
                   ("edge", contact, j))

    def backward_error(self, x, strictly=False):
        return max((min(v for v, _ in states) for states in self.fits(x, strictly)), default=Q(0))

    def equations(self, state):
        """The linear equations c.x + c_w.w = c_0 of a state, as (c, c_w, c_0)."""
        kind, of, *j = state
        if kind in ("=", "<", ">"):
            bound = {"<": self.box.lo[of], ">": self.box.hi[of]}.get(kind)
            return [({}, {of: 1}, 0)] if kind == "=" else [({of: 1}, {}, bound)]
        n, t1, t2, mu = of
        if kind == "open":
            return [({i: 1}, {}, 0) for i in (n, t1, t2)]
        if kind == "smooth":
            return [({}, {n: 1}, 0), ({t1: 1}, {}, 0), ({t2: 1}, {}, 0)]
        if kind == "stick":
            return [({}, {i: 1}, 0) for i in (n, t1, t2)]
        d, side = self.d[j[0]], self.sides[j[0]]
        if kind == "corner":
            return [({}, {n: 1}, 0), ({t1: 1, n: -mu * d[0]}, {}, 0), ({t2: 1, n: -mu * d[1]}, {}, 0)]
        return [({}, {n: 1}, 0), ({t1: -side[1], t2: side[0], n: -mu * cross(side, d)}, {}, 0),
                ({}, {t1: side[0], t2: side[1]}, 0)]

    def point_in(self, states, x):
        """The point where all these states hold. Unknowns left open by the equations stay as in x."""
        m, n = [], self.n
        for c, c_w, c_0 in (e for state in states for e in self.equations(state)):
            row = [Q(0)] * n + [Q(c_0)]
            for i, v in c.items():
                row[i] += v
            for i, v in c_w.items():
                row = [a + v * b for a, b in zip(row, [*self.A[i], -self.b[i]])]
            m.append(common(row)[0])
        pivots, _ = eliminate(m, n)
        y = list(x)
        for row, c in zip(m[len(pivots) - 1::-1], pivots[::-1]):
            y[c] = Q(row[n] - sum(a * v for a, v in zip(row[c + 1:n], y[c + 1:])), row[c])
        return y

    def nearby(self, x):
        """Solutions in the states that x seems to be in, or its rounded neighbor."""
        for v in (x, self.rounded(x)):
            choices = []
            for states in self.fits(v):
                best = min(fit for fit, _ in states)
                limit = max(10 * best, Q(1, 10**9))
                choices.append([s for fit, s in sorted(states, key=lambda s: s[0]) if fit <= limit])
            for states in islice(product(*choices), 12):
                y = self.point_in(states, x)
                if self.is_solution(y):
                    yield y

    def may_be_near(self, x, far):
        """False if x_n and w_n show that no solution is within `far` of x, entry by entry."""
        w = self.w(x)
        slack = [sum(abs(a) * f for a, f in zip(row, far) if a and f) for row in self.A]
        normals = [c[0] for c in self.contacts]
        return all(x[n] >= -far[n] and w[n] >= -slack[n] and (x[n] <= far[n] or w[n] <= slack[n]) for n in normals)

    def solution_near(self, x, far):
        """A solution within `far` of x, entry by entry, or None; and whether that was decided."""
        near = lambda y: all(abs(a - b) <= f for a, b, f in zip(x, y, far))
        if not self.may_be_near(x, far):
            return None, True
        found = next((y for y in self.nearby(x) if near(y)), None)
        if found:
            return found, True
        count, y = States(self, x, far).decide()
        return y, count is not None

    def truth(self):
        """0 if there is no solution, 1 if there is one (or more), None if that is too much work."""
        if self.count is None:
            self.count, self.exists = States(self).decide()
            self.count = "undecided" if self.count is None else self.count
        return None if self.count == "undecided" else self.count


class States(CaseSplit):
    """All states, tried by splitting contact after contact. The table of judge.py has the variables
    x, w and, for each contact with friction and each edge, how far x_t is inside of it and how fast
    the contact slips along it."""

    def holds(self, x):
        return self.p.is_solution(x)

    def __init__(self, polygon, x=None, far=None):
        p, box = polygon, polygon.box
        n = self.n = p.n
        self.p, self.det = p, 1
        self.table = [list(row) for row in box.rows]
        self.low = [-INF if i in p.owned else box.lo[i] for i in range(n)] + [-INF] * n
        self.high = [INF if i in p.owned else box.hi[i] for i in range(n)] + [INF] * n
        self.choices, zero, above, below = [], (0, 0), (0, INF), (-INF, 0)
        for i in p.others:
            w, lo, hi = n + i, box.lo[i], box.hi[i]
            if lo < hi:
                self.low[w], self.high[w] = (0 if hi == INF else -INF), (0 if lo == -INF else INF)
                lower, upper = {i: (lo, lo), w: above}, {i: (hi, hi), w: below}
                self.choices.append([lower] * (lo > -INF) + [upper] * (hi < INF) + [{w: zero}])
        for i, t1, t2, mu in p.contacts:
            self.low[i] = self.low[n + i] = 0
            free = {i: zero, t1: zero, t2: zero, n + i: above}
            if not mu:
                self.low[t1] = self.high[t1] = self.low[t2] = self.high[t2] = 0
                self.choices.append([free, {n + i: zero}])
                continue
            edge, slip = len(self.low), len(self.low) + p.k
            for d, side in zip(p.d, p.sides):        # cross(side, x_t - mu x_n d) >= 0
                row = [Q(0)] * (n + 1)
                row[t1], row[t2], row[i] = -side[1], side[0], -mu * cross(side, d)
                self.add(row, 0)
            for side in p.sides:                     # side.w_t
                self.add([side[0] * a + side[1] * b for a, b in zip([*p.A[t1], p.b[t1]], [*p.A[t2], p.b[t2]])], -INF)
            states, shut = [free, {n + i: zero, n + t1: zero, n + t2: zero}], {n + i: zero}
            for j in range(p.k):
                before, after = (j - 1) % p.k, (j + 1) % p.k
                states.append(shut | {edge + before: zero, edge + j: zero, slip + before: below, slip + j: above})
                states.append(shut | {edge + j: zero, slip + j: zero, slip + before: below, slip + after: above})
            self.choices.append(states)
        for i, (v, f) in enumerate(zip(x or (), far or ())):
            self.low[i], self.high[i] = max(self.low[i], v - f), min(self.high[i], v + f)
        self.others, self.basic = list(range(n)), list(range(n, len(self.low)))
        self.value = list(x or [Q(0)] * n) + [Q(0)] * len(self.basic)
        self.work = INF if p.split <= PIECES else WORK

    def add(self, row, low):
        self.table.append(common(row)[0])
        self.low.append(low)
        self.high.append(INF)


def judge(p, tolerance, answer, count):
    """Yields what is wrong with an answer."""
    x = [number(v, False) for v in answer["x"]]
    verdict, status = answer["verdict"], answer["status"]
    accepts, by, row = verdict != NOT, answer.get("rounded_by"), answer.get("row")
    if len(x) != p.n or verdict not in (NOT, WITHIN, PROVED):
        raise ValueError("wrong length or unknown word")
    denies = answer.get("certificate", {}).keys() & {"no_solution", "case_split"}
    if status == "infeasible" and not denies:
        yield "infeasible without a certificate"
    if status == "infeasible" or denies:
        if accepts:
            yield f"infeasible beside verdict {verdict}"
        if p.truth():
            yield f"infeasible, but ({', '.join(map(show, p.exists))}) is a solution"
        count["undecided" if p.truth() is None else "confirmed infeasible"] += 1
    if not accepts and by is not None:
        yield f"rounded_by is {by}, but x is rejected"
    if not all(isinstance(v, Q) for v in x):
        if accepts or status == "solved":
            yield "accepted, and not finite"
        return
    limit, output, at = number(tolerance), number(answer["scaled_residual"], False), p.look(x)
    more, less = limit * (1 + CLOSE) + at.doubt, limit * (1 - CLOSE) - at.doubt
    if not (output == INF or output >= max(at.worst / 2, at.least) * (1 - CLOSE) - at.doubt):
        yield f"scaled_residual is {show(at.worst)}, not {show(output)}"
    passes = lambda at, most: at.worst <= most and p.is_worth(at, most)
    may_pass = lambda at: max(at.worst / 2, at.least) <= more and p.is_worth(at, more)
    neighbor = p.rounded(x)
    at_neighbor = p.look(neighbor)
    rounding = [size * 64 / 2**52 for size in p.box.sizes(x)]
    y = None
    if verdict == PROVED:
        most = number(answer["distance"])
        y, decided = p.solution_near(x, [most] * p.n)
        if p.k != 4:
            yield "proved, though the corners are rounded numbers"
        if y is None and decided:
            yield f"proved, but no solution is within {show(most)} of x"
        count["confirmed proofs" if y else "undecided"] += 1
        if most > max(map(abs, x), default=Q(0)) / 10**6 * (1 + CLOSE):
            yield "proved with a distance above 1e-6 max|x|"
    if accepts and by is None:
        if max(at.worst / 2, at.least) > more or not output <= more:
            yield f"{verdict}, but its residual is {show(at.worst)}, as reported {show(output)}"
        elif verdict == WITHIN and not may_pass(at):
            yield "within tolerance, but not worth anything"
        if p.backward_error(x) > FACTOR * limit:
            yield f"accepted, but its backward error is {show(p.backward_error(x))}"
    elif accepts:
        near = p.solution_near(x, rounding)[0]
        points = [v for v, a in ((x, at), (neighbor, at_neighbor)) if may_pass(a)] + [near] * (near is not None)
        if not points:
            yield (f"accepted by rounding of {by}, but no solution is that close; its residual is {show(at.worst)}, "
                   f"that of its neighbor {show(at_neighbor.worst)}")
        elif number(by) < min(distance(x, z) for z in points) * (1 - CLOSE):
            yield f"rounded_by is {show(min(distance(x, z) for z in points))}, not {by}"
    if accepts and y is None and p.truth() == 0:
        # Rounding alone may contradict a problem with a scale; judge.py decides that, for boxes.
        if p.k == 4 and not p.box.least and 2 ** (p.z.n - len(p.others)) * 3 ** len(p.others) <= 1 << 16 and p.z.n <= 50:
            yield "accepted, but no solution exists"
        else:
            count["unsupported"] += 1
    if not accepts and p.n:
        if type(row) is not int or not 0 <= row < p.n:
            yield f"row {row} does not exist"
        elif number(answer["amount"], False) != output:
            yield f"the amount is {answer['amount']}, but scaled_residual is {answer['scaled_residual']}"
        elif agrees(output, at.worst, CLOSE, at.doubt):
            here = p.worst_beside(row, at)
            if here < at.worst * (1 - CLOSE) - at.doubt:
                yield f"row {row} is not of the worst contact: {show(here)}, of {show(at.worst)}"
        right = passes(at, less) or passes(at_neighbor, less)
        if right and not denies and p.truth() != 0:
            found = "a solution exists" if p.truth() else "nothing denies one"
            yield f"refused with residual {show(at.worst)}, its neighbor with {show(at_neighbor.worst)}; {found}"
        elif p.split <= PIECES and p.solution_near(x, rounding)[0] is not None:
            if p.k == 4:
                yield "refused, but a solution is within rounding of x"
            count["unproved"] += p.k != 4
        if at.worst > more and (error := p.backward_error(x, True)) < limit / FACTOR:
            yield f"refused with residual {show(at.worst)}, but its backward error is {show(error)}"
        if status == "solved" and at.worst > limit * Q(1001, 1000):
            yield "solved, and refused"


def judge_line(line):
    """What is wrong with a record, and how much was counted."""
    record, count, said = json.loads(line), Counter(), []
    k = directions(record.get("model"))
    if k is not None:
        p = Polygons(record["problem"], k)
        count["records"] += 1
        for answer in record["answers"]:
            count["answers"] += 1
            for what in judge(p, record["tolerance"], answer, count):
                count["contradictions"] += 1
                said.append(f"{record['name']}, polygon-{k}: {answer['solver']}: CONTRADICTION: {what}")
    return said, count


def chosen(seed):
    """Chooses x and w of up to three contacts in states of a square, and b to fit: x must be found."""
    random = Random(seed)
    count = random.choice([1, 1, 2, 3])
    whole = lambda low=-3, high=3: random.randint(low, high)
    A = [[whole() for _ in range(3 * count)] for _ in range(3 * count)]
    x, w, mus, wrong = [], [], [], []
    for _ in range(count):
        mu, kind = random.choice([0.5, 1, 2]), random.randrange(4)
        c, s = random.choice([(1, 0), (0, 1), (-1, 0), (0, -1)])
        mus.append(mu)
        n, turned = 4 * whole(1, 3), lambda a, b: [c * a - s * b, s * a + c * b]
        if kind == 0:       # open
            x += [0, 0, 0]
            w += [whole(0), whole(), whole()]
        elif kind == 1:     # sticking, well inside
            x += [n, *turned(mu * n / 4, mu * n / 4)]
            w += [0, 0, 0]
        elif kind == 2:     # at the corner (1, 0), turned
            fast = whole(1)
            x += [n, *turned(mu * n, 0)]
            w += [0, *turned(-fast, random.choice([-0.5, 0, 0.25]) * fast)]
        else:               # on the edge behind it
            fast = whole(1)
            x += [n, *turned(mu * n / 4, mu * n * 3 / 4)]
            w += [0, *turned(-fast, -fast)]
        wrong.append(kind > 1)
    b = [v - sum(map(mul, row, x)) for v, row in zip(w, A)]
    index = [k for c in range(count) for k in (-1, 3 * c, 3 * c)]
    data = {"A": {"dense": A}, "b": b, "friction_index": index, "mu": [mu for mu in mus for _ in range(3)]}
    p, x = Polygons(data, 4), [Q(v) for v in x]
    good = (p.is_solution(x) and p.truth() == 1 and p.solution_near(x, [0] * p.n)[0] == x
            and p.look(x).worst == p.backward_error(x) == 0)
    for c, slides in enumerate(wrong):      # a sliding contact with 1e-6 too little friction
        y = [v * (1 - Q(1, 10**6)) if slides and i in (3 * c + 1, 3 * c + 2) else v for i, v in enumerate(x)]
        good &= not slides or not p.is_solution(y) and p.look(y).worst > 0 and p.backward_error(y) > 0
    return good


def sliding(seed):
    """A block that slides: x_t is the point of the polygon that is nearest to -b_t."""
    random = Random(seed)
    k, mu, n = random.choice([8, 12, 16, 32]), random.choice([0.25, 0.5, 1]), random.choice([1, 2, 8])
    angle, far = random.uniform(0, 2 * math.pi), n * mu * random.choice([0.5, 1.5, 10])
    wanted = [far * math.cos(angle), far * math.sin(angle)]
    rim = [[mu * n * math.cos(2 * math.pi * j / k), mu * n * math.sin(2 * math.pi * j / k)] for j in range(k + 1)]
    nearest = wanted
    if far > mu * n:
        def on_edge(a, b):
            edge, way = (b[0] - a[0], b[1] - a[1]), (wanted[0] - a[0], wanted[1] - a[1])
            t = min(max((edge[0] * way[0] + edge[1] * way[1]) / (edge[0] ** 2 + edge[1] ** 2), 0), 1)
            return [a[0] + t * edge[0], a[1] + t * edge[1]]
        nearest = min((on_edge(*pair) for pair in zip(rim, rim[1:])), key=lambda v: math.dist(v, wanted))
    data = {"A": {"dense": [[1, 0, 0], [0, 1, 0], [0, 0, 1]]}, "b": [-n, -wanted[0], -wanted[1]],
            "friction_index": [-1, 0, 0], "mu": [0, mu, mu]}
    p, x = Polygons(data, k), [Q(v) for v in (n, *nearest)]
    y = States(p).decide(True)
    near = y[0] == 1 and distance(x, y[1]) < 1e-13 and p.look(x).worst < 1e-13 and p.backward_error(x) < 1e-13
    turned = [x[0], x[1] * Q(3, 5) - x[2] * Q(4, 5), x[1] * Q(4, 5) + x[2] * Q(3, 5)]
    return near and p.look(turned).worst > 1e-3 and p.backward_error(turned) > 1e-3


def self_test():
    def block(b, mu=0.5, A=((1, 0, 0), (0, 1, 0), (0, 0, 1)), **more):
        """A block on a plane, pressed and pushed."""
        return {"A": {"dense": A}, "b": b, "friction_index": [-1, 0, 0], "mu": [0, mu, mu], **more}

    def answer(x, verdict, r=0.0, **more):
        refused = {"row": 0, "amount": r} if verdict == NOT else {}
        return {"solver": "test", "status": "failed", "x": x, "verdict": verdict, "scaled_residual": r} | refused | more

    exact, root = {"distance": 0.0}, math.sqrt(0.5)
    along, askew, across = block([-2, -3, 0]), block([-2, -3, -3]), block([-2, -3, -0.5])
    sticks, apart, tilted = block([-2, -0.25, -0.5]), block([1, -3, 0]), block([-2, -3, 0.75])
    # w_t1 = 1 whatever x is, so x_t1 = -x_n and w_n = x_n + 2 x_t1 - 1 < 0: Painleve's paradox.
    paradox = block([-1, 1, 0], 1, ((1, 2, 0), (0, 0, 0), (0, 0, 1)))
    twice = {"A": {"triplets": [[i, i, 1] for i in range(6)], "rows": 6, "cols": 6}, "b": [-2, -3, 0, 1, 5, 0],
             "friction_index": [-1, 0, 0, -1, 3, 3], "mu": [0, 0.5, 0.5, 0, 0.5, 0.5]}
    closed = [      # problem, corners, the only solution (None: there is none)
        (along, 4, [2, 1, 0]), (along, 8, [2, 1, 0]), (along, 64, [2, 1, 0]),
        (askew, 4, [2, 0.5, 0.5]), (askew, 8, [2, root, root]),      # 29 % too little; a corner
        (across, 4, [2, 1, 0]), (tilted, 4, [2, 1, 0]), (sticks, 4, [2, 0.25, 0.5]), (sticks, 8, [2, 0.25, 0.5]),
        (apart, 4, [0, 0, 0]), (apart, 12, [0, 0, 0]), (paradox, 4, None), (paradox, 8, None),
        (twice, 4, [2, 1, 0, 0, 0, 0]), (twice, 8, [2, 1, 0, 0, 0, 0]), (block([-2, -3, 0], 0), 8, [2, 0, 0]),
        (block([-2, -3, -3], 0.5, ((1, 0, 0), (0, 4, 0), (0, 0, 4))), 4, [2, 0.5, 0.5])]
    right, wrong = None, "CONTRADICTION"
    output = [        # what lcplab may say of x, and what must be found wrong with it
        (along, 4, answer([2, 1, 0], PROVED, **exact), right),
        (along, 4, answer([2, 1, 0], NOT, 1.0), "refused with residual 0"),
        (along, 4, answer([2, 0.5, 0], PROVED, **exact), "no solution is within"),
        (along, 4, answer([2, 1.0000001, 0], NOT, 5e-8), right),
        (along, 4, answer([2, 1.0000001, 0], WITHIN, 5e-8), "within_tolerance, but its residual is"),
        (along, 4, answer([2, 1.0000001, 0], WITHIN, 1e-9), "scaled_residual is 5e-08, not"),
        (along, 4, answer([2, 1.0000001, 0], NOT, 5e-8, row=3), "does not exist"),
        (along, 4, answer([2, 1.0000001, 0], NOT, 5e-8, amount=1e-9), "the amount is"),
        (along, 4, answer([2, 1.0000001, 0], NOT, 5e-8, status="solved"), "solved, and refused"),
        (along, 4, answer([2, -1, 0], WITHIN, 0.0), wrong),
        (along, 4, answer([2, 1, 1e-16], PROVED, 5e-17, distance=2e-16), right),
        (along, 4, answer([2, 1, 1e-16], PROVED, 5e-17, distance=5e-17), "no solution is within"),
        (along, 4, answer([2, 1, 0], PROVED, distance=0.1), "above 1e-6"),
        (along, 4, answer([2, 1, 0], NOT, 0.0, status="infeasible", certificate={"case_split": 3}), "is a solution"),
        (along, 4, answer([2, 1, 0], NOT, 0.0, status="infeasible"), "without a certificate"),
        (along, 8, answer([2, 1, 0], WITHIN), right),
        (along, 8, answer([2, 1, 0], PROVED, **exact), "rounded numbers"),
        (askew, 4, answer([2, 0.5, 0.5], PROVED, **exact), right),
        (askew, 4, answer([2, root, root], WITHIN), "but its residual is"),       # Coulomb's law
        (askew, 8, answer([2, root, root], WITHIN, 1e-16), right),
        (askew, 8, answer([2, 0.5, 0.5], WITHIN), "but its residual is"),
        (askew, 4, answer([2, 1, 0], PROVED, **exact), "no solution is within"),
        (across, 4, answer([2, 1, 0], PROVED, **exact), right),
        (across, 4, answer([2, 0.75, 0.25], WITHIN), "but its residual is"),
        (sticks, 4, answer([2, 0.25, 0.5], PROVED, **exact), right),
        (sticks, 4, answer([2, 0.25, 0.25], WITHIN), "but its residual is"),
        (sticks, 8, answer([2, 0.25, 0.5 + 1e-10], WITHIN, 2e-10), right),
        (apart, 4, answer([0, 0, 0], PROVED, **exact), right),
        (apart, 4, answer([1e-12, 0, 0], WITHIN, 1e-12), right),
        (apart, 4, answer([1e-12, 0, 0], NOT, 1.0), "refused with residual"),
        (apart, 4, answer([1e-12, 1e-13, 0], NOT, 1.0), "refused with residual"),
        (apart, 4, answer([1, 0.5, 0], NOT, 2 / 3), right),
        (apart, 4, answer([1, 0.5, 0], WITHIN, 2 / 3, rounded_by=1.0), "accepted by rounding of 1.0"),
        (apart, 4, answer([1e-20, 0.5, 0], WITHIN, 1.0), "backward error"),
        (block([0, -1, 0]), 4, answer([0, 1, 0], WITHIN), "but its residual is"),     # nothing presses
        (block([0, -1, 0]), 8, answer([0, 1, 0], NOT, 1.0), right),
        (paradox, 4, answer([1, -1, 0], NOT, 1.0), right),
        (paradox, 4, answer([1, -1, 0], NOT, 1.0, status="infeasible", certificate={"case_split": 9}), right),
        (paradox, 4, answer([1e9, -1e9, 0], PROVED, distance=1.0), "no solution is within"),
        (paradox, 4, answer([1e12, -5e11, 0], WITHIN, 1.0), "accepted, but no solution exists"),
        (twice, 4, answer([2, 1, 0, 1e-17, 0, 0], PROVED, 1e-17, distance=1e-17), right),
        (twice, 4, answer([2, 1, 0, 0, 0, 1e-15], NOT, 0.5), "refused"),
        (twice, 4, answer(["nan"] * 6, WITHIN, "inf"), "not finite"),
        (twice, 4, answer(["nan"] * 6, NOT, "inf"), right),
        (block([-1e-3, -1e16, 0]), 4, answer([0, 0, 0], WITHIN, 1.0, rounded_by=1e-3), "accepted by rounding")]
    failed = 0
    for problem, k, x in closed:
        p = Polygons(problem, k)
        count, y = States(p).decide(True)
        is_right = count == 0 if x is None else (
            count == 1 and distance(y, [Q(v) for v in x]) <= (0 if k == 4 else 1e-15))
        if not is_right:
            failed += 1
            print(f"closed form of {problem['b']}, polygon-{k}: {x}, not {y and list(map(show, y))}, {count} solutions")
    for problem, k, raw, expected in output:
        record = {"name": str(problem["b"]), "problem": problem, "model": f"polygon-{k}", "tolerance": 1e-8,
                  "answers": [raw]}
        said = judge_line(json.dumps(record))[0]
        if bool(said) != (expected is not None) or expected and not any(expected in line for line in said):
            failed += 1
            print(f"self-test {raw} of {problem['b']}, polygon-{k}: expected {expected!r}, got {said}")
    many = [*(chosen(seed) for seed in range(200)), *(sliding(seed) for seed in range(100))]
    failed += len(many) - sum(many)
    print(f"self-test: {len(closed) + len(output) + len(many)} cases, {failed} failed")
    return 1 if failed else 0


def main():
    if sys.argv[1:] == ["--self-test"]:
        return self_test()
    total = Counter()
    with fileinput.input(sys.argv[1:], encoding="utf-8") as lines, multiprocessing.Pool() as pool:
        for said, count in pool.imap(judge_line, (line for line in lines if '"polygon-' in line)):
            total += count
            print(*said, sep="\n", end="\n" if said else "")
    keys = ("records", "answers", "confirmed proofs", "confirmed infeasible", "unproved", "undecided", "unsupported",
            "contradictions")
    print("polygons: " + "; ".join(f"{key}: {total[key]}" for key in keys))
    return 1 if total["contradictions"] else 0 if total["records"] else 2


if __name__ == "__main__":
    sys.exit(main())

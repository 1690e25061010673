"""The second judge for contacts with a circular friction cone, from the definitions alone.

A contact has rows n, t1, t2 (t1 and t2 name n in `friction_index`) and mu. With w = A x + b Coulomb's law says

    x_n >= 0,  w_n >= 0,  x_n w_n = 0,      |x_t| <= mu x_n,      w_t != 0  =>  x_t = -mu x_n w_t / |w_t|

How far x is from it: each part beside its own scale s and its own terms T = sum |a_ij x_j| + |b_i|,

    r_n = |x_n - max(x_n - w_n/s_n, 0)| s_n / T_n                    s_n = |a_nn|
    r_t = |x_t - D(x_t - w_t/s_t)| s_t / |(T_t1, T_t2)|              s_t = the largest row sum of |A| among t1, t2

but s_t is at least |(T_t1, T_t2)| / R, and just that where t1 and t2 are rows of zeros, with
R = mu max(x_n, T_n/s_n) unless that is 0, and where D(v) is the point of the disc of radius mu x_n nearest to v. Other rows as in judge.py. The associated law
(x in K, w in its dual, x.w = 0) is the fixed point x = P(x - w/s), P the nearest point of the cone in the metric
of s. A cone is proved only where no contact slides: a contact is open (x = 0) or sticks (w = 0, |x_t| <= mu x_n), and that
point, by exact equations, lies within `distance` of x. Rounding as in judge.py. x is worth something if the longest |x - its step| sqrt(s) is at most a
tenth of that of x = 0, or 0 is within the tolerance.

Records and output as in judge.py. Numbers are exact, roots have 60 digits.
"""
import json
import sys
from decimal import Decimal, getcontext
from fractions import Fraction as Q

from judge import Problem, number

getcontext().prec = 60
CLOSE, TINY = Decimal("1e-6"), Decimal("1e-15")   # a reported residual is a float, summed with care


def dec(q):
    return Decimal(q.numerator) / Decimal(q.denominator)


def norm(*v):
    return sum((dec(a) if isinstance(a, Q) else a) ** 2 for a in v).sqrt()


def in_disc(radius, v):
    length = norm(*v)
    return v if length <= radius else [radius * a / length for a in v]


def in_cone(mu, n, t):
    """The nearest point of |t| <= mu n, in the usual metric."""
    length = norm(*t)
    if n + mu * length <= 0:
        return Decimal(0), [Decimal(0)] * 2
    if length <= mu * n:
        return n, t
    n = (n + mu * length) / (1 + mu * mu)
    return n, [mu * n * a / length for a in t]


class Cones:
    def __init__(self, data, law):
        self.law, self.box = law, Problem(data)
        n = self.box.n
        self.A = [[Q(v, den) for v in row[:n]] for row, den in zip(self.box.rows, self.box.den)]
        self.b = [Q(row[n], den) for row, den in zip(self.box.rows, self.box.den)]
        owners = {}
        for i, k in enumerate(self.box.owner):
            if k >= 0:
                owners.setdefault(k, []).append(i)
        self.contacts = [(k, *t, dec(self.box.mu[t[0]])) for k, t in owners.items()]

    def nothing(self):
        """x = 0, moved into the bounds of the rows that belong to no contact."""
        taken = {i for n, t1, t2, _ in self.contacts for i in (n, t1, t2)}
        return [Q(0) if i in taken else max(self.box.lo[i], min(self.box.hi[i], Q(0))) for i in range(self.box.n)]

    def rounded(self, x):
        """The rounded neighbor of x: only a normal has a bound, and tangents may be moved to 0."""
        out = list(x)
        taken = {t for _, t1, t2, _ in self.contacts for t in (t1, t2)}
        for i, (v, size) in enumerate(zip(x, self.box.sizes(x))):
            targets = [Q(0)] if i in taken else [self.box.lo[i], self.box.hi[i], Q(0)]
            out[i] = next((t for t in targets if abs(t) != float("inf") and abs(v - t) <= size * 16 / 2**52), v)
        return out

    def still(self, x):
        """The exact point in which each contact is open or sticks as in x, if it solves the problem."""
        piece = list(self.box.piece_of(x))
        for n, t1, t2, mu in self.contacts:
            side = "=" if piece[n] == "=" else "<"
            piece[n], piece[t1], piece[t2] = side, *[side if mu else "<"] * 2
        y, _ = self.box.point_on("".join(piece), x)
        w = [sum(a * v for a, v in zip(row, y)) + b for row, b in zip(self.A, self.b)]
        taken = {i for n, t1, t2, _ in self.contacts for i in (n, t1, t2)}
        for i in set(range(len(y))) - taken:
            lo, hi = self.box.lo[i], self.box.hi[i]
            if not lo <= y[i] <= hi or w[i] > 0 and y[i] != lo or w[i] < 0 and y[i] != hi:
                return None
        for n, t1, t2, mu in self.contacts:
            q = self.box.mu[t1]
            if piece[n] == "=":
                is_right = (w[n] == 0 and (not mu or w[t1] == w[t2] == 0) and y[n] >= 0
                            and y[t1] ** 2 + y[t2] ** 2 <= (q * y[n]) ** 2)
            else:
                slip = q * q * (w[t1] ** 2 + w[t2] ** 2) if self.law == "associated-cone" else 0
                is_right = y[n] == y[t1] == y[t2] == 0 and w[n] >= 0 and w[n] ** 2 >= slip
            if not is_right:
                return None
        return y

    def look(self, x):
        """For every row: the residual, and the length of the step times sqrt(s)."""
        w = [sum(a * v for a, v in zip(row, x)) + b for row, b in zip(self.A, self.b)]
        T = [sum(abs(a * v) for a, v in zip(row, x)) + abs(b) for row, b in zip(self.A, self.b)]
        T = [max(t, rest) for t, rest in zip(T, self.box.rest)]     # the key `scale`, as in judge.py
        w, T, X = [[dec(v) for v in u] for u in (w, T, x)]
        out = [None] * len(x)

        def put(rows, step, s, miss, terms):
            r = miss / terms if terms else Decimal(0) if not miss else Decimal("inf")
            for i in rows:
                out[i] = (r, step * s.sqrt())

        taken = {i for n, t1, t2, _ in self.contacts for i in (n, t1, t2)}
        for i in set(range(len(x))) - taken:
            s = dec(self.box.scale[i])
            lo, hi = (v if abs(v) == float("inf") else dec(v) for v in (self.box.lo[i], self.box.hi[i]))
            largest = max([abs(v) for v in (lo, hi) if abs(v) != float("inf")], default=Decimal(0))
            near = max(s, T[i] / max(largest, dec(self.box.least))) if largest else s
            step, gap = (abs(X[i] - max(lo, min(hi, X[i] - w[i] / s))) for s in (s, near))
            put([i], step, s, gap * near, T[i])
        for n, t1, t2, mu in self.contacts:
            s_n = dec(self.box.scale[n])
            s_t = dec(max(abs(self.A[i][t1]) + abs(self.A[i][t2]) for i in (t1, t2)))
            s_t = s_t or dec(max(self.box.scale[t1], self.box.scale[t2]))
            is_zero = not any(self.A[t1]) and not any(self.A[t2])
            plane = norm(T[t1], T[t2])
            reach = mu * max(X[n], T[n] / s_n)
            near = (plane / reach if is_zero else max(s_t, plane / reach)) if reach and plane else s_t

            def gaps(s_t):
                aim_n, aim_t = X[n] - w[n] / s_n, [X[t] - w[t] / s_t for t in (t1, t2)]
                if self.law == "coulomb-cone":
                    q_n, q_t = max(aim_n, Decimal(0)), in_disc(mu * max(X[n], Decimal(0)), aim_t)
                else:               # lengths along n count sqrt(s_n / s_t) times: a cone with another slope
                    c = (s_n / s_t).sqrt()
                    q_n, q_t = in_cone(mu / c, aim_n * c, aim_t)
                    q_n = q_n / c
                return abs(X[n] - q_n), norm(*(a - b for a, b in zip((X[t1], X[t2]), q_t)))

            (step_n, step_t), (gap_n, gap_t) = gaps(s_t), gaps(near)
            put([n], step_n, s_n, gap_n * s_n, T[n])
            put([t1, t2], step_t, s_t, gap_t * near, plane)
        return out


def differ(told, worst):
    if told.is_infinite() or worst.is_infinite():       # a float may be infinite where a decimal is not yet
        return not min(told, worst) > Decimal("1e300")
    return abs(told - worst) > max(CLOSE * worst, TINY)


def judge(cones, tolerance, answer):
    """Yields what is wrong with an answer."""
    x = [number(v, False) for v in answer["x"]]
    accepts = answer["verdict"] != "not_a_solution"
    if not all(isinstance(v, Q) for v in x):
        if accepts or answer["status"] == "solved":
            yield "accepted, and not finite"
        return
    rows, start = cones.look(x), cones.look(cones.nothing())
    worst = max(r for r, _ in rows)
    told = Decimal(str(answer["scaled_residual"]))
    if differ(told, worst):
        yield f"scaled_residual is {float(worst):.6g}, not {told}"
    limit = Decimal(tolerance)
    if answer["verdict"] == "proved":
        y, most = cones.still(x), number(answer["distance"])
        y = cones.still(cones.rounded(x)) if y is None else y
        if y is None or max((abs(a - b) for a, b in zip(x, y)), default=Q(0)) > most:
            yield "could not confirm the proof"
        elif worst > limit * (1 + CLOSE) and not answer.get("rounded_by") and not cones.box.differs_by_rounding(x, y):
            yield f"proved with residual {float(worst):.6g}"
        return
    if answer.get("rounded_by"):
        x = cones.rounded(x)
        rows = cones.look(x)
        worst = max(r for r, _ in rows)
    is_worth = (max(e for _, e in rows) <= max(e for _, e in start) / 10 * (1 + CLOSE)
                or max(r for r, _ in start) <= limit)
    if accepts and (worst > limit * (1 + CLOSE) or not is_worth):
        yield f"accepted with residual {float(worst):.6g}, worth something: {is_worth}"
    if not accepts and worst < limit * (1 - CLOSE) and is_worth and cones.box.n:
        yield f"refused with residual {float(worst):.6g}"
    if not accepts and differ(rows[answer["row"]][0], worst):
        yield f"row {answer['row']} is not the worst"
    if answer["status"] == "solved" and not accepts:
        yield "solved, and refused"


def main():
    records, answers, wrong = 0, 0, 0
    for line in (line for name in sys.argv[1:] for line in open(name)):
        record = json.loads(line)
        law = record.get("model")
        if law not in ("coulomb-cone", "associated-cone"):
            continue
        cones, records = Cones(record["problem"], law), records + 1
        for answer in record["answers"]:
            answers += 1
            for what in judge(cones, record["tolerance"], answer):
                wrong += 1
                print(f"{record['name']}: {answer['solver']}: CONTRADICTION: {what}")
    print(f"cones: {records} records, {answers} answers, {wrong} contradictions")
    return 1 if wrong else 0 if records else 2


if __name__ == "__main__":
    sys.exit(main())

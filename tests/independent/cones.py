"""The second judge for contacts with a circular friction cone, from the definitions alone.

A contact has rows n, t1, t2 (t1 and t2 name n in `friction_index`) and mu. With w = A x + b Coulomb's law says

    x_n >= 0,  w_n >= 0,  x_n w_n = 0,      |x_t| <= mu x_n,      w_t != 0  =>  x_t = -mu x_n w_t / |w_t|

How far x is from it: each part beside its own scale s and its own terms T = sum |a_ij x_j| + |b_i|,

    r_n = |x_n - max(x_n - w_n/s_n, 0)| s_n / T_n                    s_n = |a_nn|
    r_t = |x_t - D(x_t - w_t/s_t)| s_t / |(T_t1, T_t2)|              s_t = the largest row sum of |A| among t1, t2

but s_t is at least |(T_t1, T_t2)| / R, and just that where t1 and t2 are rows of zeros, with
R = mu max(x_n, T_n/s_n) unless that is 0, and where D(v) is the point of the disk of radius mu x_n nearest to v. Other rows as in judge.py. The associated law
(x in K, w in its dual, x.w = 0) is the fixed point x = P(x - w/s), P the nearest point of the cone in the metric
of s. Of an answer that is called proved, a solution must lie within `distance`. Where each contact is open (x = 0) or sticks (w = 0,
|x_t| <= mu x_n), exact equations give it. Where one slides, it is a closed form if there is one contact and A is diagonal, else the zero
of w_n (Coulomb) or w_n - mu |w_t| (associated) and of x_t |w_t| + mu x_n w_t, by Newton's method in 60 digits, at which all
conditions above hold to 40 digits. Rounding as in judge.py. x is worth something if the longest |x - its step| sqrt(s) is at most a
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
        """x = 0, clamped to the bounds of the rows that belong to no contact."""
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

    def closed_form(self):
        """The solution of one contact whose A is diagonal, alike along both tangents."""
        if len(self.contacts) != 1 or self.box.n != 3:
            return None
        n, t1, t2, mu = self.contacts[0]
        if any(self.A[i][j] for i in range(3) for j in range(3) if i != j) or self.A[t1][t1] != self.A[t2][t2]:
            return None
        a, c, b, push = dec(self.A[n][n]), dec(self.A[t1][t1]), [dec(self.b[i]) for i in (n, t1, t2)], norm(self.b[t1], self.b[t2])
        if a <= 0 or c <= 0:
            return None
        normal, y = max(-b[0] / a, Decimal(0)), [None] * 3
        if push <= mu * normal * c:
            y[n], y[t1], y[t2] = normal, -b[1] / c, -b[2] / c
            return y
        if self.law == "associated-cone":       # the least energy along the side of the cone that faces the push
            normal = max((mu * push - b[0]) / (a + mu * mu * c), Decimal(0))
        y[n], y[t1], y[t2] = normal, -mu * normal * b[1] / push, -mu * normal * b[2] / push
        return y

    def sliding(self, x):
        """A solution near x with sliding contacts, to 40 digits: its entries; None if Newton's method finds none."""
        y = self.closed_form()
        if y is not None:
            return y
        for near in (None, "1e-14", "1e-9", "1e-6"):
            y = self.newton(x, self.states(x, near and Decimal(near)))
            if y is not None:
                return y
        return None

    def states(self, x, near):
        """The state of each contact and of each other row: from w where `near` is None, else from x alone."""
        X, states = [dec(v) for v in x], {}
        w = [dec(sum(a * v for a, v in zip(row, x)) + b) for row, b in zip(self.A, self.b)]
        taken = {i for n, t1, t2, _ in self.contacts for i in (n, t1, t2)}
        for i in set(range(len(x))) - taken:
            s = dec(self.box.scale[i])
            lo, hi = self.box.lo[i], self.box.hi[i]
            aim = X[i] - w[i] / s
            states[i] = "lo" if aim <= lo else "hi" if aim >= hi else "="
        sizes = self.box.sizes(x)
        for n, t1, t2, mu in self.contacts:
            length = norm(X[t1], X[t2])
            if near is None:
                s_t = dec(max(abs(self.A[i][t1]) + abs(self.A[i][t2]) for i in (t1, t2))) or Decimal(1)
                aim, push = X[n] - w[n] / dec(self.box.scale[n]), norm(X[t1] - w[t1] / s_t, X[t2] - w[t2] / s_t)
                is_open, slides = aim <= 0, push > mu * X[n]
                if self.law == "associated-cone":
                    is_open = aim + mu * push <= 0
            else:
                is_open, slides = X[n] <= near * dec(sizes[n]), length >= (1 - near) * mu * X[n]
            states[n] = "open" if is_open else "slides" if slides or not mu else "sticks"
        return states

    def newton(self, x, states):
        """The zero of the equations of these states near x, if it satisfies all conditions."""
        n = len(x)
        exact = lambda v: v if isinstance(v, Decimal) else dec(v)
        A, b, y = [[dec(a) for a in row] for row in self.A], [dec(v) for v in self.b], [dec(v) for v in x]
        unknowns = [i for i, state in states.items() if state == "="]
        for k, t1, t2, mu in self.contacts:
            unknowns += {"open": [], "sticks": [k, t1, t2]}.get(states[k], [k, t1, t2] if mu else [k])
            for i in {k, t1, t2} - set(unknowns):
                y[i] = Decimal(0)
        for i, state in states.items():
            if state in ("lo", "hi"):
                y[i] = exact((self.box.lo if state == "lo" else self.box.hi)[i])
        size = max(map(abs, y), default=Decimal(0)) or Decimal(1)
        for _ in range(40):
            w = [sum(a * v for a, v in zip(row, y)) + c for row, c in zip(A, b)]
            rows = {i: (w[i], A[i]) for i, state in states.items() if state == "="}
            for k, t1, t2, mu in self.contacts:
                if states[k] == "sticks" or states[k] == "slides" and not mu:
                    rows.update({i: (w[i], A[i]) for i in ((k, t1, t2) if mu else (k,))})
                elif states[k] == "slides":
                    slip = norm(w[t1], w[t2])
                    if not slip:
                        return None
                    grow = [(w[t1] * p + w[t2] * q) / slip for p, q in zip(A[t1], A[t2])]      # d|w_t|/dx
                    lift = mu if self.law == "associated-cone" else 0
                    rows[k] = w[k] - lift * slip, [a - lift * g for a, g in zip(A[k], grow)]
                    for t in (t1, t2):
                        slope = [y[t] * g + mu * y[k] * a for g, a in zip(grow, A[t])]
                        slope[t] += slip
                        slope[k] += mu * w[t]
                        rows[t] = y[t] * slip + mu * y[k] * w[t], slope
            step = solve([[rows[i][1][j] for j in unknowns] for i in unknowns], [rows[i][0] for i in unknowns])
            if step is None:
                return None
            for i, d in zip(unknowns, step):
                y[i] -= d
            longest = max(map(abs, step), default=Decimal(0))
            if longest > 1000 * size:
                return None
            if longest <= size * Decimal("1e-52"):
                return y if self.holds(y, w) else None
        return None

    def holds(self, y, w):
        """Whether a point satisfies all conditions to 40 digits of its own terms."""
        small = Decimal("1e-40")
        load = [sum(abs(dec(a) * v) for a, v in zip(row, y)) + abs(dec(c)) for row, c in zip(self.A, self.b)]
        size, slack = max(map(abs, y), default=Decimal(0)), [small * t for t in load]
        taken = {i for n, t1, t2, _ in self.contacts for i in (n, t1, t2)}
        for i in set(range(len(y))) - taken:
            lo, hi = self.box.lo[i], self.box.hi[i]
            lo, hi = (v if abs(v) == float("inf") else dec(v) for v in (lo, hi))
            if not lo - small * size <= y[i] <= hi + small * size:
                return False
            if w[i] > slack[i] and y[i] > lo + small * size or w[i] < -slack[i] and y[i] < hi - small * size:
                return False
        for n, t1, t2, mu in self.contacts:
            friction, slip, limit, rest = norm(y[t1], y[t2]), norm(w[t1], w[t2]), mu * y[n], slack[t1] + slack[t2]
            lift = w[n] - (mu * slip if self.law == "associated-cone" else 0)
            if y[n] < -small * size or friction > limit + small * size or lift < -slack[n] - mu * rest:
                return False
            if y[n] > small * size and lift > slack[n] + mu * rest:
                return False
            if slip > rest and norm(*(y[t] + limit * w[t] / slip for t in (t1, t2))) > small * size * (1 + rest / slip):
                return False
        return True

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


def solve(a, f):
    """a^-1 f by elimination with row exchanges, in decimals; None if a is singular."""
    n = len(a)
    rows = [row + [v] for row, v in zip(a, f)]
    for c in range(n):
        p = max(range(c, n), key=lambda i: abs(rows[i][c]) / (max(map(abs, rows[i][:n])) or 1))
        if not rows[p][c]:
            return None
        rows[c], rows[p] = rows[p], rows[c]
        for row in rows[c + 1:]:
            if row[c]:
                factor = row[c] / rows[c][c]
                row[c:] = [v - factor * t for v, t in zip(row[c:], rows[c][c:])]
    out = [Decimal(0)] * n
    for i in reversed(range(n)):
        out[i] = (rows[i][n] - sum(rows[i][j] * out[j] for j in range(i + 1, n))) / rows[i][i]
    return out


def size(x):
    return max(map(abs, x), default=Q(0))


def differ(message, worst):
    if message.is_infinite() or worst.is_infinite():       # a float may be infinite where a decimal is not yet
        return not min(message, worst) > Decimal("1e300")
    return abs(message - worst) > max(CLOSE * worst, TINY)


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
    message = Decimal(str(answer["scaled_residual"]))
    if differ(message, worst):
        yield f"scaled_residual is {float(worst):.6g}, not {message}"
    limit = Decimal(tolerance)
    if answer["verdict"] == "proved":
        most, far = number(answer["distance"]), None
        for find in (cones.still, lambda x: cones.still(cones.rounded(x)), cones.sliding, lambda x: cones.sliding(cones.rounded(x))):
            y = find(x)
            if y is not None:
                y = [v if isinstance(v, Q) else Q(v) for v in y]
                far = max((abs(a - b) for a, b in zip(x, y)), default=Q(0))
                if far <= most + size(x) / 10**40:
                    break
        if far is None or far > most + size(x) / 10**40:
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

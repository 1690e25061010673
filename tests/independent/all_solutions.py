"""All solutions of small problems: what `lcplab prove --all` lists, and the set itself, in exact arithmetic.

    all_solutions.py LCPLAB [NUMBER]     LCPLAB: the program; 300 problems
    all_solutions.py --self-test         planted lies must be caught, true lists must pass

PROBLEM.  Find x with w = A x + b and lo <= x <= hi so that w_i > 0 only where x_i = lo_i, and w_i < 0 only where
x_i = hi_i. A row i with friction_index[i] = k >= 0 has the bounds -+ mu_i max(x_k, 0).
PIECES.  Each row is at its lower bound (w_i >= 0), at its upper one (w_i <= 0), or inside (w_i = 0). All these are linear
in (x, 1), so that the solutions on such a choice form a cone of vectors (x, t), t >= 0, cut at t = 1: a polyhedron.
Cones are cut by one hyperplane after the other (double description); a ray with t = 0 is a direction without end.
COMPARED.  The solutions that are a piece by themselves and lie in no other one; whether there are others, and whether they
are bounded; each listed corner, by the definition, and whether it is a corner of a piece, each ray likewise; each face (the
means of its corners plus multiples of its rays), which must lie in the union of the pieces; each piece, which must lie in one
face. Nothing is sampled.
Problems have 1 to 4 rows, with entries so small that rows depend on each other. Each kind of set must occur, with and
without coupled rows. Exit code: 1 if anything differs or a kind is missing.
"""
import json
import math
import random
import subprocess
import sys
import tempfile
from collections import Counter
from fractions import Fraction as F
from pathlib import Path

INF = math.inf
KINDS = ["none", "one", "several", "bounded family", "unbounded family", "family and isolated ones"]
LEAST = 3       # so often each kind must occur, with and without coupled rows, in 300 problems


def dot(a, b):
    return sum(x * y for x, y in zip(a, b))


def whole(v):
    """The shortest vector of integers in this direction."""
    v = [F(x) for x in v]
    den = math.lcm(*(x.denominator for x in v))
    v = [x.numerator * (den // x.denominator) for x in v]
    return tuple(x // (math.gcd(*v) or 1) for x in v)


class Cone:
    """All sums of multiples of `lines` and of positive multiples of `rays`, each ray with the cuts that it lies in."""

    def __init__(self, lines, rays=(), cuts=0):
        self.lines, self.rays, self.cuts = list(lines), list(rays), cuts

    @staticmethod
    def space(n):
        return Cone([tuple(int(i == j) for j in range(n)) for i in range(n)])

    def cut(self, h, is_equation=False):
        """The part where h.v >= 0 or, of an equation, h.v = 0."""
        bit, more = 1 << self.cuts, self.cuts + 1
        for line in self.lines:
            if (size := dot(h, line)) != 0:
                up = line if size > 0 else tuple(-x for x in line)
                onto = lambda v: whole([abs(size) * x - dot(h, v) * y for x, y in zip(v, up)])
                rays = [(onto(v), on | bit) for v, on in self.rays] + [(up, bit - 1)] * (not is_equation)
                return Cone([onto(v) for v in self.lines if v is not line], rays, more)
        at = [dot(h, v) for v, _ in self.rays]
        rays = [(v, on | bit) for (v, on), s in zip(self.rays, at) if s == 0]
        rays += [ray for ray, s in zip(self.rays, at) if s > 0 and not is_equation]
        for i, (p, on_p) in enumerate(self.rays):
            for j, (q, on_q) in enumerate(self.rays):
                both = on_p & on_q      # neighbors share cuts that no third ray has all of
                if at[i] > 0 > at[j] and not any(both & ~on == 0 for k, (_, on) in enumerate(self.rays) if k not in (i, j)):
                    rays.append((whole([at[i] * y - at[j] * x for x, y in zip(p, q)]), both | bit))
        return Cone(self.lines, rays, more)

    def generators(self):
        return [v for v, _ in self.rays] + self.lines + [tuple(-x for x in v) for v in self.lines]

    def points(self):
        return [tuple(F(x, v[-1]) for x in v[:-1]) for v, _ in self.rays if v[-1] > 0]


class Problem:
    def __init__(self, data):
        self.A, self.b = data["A"]["dense"], data["b"]
        n = self.n = len(self.b)
        self.owner = data.get("friction_index", [-1] * n)
        self.mu = [F(m) for m in data.get("mu", [0] * n)]
        self.lo, self.hi = [float(v) for v in data["lo"]], [float(v) for v in data["hi"]]
        self.pieces = self.all_pieces()
        self.isolated = {p.points()[0] for p, _ in self.pieces if len(p.generators()) == 1}
        self.families = [(p, side) for p, side in self.pieces if len(p.generators()) > 1]
        inside = lambda x: any(lies_in([*x, 1], side) for _, side in self.families)
        self.isolated = {x for x in self.isolated if not inside(x)}
        self.is_bounded = all(v[-1] > 0 for p, _ in self.pieces for v in p.generators())

    def bounds(self, i, x):
        k = self.owner[i]
        return (self.lo[i], self.hi[i]) if k < 0 else (-self.mu[i] * max(x[k], 0), self.mu[i] * max(x[k], 0))

    def is_solution(self, x):
        def holds(i):
            (lo, hi), w = self.bounds(i, x), dot(map(F, self.A[i]), x) + F(self.b[i])
            return lo <= x[i] <= hi and (w <= 0 or x[i] == lo) and (w >= 0 or x[i] == hi)
        return all(map(holds, range(self.n)))

    def forms(self, i):
        """w_i, and the distances of x_i from its lower and its upper bound, as vectors h with h.(x, 1); None for infinity."""
        unit = [F(i == j) for j in range(self.n + 1)]
        if self.owner[i] >= 0:
            limit = [self.mu[i] * (self.owner[i] == j) for j in range(self.n + 1)]
            lower, upper = [limit] * 2
        else:
            at = lambda v: None if math.isinf(v) else [F(0)] * self.n + [F(v)]
            lower, upper = at(-self.lo[i]), at(self.hi[i])
        add = lambda bound, sign: None if bound is None else whole([a + sign * b for a, b in zip(bound, unit)])
        return whole([*map(F, self.A[i]), F(self.b[i])]), add(lower, 1), add(upper, -1)

    def all_pieces(self):
        """The cones of all pieces with a solution, each with its equations and its inequalities."""
        forms = [self.forms(i) for i in range(self.n)]
        within = [tuple([0] * self.n + [1])] + [h for _, *bounds in forms for h in bounds if h]
        cone = Cone.space(self.n + 1)
        for h in within:
            cone = cone.cut(h)
        pieces = [(cone, ([], within))]
        for w, lower, upper in forms:
            negative = tuple(-v for v in w)
            sides = [(w, None)] + [(lower, w)] * bool(lower) + [(upper, negative)] * bool(upper)
            if lower and upper and not any(p + q for p, q in zip(lower, upper)):    # fixed: any w
                sides = [(lower, None)]
            pieces = [(part, (zero + [equal], positive + [least] * bool(least)))
                      for cone, (zero, positive) in pieces for equal, least in sides
                      if (part := cut(cone, equal, least)).points()]
        return pieces

    def kind(self):
        if not self.families:
            return KINDS[min(2, len(self.isolated))]
        return KINDS[5 if self.isolated else 3 if self.is_bounded else 4]


def cut(cone, equal, least):
    cone = cone.cut(equal, is_equation=True)
    return cone.cut(least) if least else cone


def lies_in(v, side):
    zero, positive = side
    return all(dot(h, v) == 0 for h in zero) and all(dot(h, v) >= 0 for h in positive)


def hull(generators, n):
    """The equations and the inequalities of the cone with these generators: the generators of its dual cone."""
    dual = Cone.space(n)
    for v in generators:
        dual = dual.cut(v)
    return dual.lines, [v for v, _ in dual.rays]


def is_covered(cone, sides):
    """Whether the cone lies in the union of pieces. What lies outside the first must lie in the others. A piece
    with an equation that does not hold everywhere is thinner than the cone, and covers nothing of it."""
    if not sides:
        return False
    (zero, positive), *rest = sides
    if any(dot(h, v) != 0 for h in zero for v in cone.generators()):
        return is_covered(cone, rest)
    for h in positive:
        if any(dot(h, v) < 0 for v in cone.generators()):
            if not is_covered(cone.cut(tuple(-x for x in h)), rest):
                return False
            cone = cone.cut(h)
    return True


def differences(problem, code, found):
    """What is wrong with the list of all solutions."""
    exact = lambda vectors: [tuple(map(F, v)) for v in vectors]
    corners, rays, faces = exact(found["exact_corners"]), exact(found["exact_rays"]), found["faces"]
    isolated = [corners[f["corners"][0]] for f in faces if len(f["corners"]) == 1 and not f["rays"]]
    says = lambda name, own, known: [] if own == known else [f"{name}: {own}, not {known}"]
    wrong = says("exit code", code, int(not problem.pieces))
    wrong += says("isolated solutions", sorted(isolated), sorted(problem.isolated))
    wrong += says("a family", len(isolated) < len(faces), bool(problem.families))
    wrong += says("bounded", not rays, problem.is_bounded)
    wrong += says("unique", found["unique"], problem.kind() == "one")
    wrong += [f"{x} is no solution" for x in corners if not problem.is_solution(x)]
    if not any(piece.lines for piece, _ in problem.pieces):     # with lines, any of their points serves
        known = {v for piece, _ in problem.pieces for v in piece.generators()}
        listed = [whole([*x, 1]) for x in corners] + [whole([*d, 0]) for d in rays]
        wrong += [f"{v} is no corner or ray of a piece" for v in listed if v not in known]
    for name, all_exact in (("corners", corners), ("rays", rays)):
        wrong += says(f"{name} as decimals", found[name], [[float(v) for v in x] for x in all_exact])
        wrong += says(f"{name} of the faces", sorted({k for f in faces for k in f[name]}), list(range(len(set(all_exact)))))
    hulls = []
    for face in faces:
        points = [[*corners[k], 1] for k in face["corners"]] + [[*rays[k], 0] for k in face["rays"]]
        zero, positive = sides = hull(map(whole, points), problem.n + 1)
        hulls.append(sides)
        cone = Cone.space(problem.n + 1)
        for h in zero:
            cone = cone.cut(h, is_equation=True)
        for h in positive:
            cone = cone.cut(h)
        if not is_covered(cone, [side for _, side in problem.pieces]):
            wrong.append(f"not all points of the face {face} are solutions")
    for piece, _ in problem.pieces:
        if not any(all(lies_in(v, sides) for v in piece.generators()) for sides in hulls):
            wrong.append(f"no face contains the solutions {piece.generators()}")
    return wrong


def drawn(draw, is_coupled):
    """A problem of small numbers. A matrix of bodies is J J', of fewer columns than rows, so that the force in some rows is not
    determined; b is then such that there is a solution, or any. Some rows are equations, fixed, or have two bounds."""
    n = draw.choice([2, 2, 3, 3, 4] if is_coupled else [1, 2, 3, 3, 3])
    if draw.random() < 0.35:
        J = [[draw.choice([-1, 0, 1, 1]) for _ in range(max(1, n - draw.randint(0, 2)))] for _ in range(n)]
        A = [[dot(p, q) for q in J] for p in J]
    else:
        J, A = None, [[draw.choice([-2, -1, -1, 0, 0, 0, 1]) for _ in range(n)] for _ in range(n)]
    lo = [draw.choice([0, 0, 0, -1, 1, -INF]) for _ in range(n)]
    hi = [max(l, draw.choice([INF, INF, 1, 2])) for l in lo]
    data = {"A": {"dense": A}}
    if is_coupled:
        rows = list(range(n))
        draw.shuffle(rows)
        normal, *others = rows
        owner, mu = [-1] * n, [0] * n
        for i in others[:draw.randint(1, n - 1)]:
            owner[i], mu[i], lo[i], hi[i] = normal, draw.choice([0, 0.5, 0.5, 1, 1, 2]), -INF, INF
        lo[normal] = max(lo[normal], 0)
        hi[normal] = max(hi[normal], lo[normal])
        data |= {"friction_index": owner, "mu": mu}
    if J and draw.random() < 0.6:
        push = [draw.choice([-2, -1, 0, 1]) for _ in J[0]]
        b = [dot(row, push) for row in J]
    elif draw.random() < 0.4:       # a point with w = 0 in many rows: kinks
        x = [max(min(draw.choice([0, 0, 1, 2]), h), l) for l, h in zip(lo, hi)]
        b = [draw.choice([0, 0, 0, 1, -1]) - dot(row, x) for row in A]
    else:
        b = [draw.choice([-2, -1, 0, 0, 1, 2]) for _ in range(n)]
    if n > 1 and draw.random() < 0.4:       # w of a row is another x, or 0 of a normal row if it slides in one direction
        row, other = (normal, i) if is_coupled else draw.sample(range(n), 2)
        A[row] = [A[row][j] if j == other else 0 for j in range(n)]
        A[row][row], b[row] = draw.choice([-1, 1]) * mu[i] * A[row][i] if is_coupled else 0, 0
    text = lambda v: str(v) if math.isinf(v) else v
    return data | {"b": b, "lo": list(map(text, lo)), "hi": list(map(text, hi))}


def main(program, number=300):
    draw, seen, bad = random.Random(67), Counter(), 0
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder, "problem.json")
        for k in range(int(number)):
            data = drawn(draw, k % 2 == 1)
            problem = Problem(data)
            file.write_text(json.dumps(data))
            run = subprocess.run([program, "prove", file, "--all", "--json"], capture_output=True, text=True)
            wrong = [run.stderr.strip()] if run.returncode > 1 else differences(problem, run.returncode, json.loads(run.stdout))
            seen[problem.kind(), k % 2 == 1] += 1
            if wrong:
                bad += 1
                print(f"DIFFERS {json.dumps(data)}: {wrong}")
    for kind in KINDS:
        print(f"{kind}: {seen[kind, False]}, with coupled rows: {seen[kind, True]}")
        if min(seen[kind, False], seen[kind, True]) < LEAST * int(number) // 300:
            bad += 1
            print("TOO FEW of this kind")
    print(f"{number} problems; {bad} differ")
    return bool(bad)


def self_test():
    """Sets that are known by hand pass; each planted lie about them is caught."""
    def listed(corners, rays, faces):
        written = lambda vectors: [[str(F(v)) for v in x] for x in vectors]
        return {"unique": faces == [([0], [])], "corners": corners, "rays": rays, "exact_corners": written(corners),
                "exact_rays": written(rays), "faces": [{"corners": c, "rays": r} for c, r in faces]}

    def rows(A, b, **more):
        return Problem({"A": {"dense": A}, "b": b, "lo": [0] * len(b), "hi": ["inf"] * len(b)} | more)

    def check(problem, kind, truth, *lies):
        assert problem.kind() == kind, problem.kind()
        assert not differences(problem, int(kind == "none"), listed(*truth)), differences(problem, int(kind == "none"), listed(*truth))
        for lie in lies:
            assert differences(problem, int(not lie[2]), listed(*lie)), lie

    none, one = ([], [], []), ([[0]], [], [([0], [])])
    check(rows([[0]], [-1]), "none", none, one)
    check(rows([[2]], [1]), "one", one, none, ([[1]], [], [([0], [])]), ([[0], [1]], [], [([0], []), ([1], [])]), ([[0]], [[1]], [([0], [0])]))
    # w = 1 - x: 0 and 1, and nothing between them.
    check(rows([[-1]], [1]), "several", ([[0], [1]], [], [([0], []), ([1], [])]), one, ([[0], [1]], [], [([0, 1], [])]))
    # Two supports share a load of 1: a segment, which a list may not shorten, stretch or leave in pieces.
    ends = [[0, 1], [1, 0]]
    check(rows([[1, 1], [1, 1]], [-1, -1]), "bounded family", (ends, [], [([0, 1], [])]), (ends, [], [([0], []), ([1], [])]),
          ([[0, 1], [0.5, 0.5]], [], [([0, 1], [])]), ([[-1, 2], [1, 0]], [], [([0, 1], [])]), (ends, [[1, -1]], [([0, 1], [0])]),
          ([*ends, [0.5, 0.5]], [], [([0, 2], []), ([1, 2], [])]), ([*ends, [0.5, 0.5]], [], [([0, 1, 2], [])]))
    # w = (0, x1 - 1): x1 = 1, and any x0 >= 0. Without bounds of x0 a line, which is two rays.
    flat = [[0, 0], [0, 1]], [0, -1]
    check(rows(*flat), "unbounded family", ([[0, 1]], [[1, 0]], [([0], [0])]), ([[0, 1]], [], [([0], [])]),
          ([[0, 1]], [[1, 1]], [([0], [0])]), ([[0, 1], [5, 1]], [], [([0, 1], [])]), ([[2, 1]], [[1, 0]], [([0], [0])]))
    check(rows(*flat, lo=["-inf", 0]), "unbounded family", ([[0, 1]], [[1, 0], [-1, 0]], [([0], [0, 1])]), ([[0, 1]], [[1, 0]], [([0], [0])]))
    # w = (x0 + x1, x0 - 1), |x1| <= x0 <= 4: from (1, -1) to (4, -4), and (0, 0), where x1 is fixed, whatever w1 is.
    sliding = rows([[1, 1], [1, 0]], [0, -1], lo=[0, "-inf"], hi=[4, "inf"], friction_index=[-1, 0], mu=[0, 1])
    three = [[0, 0], [1, -1], [4, -4]]
    check(sliding, "family and isolated ones", (three, [], [([0], []), ([1, 2], [])]),
          (three, [], [([0, 2], []), ([1, 2], [])]), (three, [], [([0, 1, 2], [])]), (three[1:], [], [([0, 1], [])]), (three, [], [([0], []), ([1], []), ([2], [])]))
    # w = (x0 + x1, 1 + x0 - x2, 0), |x1| <= x0: (s, -s, t) with t <= 1 + s, and (0, 0, t) for all t.
    fixed = rows([[1, 1, 0], [1, 0, -1], [0, 0, 0]], [0, 1, 0], lo=[0, "-inf", 0], hi=["inf"] * 3, friction_index=[-1, 0, -1], mu=[0, 1, 0])
    corners, rays = [[0, 0, 0], [0, 0, 1]], [[1, -1, 0], [1, -1, 1], [0, 0, 1]]
    check(fixed, "unbounded family", (corners, rays, [([0, 1], [0, 1]), ([0, 1], [2])]), (corners, rays, [([0, 1], [0, 1]), ([0, 1], [0, 2])]))
    print("self-test passed")


if __name__ == "__main__":
    sys.exit(self_test() if sys.argv[1:] == ["--self-test"] else main(*sys.argv[1:]))

"""Errors in single precision, computed again operation by operation.

    precision.py LCPLAB [NUMBER]     LCPLAB: the program; 200 problems
    precision.py --self-test         wrong numbers are found

Each problem has random masses (also coupled ones), rows, biases, compliances and bounds. This program assembles A and b, runs
projected Gauss-Seidel and computes the velocity with every operation rounded to 24 or 53 bits, in the order that
docs/precision.md states, and compares the errors of all stages with those that `lcplab precision --solver pgs` prints. The exact
solution comes from fractions. For `--solver dantzig` and `newton`, whose order of operations is not specified, it compares the errors of the
data alone, with those of the exact solution of the rounded problem, and the prediction. Exit code: 1 if anything differs.
"""
import copy
import json
import math
import random
import struct
import subprocess
import sys
from fractions import Fraction as F

SINGLE = struct.Struct("f")
STAGES = ["data", "assembly", "sums", "velocity"]
SWEEPS = 100


def double(v):
    return v


def single(v):
    return SINGLE.unpack(SINGLE.pack(v))[0] if math.isfinite(v) else v


def total(r, terms):
    """The sum of terms, each already rounded."""
    value = 0.0
    for term in terms:
        value = r(value + term)
    return value


def factors(r, M):
    """L D Lᵀ of M."""
    k = len(M)
    L, D = [[float(i == j) for j in range(k)] for i in range(k)], [0.0] * k
    for j in range(k):
        D[j] = r(M[j][j] - total(r, [r(r(L[j][c] * D[c]) * L[j][c]) for c in range(j)]))
        for i in range(j + 1, k):
            L[i][j] = r(r(M[i][j] - total(r, [r(r(L[i][c] * D[c]) * L[j][c]) for c in range(j)])) / D[j])
    return L, D


def solved(r, L, D, right):
    x = list(right)
    for i in range(len(x)):
        x[i] = r(x[i] - total(r, [r(L[i][c] * x[c]) for c in range(i)]))
    x = [r(v / d) for v, d in zip(x, D)]
    for i in reversed(range(len(x))):
        x[i] = r(x[i] - total(r, [r(L[c][i] * x[c]) for c in range(i + 1, len(x))]))
    return x


def rounded(r, v):
    return [rounded(r, own) for own in v] if isinstance(v, list) else r(v)


def assembled(r, p):
    M, J, bias, gamma, target = (rounded(r, p[name]) for name in ("M", "J", "bias", "gamma", "target"))
    L, D = factors(r, M)
    responses = [solved(r, L, D, row) for row in J]
    along = lambda row, v: total(r, [r(a * b) for a, b in zip(row, v)])
    n = len(J)
    A = [[0.0] * n for _ in range(n)]
    for i in range(n):
        for j in range(i + 1):
            own = along(J[i], responses[j])
            A[i][j] = A[j][i] = r(own + gamma[i]) if i == j else own
    return A, [r(along(row, target) + own) for row, own in zip(J, bias)]


def swept(r, A, b, lo, hi):
    A, b, lo, hi = (rounded(r, v) for v in (A, b, lo, hi))
    n, x = len(b), [0.0] * len(b)
    for _ in range(SWEEPS):
        for i in range(n):
            w = r(total(r, [r(A[i][j] * x[j]) for j in range(n)]) + b[i])
            x[i] = min(max(r(x[i] - r(w / A[i][i])), lo[i]), hi[i])
    return x


def velocity(r, p, x):
    M, J, target, x = (rounded(r, v) for v in (p["M"], p["J"], p["target"], x))
    force = [total(r, [r(J[i][c] * x[i]) for i in range(len(x))]) for c in range(len(target))]
    change = solved(r, *factors(r, M), force)
    return [r(u + d) for u, d in zip(target, change)]


def run(p, stages):
    """x and u with these stages in single precision."""
    of = lambda stage: single if stage in stages else double
    p = {name: rounded(of("data"), v) for name, v in p.items()}
    A, b = assembled(of("assembly"), p)
    x = swept(of("sums"), A, b, p["lo"], p["hi"])
    return x, velocity(of("velocity"), p, x)


def linear(A, right):
    """The solution of linear equations in fractions."""
    rows = [[F(a) for a in row] + [F(v)] for row, v in zip(A, right)]
    n = len(rows)
    for c in range(n):
        at = next(r for r in range(c, n) if rows[r][c])
        rows[c], rows[at] = rows[at], rows[c]
        rows[c] = [v / rows[c][c] for v in rows[c]]
        for r in range(n):
            if r != c and rows[r][c]:
                rows[r] = [v - rows[r][c] * own for v, own in zip(rows[r], rows[c])]
    return [row[-1] for row in rows]


def solution(A, b, lo, hi):
    """The x of a box with a positive definite A, in fractions, and its free rows: Murty's rule."""
    n, side = len(b), ["free"] * len(b)
    bound = lambda i: F(lo[i] if side[i] == "lo" else hi[i])
    for _ in range(1000):
        free = [i for i in range(n) if side[i] == "free"]
        fixed = [i for i in range(n) if side[i] != "free"]
        right = [-F(b[i]) - sum((F(A[i][j]) * bound(j) for j in fixed), F(0)) for i in free]
        own = dict(zip(free, linear([[A[i][j] for j in free] for i in free], right)))
        x = [own[i] if i in own else bound(i) for i in range(n)]
        w = [sum((F(a) * v for a, v in zip(row, x)), F(c)) for row, c in zip(A, b)]
        for i in range(n):
            if side[i] == "free" and (x[i] < lo[i] or x[i] > hi[i]):
                side[i] = "lo" if x[i] < lo[i] else "hi"
            elif side[i] == "lo" and w[i] < 0 or side[i] == "hi" and w[i] > 0:
                side[i] = "free"
            else:
                continue
            break
        else:
            return x, free
    raise ValueError("no solution found")


def moved(p, x):
    """The exact motion."""
    force = [sum((F(row[c]) * v for row, v in zip(p["J"], x)), F(0)) for c in range(len(p["target"]))]
    return [F(u) + d for u, d in zip(p["target"], linear(p["M"], force))]


def length(M, v):
    return math.sqrt(sum(F(M[i][j]) * v[i] * v[j] for i in range(len(v)) for j in range(len(v))))


def residual(A, b, lo, hi, x):
    """The scaled residual, as docs/verdicts.md defines it: |x - Π(x - e w/T)|/e, e = min(T/s, R)."""
    worst = F(0)
    for i, row in enumerate(A):
        terms = [F(a) * F(v) for a, v in zip(row, x)] + [F(b[i])]
        w, size = sum(terms), sum(map(abs, terms))
        reach = max((F(abs(bound)) for bound in (lo[i], hi[i]) if math.isfinite(bound)), default=F(0))
        unit = min(size / F(row[i]), reach) if reach else size / F(row[i])
        if size:
            step = F(x[i]) - unit * w / size
            step = F(lo[i]) if step < lo[i] else F(hi[i]) if step > hi[i] else step
            worst = max(worst, abs(F(x[i]) - step) / unit)
    return float(worst)


def predicted(p, A, b, x, free, u, is_sweep):
    """The formula of docs/precision.md."""
    rounding = 2.0**-24 / math.sqrt(8 * math.log(2))
    inverse = [linear([[A[i][j] for j in free] for i in free], [float(i == k) for i in free]) for k in free]
    if is_sweep:
        spacing = lambda v: 2.0 ** (math.frexp(single(abs(v)))[1] - 25)
        r = [A[i][i] * spacing(float(x[i])) * math.copysign(1, x[i]) for i in free]
        square = sum(float(inverse[k][m]) * r[k] * r[m] for k in range(len(free)) for m in range(len(free)))
    else:
        terms = lambda i: sum(float(F(a) * v) ** 2 for a, v in zip(A[i], x)) + b[i] ** 2
        square = rounding**2 * sum(float(inverse[k][k]) * terms(i) for k, i in enumerate(free))
    for k, (target, own) in enumerate(zip(p["target"], u)):
        square += rounding**2 * p["M"][k][k] * (target**2 + float(own - F(target)) ** 2 + float(own) ** 2)
    return math.sqrt(square)


def expected(p, is_sweep):
    """What the program should print."""
    A, b = assembled(double, p)
    x, free = solution(A, b, p["lo"], p["hi"])
    u = moved(p, x)
    effect = length(p["M"], [a - F(c) for a, c in zip(u, p["target"])]) or length(p["M"], u)
    own = {"predicted": predicted(p, A, b, x, free, u, is_sweep) / effect}

    def loss(stages):
        x, v = run(p, stages)
        change = [F(a) - c for a, c in zip(v, u)]
        return {"relative": length(p["M"], change) / effect, "largest_entry": float(max(map(abs, change))),
                "scaled_residual": residual(A, b, p["lo"], p["hi"], x)}

    if is_sweep:
        own.update(single=loss(STAGES), double=loss([]))
        for stage in STAGES:
            own[stage] = {"alone": loss([stage]), "mended": loss([other for other in STAGES if other != stage])}
    else:
        less = {name: rounded(single, v) for name, v in p.items()}
        x, _ = solution(*assembled(double, less), less["lo"], less["hi"])
        change = [a - c for a, c in zip(moved(less, x), u)]
        own["data"] = {"alone": {"relative": length(p["M"], change) / effect}}
    return own


def flat(value, name=""):
    if isinstance(value, dict):
        return {key: v for own, part in value.items() for key, v in flat(part, f"{name} {own}".strip()).items()}
    return {name: value}


def differences(printed, own):
    """The names of the numbers that differ by more than the rounding of errors themselves."""
    theirs = {**printed, **{stage["name"]: stage for stage in printed["stages"]}}
    theirs = flat({key: v for key, v in theirs.items() if key in own})
    unequal = lambda a, b: abs(a - b) > 1e-5 * abs(b) + 1e-13
    return [name for name, value in flat(own).items() if unequal(theirs[name], value)]


def problem(rng):
    k, n = rng.randint(2, 4), rng.randint(1, 4)
    M = [[0.0] * k for _ in range(k)]
    for i in range(k):
        M[i][i] = 10 ** rng.uniform(-1, 2)
    if rng.random() < 0.5:  # one coupling, as in the inertia of a body
        M[0][1] = M[1][0] = rng.uniform(-0.6, 0.6) * math.sqrt(M[0][0] * M[1][1])
    J = [[rng.choice([0.0, 1.0, -1.0, rng.uniform(-1, 1)]) for _ in range(k)] for _ in range(n)]
    for row in J:
        row[rng.randrange(k)] = rng.uniform(0.5, 1)
    bounds = [rng.choice([(0.0, math.inf), (-math.inf, math.inf), (-0.3, 0.7)]) for _ in range(n)]
    return {"M": M, "J": J, "bias": [rng.uniform(-0.1, 0.1) for _ in range(n)], "gamma": [rng.uniform(0.5, 2) for _ in range(n)],
            "target": [rng.uniform(-1, 1) for _ in range(k)], "lo": [lo for lo, _ in bounds], "hi": [hi for _, hi in bounds]}


def written(p):
    A, b = assembled(double, p)
    triplets = lambda T, upper: [[i, j, v] for i, row in enumerate(T) for j, v in enumerate(row) if v and (i <= j or not upper)]
    motion = {"mass": triplets(p["M"], True), "jacobian": triplets(p["J"], False), "bias": p["bias"], "compliance": p["gamma"],
              "target": p["target"], "level": "velocity"}
    word = lambda v: v if math.isfinite(v) else str(v)
    return json.dumps({"A": {"dense": A}, "b": b, "lo": list(map(word, p["lo"])), "hi": list(map(word, p["hi"])), "motion": motion})


def printed(program, p, solver):
    command = [program, "precision", "-", "--json", "--solver", solver, "--tolerance", "1"]
    command += ["--sweeps", str(SWEEPS)] if solver == "pgs" else []
    output = subprocess.run(command, input=written(p), capture_output=True, text=True)
    if output.returncode not in (0, 1):
        raise SystemExit(f"{output.stderr}\n{written(p)}")
    return json.loads(output.stdout)


def self_test():
    own = expected(problem(random.Random(1)), True)
    true = {key: own[key] for key in ("predicted", "single", "double")}
    true["stages"] = [{"name": stage, **own[stage]} for stage in STAGES]
    assert differences(true, own) == []
    for stage in range(len(STAGES)):
        for run in ("alone", "mended"):
            wrong = copy.deepcopy(true)
            wrong["stages"][stage][run]["relative"] = 1.01 * true["stages"][stage][run]["relative"] + 1e-12
            assert differences(wrong, own) == [f"{STAGES[stage]} {run} relative"]
    assert differences({**true, "predicted": 1.01 * own["predicted"]}, own) == ["predicted"]
    own = expected(problem(random.Random(1)), False)  # dantzig and newton
    true = {"predicted": own["predicted"], "stages": [{"name": "data", **own["data"]}]}
    assert differences(true, own) == []
    assert differences({**true, "predicted": 1.01 * own["predicted"]}, own) == ["predicted"]
    wrong = copy.deepcopy(true)
    wrong["stages"][0]["alone"]["relative"] = 1.01 * own["data"]["alone"]["relative"] + 1e-12
    assert differences(wrong, own) == ["data alone relative"]
    assert single(1 + 2.0**-24) == 1 and single(1 + 3 * 2.0**-24) == 1 + 2.0**-22  # ties to even
    print("precision.py: every wrong number was found")


def main(program, number):
    rng, wrong = random.Random(59), 0
    for i in range(number):
        p = problem(rng)
        for solver in ("pgs", "dantzig", "newton"):
            found = differences(printed(program, p, solver), expected(p, solver == "pgs"))
            if found:
                wrong += 1
                print(f"problem {i}, {solver}: {', '.join(found)}\n{written(p)}")
    print(f"precision.py: {number} problems, {wrong} differences")
    return int(wrong > 0)


if __name__ == "__main__":
    if sys.argv[1:] == ["--self-test"]:
        self_test()
    elif len(sys.argv) in (2, 3):
        sys.exit(main(sys.argv[1], int(sys.argv[2]) if len(sys.argv) == 3 else 200))
    else:
        sys.exit(__doc__)

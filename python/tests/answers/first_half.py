"""Finds every answer and every trap of the problem sets 1 to 9 anew, and asserts them.

Each number is found in two ways where that is possible: in fractions or by a program of its own here, and by lcplab.
The commands of the "predict" problems are taken from the texts and run. With the argument "pages" the live pages are opened
by chromium at the addresses of the texts, and what they say is read (a minute more).
"""
import json, re, shlex, subprocess, sys, tempfile
from fractions import Fraction as F
from itertools import product
from math import *
from pathlib import Path

import numpy as np
from scipy.optimize import linprog
import lcplab

sys.path.insert(0, str(Path(__file__).parent))
from printed import problems
from lcplab import textbook

ROOT = Path(__file__).parent.parent.parent.parent
G, INF = 9.81, float("inf")
P, done = {}, {}
for k in range(1, 10):
    data = problems(k)
    assert all(re.fullmatch(rf"{k}\.[prx][12]", p["id"]) for p in data)
    for p in data:
        kinds = {"p": "pencil", "r": "predict", "x": "live"}
        assert set(p) - {"also"} == {"id", "kind", "title", "minutes", "level", "text", "unit", "answer", "within", "traps", "because"}
        assert p["kind"] == kinds[p["id"].split(".")[1][0]] and len(p["title"]) <= 60 and p["level"] in (1, 2, 3)
        assert 5 <= p["minutes"] <= 15 and 1 <= len(p["traps"]) <= 4 and all(set(t) == {"answer", "hint"} for t in p["traps"])
        assert isinstance(p["answer"], float) and all(isinstance(t["answer"], float) for t in p["traps"]) and 0 < p["within"] < 0.1
        assert "—" not in p["text"] + p["because"] and all(p[s].count("$") % 2 == 0 for s in ("text", "because"))
        near = lambda a, b: abs(a - b) <= p["within"] * (abs(b) if b else 1)
        numbers = [t["answer"] for t in p["traps"]]
        assert not any(near(t, p["answer"]) or near(p["answer"], t) for t in numbers), p["id"]
        assert len(set(numbers)) == len(numbers), p["id"]  # of two near ones the nearest speaks
        if p["kind"] == "live": assert "](../live/" in p["text"]
        if p["kind"] == "predict": assert "`lcplab " in p["text"] or "| lcplab " in p["text"] or "cell `" in p["text"]
        P[p["id"]] = p
titles = [p["title"] for k in range(1, 18) for p in problems(k)]
assert len(set(titles)) == len(titles)

def check(id, answer, traps, how, rel=5e-4):
    p = P[id]
    close = lambda a, b: abs(a - b) <= max(rel * abs(b), 1e-12)
    assert close(p["answer"], answer), (id, p["answer"], answer)
    assert len(traps) == len(p["traps"]), id
    for t, v in zip(p["traps"], traps): assert close(t["answer"], v), (id, t["answer"], v)
    done[id] = True
    print(f"{id:5} {p['answer']:<10} traps {[t['answer'] for t in p['traps']]}: {how}")

TMP = tempfile.mkdtemp()
def run(id, which):
    """The output of a command of the text, by python -m lcplab."""
    line = re.findall(r"`((?:[^`]*\| )?lcplab [^`]*)`", P[id]["text"])[which]
    before, words = line.split("lcplab ", 1)
    given = re.match(r"echo '(.*)' \| $", before)[1] if before else None
    r = subprocess.run([sys.executable, "-m", "lcplab", *shlex.split(words)], capture_output=True, text=True, timeout=300, cwd=TMP, input=given)
    assert r.returncode in (0, 1), (line, r.stderr)
    return r.stdout
iterations = lambda text: int(re.search(r"([\d,]+) iterations", text)[1].replace(",", ""))
PLAIN = str.maketrans("−⁻⁰¹²³⁴⁵⁶⁷⁸⁹", "--0123456789", ",")  # −1.5×10⁻⁸ becomes -1.5e-8
plain = lambda text: re.sub(r"(?<=\s)10(?=-)", "1e", text.translate(PLAIN).replace("×10", "e"))
field = lambda text, name: float(re.search(rf"(?m)^\s*{name}\s+(-?[\d.]+(?:e-?\d+)?)", plain(text))[1])
column_x = lambda text: [float(r[2]) for r in re.findall(r"(?m)^ +(\d+) +(\S+) +(-?\d\S*) +(\S+) +(\S+)(?: +\S.*)?$", plain(text))]

# --- own solvers ---------------------------------------------------------------------------------------------------
def det_solve(M, r):
    """Gauss in fractions; None if M is singular."""
    n, T = len(r), [[F(v) for v in row] + [F(s)] for row, s in zip(M, r)]
    for i in range(n):
        k = next((k for k in range(i, n) if T[k][i] != 0), None)
        if k is None: return None
        T[i], T[k] = T[k], T[i]
        T[i] = [v / T[i][i] for v in T[i]]
        for k in range(n):
            if k != i: T[k] = [a - T[k][i] * c for a, c in zip(T[k], T[i])]
    return [row[-1] for row in T]

def solutions(A, b, hi=None):
    """All isolated solutions, by trying every case, in fractions."""
    n, found = len(b), []
    A, b = [[F(v) for v in row] for row in A], [F(v) for v in b]
    for case in product("0fh" if hi else "0f", repeat=n):
        x = [F(hi[i]) if c == "h" else F(0) for i, c in enumerate(case)]
        free = [i for i, c in enumerate(case) if c == "f"]
        if free:
            s = det_solve([[A[i][j] for j in free] for i in free], [-b[i] - sum(A[i][j] * x[j] for j in range(n)) for i in free])
            if s is None: continue
            for i, v in zip(free, s): x[i] = v
        w = [sum(a * v for a, v in zip(row, x)) + c for row, c in zip(A, b)]
        fits = all({"0": w[i] >= 0, "f": x[i] >= 0 and (not hi or x[i] <= F(hi[i])), "h": w[i] <= 0}[c] for i, c in enumerate(case))
        if fits and x not in found: found.append(x)
    return found

def sweeps(A, b, x, count, order=1, clamp=True):
    A, b, x = np.array(A, float), np.array(b, float), np.array(x, float)
    for _ in range(count):
        for i in list(range(len(b)))[::order]:
            x[i] -= (A[i] @ x + b[i]) / A[i, i]
            if clamp: x[i] = max(x[i], 0.0)
    return x

def scaled(A, b, x):
    terms = np.abs(A) @ np.abs(x) + np.abs(b)
    return (np.abs(np.minimum(x, (A @ x + b) / np.diag(A))) * np.diag(A) / np.where(terms > 0, terms, 1)).max()

def rho(A): return max(abs(np.linalg.eigvals(-np.linalg.solve(np.tril(A), np.triu(A, 1)))))
def column(m):
    A = np.diag([1 / m[i] + (1 / m[i - 1] if i else 0) for i in range(len(m))])
    for i in range(1, len(m)): A[i, i - 1] = A[i - 1, i] = -1 / m[i - 1]
    return A
slider = lambda low, high: [round(low + 0.1 * k, 1) for k in range(round((high - low) / 0.1) + 1)]

# === 1 =============================================================================================================
m, dt, before, after = 3, 0.05, -0.5, -0.8
b = before - G * dt - after
x = max(0, -b * m)
check("1.p1", x, [m * G * dt, m * (G * dt - before), x / m, m * G * dt + m * (before - after)], "one row; momentum of the crate; lcplab with a tray that moves")
assert abs(m * (after - before) + m * G * dt - x) < 1e-12 and round(100 * x / (m * G * dt)) == 39
with tempfile.NamedTemporaryFile("w", suffix=".toml", delete=False) as f:
    f.write("""[step]
dt = 0.05
count = 1
[contact]
friction = 0
restitution = 0
[[bodies]]
name = "tray"
fixed = true
shape = { plane = [0, 0, 1] }
velocity = [0, 0, -0.8]
[[bodies]]
name = "crate"
shape = { sphere = 0.5 }
mass = 3
position = [0, 0, 0.5]
velocity = [0, 0, -0.5]
""")
s = lcplab.Scene.load(f.name)
assert abs(s.step().x[0] - x) < 1e-12  # a tray that has its speed at the end of the step

A, b, hi = [[1, -1], [-1, 2]], [-1, 0], [F(8, 5), F(9, 10)]
[x] = solutions(A, b, hi)
assert x == [F(8, 5), F(4, 5)] and solutions(A, b) == [[2, 1]]
r = lcplab.solve(A, b, [0, 0], [1.6, 0.9])
assert r and np.allclose(r.x, [1.6, 0.8]) and np.allclose(r.w, [-0.2, 0])
lower = lambda x: float(1 - x[1])  # downwards
both = hi[0] - hi[1] - 1
assert -hi[0] + 2 * hi[1] == F(1, 5)  # w1 if both slip: not allowed
check("1.p2", lower(x), [lower(hi), lower([2, 1]), float(-both)], "nine cases in fractions; lcplab with bounds; u of both loads")
assert x[0] - x[1] - 1 == -F(1, 5) == -F(lower(x)).limit_denominator(100)

n = np.array([[0.96, 0, 0.28], [-0.96, 0, 0.28]])
A, b = n @ n.T, n @ [0, 0, -1]
out = column_x(run("1.r1", 0))
given = json.loads(re.search(r"echo '(.*)' \|", P["1.r1"]["text"])[1])
assert np.allclose(A, given["A"]["dense"]) and np.allclose(b, given["b"]) and np.allclose(out, 25 / 14, rtol=1e-6)
check("1.r1", 25 / 14, [0.5, 0.28], "closed form 1/(2·0.28) from the balance of forces; command")
assert np.allclose(n.T @ np.full(2, 25 / 14), [0, 0, 1]) and abs(2 * 0.28 * 25 / 14 - 1) < 1e-12 and round(50 / 14, 1) == 3.6

grid = [a for a in slider(-1, 4)]
count = {a: len(solutions([[2, a], [a, 2]], [-1, F(-3, 2)])) for a in grid}
first = next(a for a in grid if count[a] > 1)
stops = next(a for a in grid if solutions([[2, a], [a, 2]], [-1, F(-3, 2)])[0][0] == 0)
negative = next(a for a in grid if a > 2)
three = next(a for a in grid if count[a] == 3)
assert count[3.0] == 2 and all(count[a] == 1 for a in grid if a < 3) and all(count[a] == 3 for a in grid if a > 3)
check("1.x1", first, [negative, three, stops], "four cases in fractions at every value of the slider; cases by hand; page")
assert sorted(solutions([[2, 3], [3, 2]], [-1, F(-3, 2)])) == [[0, F(3, 4)], [F(1, 2), 0]]
for a in (2.9, 3.0, 3.1):
    assert bool(lcplab.judge([[2, a], [a, 2]], [-1, -1.5], [0.5, 0])) == (a >= 3) and lcplab.judge([[2, a], [a, 2]], [-1, -1.5], [0, 0.75])

# === 2 =============================================================================================================
p1, v1, p2, v2 = np.array([0.3, 0.4, 0]), np.array([-1.0, 2, 0]), np.array([0, 0, -0.6]), np.array([0, 0, 1.0])
norm = np.linalg.norm
c = lambda t: norm(p1 + v1 * t) + norm(p2 + v2 * t)
bend = lambda p, v: (v @ v - (p @ v / norm(p))**2) / norm(p)
h = 1e-4
assert abs((c(h) - c(-h)) / (2 * h)) < 1e-6 and abs((c(h) - 2 * c(0) + c(-h)) / h**2 - 8) < 1e-4
across = v1 @ v1 - (p1 @ v1 / norm(p1))**2
check("2.p1", bend(p1, v1) + bend(p2, v2), [v1 @ v1 / norm(p1), across, bend(p1, v1) + v2 @ v2 / norm(p2)], "formula of a rod, twice; second difference of c")

w0, n, d, ball = np.array([0, -1.5, 0]), np.array([0, 0, 1.0]), np.array([0.8, 0, 0]), np.array([0, 0, 1.0])
rate = n @ ball + np.cross(w0, n) @ d
J0 = -np.cross(np.zeros(3) + d, n)  # the row's entries at ω0, r0 = 0
def gap(t):  # the door turns by −1.5 t about y, by Rodrigues' formula
    a = -1.5 * t
    return np.array([sin(a), 0, cos(a)]) @ (d + ball * t)
assert abs(rate - (J0 @ w0 + n @ ball)) < 1e-12 and abs((gap(h) - gap(-h)) / (2 * h) - rate) < 1e-6
check("2.p2", rate, [n @ ball, n @ ball - np.cross(w0, n) @ d, np.cross(w0, n) @ d], "formula of the contact; its row J; difference quotient of n·d with a turning n")
assert np.allclose(np.cross(w0, d), [0, 0, 1.2])

def freedoms(points):
    J = np.zeros((3, 9))
    for k, (i, j) in enumerate([(0, 1), (1, 2), (2, 0)]):
        e = np.subtract(points[j], points[i]) / norm(np.subtract(points[j], points[i]))
        J[k, 3 * i:3 * i + 3], J[k, 3 * j:3 * j + 3] = -e, e
    return 9 - np.linalg.matrix_rank(J, 1e-9)
left = lambda text: int(re.search(r"remaining degrees of freedom\s+(\d+)", text)[1])
stick, triangle = [[1, 0, 0], [0, 0, 0], [-1, 0, 0]], [[1, 0, 0], [-.5, .75**.5, 0], [-.5, -.75**.5, 0]]
assert left(run("2.r1", 0)) == 6 == freedoms(triangle) and left(run("2.r1", 1)) == 7 == freedoms(stick) and freedoms([[1, 0, 0], [0, .01, 0], [-1, 0, 0]]) == 6
check("2.r1", left(run("2.r1", 1)), [5, 9 - 3], "commands; rank of an own J; 5 by thought")
# the rigid motions of a stick, three shifts and two turns, are five
rigid = [np.tile(e, 3) for e in np.eye(3)] + [np.concatenate([np.cross(e, p) for p in stick]) for e in np.eye(3)]
assert np.linalg.matrix_rank(np.array(rigid)) == 5

J = np.array([[1.0], [2.0]])
A = J @ J.T
assert np.allclose(A, [[1, 2], [2, 4]])
fit = (J @ [-1.0])[1]
check("2.x1", fit, [-1, (J @ J.T)[1, 1] * -1], "b = J u*; lcplab judges both corners at every value of the slider; page")
for b1 in slider(-4, 4):
    on_line = [x for x in ([1, 0], [0, 0.5]) if lcplab.judge(A, [-1, b1], x)]
    assert (len(on_line) == 2) == (b1 == -2.0), b1
assert np.allclose(sweeps(A, [-1, -1], [0, 0], 1), [1, 0]) and np.allclose(A @ [1, 0] + [-1, -1], [0, 1])
for start in ([2, 1], [-1, 1], [0.2, 3]):
    x = sweeps(A, [-1, -2], start, 5)
    assert abs(x[0] + 2 * x[1] - 1) < 1e-12

# === 3 =============================================================================================================
m, l = 2, 1.2
I = m * l**2 / 12
M1 = np.diag([1 / m, 1 / I])
entry = lambda r: np.array([1, r]) @ M1 @ [1, 0.6]
place = -I / (m * 0.6)
assert abs(entry(place)) < 1e-12 and abs(I - 0.24) < 1e-12 and entry(0.6) == 2 and abs(entry(-0.6) + 1) < 1e-12 and abs(place + l / 6) < 1e-12
halves = (-0.6, 0.6)  # the root once more, by halving
for _ in range(60):
    c = sum(halves) / 2
    halves = (c, halves[1]) if entry(c) < 0 else (halves[0], c)
assert abs(halves[0] - place) < 1e-12
check("3.p1", -place, [0, l / 2 + place, l / 2], "zero of an entry of J M⁻¹ Jᵀ; by halving; l/6")

m, v, R = 800, 15, 40
lam = m * (G - v**2 / R)
check("3.p2", lam, [m * G, m * (G + v**2 / R), m * v**2 / R], "closed form; second difference of c; lcplab on A and b")
c = lambda t: hypot(v * t, R) - R
h = 1e-3
assert abs((c(h) - 2 * c(0) + c(-h)) / h**2 - v**2 / R) < 1e-4 and round(sqrt(G * R), 1) == 19.8
assert abs(lcplab.solve([[1 / m]], [-G + v**2 / R]).x[0] - lam) < 1e-6

run("3.r1", 0); out = column_x(run("3.r1", 1))
A, b = column([1000, 1, 1]), np.array([[1, 0, 0], [-1, 1, 0], [0, -1, 1]]) @ [0, -1, 0]
assert np.allclose(np.linalg.solve(A, -b), [1, 1, 0]) and np.allclose(out, [1, 1, 0], atol=1e-9)
light = np.linalg.solve(column([1, 1, 1]), -b)
assert np.allclose(light, [1, 1, 0])  # what the text says of 1 kg
check("3.r1", out[0], [0, 1000, 1 / 1000], "commands; own A and b, Gauss; momentum")

A = [[1, -1], [-1, 2]]
pushes = {b1: solutions(A, [-1, F(round(10 * b1), 10)]) for b1 in slider(0, 4)}
last = max(b1 for b1, [x] in pushes.items() if x[1] > 0)
heavy = max(b1 for b1 in slider(0, 4) if solutions([[1, -1], [-1, F(11, 10)]], [-1, F(round(10 * b1), 10)])[0][1] > 0)
assert heavy == last and pushes[1.0] == [[1, 0]] and pushes[0.9] == [[F(11, 10), F(1, 10)]]
for b1 in (0.0, 0.5, 0.9, 1.0, 1.1):
    assert (lcplab.solve(A, [-1, b1]).x[1] > 1e-9) == (b1 <= 0.9)
check("3.x1", last, [0, 1.0], "cases in fractions on the slider; by hand b1 < 1; lcplab; page; the same with 10 kg")

# === 4 =============================================================================================================
A, b = [[1, -1], [-1, 2]], [-1, 0]
warm = sweeps(A, b, [3, 2], 2)
x = [F(3), F(2)]
for _ in range(2): x[0] = x[1] + 1; x[1] = x[0] / 2
assert x == [F(5, 2), F(5, 4)] and np.allclose(warm, [2.5, 1.25]) and solutions(A, b) == [[2, 1]]
traces = lcplab.solve(A, b, solver=lambda A, b, lo, hi, **k: sweeps(A, b, [3, 2], 60))
assert traces and np.allclose(traces.x, [2, 1])
kept = np.array([3.0, 2.0])  # corrections clamped at 0: nothing moves
for _ in range(2):
    for i in (0, 1): kept[i] += max(0.0, -(np.array(A[i]) @ kept + b[i]) / A[i][i])
assert np.allclose(kept, [3, 2]) and np.allclose(sweeps(A, b, [3, 2], 1)[0], 3) and abs(2 - 0 - 1) == 1  # u of the upper ball
check("4.p1", warm[0], [3, sweeps(A, b, [0, 0], 2)[0], 2], "own sweeps; in fractions; clamped corrections stay at (3, 2)")
assert np.allclose(textbook.gauss_seidel(np.array(A, float), np.array(b, float), np.zeros(2), np.full(2, INF), 2), [1.5, 0.75])

need = lambda r: ceil(6 * log(10) / -log(r))
A = column([1.0] * 10)
xs = np.array([6, 5, 4, 3, 2, 1, 0, 1, 2, 1.0])
w = np.zeros(10); w[6] = 3.0
b = w - A @ xs
assert b[6] > 0 and lcplab.judge(A, b, xs) and lcplab.prove(lcplab.Problem(A, b)).kind == "unique"
free = [i for i in range(10) if i != 6]
R6, C3 = cos(pi / 12)**2, cos(pi / 4)**2
assert abs(rho(A[np.ix_(free, free)]) - R6) < 1e-9 and abs(rho(A[:6, :6]) - R6) < 1e-9 and abs(rho(A[7:, 7:]) - C3) < 1e-9
e0 = np.abs(sweeps(A, b, np.zeros(10), 100) - xs).max()
k = next(k for k in range(190, 215) if np.abs(sweeps(A, b, np.zeros(10), 100 + k) - xs).max() <= 1e-6 * e0)
assert abs(k - need(R6)) <= 1, k
check("5.p1", need(R6), [need(cos(pi / 20)**2), need(cos(pi / 14)**2), need(C3)], f"formulas; eigenvalues of the free rows; counted on such a problem: {k}")
assert round(6 * log(10) / -log(R6), 1) == 199.3

run("4.r1", 0); up, down = iterations(run("4.r1", 1)), iterations(run("4.r1", 2))
A, b = column([1.0] * 10), np.array([-1.0] + [0] * 9)
def until(order, tolerance):
    x, k = np.zeros(10), 0
    while scaled(A, b, x) > tolerance: x, k = sweeps(A, b, x, 1, order), k + 1
    return k
assert (until(1, 1e-8), until(-1, 1e-8)) == (up, down) == (558, 581)
assert until(-1, 1e-5) - until(1, 1e-5) == 23  # the same lead all along
first = sweeps(A, b, np.zeros(10), 1, -1)
assert first[0] == 1 and not first[1:].any()
reach = next(k for k in range(1, 20) if sweeps(A, b, np.zeros(10), k, -1).all())
check("4.r1", down, [up, 1, reach], "commands; own sweeps, counted with the scaled residual")

digit = lambda masses: ceil(log(10) / -log(rho(column(masses))))
keys = sorted({round(10**(k / 20), 3) for k in range(-20, 61)})
table = {(i, M): digit([M if j == i else 1.0 for j in range(5)]) for i in range(5) for M in keys}
best = min(table.values())
assert {i for (i, M), d in table.items() if d == best} == {0} and all(table[0, M] == best for M in keys if M >= 100)
assert digit([1.0] * 5) == 23 and abs(cos(pi / 8)**2 - 0.854) < 1e-3 and ceil(log(10) / -log(cos(pi / 8)**2)) == best and max(table.values()) > 9000
top, middle = min(d for (i, _), d in table.items() if i == 4), min(d for (i, _), d in table.items() if i in (1, 3))
check("5.x1", best, [top, middle, digit([1.0] * 5)], "eigenvalues for each box and mass; column of four; page")

# === 5 =============================================================================================================
A, b = [[2, -1], [-1, 2]], [1, -3]
[x] = solutions(A, b)
assert x == [F(1, 3), F(5, 3)] and np.allclose(textbook.dantzig(np.array(A, float), np.array(b, float), np.zeros(2), np.full(2, INF)), [1 / 3, 5 / 3])
moves = re.findall(r"Now x = \((.*)\)\.", lcplab.explain(A, b, solver="dantzig").text)
assert moves[0] == "0, 1" and len(moves) == 2
check("6.p1", float(x[1]), [3, 3 / 2, 1], "cases in fractions; lcplab's moves; textbook")

def lemke(A, b):
    """Own walk along Lemke's path in fractions: the values of z0 at each stop; True at the end if a solution was found."""
    n, A, b = len(b), [[F(v) for v in row] for row in A], [F(v) for v in b]
    # unknowns: w0.., x0.., z; equation rows: w − A x − e z = b
    rows = [[F(int(i == j)) for j in range(n)] + [-v for v in A[i]] + [F(-1), b[i]] for i in range(n)]
    basis, z, stops, enter = list(range(n)), 2 * n, [], 2 * n
    r = min(range(n), key=lambda i: b[i])
    while True:
        p = rows[r][enter]
        rows[r] = [v / p for v in rows[r]]
        for k in range(n):
            if k != r: rows[k] = [a - rows[k][enter] * c for a, c in zip(rows[k], rows[r])]
        leave, basis[r] = basis[r], enter
        stops.append(rows[basis.index(z)][-1] if z in basis else F(0))
        if z not in basis:
            x = [F(0)] * n
            for i, v in enumerate(basis):
                if n <= v < 2 * n: x[v - n] = rows[i][-1]
            return stops, x
        enter = leave + n if leave < n else leave - n
        ratios = [(rows[i][-1] / rows[i][enter], basis[i] != z, i) for i in range(n) if rows[i][enter] > 0]
        if not ratios: return stops, None
        r = min(ratios)[2]
stops, x = lemke([[2, -1], [-1, 2]], [-1, -4])
assert x == [2, 3] and stops == [4, 2, 0]
tableau = lcplab.explain([[2, -1], [-1, 2]], [-1, -4], solver="lemke").text
assert re.search(r"Tableau 3[\s\S]*?z\s+2 ", tableau)
check("7.p1", float(stops[1]), [float(stops[0]), 0, 1], "own tableau in fractions; lcplab's tableaux")
assert np.allclose(textbook.lemke(np.array([[2.0, -1], [-1, 2]]), np.array([-1.0, -4])), [2, 3])

run("7.r1", 0); one = iterations(run("7.r1", 1))
U, e = np.triu(np.full((10, 10), 2.0), 1) + np.eye(10), -np.ones(10)
def exchange(rule):
    free, count, tail, order = np.zeros(10, bool), 0, [], []
    while True:
        x = np.zeros(10); x[free] = np.linalg.solve(U[np.ix_(free, free)], -e[free]) if free.any() else 0
        wrong = np.where(free, x < -1e-9, U @ x + e < -1e-9)
        if not wrong.any(): return count, x, tail, order
        tail.append(max(np.flatnonzero(wrong)))
        flip = np.flatnonzero(wrong) if rule == "block" else np.flatnonzero(wrong)[:1]
        order.append(flip[0])
        free[flip] ^= True; count += 1
blocks = exchange("block")[0]
assert blocks == 10 and exchange("first")[0] == one == 1023
assert exchange("block")[2] == list(range(9, -1, -1))  # after each exchange one row more is right for good
assert exchange("first")[3][::2] == [0] * 512  # every second exchange is row 0
alternating = np.linalg.solve(U, np.ones(10))
assert np.allclose(alternating, [(-1)**(9 - i) for i in range(10)])
check("7.r1", blocks, [one, 1, 512], "commands; own exchanges, Murty's and by blocks")

ray = {}
for a in slider(-2, 4):
    A, b = [[1, -1], [2, F(round(10 * a), 10)]], [-1, F(-3, 2)]
    stops, x = lemke(A, b)
    ray[a] = x is None
    assert solutions(A, b)[:1] == [[1, 0]] or [1, 0] in solutions(A, b)
    assert len(solutions(A, b)) == 1 or a > 0, a
    assert x is None or x in solutions(A, b)
    if a in (2.0, 0.0, -0.9, -1.0, -1.1, -2.0):
        assert (lcplab.solve([[1, -1], [2, a]], [-1, -1.5], solver="lemke").status != "solved") == ray[a]
assert all(len(solutions([[1, -1], [2, F(round(10 * a), 10)]], [-1, F(-3, 2)])) == 1 for a in slider(-2, 2))
first = max(a for a in ray if ray[a])
assert all(ray[a] == (a <= first) for a in ray)
check("7.x1", first, [0, first + 0.1, -2], "own tableau in fractions at every value of the slider; rates by hand; lcplab; page")

# === 6 =============================================================================================================
at = np.array([[0, 0], [1, 0], [1, 1], [0, 1]], float)
E = np.vstack([np.ones(4), at.T]); need = 10 * np.array([1, 0.4, 0.3])
most, least = -linprog([-1, 0, 0, 0], A_eq=E, b_eq=need).fun, linprog([1, 0, 0, 0], A_eq=E, b_eq=need).fun
middle = -linprog([-1, 0, 0, 0], A_eq=E, b_eq=10 * np.array([1, 0.5, 0.5])).fun
check("9.p1", most, [10 / 4, 10 * 0.6 * 0.7, least, middle], "linear program; t by hand; lcplab's judge on a table of its own")
assert np.allclose(E @ [4.2, 2.8, 1.2, 1.8], need)  # that trap is a solution
arms = at - [0.4, 0.3]
J = np.array([[1, r[1], -r[0]] for r in arms])  # up, about x, about y
A = J @ np.diag([1 / 2.0, 1 / 0.3, 1 / 0.5]) @ J.T
b = J @ [-10 / 2.0, 0, 0]
for t, good in ((0, True), (1.5, True), (3, True), (3.01, False), (-0.01, False)):
    assert bool(lcplab.judge(A, b, [3 + t, 4 - t, t, 3 - t])) == good, t
assert np.allclose(A @ [1, -1, 1, -1], 0) and np.linalg.matrix_rank(A) == 3

A, b, x = np.array([[2.0, -1], [-1, 2]]), np.array([-1, 0.5]), np.array([0.6, 0.2])
w = A @ x + b
gap = x @ w
Jb = np.array([[-1.0, 1, 0], [0, -1, 1]])
assert np.allclose(Jb @ Jb.T, A) and np.allclose(w, [0, 0.3]) and solutions([[2, -1], [-1, 2]], [-1, F(1, 2)]) == [[F(1, 2), 0]]
error = np.abs(Jb.T @ (x - [0.5, 0]))
f = lambda x: 0.5 * x @ A @ x + b @ x
assert np.allclose(sorted(error), [0.1, 0.1, 0.2]) and 0.5 * error @ error <= f(x) - f(np.array([0.5, 0])) + 1e-15 <= gap and abs(error.max() - sqrt(gap / 1.5)) < 1e-15 and error @ error <= gap
assert abs(gap - (f(x) + 0.5 * x @ A @ x)) < 1e-15
check("8.p1", sqrt(gap), [gap, sqrt(2 * gap)], "gap as x·w and as P − D; momentum alone makes the true error smaller")

run("9.r1", 0); early, late = run("9.r1", 1), run("9.r1", 2)
p = lcplab.Problem.generate("wedged", n=4)
# lcplab gives the point from which the ray starts, one sweep before the last (iterate.rs, finish)
x = sweeps(p.A, p.b, np.zeros(4), 99); own = scaled(p.A, p.b, x)
far = sweeps(p.A, p.b, np.zeros(4), 9999); last = scaled(p.A, p.b, far)
natural = lambda x: np.abs(np.minimum(x, p.A @ x + p.b)).max()
assert abs(field(early, "scaled residual") - own) < 5e-6 and abs(field(late, "scaled residual") / last - 1) < 2e-3
assert natural(x) == 2 and abs(natural(far) - 2) < 1e-6 and field(late, "natural residual") == field(early, "natural residual") == 2
assert "no solution exists" in late and np.allclose(sweeps(p.A, p.b, far, 1) - far, 1)
check("9.r1", field(late, "scaled residual"), [0.00505, 2], "commands; own sweeps and own residuals", rel=2e-3)

A, b = [[1, 2], [2, 1]], [-2, -2]
ends = {(x0, x1): tuple(sweeps(A, b, [x0, x1], 30)) for x0 in (-4.0, 0.0, 0.7, 4.0) for x1 in slider(-4, 4)}
first = min(x1 for (x0, x1), end in ends.items() if end == (0, 2))
assert all(end == ((0, 2) if x1 >= first else (2, 0)) for (_, x1), end in ends.items())
assert sorted(solutions(A, b)) == [[0, 2], [F(2, 3), F(2, 3)], [2, 0]]
assert np.allclose(sorted(np.linalg.eigvalsh(np.array(A, float))), [-1, 3])  # a saddle
check("9.x1", first, [round(first - 0.1, 1), 2 / 3, 1.0], "own sweeps from every start on the grid; x1 ← 4 x1 − 2; lcplab's judge; page")
assert all(lcplab.judge(A, b, [float(v) for v in s]) for s in solutions(A, b)) and sweeps(A, b, [0, 1], 1)[1] == 2

x = det_solve([[1, -1, 0], [-1, 2, 0], [0, 0, 1]], [1, 0, 1])
assert lcplab.judge([[1, -1, 0], [-1, 2, 0], [0, 0, 1]], [-1, 0, -1], [float(v) for v in x])
check("6.p2", float(x[0]), [4, 3, 1], "Gauss in fractions; lcplab's judge; balls that fall, and the row alone")

A, b = np.array([[2.0, 1], [1, 2]]), np.array([-2.0, 1])
right = [x for x in ([1, 0], [5 / 3, -4 / 3], [2, 0], [0, 0]) if lcplab.judge(A, b, [float(v) for v in x])]
assert right == [[1, 0]]
w = A @ [2, 0] + b
check("8.p2", max(min(2, w[0]), min(0, w[1]), key=abs), [w[1], min(0, w[1])], "w by hand; lcplab's judge of all four")

assert set(done) == set(P), set(P) - set(done)

# === what the pages say, with the argument "pages" =================================================================
def page(id, more):
    name, state = re.search(r"\]\(\.\./live/(\w+)\.html(?:#([^)]*))?\)", P[id]["text"]).groups()
    url = f"file://{ROOT}/live/{name}.html#" + "&".join(filter(None, [state, more]))
    for _ in range(5):
        t = subprocess.run(["chromium", "--headless", "--no-sandbox", "--disable-gpu", "--virtual-time-budget=8000", "--dump-dom", url], capture_output=True, text=True, timeout=120).stdout
        if 'data-ready="yes"' in t: break
    return re.search(r'(?s)id="says"[^>]*>(.*?)</p', t)[1] + " " + re.search(r'(?s)<pre id="words">(.*?)</pre>', t)[1]
if "pages" in sys.argv[1:]:
    for id, more, says in [
        ("1.x1", "", "One solution: (7/6, 4/3)"), ("1.x1", "a01=2.9&a10=2.9", "One solution"), ("1.x1", "a01=3&a10=3", "Solutions: (1/2, 0), (0, 3/4)."), ("1.x1", "a01=3.1&a10=3.1", "(0.472371, 0.0178253)"),
        ("2.x1", "step=1", "w = (0, 1)"), ("2.x1", "b1=-1.9", "One solution"), ("2.x1", "b1=-2", "Infinitely many solutions"), ("2.x1", "b1=-2.1", "One solution"),
        ("3.x1", "b1=0.9", "One solution: (1.1, 0.1)"), ("3.x1", "b1=1", "One solution: (1, 0)"),
        ("5.x1", "", "23 sweeps a digit"), ("5.x1", "masses=100,1,1,1,1", "15 sweeps a digit"), ("5.x1", "masses=1000,1,1,1,1", "15 sweeps a digit"), ("5.x1", "masses=1,1,1,1,0.1", "16 sweeps a digit"), ("5.x1", "masses=1,1,1,0.5,1", "22 sweeps a digit"),
        ("7.x1", "", "One solution: (1, 0). solved"), ("7.x1", "a11=-0.9", "One solution: (1, 0). solved"), ("7.x1", "a11=-1", "One solution: (1, 0). a ray"), ("7.x1", "a11=-2", "One solution: (1, 0). a ray"),
        ("9.x1", "", "Solutions: (2, 0), (0, 2), (2/3, 2/3)"), ("9.x1", "x1=0.6&step=30", "x = (2, 0)"), ("9.x1", "x1=0.7&step=30", "x = (0, 2)"), ("9.x1", "x0=-3&x1=0.7&step=30", "x = (0, 2)"),
    ]:
        text = page(id, more)
        assert says in text, (id, more, says, text)
    print("the live pages say the same, at 23 addresses")
print(f"{len(done)} problems, {sum(len(p['traps']) for p in P.values())} traps: all as they stand in the files")

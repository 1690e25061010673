"""Finds every answer and every trap of the problem sets 10 to 17 anew, and asserts them.

Each number is found in two ways where that is possible: a closed form or a program of its own here, and lcplab.
Takes about a minute.
"""
import json, re, subprocess, sys, tempfile
from fractions import Fraction as F
from math import *
from pathlib import Path

import numpy as np
import lcplab

sys.path.insert(0, str(Path(__file__).parent))
from printed import problems

ROOT = Path(__file__).parent.parent.parent.parent
G = 9.81
P, INF = {}, np.inf
for k in range(10, 18):
    data = problems(k)
    assert all(re.fullmatch(rf"{k}\.[prx][12]", p["id"]) for p in data)
    for p in data:
        kinds = {"p": "pencil", "r": "predict", "x": "live"}
        assert set(p) - {"also"} == {"id", "kind", "title", "minutes", "level", "text", "unit", "answer", "within", "traps", "because"}
        assert p["kind"] == kinds[p["id"].split(".")[1][0]] and len(p["title"]) <= 60 and p["level"] in (1, 2, 3)
        assert 5 <= p["minutes"] <= 15 and 1 <= len(p["traps"]) <= 4 and all(set(t) == {"answer", "hint"} for t in p["traps"])
        assert "—" not in p["text"] + p["because"] and p["text"].count("$") % 2 == 0 and p["because"].count("$") % 2 == 0
        near = lambda a, b: abs(a - b) <= p["within"] * abs(b)
        assert not any(near(t["answer"], p["answer"]) or near(p["answer"], t["answer"]) for t in p["traps"]), p["id"]
        if p["kind"] == "live": assert "../live/" in p["text"]
        if p["kind"] == "predict": assert "`lcplab " in p["text"] or "| lcplab " in p["text"] or "cell `" in p["text"]
        P[p["id"]] = p
done = {}

def check(id, answer, traps, how, rel=5e-4):
    p = P[id]
    close = lambda a, b: abs(a - b) <= max(rel * abs(b), 1e-12)
    assert close(p["answer"], answer), (id, p["answer"], answer)
    assert len(traps) == len(p["traps"]), id
    for t, v in zip(p["traps"], traps): assert close(t["answer"], v), (id, t["answer"], v)
    done[id] = True
    print(f"{id:6} {p['answer']:<10} traps {[t['answer'] for t in p['traps']]}: {how}")

def run(id, which, folder=None):
    """The command of the text, by python -m lcplab."""
    commands = re.findall(r"`lcplab ([^`]*)`", P[id]["text"])
    words = __import__("shlex").split(commands[which])
    r = subprocess.run([sys.executable, "-m", "lcplab", *words], capture_output=True, text=True, timeout=300, cwd=folder)
    assert r.returncode in (0, 1), r.stderr
    return r.stdout

def of_line(text, name):
    line = next(l for l in text.splitlines() if l.strip().startswith(name))
    return [float(w) for w in re.findall(r"-?\d+\.\d+(?:e-?\d+)?|-?\d+", line.strip()[len(name):])]

def scene(text, **given):
    with tempfile.NamedTemporaryFile("w", suffix=".toml", delete=False) as f: f.write(text)
    return lcplab.Scene.load(f.name, **given)

# --- the live stack page (live/src/column.rs, page/stack.js), written anew -------------------------------------------
def column(m, dt, u, gaps):
    n, v = len(m), np.array(u) - G * dt
    A = np.diag([1 / m[i] + (1 / m[i - 1] if i else 0) for i in range(n)])
    for i in range(1, n): A[i, i - 1] = A[i - 1, i] = -1 / m[i - 1]
    return A, np.array([v[i] - (v[i - 1] if i else 0) + max(gaps[i], 0) / dt for i in range(n)])

def sweep(A, b, x):
    for i in range(len(b)): x[i] = max(0.0, x[i] - (A[i] @ x + b[i]) / A[i, i])

def motion(m, dt, steps, sweeps, warm):
    n = len(m); u, z, x, Z = np.zeros(n), np.zeros(n), np.zeros(n), []
    for _ in range(steps):
        A, b = column(m, dt, u, [z[i] - (z[i - 1] if i else 0) for i in range(n)])
        if not warm: x = np.zeros(n)
        for _ in range(sweeps): sweep(A, b, x)
        u = u + [-G * dt + (x[i] - (x[i + 1] if i + 1 < n else 0)) / m[i] for i in range(n)]
        z = z + dt * u; Z.append(z)
    return np.array(Z)

def balls(masses, dt, sweeps, warm):
    text = f"[step]\ndt={dt}\ncount=10\n[contact]\nfriction=0\npersistence='{'features' if warm else 'none'}'\n[solver]\nname='pgs'\nmax_iterations={sweeps}\n"
    text += "[[bodies]]\nname='ground'\nfixed=true\nshape={plane=[0,0,1]}\n"
    for k, m in enumerate(masses): text += f"[[bodies]]\nname='b{k}'\nshape={{sphere=0.5}}\nmass={m}\nposition=[0,0,{k + 0.5}]\n"
    return scene(text)

# === 7 ===============================================================================================================
beta, s, dt = 0.5, 0.005, 0.02
limit = s + G * dt**2 / beta**2
check("10.p1", 1e3 * limit, [1e3 * (limit - s), limit, 1e3 * (s + G * dt**2 / beta)], "closed form; lcplab just below and above the limit")
for d, creeps in ((limit - 2e-4, True), (limit + 2e-4, False)):
    b = lcplab.Scene.load("bouncing_ball", set={"dt": dt, "contact.restitution": 0, "step.baumgarte": beta, "contact.slop": s, "bodies.ball.position": [0, 0, 0.1 - d], "bodies.ball.velocity": [0, 0, 0]})
    i = b.bodies.index("ball"); b.step(); v1 = b.velocities[i, 2]; b.step(); v2 = b.velocities[i, 2]
    assert abs(v1 - beta * (d - s) / dt) < 1e-9
    assert abs(v2 - ((1 - beta) * v1 if creeps else v1 - G * dt)) < 1e-9

v, k = 4.0, 0
while v > 4 / sqrt(2) * (1 + 1e-12): v, k = v * cos(atan(v * 0.05)), k + 1
check("10.p2", k, [round(log(2) / log(1 + 0.2**2)), round(0.5 / (1 - 1 / (1 + 0.2**2)))], "loop of projections; 1/v² by hand; lcplab split impulse")
assert abs(1 / v**2 - (1 / 16 + 25 * 0.05**2)) < 1e-12
b = lcplab.Scene.load("pendulum", scheme="split-impulse", set={"dt": 0.05, "gravity": [0, 0, 0], "bodies.bob.velocity": [0, 0, 4]})
for _ in range(26): b.step()  # the first step finds a velocity that is tangent: 25 projections
assert abs(np.sum(b.energy) - 4.0) < 1e-9 and b.drift < 1e-12

one, two = (of_line(run("10.r1", k), "ball")[-1] for k in (0, 1))
assert one == 2.0 and two == 8.0 and abs(0.2 * 0.1 / 0.0025 - 8) < 1e-12
check("10.r1", two, [one / 4, one], "command; β d/dt")

sunk = lambda k: -100 * motion([1] * 5, 0.01, 200, k, False)[-1][-1]
first = lambda depth: next(k for k in range(1, 61) if sunk(k) < depth)
check("10.x1", first(1.0), [first(1.0) - 1, first(0.1)], f"own column: {sunk(30):.2f} cm with 30, {sunk(31):.2f} with 31; lcplab's balls")
assert abs(sunk(10) - 12) < 0.02 and abs(sunk(30) - 1.08) < 5e-3 and abs(sunk(31) - 0.97) < 5e-3
A, _ = column([1] * 5, 0.01, [0] * 5, [0] * 5)
rho = max(abs(np.linalg.eigvals(-np.linalg.solve(np.tril(A), np.triu(A, 1)))))
assert abs(rho - cos(pi / 10)**2) < 1e-9 and round(log(10) / -log(rho)) == 23
b = balls([1] * 5, 0.01, 31, False)
for _ in range(200): b.step()
assert abs(100 * (4.5 - b.poses[b.bodies.index("b4"), 2]) - sunk(31)) < 1e-6

# === 8 ===============================================================================================================
def nearest(corners, w):
    """Nearest point of a convex polygon to w outside it, edge by edge."""
    best = None
    for p, q in zip(corners, np.roll(corners, -1, axis=0)):
        t = np.clip((w - p) @ (q - p) / ((q - p) @ (q - p)), 0, 1); y = p + t * (q - p)
        if best is None or np.linalg.norm(w - y) < np.linalg.norm(w - best): best = y
    return best
corners = lambda k: np.array([[cos(2 * pi * j / k), sin(2 * pi * j / k)] for j in range(k)])
at = lambda size, deg: size * np.array([cos(radians(deg)), sin(radians(deg))])
def model(name, w, press=2.0, mu=0.5):
    r = lcplab.solve(np.eye(3), [-press, -w[0], -w[1]], [0, -INF, -INF], [INF] * 3, friction_index=[-1, 0, 0], mu=[0, mu, mu], model=name, tolerance=1e-12)
    return r.x[1:3], r
y = nearest(corners(8), at(2, 30))
half = sin(radians(22.5))
check("11.p1", hypot(cos(radians(22.5)), 2 * sin(radians(7.5))), [1, cos(radians(22.5)), cos(radians(22.5)) / cos(radians(7.5))], "closed form; nearest point of the polygon; lcplab polygon-8")
assert abs(np.linalg.norm(y) - 0.96) < 1e-3 and np.abs(model("polygon-8", at(2, 30))[0] - y).max() < 1e-8
assert 2 * sin(radians(7.5)) < half < 3 * sin(radians(7.5)) and np.allclose(model("polygon-8", at(3, 30))[0], at(1, 45))

check("11.p2", tan(asin(0.6)), [0, 0.6], "closed form; integrated here; lcplab with a belt and a rail")
v = 0.0
for _ in range(200000): v += 1e-4 * (0.6 - v / hypot(1, v))  # in units of μ g
assert abs(v - 0.75) < 1e-4
b = scene("""[step]
dt=0.005
count=10
[contact]
model='coulomb-cone'
friction=0.5
[[bodies]]
name='belt'
fixed=true
shape={plane=[0,0,1]}
velocity=[-1,0,0]
[[bodies]]
name='rail'
fixed=true
friction=0
shape={plane=[1,0,0]}
position=[-0.1,0,0]
[[bodies]]
name='block'
shape={box=[0.2,0.2,0.1]}
mass=2
position=[0,0,0.05]
force=[0,5.886,0]""")
for _ in range(800): b.step()
assert abs(b.velocities[b.bodies.index("block"), 1] - 0.75) < 1e-3

out = of_line([l for l in run("11.r1", 0).splitlines() if l.strip().startswith("block ")][-1], "block")
v, mu, th = np.array([0.0, 2.0]), 0.36397, radians(20)
for _ in range(300):
    v = v + [0.01 * G * sin(th), 0]
    v = v * max(0, 1 - mu * G * cos(th) * 0.01 / np.linalg.norm(v))
fine = np.array([0.0, 2.0])
for _ in range(30000):
    fine = fine + [1e-4 * G * sin(th), 0]
    fine = fine * max(0, 1 - tan(th) * G * cos(th) * 1e-4 / np.linalg.norm(fine))
assert abs(out[3] - v[0]) < 1e-4 and abs(fine[0] - 1) < 1e-3 and abs(fine[1]) < 1e-3
box = lcplab.Scene.load("sliding", set={"angle": 20, "mu": 0.36397, "contact.model": "coupled-box", "bodies.block.velocity": [0, 2, 0]})
for _ in range(300): box.step()
assert np.abs(box.velocities[box.bodies.index("block"), :3]).max() < 1e-3
check("11.r1", out[3], [0, 2], "command; own steps of a point; first integral |v| + v_x = 2; coupled box stops")

grid = [round(4 - 0.05 * k, 2) for k in range(80)]
second = next(p for p in grid if nearest(corners(4), at(p, 30))[1] > 1e-9)
sticks = lambda name: next(p for p in grid if np.abs(model(name, at(p, 30))[0] - at(p, 30)).max() < 1e-7)
for p in (2.75, 2.7, 2.0):
    assert np.abs(model("polygon-4", at(p, 30))[0] - nearest(corners(4), at(p, 30))).max() < 1e-8
assert abs(1 / (cos(pi / 6) - sin(pi / 6)) - 2.732) < 1e-3
check("11.x1", second, [sticks("polygon-4"), sticks("coupled-box")], "nearest point of the diamond on the slider's grid; lcplab polygon-4")

# === 9 ===============================================================================================================
after = lambda r, e=1: (r * 1 - 1 - e * 1 * 2) / (r + 1)  # lower ball, m_high = 1, v = 1
root = next(F(n, 10) for n in range(1, 100) if (F(n, 10) - 1 - 2) == 0)
assert after(3) == 0 and after(1) == -1
check("12.p1", float(root), [1, 1 / float(root), 2], "momentum and restitution in fractions; lcplab with a gap; touching: both go up at v")
for gap, low, high in ((0.01, 0.0, 2.0), (0.0, 1.0, 1.0)):
    b = scene(f"gravity=[0,0,0]\n[step]\ndt=0.001\ncount=5\n[contact]\nrestitution=1\nfriction=0\n[[bodies]]\nname='ground'\nfixed=true\nshape={{plane=[0,0,1]}}\n[[bodies]]\nname='low'\nshape={{sphere=0.1}}\nmass=3\nposition=[0,0,0.1]\nvelocity=[0,0,-1]\n[[bodies]]\nname='high'\nshape={{sphere=0.1}}\nmass=1\nposition=[0,0,{0.3 + gap}]\nvelocity=[0,0,-1]\n")
    for _ in range(20): b.step()
    w = [b.velocities[b.bodies.index(n), 2] for n in ("low", "high")]
    assert np.allclose(w, [low, high], atol=1e-9), (gap, w)

xn, need = 1.5 * 3, 2 / (1 + 5 / 2)
assert abs(need - 2 * 2 / 7) < 1e-12 and need > 0.1 * xn
check("12.p2", 2 - 0.1 * xn, [2, 2 - 0.1 * 3, 2 - need], "impulse by hand; lcplab with a sphere")
b = scene("gravity=[0,0,0]\n[step]\ndt=0.001\ncount=1\n[contact]\nrestitution=0.5\nfriction=0.1\n[[bodies]]\nname='ground'\nfixed=true\nshape={plane=[0,0,1]}\n[[bodies]]\nname='ball'\nshape={sphere=0.1}\nmass=0.5\nposition=[0,0,0.1]\nvelocity=[2,0,-3]\n")
b.step(); i = b.bodies.index("ball")
assert np.allclose(b.velocities[i, [0, 2]], [1.55, 1.5], atol=1e-9)

A = [[F(2), F(-1)], [F(-1), F(2)]]
x = [(2 * 0 + 1 * 2) * F(1, 3), (1 * 0 + 2 * 2) * F(1, 3)]  # A⁻¹ (0, 2)
assert [sum(a * y for a, y in zip(row, x)) for row in A] == [0, 2] and min(x) > 0
speeds = [1 - x[0], 1 + x[0] - x[1], x[1]]
assert sum(speeds) == 2 and sum(v * v for v in speeds) / 2 == 1
out = of_line(run("12.r1", 0), "ball 3")
assert abs(out[3] - float(speeds[2])) < 1e-5
check("12.r1", float(speeds[2]), [1, 2 / 3], "LCP in fractions; command")

a = lambda mu, th: 1 + 3 * cos(th)**2 - 3 * mu * sin(th) * cos(th)
none = [t for t in range(5, 86) if a(1.5, radians(t)) < 0]
assert none == list(range(51, 74))
r = np.roots([1, -4.5, 4])
assert np.allclose(np.degrees(np.arctan(sorted(r))), [50.64, 73.05], atol=0.01) and np.allclose(sorted(r), [1.219, 3.281], atol=1e-3)
assert all(1.2**2 * sin(radians(t)) > 1 for t in none)
for t in (50, 51, 73, 74):  # the sign of a from the library's matrix of the rod
    q = lcplab.Problem.generate("painleve", tan=tan(radians(t)), mu=1.5)
    assert (q.A[0, 0] < 0) == (t in none)
check("13.x1", none[-1] - none[0], [len(none), 63 - none[0]], "own row a(θ) on the slider's grid; quadratic in tan θ; lcplab's matrix")

# === 10 ==============================================================================================================
touch = [{k - 1, k} - {-1} for k in range(100)]  # links of joint k; the ceiling does not count
pairs = sum(bool(p & q) for p in touch for q in touch)
check("14.p1", 9 * pairs, [pairs, 300 + 2 * 299, 9 * 300], "counted pair by pair")

def fill(n, order):
    near, new = {i: {(i - 1) % n, (i + 1) % n} for i in range(n)}, 0
    for i in order:
        nb = near.pop(i)
        for p in nb:
            near[p].discard(i)
            for q in nb:
                if p < q and q not in near[p]: near[p].add(q); near[q].add(p); new += 1
    return new
rng = np.random.default_rng(1)
assert {fill(50, rng.permutation(50)) for _ in range(20)} == {47}
check("14.p2", fill(50, range(50)), [0, 48, 49, 94], "elimination on the graph, in 21 orders; Cholesky of a numeric ring")
M = 3 * np.eye(50); 
for i in range(50): M[i, (i + 1) % 50] = M[(i + 1) % 50, i] = -1
L = np.linalg.cholesky(M)
assert (np.abs(L) > 1e-30).sum() - (np.abs(np.tril(M)) > 0).sum() == 47

with tempfile.TemporaryDirectory() as folder:
    for k in (0, 2): run("14.r1", k, folder)
    heads = [run("14.r1", k, folder).splitlines()[0] for k in (1, 3)]
assert "60 rows, 3,600 stored" in heads[0] and "600 rows, 21,312 stored" in heads[1], heads
blocks = lambda n: sum(abs(i - j) <= 1 for i in range(n) for j in range(n))
assert blocks(5) * 144 == 1872 and round(100 * 1872 / 3600) == 52 and round(100 * 21312 / 360000) == 6
check("14.r1", 144 * blocks(50), [600**2, 10 * 3600, 10 * 1872], "blocks counted; commands")

def ground(m, sweeps):
    A, b = column(m, 0.01, [0] * 4, [0] * 4); x, seen = np.zeros(4), []
    for _ in range(sweeps): sweep(A, b, x); seen.append(x[0])
    return np.array(seen)
three = lambda v: [float(f"{w:.3g}") for w in v]
p, q = ground([1, 1, 1, 1], 8), ground([1, 1, 1, 1000], 8)
shown = next(k + 1 for k, (u, v) in enumerate(zip(three(p), three(q))) if u != v)
exactly = next(k + 1 for k, (u, v) in enumerate(zip(p, q)) if abs(u - v) > 1e-12)
def jacobi(m, sweeps):
    A, b = column(m, 0.01, [0] * 4, [0] * 4); x, seen = np.zeros(4), []
    for _ in range(sweeps): x = np.maximum(0, x - 0.5 * (A @ x + b) / np.diag(A)); seen.append(x[0])
    return np.array(seen)
jac = next(k + 1 for k, (u, v) in enumerate(zip(jacobi([1] * 4, 12), jacobi([1, 1, 1, 1000], 12))) if abs(u - v) > 1e-12)
assert shown == exactly
check("14.x1", exactly, [1, jac], f"own sweeps, as the page shows them: {three(p)[:4]} and {three(q)[:4]}; lcplab's pgs")
for m, want in (([1] * 4, p), ([1, 1, 1, 1000], q)):
    A, b = column(m, 0.01, [0] * 4, [0] * 4)
    for k in range(1, 6): assert abs(lcplab.solve(A, b, solver="pgs", tolerance=0, max_iterations=k).x[0] - want[k - 1]) < 1e-12

# === 11 ==============================================================================================================
f = 1 / 8
Z = motion([1, 1], 0.01, 6000, 3, False)
assert abs((Z[-2] - Z[-1])[1] / 0.01 - f * G * 0.01 / (1 - f)) < 1e-9 and abs(-Z[-1][1] - 0.84) < 2e-3
b = balls([1, 1], 0.01, 3, False)
for _ in range(100): b.step()
assert abs(-b.velocities[b.bodies.index("b1"), 2] - G * 0.01 / 7) < 1e-6
check("15.p1", 1e3 * G * 0.01 / 7, [G * 0.01 / 7, 1e3 * f * G * 0.01, 1e3 * G * 0.01], "closed form; own column; lcplab's balls")

rho, u, depth = 10 / 11, [0.0, -10 / 11 * G * 0.01], 0.0
for _ in range(4000): u.append(rho * (2 * u[-1] - u[-2]))
Z = motion([1, 10], 0.01, 4000, 1, True)
assert np.abs(np.diff(Z[:, 1]) / 0.01 - u[2:4001]).max() < 1e-9  # the recursion of the text is what sweeps do
assert abs(-0.01 * sum(u) - 10 * G * 1e-4) < 1e-12 and abs(-Z[-1][1] - 10 * G * 1e-4) < 1e-9
b = balls([1, 10], 0.01, 1, True)
for _ in range(2000): b.step()
assert abs(1.5 - b.poses[b.bodies.index("b1"), 2] - 10 * G * 1e-4) < 1e-6
check("15.p2", 1e3 * 10 * G * 1e-4, [10 * G * 1e-4, 1e3 * rho * G * 1e-4, 1e3 * G * 1e-4], "sum of the recursion; own column (recursion too); lcplab's balls", rel=1e-3)

deep = lambda Z: -np.diff(np.c_[np.zeros(len(Z)), Z], axis=1).min()
one, ten = (1e3 * deep(motion([1, 1, 100], d, n, k, True)) for d, n, k in ((0.001, 1000, 1), (0.01, 100, 10)))
seen = [1e3 * of_line(run("15.r1", k), "penetration")[0] for k in (0, 1)]
assert abs(seen[0] - 16.5) < 0.05 and abs(seen[0] - ten) < 0.05 and abs(seen[1] - one) < 0.006
assert abs(1e3 * deep(motion([1, 1, 100], 0.01, 1000, 1, True)) - 187.8) < 0.1  # 100 times, and 11 times
check("15.r1", seen[1], [seen[0], 1e-3 * seen[1]], f"command; own column {one:.3f} mm, first way {ten:.2f}")

sunk = [-100 * motion([1, 1, 1, 1, 100], 0.01, 200, k, True)[-1][-1] for k in range(1, 61)]
assert [round(v, 1) for v in sunk[3:9]] == [7.9, 10.2, 5.6, 5.2, 5.6, 4.4] and all(v < 5 for v in sunk[8:])
assert -motion([1, 1, 1, 1, 100], 0.01, 200, 60, False)[-1][-1] > 1
for k in (8, 9):
    b = balls([1, 1, 1, 1, 100], 0.01, k, True)
    for _ in range(200): b.step()
    assert abs(100 * (4.5 - b.poses[b.bodies.index("b4"), 2]) - sunk[k - 1]) < 1e-6
check("15.x1", 1 + max(k for k in range(1, 61) if sunk[k - 1] >= 5), [7, 8], f"own column; lcplab's balls; {[round(v, 2) for v in sunk[3:10]]} cm with 4 to 10")

# === 12 ==============================================================================================================
lam = (G + 9) / 2
x2 = -1 * (9 + G) / 2  # Lagrange: (1 + x²) ẍ + x ẋ² + g x = 0
z2 = 9 + 1 * x2
assert abs(hypot(x2, z2 + G) - sqrt(2) * lam) < 1e-12
r = lcplab.solve([[2.0]], [-G - 9], [-INF], [INF])
assert abs(r.x[0] - lam) < 1e-9
check("17.p1", sqrt(2) * lam, [lam, 2 * lam, sqrt(2) * G / 2, sqrt(2) * (G - 9) / 2], "J and J'u; Lagrange's equation of the wire", rel=1e-3)

def cross(r): return np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])
def hinges(bodies, joints):
    """J of hinges: (body or None, body, point, axis); three rows for the point, two for the axis."""
    rows = []
    for p, q, point, axis in joints:
        axis = np.array(axis, float); axis /= np.linalg.norm(axis)
        e = np.linalg.svd(axis[None])[2][1:]  # two directions across
        block = np.zeros((5, 6 * len(bodies)))
        for body, sign in ((p, -1), (q, 1)):
            if body is None: continue
            c = 6 * body
            block[:3, c:c + 3] = sign * np.eye(3)
            block[:3, c + 3:c + 6] = -sign * cross(np.array(point, float) - bodies[body])
            block[3:, c + 3:c + 6] = sign * e
        rows.append(block)
    return np.vstack(rows)
rank = lambda J: int((np.linalg.svd(J, compute_uv=False) > 1e-9).sum())
pins = np.array([[0, 0, 0], [0.3, 0, 0.9], [2.1, 0, 1.7], [2.0, 0, 0.1]])
J = hinges([(pins[k] + pins[k + 1]) / 2 for k in range(3)], [(None, 0, pins[0], [0, 1, 0]), (0, 1, pins[1], [0, 1, 0]), (1, 2, pins[2], [0, 1, 0]), (2, None, pins[3], [0, 1, 0])])
assert J.shape == (20, 18)
check("17.p2", rank(J), [20, 18, 19], "rank of J by singular values, built here")

rods = np.array([[0.5, 0, 0], [1, 0.5, 0], [1, 1, 0.5], [0.5, 1, 1], [0, 0.5, 1]])
places = [[0, 0, 0], [1, 0, 0], [1, 1, 0], [1, 1, 1], [0, 1, 1], [0, 0, 1]]
axes = [[0, 1, 0], [0, 0, 1], [1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 0, 0]]
def bricard(tilted):
    ax = [list(a) for a in axes]
    if tilted: ax[1] = [0, 0.001, 1]
    return hinges(rods, [(k - 1 if k else None, k if k < 5 else None, places[k], ax[k]) for k in range(6)])
assert rank(bricard(False)) == 29 and rank(bricard(True)) == 30
seen = [int(of_line(run("17.r1", k), "rank of A, up to rounding")[-1]) for k in (0, 1)]
check("17.r1", seen[1], [seen[0]], f"command; rank built here, smallest singular value {np.linalg.svd(bricard(True), compute_uv=False)[-1]:.1e}")
assert seen == [29, 30]

def left(a, sweeps):
    """Scaled residual after the sweeps on [1 1; 1 a], b = (-1, -1.1), both rows equations."""
    A, b, x = np.array([[1, 1], [1, a]]), np.array([-1, -1.1]), np.zeros(2)
    for _ in range(sweeps):
        for i in range(2): x[i] -= (A[i] @ x + b[i]) / A[i, i]
    return max(abs(A @ x + b) / (abs(A) @ abs(x) + abs(b))), x
slider = [round(1 + 0.1 * k, 1) for k in range(31)]
enough = next(a for a in slider if any(left(a, k)[0] <= 1e-8 for k in range(31)))
for a in slider[1:]:
    r = lcplab.solve([[1, 1], [1, a]], [-1, -1.1], [-INF] * 2, [INF] * 2, solver="pgs", tolerance=1e-8, max_iterations=30)
    assert (r.status == "solved") == (a >= enough), a
assert np.allclose(left(1.0, 30)[1], [-1.9, 3.0]) or abs(left(1.0, 30)[1][1] - left(1.0, 29)[1][1] - 0.1) < 1e-9
assert abs(1.6**-30 - 7e-7) < 1e-7 and abs(1.7**-30 - 1e-7) < 5e-8
check("17.x1", enough, [1.1, round(enough - 0.1, 1)], f"own sweeps, residual {left(1.6, 30)[0]:.1e} at 1.6 and {left(1.7, 30)[0]:.1e} at 1.7; lcplab's pgs")

a = 1 + 3 / 2 - 3 * 2 / 2
number = lambda b: len([x for x in (0.0, -b / a) if x >= 0 and min(x, a * x + b) > -1e-12 and abs(x * (a * x + b)) < 1e-12])
spin = 2 ** 0.25
assert a == -0.5 and number((0.999 * spin) ** 2 * sin(pi / 4) - 1) == 0 and number((1.001 * spin) ** 2 * sin(pi / 4) - 1) == 2
check("13.p1", spin, [sqrt(1 / 2), sqrt(2), 1], "the number of solutions of its one row, counted a little below and above")

omega = 2 * pi * 60
def sag(seconds=2.0, dt=1e-5):
    """How deep two balls on critically damped springs come to rest, by small steps (m)."""
    m, k, z, u = np.array([1.0, 10.0]), omega**2 / np.array([1, 1 + 1 / 10]), np.zeros(2), np.zeros(2)
    for _ in range(round(seconds / dt)):
        gap, rate = np.array([z[0], z[1] - z[0]]), np.array([u[0], u[1] - u[0]])
        force = -k * gap - 2 * k / omega * rate
        u = u + dt * (np.array([force[0] - force[1], force[1]]) / m - G)
        z = z + dt * u
    return -z[0]
deep = 11 * G / omega**2
assert abs(sag() - deep) < 1e-6 * deep
check("16.p1", 1000 * deep, [1000 * G / omega**2, 1000 * 10 * G / omega**2, deep, 1000 * 11 * G / 60**2], "closed form; a simulation of its own")

check("16.p2", 10 * sqrt(16), [10 * 16, sqrt(16), 10, 10 * 2], "the sag goes with 1/omega squared, omega with 1/dt")

cells = re.findall(r"(?s)```python[^\n]*\n(.*?)```", (ROOT / "notebooks" / "16_soft_rows.md").read_text(encoding="utf-8"))
source = "".join(text.split("\nfor ")[0] for text in cells if "def soft_column" in text)
sys.path.insert(0, str(ROOT / "notebooks"))
from engine import softness
cold = source.replace("        u += (x - np", "        x = np.zeros(n)\n        u += (x - np", 1)
rise = {}
for name, text in (("warm", source), ("cold", cold)):
    place = {"np": np, "softness": softness}
    exec(text, place)
    rise[name] = place["soft_column"]([1, 1, 1, 1, 100], 0.001, 1, 120)
assert cold != source
check("16.r1", rise["cold"], [1e3 * rise["cold"], rise["warm"], -rise["cold"]], "the cell, with and without its line", rel=5e-3)

# === the pages that are linked, and their sliders ====================================================================
page = ROOT / "src" / "live" / "page"
for p in P.values():
    for name, state in re.findall(r"\.\./live/(\w+)\.html#([^)]*)\)", p["text"]):
        usual = re.search(r"const USUAL = \{(.*?)\};", (page / f"{name}.js").read_text(), re.S)[1]
        for pair in state.split("&"): assert re.search(rf"\b{pair.split('=')[0]}:", usual), (p["id"], pair)
assert set(done) == set(P), set(P) - set(done)
print(f"all {len(done)} right")

"""Ranges of forces against linear programs by SciPy, with rows, friction and slip of all kinds."""

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.optimize import linprog

import lcplab

DT = 0.01


def crate(rng: np.random.Generator, push: float) -> dict[str, Any]:
    """A crate of 10 kg on random points of its bottom, pushed sideways, with coupled friction, as a problem file."""
    points = rng.integers(3, 7)
    mu = float(rng.uniform(0.2, 0.8))
    mass = np.array([10.0, 10.0, 10.0, 2.0, 2.0, 2.0])
    target = np.array([push, 0.3 * push, -9.81 * DT, 0.0, 0.0, 0.0])
    rows, index, coefficient, named = [], [], [], []
    for k in range(points):
        r = np.array([*rng.uniform(-1.0, 1.0, 2), -0.5])
        for direction in ([0.0, 0.0, 1.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]):
            rows.append([*direction, *np.cross(r, direction)])
        index += [-1, 3 * k, 3 * k]
        coefficient += [0.0, mu, mu]
        named += [{"label": f"{kind} {k}", "kind": kind, "bodies": ["ground", "crate"]} for kind in ("normal", "friction", "friction")]
    j = np.array(rows)
    n = len(j)
    jacobian = [[i, c, j[i, c]] for i in range(n) for c in range(6) if j[i, c] != 0.0]
    return {
        "A": {"dense": (j / mass @ j.T).tolist()},
        "b": (j @ target).tolist(),
        "lo": [0.0 if k < 0 else "-inf" for k in index],
        "hi": ["inf"] * n,
        "friction_index": index,
        "mu": coefficient,
        "dt": DT,
        "rows": named,
        "bodies": [{"name": "crate", "first": 0, "count": 6}],
        "gravity": [0.0, 0.0, -9.81 * DT, 0.0, 0.0, 0.0][:3],
        "motion": {
            "mass": [[c, c, m] for c, m in enumerate(mass)],
            "jacobian": jacobian,
            "bias": [0.0] * n,
            "compliance": [0.0] * n,
            "target": target.tolist(),
            "level": "velocity",
        },
    }


def expected(problem: dict[str, Any], x: np.ndarray, row: int) -> tuple[float, float]:
    """The least and largest force of a row among all with the motion of x, by HiGHS."""
    a, b = np.array(problem["A"]["dense"]), np.array(problem["b"])
    w = a @ x + b
    n = len(b)
    j = np.zeros((n, 6))
    for i, c, v in problem["motion"]["jacobian"]:
        j[i, c] = v
    equal, right = list(j.T), list(j.T @ x)
    below = []
    bounds: list[tuple[float | None, float | None]] = []
    unit = np.eye(n)
    for i, k in enumerate(problem["friction_index"]):
        mu = problem["mu"][i]
        slips = abs(w[i]) > 1e-7
        if k < 0:
            bounds.append((0.0, 0.0 if slips else None))
            continue
        bounds.append((None, None))
        if slips:
            equal.append(unit[i] + np.sign(w[i]) * mu * unit[k])
            right.append(0.0)
        else:
            below += [unit[i] - mu * unit[k], -unit[i] - mu * unit[k]]
    values = []
    for sign in (1.0, -1.0):
        found = linprog(sign * unit[row], A_ub=np.array(below) if below else None, b_ub=np.zeros(len(below)) if below else None,
                        A_eq=np.array(equal), b_eq=np.array(right), bounds=bounds)
        assert found.status == 0, found.message
        values.append(sign * found.fun)
    return values[0], values[1]


@pytest.mark.parametrize("push", [0.0, 0.01, 0.5])
def test_ranges_with_friction_are_those_of_linear_programs(push: float, tmp_path: Path, capfd: pytest.CaptureFixture[str]) -> None:
    rng = np.random.default_rng(int(1000 * push))
    examined = free = 0
    for case in range(40):
        problem = crate(rng, push)
        file = tmp_path / f"{case}.json"
        file.write_text(json.dumps(problem))
        lcplab._lcplab.run(["lcplab", "solve", str(file), "--loads", "--json"])
        answer = json.loads(capfd.readouterr().out)
        loads = answer["loads"]
        if answer["verdict"] not in ("proved", "within_tolerance") or loads["unexamined"]:
            continue
        examined += 1
        x = np.array(answer["x"])
        for k, contact in enumerate(loads["pairs"][0]["contacts"]):
            least, most = (value / DT for value in expected(problem, x, 3 * k))
            found = contact["range"]
            assert found["least"] == pytest.approx(least, abs=2e-3), (case, k)
            assert found["most"] == pytest.approx(most, abs=2e-3), (case, k)
            assert found["is_unique"] == (most - least < 1e-4), (case, k, least, most)
            free += not found["is_unique"]
    # Enough of both kinds was seen.
    assert examined >= 20 and free >= 20, (examined, free)

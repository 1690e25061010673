"""The list of good releases and settings, and the independent solve that says which of their steps are good."""

import importlib.util
import sys
import tomllib
from pathlib import Path

import numpy as np
import pytest

HERE = Path(__file__).parents[1] / "good_runs"


def module(name, monkeypatch):
    """A module of the folder, which imports its neighbors by their names."""
    monkeypatch.syspath_prepend(str(HERE))
    spec = importlib.util.spec_from_file_location(name, HERE / f"{name}.py")
    made = importlib.util.module_from_spec(spec)
    monkeypatch.setitem(sys.modules, name, made)
    spec.loader.exec_module(made)
    return made


def test_at_least_thirty_different_settings_are_listed_with_scenes_that_exist(monkeypatch):
    scenes = module("scenes", monkeypatch)
    listed = tomllib.loads((HERE / "settings.toml").read_text(encoding="utf-8"))
    names = {(*setting["packages"], setting["name"]) for setting in listed["setting"]}
    assert listed["frames"] == 200 and len(names) == len(listed["setting"]) >= 30
    assert all(callable(getattr(scenes, setting["scene"])) for setting in listed["setting"])


def one_contact(exact, **changes):
    """A body of 1 kg whose contact approaches at 1 m/s and slides at 2 m/s."""
    mu, normal, along = 0.5, 0.1, 0.3
    parts = {"mass": np.eye(2), "jacobian": np.eye(2), "bias": np.zeros(2), "compliance": np.array([normal, along]),
             "target": np.array([-1.0, 2.0]), "lo": np.array([0.0, -np.inf]), "hi": np.full(2, np.inf), "cones": [(np.arange(2), [mu])]}
    return exact.Problem(**{**parts, **changes}), mu, normal, along


def test_the_independent_solve_is_the_closed_form_of_a_contact_that_slides(monkeypatch):
    exact = module("exact", monkeypatch)
    problem, mu, normal, along = one_contact(exact)
    motion, error = exact.motion(problem, problem.target)
    # x = a (1, -mu), and w is orthogonal to the cone's side: w_n = mu w_t.
    a = (1 + 2 * mu) / (1 + normal + mu**2 * (1 + along))
    assert motion == pytest.approx([-1 + a, 2 - mu * a], abs=1e-12) and error < 1e-12


def test_the_independent_solve_is_the_closed_form_of_a_contact_that_sticks(monkeypatch):
    exact = module("exact", monkeypatch)
    problem, _, normal, along = one_contact(exact, target=np.array([-1.0, 0.1]))
    motion, error = exact.motion(problem, problem.target)
    assert motion == pytest.approx([-1 + 1 / (1 + normal), 0.1 - 0.1 / (1 + along)], abs=1e-12) and error < 1e-12


def test_the_independent_solve_is_the_closed_form_of_a_row_at_its_bound(monkeypatch):
    exact = module("exact", monkeypatch)
    problem, _, normal, _ = one_contact(exact, cones=[], lo=np.array([0.0, -0.25]), hi=np.array([np.inf, 0.25]))
    motion, error = exact.motion(problem, problem.target)
    assert motion == pytest.approx([-1 + 1 / (1 + normal), 2 - 0.25], abs=1e-12) and error < 1e-12


@pytest.mark.parametrize("seed", range(20))
def test_its_error_bounds_the_distance_from_the_minimum(seed, monkeypatch):
    exact = module("exact", monkeypatch)
    random = np.random.default_rng(seed)
    root = random.normal(size=(6, 6))
    problem = exact.Problem(
        root @ root.T + np.eye(6), random.normal(size=(9, 6)), random.normal(size=9), np.tile([0.1, 0.2, 0.2], 3),
        random.normal(size=6), np.tile([0.0, -np.inf, -np.inf], 3), np.full(9, np.inf),
        [(3 * k + np.arange(3), [0.6, 0.6]) for k in range(3)],
    )
    accurate, _ = exact.motion(problem, problem.target)
    for steps in (1, 2, 3):
        early, error = exact.motion(problem, problem.target, steps)
        assert problem.norm(early - accurate) <= error * (1 + 1e-9) + 1e-12

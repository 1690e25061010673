"""The examples run, and show what they say."""

import importlib.util
from pathlib import Path

import pytest

EXAMPLES = Path(__file__).parent.parent / "examples"


def example(name):
    spec = importlib.util.spec_from_file_location(name, EXAMPLES / f"{name}.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_mujocos_forces_are_a_solution():
    pytest.importorskip("mujoco")
    assert example("mujoco_step").main()


def test_an_engine_of_ones_own_is_told_from_one_that_stops_after_two_sweeps():
    good, hasty = example("own_engine").main()
    assert good.ok and hasty.stages.keys() == {"solver"}


def test_an_impulse_that_is_applied_twice_is_written_back_wrongly():
    own = example("own_engine")

    class Twice(own.Balls):
        def step(self):
            super().step()
            self.speeds = self.speeds + self.rows.T @ self.impulses / self.mass

    assert own.run(Twice(4)).stages.keys() == {"write-back"}


def test_anderson_takes_fewer_sweeps_than_gauss_seidel_and_solves_all():
    rows = example("anderson").main().rows
    of = {solver: [row for row in rows if row["solver"] == solver] for solver in ("anderson", "pgs")}
    assert all(row["accepted"] == 1 for row in of["anderson"])
    assert sum(row["iterations"] for row in of["anderson"]) < sum(row["iterations"] for row in of["pgs"])


def test_the_reference_is_that_of_the_docstrings():
    written = EXAMPLES.parent.parent / "docs" / "python.md"
    docs = importlib.util.spec_from_file_location("reference", EXAMPLES.parent / "reference.py")
    module = importlib.util.module_from_spec(docs)
    docs.loader.exec_module(module)
    assert module.reference() == written.read_text(encoding="utf-8")

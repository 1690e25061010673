"""The replay of known defects: its list, its words, and mended releases on its scenes."""

import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest

import lcplab
from lcplab.defects import DEFECTS, __main__, drake, newton, rapier, replay
from lcplab.defects.environment import Environment
from lcplab.defects.scenes import SCENES


def reported(refused, stage="solver"):
    return {"versions": ["engine 1"], "frames": 9, "refused": refused, "stage": stage if refused else None}


def row(bad, mended):
    return {"name": "a", "stage": "solver", "bad": bad, "mended": mended}


@pytest.mark.parametrize(
    ("bad", "mended", "outcome"),
    [
        (reported(1), reported(0), "detected"),
        (reported(0), reported(0), "missed"),
        (reported(1, "assembly"), reported(0), "missed"),
        (reported(1), reported(1), "false alarm"),
        (reported(0) | {"worse": ["9 of 9 errors are above 0"]}, reported(0), "detected by comparison"),
        (reported(1, "assembly") | {"worse": ["9 of 9 errors are above 0"]}, reported(0), "missed"),
        ({"packages": ["a==1"], "unavailable": "no such version"}, reported(0), "skipped"),
    ],
)
def test_a_defect_is_told_apart_only_at_its_stage_and_without_a_false_alarm(bad, mended, outcome):
    assert __main__.outcome(row(bad, mended)) == outcome
    assert outcome in __main__.line(row(bad, mended))


def test_each_defect_has_a_scene_and_pins_all_its_packages():
    assert {defect.name for defect in DEFECTS} == set(SCENES)
    packages = [package for defect in DEFECTS for package in (*defect.bad, *defect.mended)]
    assert all(re.fullmatch(r"[\w-]+==[\d.]+|npm:@[\w/-]+@[\d.]+", package) for package in packages)


def test_an_engine_is_not_taken_from_the_folder_in_which_the_command_is_called(tmp_path, monkeypatch):
    (tmp_path / "mujoco.py").write_text("raise SystemExit('the file of the current folder')", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    own = Environment(Path("environments"), ["mujoco==1"])
    own.folder.mkdir(parents=True)
    found = "import importlib.util; print(importlib.util.find_spec('mujoco'))"
    assert str(tmp_path / "mujoco.py") not in own._run([sys.executable, "-c", found], 60)


@pytest.mark.parametrize(
    ("name", "engine", "mended"),
    [("connect_bias", "mujoco", "3.7.0"), ("sphere_in_box", "mujoco", "3.7.0"), ("welded_chain", "dartpy", "6.18.0")],
)
def test_a_mended_release_is_accepted(name, engine, mended):
    pytest.importorskip(engine, minversion=mended)
    assert replay.replay(name)["refused"] == 0


@pytest.mark.parametrize(("part", "stage"), [(1.0, None), (1.25, "write-back"), (0.25, "write-back")])
def test_a_resting_cube_that_reports_another_impulse_than_its_weight_is_written_back_wrongly(part, stage):
    corners = [[x, -0.5, z] for x in (-0.5, 0.5) for z in (-0.5, 0.5)]
    rest, weight = [0.0] * 6, 2.0 * 10.0 * 0.01
    step = {"before": rest, "after": rest, "points": corners, "impulses": [part * weight / 4] * 4}
    receipt = lcplab.receipt(rapier.read(step, {"mass": 2.0, "dt": 0.01, "version": "1"}))
    assert receipt.stage == stage and receipt.motion_error < 1e-6


@pytest.mark.parametrize(("read", "stage"), [(0.01, None), (0.15, "assembly"), (-0.01, "assembly")])
def test_a_coupler_that_reads_another_error_than_that_of_its_joints_is_assembled_wrongly(read, stage):
    masses, free = np.array([1.0, 2.0]), np.array([0.3, 0.1])
    softness = (0.1 / (2 * np.pi)) ** 2 * np.sum(1 / masses)
    impulse = -(np.sum(free) + read / (2 * drake.DT)) / (np.sum(1 / masses) + softness)
    step = drake.coupled(np.diag(masses), [0, 1], free, free + impulse / masses, apart=0.01)
    assert lcplab.receipt(step).stage == stage


@pytest.mark.parametrize(("times", "stage"), [(1.0, None), (2.0, "assembly"), (0.0, "assembly")])
def test_a_force_that_does_not_count_once_is_assembled_wrongly(times, stage):
    place, force = 0.02, 3.0
    after = drake.DT * (times * force - 100.0 * place) / (2.0 + 10.0 * drake.DT + 100.0 * drake.DT**2)
    assert lcplab.receipt(drake.free(force, place, 0.0, after)).stage == stage


@pytest.mark.parametrize(("times", "stage"), [(1.0, None), (4.0, "solver"), (0.5, "solver")])
def test_a_sliding_block_has_the_friction_of_the_cone(times, stage):
    lost = times * newton.FRICTION * newton.GRAVITY * newton.DT
    receipt = lcplab.receipt(newton.slide([0.1, 0.0, 0.0], [0.1 - lost, 0.0, 0.0]))
    assert receipt.stage == stage


@pytest.mark.parametrize(("part", "stage"), [(0.8, None), (0.675, "assembly"), (0.9, "assembly")])
def test_a_bounce_of_another_restitution_is_assembled_wrongly(part, stage):
    step = {"mass": 2.0, "dt": 0.01, "before": -1.5, "after": 1.5 * part}
    assert lcplab.receipt(rapier.bounce(step)).stage == stage


def test_the_record_has_a_row_for_each_defect_with_the_outcome_of_its_receipts():
    record = json.loads((Path(__file__).parents[2] / "reports" / "receipts.json").read_text(encoding="utf-8"))
    assert [row["name"] for row in record["defects"]] == [defect.name for defect in DEFECTS]
    assert all(row["outcome"] == __main__.outcome(row) for row in record["defects"])

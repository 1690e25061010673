"""The C++ header that writes an engine's step: its files against NumPy and the judge."""

import json
import subprocess
from pathlib import Path

import numpy as np
import pytest

import lcplab

CAPTURE = Path(__file__).resolve().parents[2] / "capture"
WARNINGS = ["-std=c++11", "-Wall", "-Wextra", "-Wconversion", "-pedantic", "-Werror"]

#: Two bodies with full inertias, an equation, a contact with friction, and a compliant row.
PAIR = r"""
#include "lcplab_dump.h"
int main(int argc, char**) {
    lcplab::Frame frame("a \"pair\"\\\n", 0.1);
    const lcplab::Mat3 first = {{{{2, 0.1, 0.2}}, {{0.1, 3, 0.3}}, {{0.2, 0.3, 4}}}};
    const lcplab::Mat3 second = {{{{5, -0.5, 0}}, {{-0.5, 6, 0.7}}, {{0, 0.7, 8}}}};
    const int a = frame.body("a", 1.0 / 3, first, {{1, 2, 3}}, {{0.1, 0.2, 0.3}});
    const int b = frame.body("b", 7, second, {{0, 0, -1e-17}}, {{0, 0, 0}});
    const int joint = frame.row("joint", "joint", -lcplab::infinity, lcplab::infinity, argc > 1 ? std::nan("") : 0.25);
    frame.along(joint, {{1, 0, 0}}, a, {{0, 0.5, 0}}, b, {{0, -0.5, 0.125}});
    const int n = frame.row("normal", "normal", 0, lcplab::infinity, 0, 1e-3);
    frame.along(n, {{0, 0, 1}}, lcplab::fixed_body, {{0, 0, 0}}, b, {{0.3, 0, -0.5}});
    const int t = frame.friction("friction", n, 0.7);
    frame.along(t, {{0, 1, 0}}, a, {{0, 0, 0}}, b, {{0.3, 0, -0.5}});
    frame.entry(t, b, {{0, 1, 0}}, {{0, 0, 0}}); // adds up
    frame.answer(n, 0.1);
    return frame.write("pair.json", "pair.x.json") ? 0 : 1;
}
"""


def built(source, folder):
    program = folder / "program"
    subprocess.run(["c++", *WARNINGS, "-I", CAPTURE, str(source), "-o", program], check=True)
    return program


def dense(triplets, shape):
    matrix = np.zeros(shape)
    for i, j, value in triplets:
        matrix[i, j] += value
    return matrix


def test_a_box_on_a_floor_is_proved_from_the_two_files(tmp_path):
    subprocess.run([built(CAPTURE / "box_on_floor.cpp", tmp_path)], cwd=tmp_path, check=True)
    x = json.loads((tmp_path / "frame.x.json").read_text())["x"]
    problem = lcplab.Problem.read(tmp_path / "frame.json")
    # m g dt, a quarter on each corner; the center of mass is above the middle of the corners.
    assert x == pytest.approx([2 * 9.81 * 0.01 / 4, 0, 0] * 4, rel=1e-15)
    assert lcplab.judge(problem, x=x).verdict == "proved"
    assert not lcplab.judge(problem, x=np.array(x) * 1.001)


def test_a_velocity_that_the_impulses_do_not_cause_is_rejected_at_write_back(tmp_path):
    subprocess.run([built(CAPTURE / "box_on_floor.cpp", tmp_path)], cwd=tmp_path, check=True)
    assert lcplab.receipts([tmp_path / "frame.json"]).ok
    answer = json.loads((tmp_path / "frame.x.json").read_text())
    assert answer["motion"] == [0] * 6
    answer["motion"][2] = 1e-3
    (tmp_path / "frame.x.json").write_text(json.dumps(answer))
    (receipt,) = lcplab.receipts([tmp_path / "frame.json"]).receipts.values()
    assert receipt.stage == "write-back"


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    folder = tmp_path_factory.mktemp("pair")
    (folder / "pair.cpp").write_text(PAIR)
    return built(folder / "pair.cpp", folder)


def test_a_and_b_are_those_of_the_masses_and_rows(pair, tmp_path):
    subprocess.run([pair], cwd=tmp_path, check=True)
    file = json.loads((tmp_path / "pair.json").read_text())
    motion = file["motion"]
    upper, jacobian = dense(motion["mass"], (12, 12)), dense(motion["jacobian"], (3, 12))
    mass = upper + np.triu(upper, 1).T
    first = [[2, 0.1, 0.2], [0.1, 3, 0.3], [0.2, 0.3, 4]]
    assert np.array_equal(mass[:3, :3], np.eye(3) / 3) and np.array_equal(mass[3:6, 3:6], first)
    # Along x from a to b, through points with the arms r: the angular parts are −r×x and r×x.
    assert jacobian[0].tolist() == [-1, 0, 0, 0, 0, 0.5, 1, 0, 0, 0, 0.125, 0.5]
    assert jacobian[2].tolist() == [0, -1, 0, 0, 0, 0, 0, 2, 0, 0.5, 0, 0.3]
    a = dense(file["A"]["triplets"], (3, 3))
    assert np.array_equal(a, a.T)
    np.testing.assert_allclose(a, jacobian @ np.linalg.solve(mass, jacobian.T) + np.diag([0, 1e-3, 0]), rtol=1e-14)
    np.testing.assert_allclose(file["b"], jacobian @ motion["target"] + [0.25, 0, 0], rtol=1e-14)
    assert motion["target"][8] == -1e-17 and file["dt"] == 0.1
    assert (file["lo"], file["hi"]) == (["-inf", 0, "-inf"], ["inf", "inf", "inf"])
    assert (file["friction_index"], file["mu"]) == ([-1, -1, 1], [0, 0, 0.7])
    assert file["rows"][2]["bodies"] == ["a", "b"]
    assert len(lcplab.Problem.read(tmp_path / "pair.json")) == 3


def test_a_number_that_is_not_finite_reaches_the_reader_as_one_message(pair, tmp_path):
    subprocess.run([pair, "nan"], cwd=tmp_path, check=True)
    with pytest.raises(lcplab.InputError, match=r"motion.bias\[0\]: must be finite"):
        lcplab.Problem.read(tmp_path / "pair.json")


def test_a_folder_that_does_not_exist_is_reported(pair, tmp_path):
    (tmp_path / "pair.json").mkdir()
    assert subprocess.run([pair], cwd=tmp_path).returncode == 1

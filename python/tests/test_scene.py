"""Scenes: closed forms of a step, and what can be read off."""

import numpy as np
import pytest

import lcplab


def test_the_stack_that_is_hit_has_the_chapters_impulses():
    s = lcplab.Scene.load("fig7")
    step = s.step()
    assert step and step.x.tolist() == [4.0, 3.0, 1.0]
    assert s.problem().b.shape == (3,) and s.poses.shape == (len(s.bodies), 7)


def test_free_fall_gains_g_dt_a_step(tmp_path):
    scene = tmp_path / "fall.toml"
    scene.write_text('[step]\ndt = 0.01\n[[bodies]]\nname = "ball"\nshape = { sphere = 0.1 }\nmass = 2\nposition = [0, 0, 10]\n')
    s = lcplab.Scene.load(scene)
    for _ in range(10):
        s.step()
    assert s.time == pytest.approx(0.1)
    np.testing.assert_allclose(s.velocities[0], [0, 0, -0.981, 0, 0, 0], atol=1e-12)


def test_fields_are_set_and_defects_are_input_errors():
    assert lcplab.Scene.load("sliding", set={"mu": 0.3, "dt": 0.02}).step()
    with pytest.raises(lcplab.InputError, match="unknown field"):
        lcplab.Scene.load("sliding", set={"colour": 3})
    with pytest.raises(lcplab.InputError, match="there is no scene file or shipped scene"):
        lcplab.Scene.load("nowhere")


def test_a_derivation_is_text_and_a_page():
    document = lcplab.explain([[2, 1], [1, 2]], [-5, -6], solver="lemke")
    assert "4/3" in str(document) or "1.333" in str(document)
    assert document.html.startswith("<!DOCTYPE html>") or "<html" in document.html
    assert "$" in document.markdown


def test_a_scene_of_a_dictionary_moves_as_that_of_its_file():
    loaded, made = lcplab.Scene.load("incline"), lcplab.Scene.of(lcplab.Scene.described("incline"))
    for _ in range(20):
        loaded.step()
        made.step()
    np.testing.assert_allclose(made.poses, loaded.poses, atol=1e-12)
    with pytest.raises(lcplab.InputError, match="unknown field"):
        lcplab.Scene.of({"colour": 3})
    with pytest.raises(TypeError, match="change the dictionary itself"):
        lcplab.Scene.described({"bodies": []}, set={"mu": 1})


def test_forces_of_a_box_at_rest_are_its_weight_also_in_the_direction_of_friction():
    s = lcplab.Scene.load("incline", set={"mu": 0.5})
    assert s.forces() is None
    for _ in range(10):
        s.step()
    np.testing.assert_allclose(s.forces(), [[0, 0, -2 * 9.81], [0, 0, 2 * 9.81]], atol=1e-6)


def test_loads_are_the_forces_by_pair_body_and_contact():
    ground = {"name": "ground", "fixed": True, "shape": {"plane": [0, 0, 1]}}
    cube = {"name": "cube", "shape": {"box": [1, 1, 1]}, "mass": 3.0, "position": [0, 0, 0.5]}
    scene = lcplab.Scene.of({"step": {"dt": 0.01}, "bodies": [ground, cube]})
    assert scene.loads() is None
    scene.step()
    loads = scene.loads()
    weight = 3.0 * 9.81
    (pair,) = loads["pairs"]
    assert (pair["by"], pair["on"], loads["unit"]) == ("ground", "cube", "N")
    assert pair["carried"] == pytest.approx(weight) and pair["range"]["is_unique"]
    # Only the difference of the diagonals of the face is free.
    for contact in pair["contacts"]:
        assert contact["range"]["least"] == pytest.approx(0, abs=1e-4)
        assert contact["range"]["most"] == pytest.approx(weight / 2, abs=1e-4)
        assert contact["range"]["least_norm"] == pytest.approx(weight / 4, abs=1e-4)
    (body,) = loads["bodies"]
    assert body["wrench"]["force"] == pytest.approx([0, 0, weight], abs=1e-9)
    assert body["weight"] == pytest.approx([0, 0, -weight])

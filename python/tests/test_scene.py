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

"""A run is not ok if it checked nothing, and drops no file in silence."""

import json

import numpy as np
import pytest

import lcplab

#: 2 kg fall at 3 m/s on a row of compliance 1/2: x = 3 N s, v = -1.5 m/s.
GOOD = lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [3.0], [-1.5], compliance=0.5)
FREE = lcplab.EngineStep.of("mine", [[2.0]], np.zeros((0, 1)), [], [-3.0], [], [-3.0])
CAPPED = lcplab.EngineStep.of(
    "mine", [[2.0]], [[1.0]], [0.0], [-3.0], [2.0], [-2.0], compliance=0.5, method="pgs", iterations=9, has_converged=False,
)


def unbounded(compliance=0.5):
    """A step without a bound on the motion: its adapter knows a row that the engine does not report."""
    return lcplab.EngineStep.of(
        "mine", np.eye(2), np.eye(2), [0.0, 0.0], [1.0, 0.0], [0.0, 0.0], [1.0, 0.0], lo=[0.0, -np.inf],
        friction_index=[-1, 0], mu=0.5, model="coulomb-cone", compliance=compliance, no_bound="because of a closed loop",
    )


@pytest.mark.parametrize(
    ("steps", "why"),
    [
        ([], "there are no frames"),
        ([FREE, FREE], "2 no rows"),
        ([CAPPED], "1 unconverged"),
        ([unbounded()], "1 not checked"),
        ([unbounded(0.0)], "1 not checked"),  # its motion is that of its forces, but the rest of its law is unknown
        ([CAPPED, FREE, unbounded()], "1 unconverged, 1 not checked, 1 no rows"),
    ],
)
def test_a_run_that_checked_no_frame_is_not_ok_and_says_why(steps, why):
    run = lcplab.receipts(steps)
    assert not run.ok and run.unchecked == f"no frame is ok or wrong: {why}"
    assert run.unchecked in str(run) and str(run).startswith("not ok")


def test_half_of_the_frames_with_rows_are_enough_and_fewer_need_a_baseline():
    run = lcplab.receipts([CAPPED, FREE, GOOD])
    assert run.ok and run.unchecked is None
    mostly = lcplab.receipts([GOOD, *[CAPPED] * 19])
    assert not mostly.ok and "in 1 of 20 frames with rows, which is less than half: 19 unconverged" in str(mostly)
    assert lcplab.receipts([GOOD, *[CAPPED] * 19], baseline=mostly.to_json()).ok


def test_a_frame_that_is_no_longer_rejected_is_named():
    wrong = lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [2.0], [-2.0], compliance=0.5)
    run = lcplab.receipts([GOOD, GOOD], baseline=lcplab.receipts([GOOD, wrong]).to_json())
    assert run.fixed == ["mine 1"] and "mine 1 is no longer rejected" in str(run)


def test_a_frame_that_is_rejected_at_another_stage_is_not_known():
    def at_stage(force, motion):
        return lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [force], [motion], compliance=0.5)

    baseline = lcplab.receipts([GOOD, at_stage(2.0, -2.0)]).to_json()
    assert lcplab.receipts([GOOD, at_stage(2.0, -2.0)], baseline=baseline).ok
    other = lcplab.receipts([GOOD, at_stage(3.0, -1.4)], baseline=baseline)
    assert other.rejected == ["mine 1"] and other.stages == {"write-back": 1} and not other.known and not other.ok


def test_files_without_a_partner_are_named_and_are_invalid_input(tmp_path):
    for stem in ("a", "b", "c"):
        lcplab.receipt(GOOD).write(tmp_path / f"{stem}.json", tmp_path / f"{stem}.x.json")
    (tmp_path / "b.x.json").unlink()
    (tmp_path / "c.json").unlink()
    with pytest.raises(lcplab.InputError) as error:
        lcplab.receipts([tmp_path])
    assert "b.json: its answer b.x.json is missing" in str(error.value)
    assert "c.x.json: its problem c.json is missing" in str(error.value)


def test_the_folders_of_the_worst_frames_can_be_checked_again(tmp_path):
    wrong = lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [2.0], [-2.0], compliance=0.5)
    lcplab.receipts([wrong]).save_worst(tmp_path)
    again = lcplab.receipts([tmp_path])
    assert len(again.receipts) == 1 and again.stages == {"solver": 1}


def test_a_session_that_checked_no_step_fails(pytester):
    pytester.makepyfile("""
        import lcplab

        def test_capped(lcplab_receipts):
            lcplab_receipts(lcplab.EngineStep.of(
                "mine", [[2.0]], [[1.0]], [0.0], [-3.0], [2.0], [-2.0], compliance=0.5, method="pgs", iterations=9,
                has_converged=False))
    """)
    result = pytester.runpytest()
    result.assert_outcomes(passed=1)
    assert result.ret == 1
    result.stdout.fnmatch_lines(["*no frame is ok or wrong: 1 unconverged*"])
    assert pytester.runpytest("--lcplab-baseline", "b.json", "--lcplab-update").ret == 0


TWO_TESTS = """
    import lcplab
    import pytest

    def step():
        return lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [3.0], [-1.5], compliance=0.5)

    def test_one(lcplab_receipts):
        for _ in range(4):
            lcplab_receipts(step())

    def test_two(lcplab_receipts):
        lcplab_receipts(step())
"""


def test_a_session_without_a_test_or_a_step_of_its_baseline_fails(pytester):
    file = pytester.makepyfile(TWO_TESTS)
    assert pytester.runpytest("--lcplab-baseline", "b.json", "--lcplab-update").ret == 0
    assert pytester.runpytest("--lcplab-baseline", "b.json").ret == 0
    for removed in ("def test_two", "def test_one"):
        file.write_text(file.read_text().replace(removed, removed.replace("def test", "def no_test")))
        result = pytester.runpytest("--lcplab-baseline", "b.json")
        assert result.ret != 0
        result.stdout.fnmatch_lines(["*of the baseline * missing: *"])
    pytester.makepyfile(TWO_TESTS.replace("range(4)", "range(3)"))
    result = pytester.runpytest("--lcplab-baseline", "b.json")
    assert result.ret == 1
    result.stdout.fnmatch_lines(["*1 frame of the baseline is missing: *test_one step 4*"])


def test_a_session_of_some_tests_needs_the_steps_of_these_tests_only(pytester):
    file = pytester.makepyfile(TWO_TESTS)
    assert pytester.runpytest("--lcplab-baseline", "b.json", "--lcplab-update").ret == 0
    assert pytester.runpytest("--lcplab-baseline", "b.json", "-k", "two").ret == 0
    assert pytester.runpytest("--lcplab-baseline", "b.json", f"{file.name}::test_one").ret == 0
    file.write_text(file.read_text().replace("range(4)", "range(2)"))
    assert pytester.runpytest("--lcplab-baseline", "b.json", f"{file.name}::test_one").ret == 1


def test_a_missing_baseline_is_a_usage_error_that_says_how_to_record_it(pytester):
    result = pytester.runpytest("--lcplab-baseline", "none.json")
    assert result.ret == pytest.ExitCode.USAGE_ERROR
    result.stderr.fnmatch_lines(["*none.json: no such file; record the baseline first (--lcplab-update records one)*"])


def test_a_run_is_valid_json(tmp_path):
    broken = lcplab.EngineStep.of("mine", [[2.0]], [[1.0]], [0.0], [-3.0], [np.nan], [-2.0], compliance=0.5)
    lcplab.receipts([broken, GOOD]).save(tmp_path / "known.json")
    assert json.loads((tmp_path / "known.json").read_text())["rejected"] == {"mine 0": "solver"}


def test_an_adapter_that_checks_more_than_its_baseline_loses_nothing():
    known = lcplab.receipts([GOOD] * 9).to_json()
    more = lcplab.EngineStep.of(
        "mine", [[2.0]], [[1.0]], [0.0], [-3.0], [3.0], [-1.5], compliance=0.5, expected_jacobian=[[1.0]]
    )
    run = lcplab.receipts([more] * 9, baseline=known)
    assert run.ok and run.lost == [], str(run)
    assert lcplab.receipts([GOOD] * 9, baseline=lcplab.receipts([more] * 9).to_json()).lost

"""The exercises in Python: each solution passes its check; each hole and each bug fails, with words."""

import sys
from pathlib import Path

import pytest

NOTEBOOKS = Path(__file__).parent.parent.parent / "notebooks"
sys.path.insert(0, str(NOTEBOOKS / "exercises"))

import checks
from test_exercises import FILES, answer


def test_the_exercises_are_those_in_rust():
    rust = {file.stem for file in (NOTEBOOKS / "exercises").glob("e[0-9]*.rs")}
    assert rust == {file.stem for file in FILES}
    assert rust == {file.stem for file in (NOTEBOOKS / "solutions").glob("e[0-9]*.py")}


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_solution_passes_and_a_hole_or_a_bug_does_not(file):
    check = getattr(checks, file.stem)
    check(answer(NOTEBOOKS / "solutions" / file.name))
    error = AssertionError if "_b_" in file.stem else NotImplementedError
    with pytest.raises(error):
        check(answer(file))


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_a_student_reads_the_same_as_in_rust(file):
    wanted = file.with_suffix(".rs").read_text(encoding="utf-8").splitlines()[0].removeprefix("//! ")
    assert file.read_text(encoding="utf-8").startswith(f'"""{wanted}')

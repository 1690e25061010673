"""The answers of the problem sets, and those of their typical mistakes, are what other programs find."""

import runpy
from pathlib import Path

import pytest

FOLDER = Path(__file__).parent / "answers"


@pytest.mark.parametrize("half", ["first_half", "second_half"])
def test_every_answer_is_found_anew(half):
    runpy.run_path(str(FOLDER / f"{half}.py"))

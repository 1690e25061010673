"""Checks your answers to the exercises in Python.

    pytest notebooks/exercises -k e04_1     # exercise 4.1
    pytest notebooks/exercises -k e04       # all of lesson 4

Each eLESSON_NUMBER_….py has a gap or a bug. Fill or fix it, and run the check. It says what is wrong, not how to mend it.
"""

import importlib.util
from pathlib import Path

import checks
import pytest
from checking import verdict

FILES = sorted(Path(__file__).parent.glob("e[0-9]*.py"))


def answer(file):
    """The function of that name in a file."""
    spec = importlib.util.spec_from_file_location(file.stem, file)
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module.answer


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_exercise(file):
    try:
        program = answer(file)
    except Exception as error:
        pytest.fail(f"{file.name} cannot be loaded: {type(error).__name__}: {error}", pytrace=False)
    wrong = verdict(getattr(checks, file.stem), program)
    if wrong:
        pytest.fail(f"{file.name}: {wrong}", pytrace=False)

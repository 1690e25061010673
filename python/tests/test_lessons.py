"""What the lessons say in Python runs, each lesson as a notebook, and its assertions hold."""

import re
from pathlib import Path

import pytest

LESSONS = sorted((Path(__file__).parent.parent.parent / "notebooks").glob("[0-9]*.md"))


@pytest.mark.parametrize("lesson", LESSONS, ids=lambda path: path.stem)
def test_every_cell_runs(lesson):
    nbclient = pytest.importorskip("nbclient")
    from nbformat.v4 import new_code_cell, new_notebook

    cells = re.findall(r"^```\n\n```python\n(.*?)^```$", lesson.read_text(encoding="utf-8"), re.M | re.S)
    assert cells, "a lesson without Python"
    book = new_notebook(cells=[new_code_cell(cell) for cell in cells])
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3").execute()

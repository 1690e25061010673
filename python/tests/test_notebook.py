"""The notebook runs, and without an error."""

from pathlib import Path

import pytest

NOTEBOOK = Path(__file__).parent.parent.parent / "notebooks" / "python" / "quickstart.ipynb"


def test_every_cell_runs():
    nbclient = pytest.importorskip("nbclient")
    pytest.importorskip("matplotlib")
    import nbformat

    book = nbformat.read(NOTEBOOK, as_version=4)
    nbclient.NotebookClient(book, timeout=120, kernel_name="python3").execute()
    figures = [o for cell in book.cells for o in cell.get("outputs", []) if "image/png" in o.get("data", {})]
    assert len(figures) == 1

"""docs/models.md: its lines are what the import does today, for the packages that are installed."""

import importlib.metadata
from pathlib import Path

import pytest

from public_models import MODELS, files, folder, row

PAGE = (Path(__file__).parents[2] / "docs" / "models.md").read_text(encoding="utf-8")


@pytest.mark.parametrize("package", MODELS)
def test_public_models_import_as_their_page_says_and_agree_with_mujoco(package):
    base = folder(package)
    if base is None or f"{package} {importlib.metadata.version(package)}" not in PAGE:
        pytest.skip(f"the version of {package} on the page is not installed")
    recorded = {line.split(" | ")[1]: line.split(" | ") for line in PAGE.splitlines() if line.startswith("| ")}
    for kind, name in files(package):
        line, _, errors = row(kind, package, base / name, name)
        cells = line.split(" | ")
        # Kind, model, bodies, degrees of freedom, and what has no counterpart; the errors differ between machines.
        assert cells[:5] == recorded[cells[1]][:5]
        assert max(errors, default=0) < 1e-9, name

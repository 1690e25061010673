"""The problems of the lessons with the numbers that the pages print: the first value of each parameter."""

import keyword
import math
import re
import tomllib
from pathlib import Path

FOLDER = Path(__file__).parent.parent.parent.parent / "notebooks" / "problems"
NAMES = {name: getattr(math, name) for name in ("sqrt", "sin", "cos", "tan", "atan", "acos", "exp", "ceil", "floor")}
NAMES |= {"ln": math.log, "PI": math.pi, "abs": abs, "min": min, "max": max, "round": round}


def problems(lesson):
    """The problems of a lesson, with numbers instead of formulas; a power is written ^ in the files."""
    text = (FOLDER / f"{lesson:02}.toml").read_text(encoding="utf-8")
    data = tomllib.loads(text)
    assert set(data) == {"problem"}
    return [printed(problem) for problem in data["problem"]]


def spelled(name):
    """A name that Python takes: lambda becomes lambda_."""
    return name + "_" if keyword.iskeyword(name) else name


def printed(problem):
    known = {**NAMES, **{spelled(name): values[0] for name, values in problem.pop("parameters", {}).items()}}

    def value(formula):
        python = re.sub(r"[a-zA-Z]\w*", lambda found: spelled(found[0]), str(formula)).replace("^", "**")
        return float(eval(python, {"__builtins__": {}}, known))

    for name, formula in problem.pop("values", {}).items():
        known[spelled(name)] = value(formula)
    assert all(value(formula) > 0 for formula in problem.pop("positive", []))
    problem["answer"] = value(problem["answer"])
    for other in [*problem["traps"], *problem.get("also", [])]:
        other["answer"] = value(other["answer"])
    for key in ("text", "because"):
        problem[key] = re.sub(r"\{\{([^{}:]*)(:[^{}]*)?\}\}", lambda found: f"{value(found[1]):.10g}", problem[key])
    return problem

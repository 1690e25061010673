"""Measures what users wait for, and writes waits.md beside the goals of goals.toml.

    cargo build --release && pip install target/wheels/lcplab-*.whl
    python3 benches/waits.py [--lcplab target/release/lcplab] [--builds]

Each number is the median of five runs, or of one for the builds; compare numbers of one machine."""

import argparse
import datetime
import json
import math
import os
import platform
import random
import re
import resource
import statistics
import subprocess
import sys
import tempfile
import time
import timeit
import tomllib
from collections.abc import Callable
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "benches/waits.md"
RUNS = 5
TOWER = ["simulate", "tower", "--solver", "pgs", "--sweeps", "50"]
SPARSE = 10_000  # rows


def main() -> None:
    parser = argparse.ArgumentParser(description="Measure what users wait for.")
    parser.add_argument("--lcplab", type=Path, default=ROOT / "target/release/lcplab", help="the program")
    parser.add_argument("--builds", action="store_true", help="also build and test from nothing, which takes half an hour")
    given = parser.parse_args()
    lcplab, load = given.lcplab.resolve(), os.getloadavg()[0]
    with tempfile.TemporaryDirectory() as folder:
        found = {**programs(lcplab, Path(folder)), **python()}
        if given.builds:
            found |= builds(Path(folder))
    OUT.write_text(page(lcplab, load, found), encoding="utf-8")
    print(OUT)


def programs(lcplab: Path, folder: Path) -> dict[str, float]:
    """The program's commands, each in a process of its own."""

    def run(*arguments: str) -> tuple[float, float]:
        """The time (s) and the largest memory (MB) of a command."""
        start = time.perf_counter()
        process = subprocess.Popen([lcplab, *arguments], cwd=folder, stdout=subprocess.DEVNULL)
        _, status, used = os.wait4(process.pid, 0)
        if os.waitstatus_to_exitcode(status) not in (0, 1):  # 1: fixed sweeps leave rows unsolved
            sys.exit(f"failed: lcplab {' '.join(arguments)}")
        return time.perf_counter() - start, used.ru_maxrss / 1024

    def step(few: int, many: int, *changes: str) -> float:
        """The time of a step (s): the difference between a long and a short run."""
        short, long = (run(*TOWER, *changes, "--steps", str(steps))[0] for steps in (few, many))
        return (long - short) / (many - few)

    def median(measure: Callable[[], float]) -> float:
        return statistics.median(measure() for _ in range(RUNS))

    small = median(lambda: step(2, 52))
    many = ("--set", "generate.count=20000")
    large = median(lambda: step(1, 21, *many))
    found = {
        "a step of the tower of 700": 1e3 * small,
        "growth of a step from 700 to 20,000 cubes": math.log(large / small) / math.log(20_000 / 700),
        "memory of 20,000 cubes": run(*TOWER, *many, "--steps", "2")[1],
        "the standard report": median(lambda: run("report", "standard", "--out", "report")[0]),
    }
    tridiagonal(folder / "sparse.json")
    for solver in ("block-pivoting", "interior-point", "pgs"):
        seconds, megabytes = run("solve", "sparse.json", "--solver", solver)
        found |= {f"{solver} on {SPARSE:,} rows": seconds, f"memory of {solver} on {SPARSE:,} rows": megabytes}
    return found


def tridiagonal(path: Path) -> None:
    """A stack of equal bodies without friction, 2 on the diagonal of A and -1 beside it, some pushed and more pulled."""
    entries = [[i, i, 2.0] for i in range(SPARSE)]
    entries += [[i, i + 1, -1.0] for i in range(SPARSE - 1)] + [[i + 1, i, -1.0] for i in range(SPARSE - 1)]
    chance = random.Random(1)
    problem = {
        "name": "a long stack",
        "A": {"rows": SPARSE, "cols": SPARSE, "triplets": entries},
        "b": [chance.uniform(-1, 1) + 0.2 for _ in range(SPARSE)],
        "lo": [0.0] * SPARSE,
        "hi": ["inf"] * SPARSE,
    }
    path.write_text(json.dumps(problem), encoding="utf-8")


def python() -> dict[str, float]:
    """The package, in this interpreter."""
    try:
        import numpy as np

        import lcplab
    except ImportError as missing:
        print(f"skipped: the Python package: {missing}")
        return {}
    script = "import numpy, time; t = time.perf_counter(); import lcplab; print(time.perf_counter() - t)"
    imported = [float(subprocess.run([sys.executable, "-c", script], check=True, capture_output=True).stdout) for _ in range(RUNS)]
    generator = np.random.default_rng(1)

    def problem(n: int) -> tuple:
        factor = generator.normal(size=(n, n + 4))
        return lcplab.Problem(factor @ factor.T, generator.normal(size=n))

    def best(call: Callable[[], object], number: int) -> float:
        return statistics.median(timeit.repeat(call, number=number, repeat=RUNS)) / number

    def proved(n: int, number: int) -> float:
        """The time of a verdict on a solution of n rows (s)."""
        own = problem(n)
        x = lcplab.solve(own, solver="dantzig").x
        if lcplab.judge(own, x=x).verdict != "proved":
            sys.exit(f"the solution of {n} rows is not proved")
        return best(lambda: lcplab.judge(own, x=x), number)

    sixty = problem(60)
    return {
        "import lcplab": 1e3 * statistics.median(imported),
        "judge of 20 rows from Python": 1e6 * proved(20, 200),
        "exact proof of a solution of 50 rows": 1e3 * proved(50, 20),
        "exact proof of a solution of 150 rows": 1e3 * proved(150, 5),
        "proof that a solution of 60 rows is the only one": 1e3 * best(lambda: lcplab.prove(sixty, kind="unique"), 5),
    }


def builds(folder: Path) -> dict[str, float]:
    """From nothing: the program's first build (processor time) and the tests (by the clock)."""
    def cargo(*arguments: str) -> tuple[float, float]:
        before, start = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
        environment = {**os.environ, "CARGO_TARGET_DIR": str(folder / "target"), "CARGO_INCREMENTAL": "0"}
        subprocess.run(["cargo", *arguments], cwd=ROOT, check=True, env=environment, capture_output=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.perf_counter() - start

    tested = cargo("test")[1]
    return {"`cargo test` from nothing": tested / 60, "first build": cargo("build", "--release")[0] / 60}


def page(lcplab: Path, load: float, found: dict[str, float]) -> str:
    goals = tomllib.loads((ROOT / "benches/goals.toml").read_text(encoding="utf-8"))["wait"]
    unknown = found.keys() - {goal["what"] for goal in goals}
    if unknown:
        sys.exit(f"goals.toml has no goal for {', '.join(sorted(unknown))}")
    version = subprocess.run([lcplab, "--version"], check=True, capture_output=True, text=True).stdout.split()[1]
    cpu = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    machine = f"{cpu[1] if cpu else platform.processor()}, {os.cpu_count()} processors, with a load of {load:.1f} before"
    rows = []
    for goal in goals:
        value = found.get(goal["what"])
        shown = "not measured" if value is None else f"{value:.3g}"
        verdict = "–" if value is None else "✓" if value <= goal["most"] else f"✗ {value / goal['most']:.2g} ×"
        rows.append(f"| {goal['what']} | {shown} | {goal['most']:g} | {goal['unit']} | {verdict} |")
    return "\n".join([
        "# What users wait for",
        "",
        f"Recorded on {datetime.date.today().isoformat()}, on {machine}, with lcplab {version}; medians of {RUNS} runs. "
        "`python3 benches/waits.py` repeats the",
        "measurement; [goals.toml](goals.toml) has the goals. The [notes](README.md#goals-that-are-not-met) explain what is missed.",
        "",
        "| what | measured | at most | unit | |",
        "| --- | --: | --: | --- | --- |",
        *rows,
        "",
    ])


if __name__ == "__main__":
    main()

"""Compares third-party solvers with lcplab's on the problem set, and writes third_party.md.

    pip install -r examples/plugins/requirements.txt      # Siconos comes from conda, or from Debian, for its Python and numpy<2
    python3 benches/third_party.py [--lcplab target/release/lcplab]

A solver meets an accuracy if one of its runs ends with a claim that the judge accepts and a scaled residual below it; its
time is that of the fastest such run. Runs ask for the tolerances ASKED, since solvers measure their errors differently."""

import argparse
import csv
import datetime
import json
import math
import os
import platform
import re
import subprocess
import sys
import tempfile
from collections import defaultdict
from importlib.metadata import PackageNotFoundError, version
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
OUT = ROOT / "benches/third_party.md"

OWN = ["dantzig", "lemke", "newton", "interior-point", "pgs", "clarabel"]
PLUGINS = {  # name of the adapter in examples/plugins: solver, and the package whose version is stated
    "use_moby": ("Drake, `MobyLcpSolver`", "drake"),
    "use_siconos": ("Siconos, `SICONOS_LCP_LEMKE`", "siconos"),
    "use_quantecon": ("QuantEcon, `lcp_lemke`", "quantecon"),
    "use_pinocchio": ("Pinocchio, `ADMMConstraintSolver`", "pin"),
    "use_osqp": ("OSQP", "osqp"),
    "use_proxsuite": ("ProxQP", "proxsuite"),
    "use_quadprog": ("quadprog", "quadprog"),
    "use_lsq_linear": ("SciPy, `lsq_linear`", "scipy"),
}
ASKED = [1e-4, 1e-8, 1e-12]
REACHED = [1e-4, 1e-8]
LIMIT = 2.0  # s: what a failure is charged with, and the longest that a solve may take
START = 10.0  # s: within which a plug-in answers at all; some of them compile first
MOST = 400  # rows
SHIFT = 1e-3  # s: added to each time before the mean, so that times near 0 do not decide it


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Compare solvers on the problem set.")
    parser.add_argument("--lcplab", type=Path, default=ROOT / "target/release/lcplab", help="the program")
    return parser.parse_args()


def main() -> None:
    lcplab = arguments().lcplab.resolve()
    present = [adapter for adapter in PLUGINS if answers(adapter)]
    with tempfile.TemporaryDirectory() as place:
        subprocess.run([lcplab, "problems", "--export", "set"], cwd=place, check=True, stdout=subprocess.DEVNULL)
        index = list(csv.DictReader(Path(place, "set/index.csv").open(encoding="utf-8")))
        files = [row["file"] for row in index if int(row["rows"]) <= MOST]
        solvable = {row["file"] for row in index if "no solution" not in row["known"]}
        runs, loads = [], []
        for tolerance in ASKED:
            runs.append(run(lcplab, place, files, tolerance, present))
            loads.append(os.getloadavg()[2])
    results = by_problem(runs)
    OUT.write_text(page(lcplab, results, solvable & set(files), present, max(loads)), encoding="utf-8")
    print(OUT)


def answers(adapter: str) -> bool:
    """Whether the package of an adapter is installed: whether it answers anything."""
    command = [sys.executable, ROOT / f"examples/plugins/{adapter}.py"]
    problem = '{"A": {"dense": [[1]]}, "b": [-1], "lo": [0], "hi": ["inf"], "tolerance": 1e-8}\n'
    done = subprocess.run(command, input=problem, capture_output=True, text=True)
    if done.returncode:
        print(f"skipped: {adapter}: {done.stderr.strip().splitlines()[-1]}")
    return done.returncode == 0


def run(lcplab: Path, place: str, files: list[str], tolerance: float, present: list[str]) -> list[dict]:
    command = [lcplab, "compare", *(f"set/{file}" for file in files), "--json", "--tolerance", f"{tolerance:g}"]
    command += ["--solve-time-limit", f"{LIMIT:g}", "--plugin-time-limit", f"{START:g}"]
    for solver in OWN:
        command += ["--solver", solver]
    for adapter in present:
        command += ["--plugin", f"{sys.executable} {ROOT}/examples/plugins/{adapter}.py"]
    done = subprocess.run(command, cwd=place, capture_output=True, text=True)
    if not done.stdout:
        sys.exit(done.stderr)
    return json.loads(done.stdout)["rows"]


Results = dict[str, dict[str, list[dict]]]  # solver, problem, runs


def by_problem(runs: list[list[dict]]) -> Results:
    results: Results = defaultdict(lambda: defaultdict(list))
    for row in (row for rows in runs for row in rows):
        is_boxed = row["model"] in (None, "coupled-box")
        if is_boxed and row["outside"] < row["problems"]:
            results[row["solver"]][Path(row["family"]).name].append(row)
    return results


def time(rows: list[dict], accuracy: float) -> float | None:
    """The time of the fastest run that meets the accuracy within the limit."""
    met = [row["seconds"] for row in rows if row["accepted"] and row["worst_residual"] <= accuracy]
    return min((seconds for seconds in met if seconds <= LIMIT), default=None)


def mean(times: list[float | None]) -> float:
    """The shifted geometric mean in ms; a failure counts as the time limit."""
    logs = [math.log(SHIFT + (LIMIT if seconds is None else seconds)) for seconds in times]
    return 1000 * (math.exp(sum(logs) / len(logs)) - SHIFT)


def rejected(rows: list[dict]) -> bool:
    """Whether the judge rejects a claim, of the run that asks for lcplab's default tolerance."""
    row = rows[ASKED.index(1e-8)]
    return row["rejected_claims"] + row["false_claims"] > 0


def page(lcplab: Path, results: Results, solvable: set[str], present: list[str], load: float) -> str:
    problems = {solver: set(runs) & solvable for solver, runs in results.items()}
    common = sorted(set.intersection(*problems.values()))
    speeds, totals, claims = [], [], []
    for solver in [*present, *OWN]:
        runs = results[solver]
        cells = []
        for accuracy in REACHED:
            times = [time(runs[problem], accuracy) for problem in common]
            cells += [str(sum(seconds is not None for seconds in times)), f"{mean(times):.3g}"]
        speeds.append((mean([time(runs[problem], REACHED[-1]) for problem in common]), [named(solver), *cells]))
        solved = sum(time(runs[problem], REACHED[-1]) is not None for problem in problems[solver])
        wrong = sorted(problem for problem, rows in runs.items() if rejected(rows))
        totals.append([named(solver), str(len(problems[solver])), str(solved), str(len(wrong))])
        if wrong:
            names = ", ".join(f"`{name.removesuffix('.json')}`" for name in wrong)
            claims.append(f"- {named(solver)}: {names}")
    return f"""# Third-party solvers on the problem set

Recorded on {datetime.date.today().isoformat()}, on {machine(load)}, with {lcplab_version(lcplab)}, {versions(present)}.

The judge verified every answer. A solver *meets* an accuracy if it claims a solution, the judge accepts it, and its
scaled residual is below that accuracy. Each solver ran with the tolerances {", ".join(f"{t:.0e}".replace("e-0", "e-") for t in ASKED)}, and the fastest run
that meets the accuracy counts. The mean is the geometric mean of time + {1000 * SHIFT:g} ms, minus {1000 * SHIFT:g} ms; a failure counts as {LIMIT:g} s. If the
average load is above the number of processors, times are upper bounds. Times of
third-party solvers include the communication with a [plug-in](../docs/plugins.md). `python3 benches/third_party.py` repeats the measurement.

## Problems that all solvers attempt

{len(common)} problems of the set with up to {MOST} rows have a solution, a symmetric A, and the bounds 0 and ∞ in every row.

{table(["solver", "meets 1e-4", "mean (ms)", "meets 1e-8", "mean (ms)"], [cells for _, cells in sorted(speeds)])}

## All problems

The {len(solvable)} problems with up to {MOST} rows that have a solution. A solver does not attempt problems that it is not made for: nonsymmetric A, two-sided
bounds, or friction. The last column also counts problems without a solution.

{table(["solver", "attempted", "meets 1e-8", "claims rejected"], totals)}

The rejected claims, at tolerance 1e-8:

{chr(10).join(claims)}
"""


def named(solver: str) -> str:
    return PLUGINS[solver][0] if solver in PLUGINS else f"`{solver}`"


def table(head: list[str], rows: list[list[str]]) -> str:
    lines = [head, ["---", *("--:" for _ in head[1:])], *rows]
    return "\n".join(f"| {' | '.join(line)} |" for line in lines)


def machine(load: float) -> str:
    """The machine, and how many processes wanted a processor; those of this program are about one of them."""
    name = re.search(r"model name\s*: (.*)", Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    return f"{name[1] if name else platform.processor()}, {platform.freedesktop_os_release()['PRETTY_NAME']}, " + (
        f"{os.cpu_count()} processors, average load {load:.1f}"
    )


def lcplab_version(lcplab: Path) -> str:
    return subprocess.run([lcplab, "--version"], check=True, capture_output=True, text=True).stdout.strip()


def versions(present: list[str]) -> str:
    return ", ".join(f"{PLUGINS[adapter][1]} {known(PLUGINS[adapter][1])}" for adapter in present)


def known(package: str) -> str:
    try:
        return version(package)
    except PackageNotFoundError:  # Siconos may have no metadata
        return "of the system"


if __name__ == "__main__":
    main()

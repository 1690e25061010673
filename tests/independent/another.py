"""Is a solution the only one? Random problems of twelve rows: what lcplab proves, and what judge.py counts.

    another.py LCPLAB [NUMBER] [ROWS]     LCPLAB: the program; 24 problems of 12 rows

The entries are small integers, so that rows depend on each other and solutions are degenerate. Every second problem
has two bounds in each row. `lcplab prove --kind not-unique` must find a second solution exactly where judge.py, which
tries all active sets in exact arithmetic, counts several; proofs/lcpcheck.py checks both. Exit code: 1 if anything
differs.
"""
import json
import random
import subprocess
import sys
import tempfile
from collections import Counter
from pathlib import Path

import judge

CHECKER = Path(__file__).parents[2] / "proofs" / "lcpcheck.py"
ONLY_ONE = "all cases were tried, and there is no other solution"


def problem(draw, n, is_boxed):
    """Small integers; the diagonal decides whether the rows push each other apart."""
    diagonal = draw.choice([1, 2, 4])
    least = draw.choice([-1, 0])
    row = lambda i: [diagonal if i == j else draw.randint(least, 1) for j in range(n)]
    data = {"A": {"dense": [row(i) for i in range(n)]}, "b": [draw.randint(-3, 1) for _ in range(n)]}
    if is_boxed:
        data |= {"lo": [-1] * n, "hi": [1] * n}
    return data


def count(data):
    """0, 1 or 2 (several) solutions, with one of them."""
    split = judge.CaseSplit(judge.Problem(data))
    split.work = judge.INF
    return split.decide(how_many=True)


def proved(program, data, folder):
    """Whether lcplab proves that there are several; None if it does not decide."""
    file, proof = Path(folder, "problem.json"), Path(folder, "proof.json")
    file.write_text(json.dumps(data))
    proof.unlink(missing_ok=True)
    run = subprocess.run([program, "prove", file, "--kind", "not-unique", "--out", proof], capture_output=True, text=True)
    if run.returncode == 0:
        subprocess.run([sys.executable, CHECKER, file, proof], check=True, capture_output=True)
        return True
    return False if ONLY_ONE in run.stderr else None


def main(program, number=24, n=12):
    draw, seen = random.Random(53), Counter()
    with tempfile.TemporaryDirectory() as folder:
        for k in range(int(number)):
            data = problem(draw, int(n), is_boxed=k % 2 == 1)
            known, _ = count(data)
            if known == 0:
                seen["without a solution"] += 1
                continue
            own = proved(program, data, folder)
            seen[{1: "one", 2: "several"}[known], {True: "several", False: "one", None: "undecided"}[own]] += 1
            if own is not None and own != (known == 2):
                print("DIFFERS", json.dumps(data))
                seen["differs"] += 1
    print(", ".join(f"{key}: {value}" for key, value in sorted(seen.items(), key=str)))
    return 1 if seen["differs"] else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))

"""Run engines on phenomena and write what was found.

Examples:
  python -m lcplab.cards                                    # all that is installed, as a table
  python -m lcplab.cards --engine mujoco --phenomenon creep,lift
  python -m lcplab.cards --out results.json                 # for lcplab report engines
"""

from __future__ import annotations

import argparse
import json
import sys
from concurrent.futures import ProcessPoolExecutor
from typing import Any

from lcplab.cards._record import record
from lcplab.cards._run import Column, run, tasks
from lcplab.cards.phenomena import PHENOMENA
from lcplab.engines import NAMES, by_name


def main(arguments: list[str] | None = None) -> int:
    """Run the command and return its exit code: 0, or 2 for what cannot be understood or is not installed."""
    options = _parser().parse_args(arguments)
    names = [phenomenon.name for phenomenon in PHENOMENA]
    if options.list:
        for phenomenon in PHENOMENA:
            print(f"{phenomenon.name:<18} {phenomenon.question}")
        for name in NAMES:
            engine = by_name(name)
            state = engine.version if engine.is_installed else f"not installed: pip install {engine.package}"
            print(f"{name:<18} {state}")
        return 0
    asked = options.engine.split(",") if options.engine else list(NAMES)
    phenomena = options.phenomenon.split(",") if options.phenomenon else names
    for what, given, known in (("engine", asked, NAMES), ("phenomenon", phenomena, names)):
        for name in given:
            if name not in known:
                print(f"error: there is no {what} {name!r}; known are {', '.join(known)}", file=sys.stderr)
                return 2
    missing = [name for name in asked if not by_name(name).is_installed]
    for name in missing:
        print(f"skipped: {name} is not installed (pip install {by_name(name).package})", file=sys.stderr)
    if options.engine and missing:
        return 2
    found = _run_all([name for name in asked if name not in missing], phenomena, options.jobs)
    if options.out:
        with open(options.out, "w", encoding="utf-8") as out:
            json.dump(record(found), out, ensure_ascii=False, separators=(",", ":"))
            out.write("\n")
    print(_table(found))
    return 0


def _parser() -> argparse.ArgumentParser:
    about, examples = (__doc__ or "").split("\n\n", 1)
    parser = argparse.ArgumentParser(
        "python -m lcplab.cards",
        description=about,
        epilog=examples,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("--engine", metavar="NAMES", help="engines, with commas; all that are installed")
    parser.add_argument("--phenomenon", metavar="NAMES", help="phenomena, with commas; all")
    parser.add_argument("--out", metavar="FILE", help="write the record for `lcplab report engines`")
    parser.add_argument("--jobs", type=int, metavar="N", help="processes at a time; one a processor")
    parser.add_argument("--list", action="store_true", help="list phenomena and engines")
    return parser


def _run_all(engines: list[str], phenomena: list[str], jobs: int | None) -> list[tuple[str, Column]]:
    wanted = list(tasks(engines, phenomena))
    with ProcessPoolExecutor(jobs) as pool:
        waiting = [(phenomenon, pool.submit(run, *rest, phenomenon)) for *rest, phenomenon in wanted]
        found = []
        for done, (phenomenon, column) in enumerate(waiting, 1):
            found.append((phenomenon, column.result()))
            if sys.stderr.isatty():
                print(f"\r{done}/{len(waiting)} {phenomenon:<20}", end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty():
        print("\r" + " " * 40 + "\r", end="", file=sys.stderr)
    return found


def _table(found: list[tuple[str, Column]]) -> str:
    """A line an engine and phenomenon: what was measured, beside the law."""
    lines: list[list[Any]] = []
    for phenomenon, column in found:
        name = [phenomenon, column.engine, column.settings]
        why = column.unsupported or column.failed
        if why is not None:
            lines.append([*name, "–" if column.unsupported else "✗", why])
        for m in column.measured:
            law = f"{m.what} {m.value:.4g} {m.unit}; law {m.law:.4g} ± {m.tolerance:.2g}"
            lines.append([*name, "✓" if m.holds else "✗", law])
    widths = [max(len(line[k]) for line in lines) for k in range(4)]
    return "\n".join(
        "  ".join([*(cell.ljust(width) for cell, width in zip(line, widths)), line[4]]).rstrip() for line in lines
    )


if __name__ == "__main__":
    sys.exit(main())

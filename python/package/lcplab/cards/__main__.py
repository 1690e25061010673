"""Run engines on phenomena and write what was found.

Examples:
  python -m lcplab.cards                                    # all that is installed, as a table
  python -m lcplab.cards --engine mujoco --phenomenon creep,lift
  python -m lcplab.cards --report mine                      # mine/index.html, and the record beside it
  python -m lcplab.cards --merge a.json b.json --report mine
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Callable
from concurrent.futures import Future, ProcessPoolExecutor
from concurrent.futures.process import BrokenProcessPool
from pathlib import Path
from typing import Any

from lcplab import _lcplab
from lcplab.cards._record import merged, record
from lcplab.cards._run import Column, run, tasks
from lcplab.cards.phenomena import PHENOMENA
from lcplab.engines import NAMES, by_name


#: A report file that draws a record.
REPORT = """\
title = "Physics engines compared with closed-form solutions"
lead = ""

[[section]]
study = "cards"
record = {record}
"""


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
    if options.merge:
        return _merge(options)
    asked = list(NAMES) if options.engine is None else options.engine.split(",")
    phenomena = names if options.phenomenon is None else options.phenomenon.split(",")
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
    print(_table(found), flush=True)
    return _keep(options, lambda: record(found))


def _merge(options: argparse.Namespace) -> int:
    """Write the record of all files of ``--merge``."""
    try:
        records = [json.loads(Path(file).read_text(encoding="utf-8")) for file in options.merge]
        one = merged(records)
    except (OSError, ValueError, KeyError, TypeError) as error:
        reason = f"lacks the key {error}" if isinstance(error, KeyError) else error
        print(f"error: --merge: {reason}", file=sys.stderr)
        return 2
    return _keep(options, lambda: one)


def _keep(options: argparse.Namespace, made: Callable[[], dict[str, Any]]) -> int:
    """Write the record where the options want it."""
    if not (options.out or options.report):
        return 0
    own = made()
    if options.out:
        _write(Path(options.out), own)
    return _report(Path(options.report), own) if options.report else 0


def _write(file: Path, own: dict[str, Any]) -> None:
    text = json.dumps(own, ensure_ascii=False, separators=(",", ":"))
    file.write_text(text + "\n", encoding="utf-8")


def _report(folder: Path, own: dict[str, Any]) -> int:
    folder.mkdir(parents=True, exist_ok=True)
    record_file, file = folder / "engines.json", folder / "engines.toml"
    for written in (record_file, file):
        # The folder may come from a stranger, whose link could lead to any file of the user.
        if written.is_symlink():
            print(f"error: {written} is a symbolic link, and nothing is written through it: delete it", file=sys.stderr)
            return 2
    _write(record_file, own)
    file.write_text(REPORT.format(record=json.dumps(str(record_file))), encoding="utf-8")
    (folder / "results.json").unlink(missing_ok=True)  # what a stopped run has left is of another record
    return _lcplab.run(["lcplab", "report", str(file), "--out", str(folder)])


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
    parser.add_argument("--out", metavar="FILE", help="write the record, which a report file can name")
    parser.add_argument("--report", metavar="FOLDER", help="write the page, and the record beside it")
    parser.add_argument("--merge", nargs="+", metavar="FILE",
                        help="run nothing; merge these records, of engines in environments of their own")
    parser.add_argument("--jobs", type=int, metavar="N", help="processes at a time; one a processor")
    parser.add_argument("--list", action="store_true", help="list phenomena and engines")
    return parser


def _run_all(engines: list[str], phenomena: list[str], jobs: int | None) -> list[tuple[str, Column]]:
    wanted = list(tasks(engines, phenomena))
    with ProcessPoolExecutor(jobs) as pool:
        waiting = [(task[2], pool.submit(run, *task)) for task in wanted]
        found = []
        for done, (phenomenon, column) in enumerate(waiting, 1):
            found.append((phenomenon, _result(column, wanted[done - 1])))
            if sys.stderr.isatty():
                print(f"\r{done}/{len(waiting)} {phenomenon:<20}", end="", file=sys.stderr, flush=True)
    if sys.stderr.isatty():
        print("\r" + " " * 40 + "\r", end="", file=sys.stderr)
    return found


def _result(column: Future[Column], task: tuple[str, str, str]) -> Column:
    """What was found; where an engine took its process down with it, its task is tried again alone."""
    try:
        return column.result()
    except BrokenProcessPool:
        with ProcessPoolExecutor(1) as alone:
            try:
                return alone.submit(run, *task).result()
            except BrokenProcessPool:
                return Column(*task[:2], failed="the engine ended its process")


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

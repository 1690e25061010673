"""The command ``python -m lcplab.defects``."""

from __future__ import annotations

import argparse
import json
import platform
import sys
from pathlib import Path
from typing import Any

from lcplab.defects.environment import Environment, Unavailable
from lcplab.defects.known import DEFECTS, Defect


def row(defect: Defect, place: Path) -> dict[str, Any]:
    """Both releases of a defect: what their receipts say, or why one does not run here.

    The run of the bad release is compared with that of the mended one.
    """
    environment = Environment(place, defect.mended)
    recorded = environment.folder / f"{defect.name}.json"
    mended = _replayed(environment, defect.name, "--save", recorded)
    compared = ("--baseline", recorded) if "unavailable" not in mended else ()
    bad = _replayed(Environment(place, defect.bad), defect.name, *compared)
    facts = {"name": defect.name, "what": defect.what, "source": defect.source, "stage": defect.stage}
    return {**facts, "bad": bad, "mended": mended}


def _replayed(own: Environment, name: str, *more: str | Path) -> dict[str, Any]:
    try:
        own.install()
        return own.replay(name, *more)
    except Unavailable as why:
        return {"packages": list(own.packages), "unavailable": str(why)}


def outcome(reported: dict[str, Any]) -> str:
    """``"detected"``, ``"detected by comparison"`` with the mended release's run, ``"missed"``, ``"false alarm"`` or ``"skipped"``."""
    if any("unavailable" in reported[side] for side in ("bad", "mended")):
        return "skipped"
    if reported["mended"]["refused"]:
        return "false alarm"
    bad = reported["bad"]
    if bad["refused"]:
        return "detected" if bad["stage"] == reported["stage"] else "missed"
    # The errors that are compared are those of the solver.
    return "detected by comparison" if bad.get("worse") and reported["stage"] == "solver" else "missed"


def line(reported: dict[str, Any]) -> str:
    """A row of the table."""
    words = []
    for side in ("bad", "mended"):
        own = reported[side]
        if "unavailable" in own:
            words.append(f"{' '.join(own['packages'])}: {own['unavailable']}")
        else:
            words.append(f"{', '.join(own['versions'])}: {own['refused']} of {own['frames']} rejected")
    if outcome(reported) == "detected by comparison":
        words[0] += f", {reported['bad']['worse'][0]}"
    return f"{reported['name']:<18} {reported['stage']:<10} {outcome(reported):<11} {'; '.join(words)}"


def main() -> int:
    """Replay the defects that are named, or all; 1 if one that runs is not detected."""
    words = "Replay released defects of physics engines."
    parser = argparse.ArgumentParser(prog="python -m lcplab.defects", description=words)
    names = ", ".join(defect.name for defect in DEFECTS)
    parser.add_argument("names", nargs="*", metavar="NAME", help=f"{names}; all without a name")
    parser.add_argument("--environments", type=Path, default=Path.home() / ".cache" / "lcplab-defects",
                        metavar="FOLDER", help="where the releases are installed (about 6 GB)")
    parser.add_argument("--out", type=Path, metavar="FILE", help="record the results as JSON")
    options = parser.parse_args()
    unknown = set(options.names) - {defect.name for defect in DEFECTS}
    if unknown:
        parser.error(f"unknown: {', '.join(sorted(unknown))}")
    rows = []
    for defect in DEFECTS:
        if options.names and defect.name not in options.names:
            continue
        rows.append(row(defect, options.environments))
        print(line(rows[-1]), flush=True)
    if options.out:
        record = {"python": platform.python_version(), "defects": [{**reported, "outcome": outcome(reported)} for reported in rows]}
        options.out.write_text(json.dumps(record, indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    return 0 if all(outcome(reported) in ("detected", "detected by comparison", "skipped") for reported in rows) else 1


if __name__ == "__main__":
    sys.exit(main())

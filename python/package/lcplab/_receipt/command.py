"""The command ``lcplab receipts FRAMES...``."""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Sequence
from pathlib import Path

from lcplab._lcplab import InputError
from lcplab._receipt.junit import junit, sarif
from lcplab._receipt.runs import receipts

EXAMPLES = """\
Examples:
  lcplab receipts frames/                                # all STEM.json, each with its answer STEM.x.json
  lcplab receipts frames/ --baseline known.json --junit receipts.xml --sarif receipts.sarif
  lcplab receipts frames/ --baseline known.json --update

The exit code is 0 if at least one frame was checked, the baseline lists all rejected frames, and no quantile of the
motion error is worse than the baseline's. It is 1 otherwise, and 2 for invalid input, such as a problem without an
answer. With --update it is 0 for every valid input."""


def main(arguments: Sequence[str]) -> int:
    """Check the frames and write the requested files; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="lcplab receipts",
        description="Check steps of a physics engine: does the motion solve the problem that the engine posed?",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    frames = "problem files with the key motion and an answer STEM.x.json next to them, or folders of them"
    parser.add_argument("frames", nargs="+", type=Path, help=frames)
    parser.add_argument("--limit", type=float, help="largest motion error, relative to what the constraints change")
    parser.add_argument("--baseline", type=Path, help="recorded run; frames that it lists as rejected do not fail")
    parser.add_argument("--update", action="store_true", help="write this run to the baseline file")
    parser.add_argument("--junit", type=Path, metavar="FILE", help="write JUnit XML")
    parser.add_argument("--sarif", type=Path, metavar="FILE", help="write SARIF")
    parser.add_argument("--out", type=Path, metavar="FOLDER", help="write a folder for each rejected frame among the ten worst")
    parser.add_argument("--json", action="store_true", help="print one JSON object")
    options = parser.parse_args(arguments)
    if options.update and not options.baseline:
        parser.error("--update needs --baseline")
    try:
        run = receipts(options.frames, baseline=None if options.update else options.baseline, limit=options.limit)
        if not run.receipts:
            raise InputError(f"{options.frames[0]}: has no frames. A frame is a file STEM.json with its answer STEM.x.json in the same folder")
        if options.update:
            run.save(options.baseline)
        if options.junit:
            options.junit.write_text(junit(run), encoding="utf-8")
        if options.sarif:
            options.sarif.write_text(json.dumps(sarif(run), indent=1) + "\n", encoding="utf-8")
        if options.out:
            run.save_worst(options.out)
    except (InputError, OSError) as error:
        print("\n".join(f"error: {line}" for line in str(error).splitlines()), file=sys.stderr)
        return 2
    checked = {name: receipt.to_json() for name, receipt in run.receipts.items()}
    print(json.dumps({"ok": run.ok, **run.to_json(), "receipts": checked}) if options.json else run)
    return 0 if run.ok or options.update else 1

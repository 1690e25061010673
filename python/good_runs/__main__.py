"""Run the listed good releases and settings and count the good steps that are rejected: `python python/good_runs`.

Each release is installed in an environment of its own, as `python -m lcplab.defects` does; lcplab is the installed one. A step
counts as good if its true motion error (exact.py) is below the limit of its solver. The exit code is 1 if a good step is rejected.
"""

import argparse
import json
import os
import subprocess
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).parent


def main():
    parser = argparse.ArgumentParser(prog="python python/good_runs", description=__doc__.split(":")[0])
    parser.add_argument("--environments", type=Path, default=Path.home() / ".cache" / "lcplab-defects", metavar="FOLDER")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write the counts as JSON")
    parser.add_argument("--only", default="", metavar="WORDS", help="settings whose name or packages contain this")
    options = parser.parse_args()
    listed = tomllib.loads((HERE / "settings.toml").read_text(encoding="utf-8"))
    rows = []
    for setting in listed["setting"]:
        name = f"{' '.join(setting['packages'])}: {setting['name']}"
        if options.only in name:
            rows.append({"setting": name, **outcome(setting, listed["frames"], options.environments)})
            print(line(rows[-1]), flush=True)
    ran = [row for row in rows if "skipped" not in row]
    total = {key: sum(row[key] for row in ran) for key in ("frames", "good", "rejected")}
    print(f"{len(ran)} settings: {total['frames']} frames, {total['good']} good, {total['rejected']} of the good ones rejected")
    if options.out:
        options.out.write_text(json.dumps({**total, "settings": rows}, indent=1) + "\n", encoding="utf-8")
    return 1 if total["rejected"] or not ran else 0


def outcome(setting, frames, place):
    """The counts of a setting, from a process in its environment."""
    from lcplab.defects.environment import Environment, Unavailable

    environment = Environment(place, setting["packages"])
    try:
        environment.install()
    except Unavailable as why:
        return {"skipped": str(why)}
    command = [environment.python, HERE / "measure.py", json.dumps({**setting, "frames": frames})]
    done = subprocess.run(command, capture_output=True, text=True, env={**os.environ, "PYTHONNOUSERSITE": "1"}, cwd=environment.folder)
    if done.returncode:
        return {"skipped": (done.stderr.strip().splitlines() or ["no message"])[-1]}
    return json.loads(done.stdout.splitlines()[-1])


def line(row):
    if "skipped" in row:
        return f"skipped: {row['setting']}: {row['skipped']}"
    words = ", ".join(f"{count} {verdict}" for verdict, count in sorted(row["verdicts"].items()))
    return (f"{row['setting']}\n    {row['frames']} frames, at most {row['rows']} rows: {words}; {row['good']} good, "
            f"{row['rejected']} of them rejected; true error at most {row['largest']:.1e}, limit {row['limit']:.0e}")


if __name__ == "__main__":
    sys.exit(main())

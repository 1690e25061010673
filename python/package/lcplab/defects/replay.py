"""One scene with the engine of this environment: ``python -m lcplab.defects.replay NAME`` prints JSON.

``--save FILE`` records the run; ``--baseline FILE`` compares with a recorded one.
"""

from __future__ import annotations

import argparse
import json
from pathlib import Path
from typing import Any

from lcplab._receipt import Run, receipts
from lcplab.defects.scenes import SCENES


def replay(name: str, save: Path | None = None, baseline: Path | None = None) -> dict[str, Any]:
    """The run of a scene: what is rejected, at which stage, the first of it, and how it is worse than a recorded run."""
    run: Run = receipts(SCENES[name](), baseline=baseline)
    if save is not None:
        run.save(save)
    first = run.receipts[run.rejected[0]].rejected if run.rejected else None
    return {
        "versions": run.to_json()["versions"],
        "frames": len(run.receipts),
        "refused": len(run.rejected),
        "unconverged": len(run.unconverged),
        "stage": first.stage if first else None,
        "what": first.what if first else None,
        "largest_motion_error": max(run.errors, default=None),
        "worse": run.worse,
    }


if __name__ == "__main__":
    parser = argparse.ArgumentParser()
    parser.add_argument("name")
    parser.add_argument("--save", type=Path)
    parser.add_argument("--baseline", type=Path)
    options = parser.parse_args()
    print(json.dumps(replay(options.name, options.save, options.baseline)))

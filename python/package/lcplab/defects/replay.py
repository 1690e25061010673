"""One scene with the engine of this environment: ``python -m lcplab.defects.replay NAME`` prints JSON."""

from __future__ import annotations

import json
import sys
from typing import Any

from lcplab._receipt import Run, receipts
from lcplab.defects.scenes import SCENES


def replay(name: str) -> dict[str, Any]:
    """The run of a scene: what is rejected, at which stage, and the first of it."""
    run: Run = receipts(SCENES[name]())
    first = run.receipts[run.rejected[0]].rejected if run.rejected else None
    return {
        "versions": run.to_json()["versions"],
        "frames": len(run.receipts),
        "refused": len(run.rejected),
        "unconverged": len(run.unconverged),
        "stage": first.stage if first else None,
        "what": first.what if first else None,
        "largest_motion_error": max(run.errors, default=None),
    }


if __name__ == "__main__":
    print(json.dumps(replay(sys.argv[1])))

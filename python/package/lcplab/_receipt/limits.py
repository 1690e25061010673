"""The largest accepted differences of the stages that are checked in Python."""

from __future__ import annotations

#: Differences between two ways to compute the same number, relative to its terms, by the bits of the engine.
ROUNDING = {64: 1e-6, 32: 1e-3}

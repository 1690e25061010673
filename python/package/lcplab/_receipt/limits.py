"""The largest accepted motion errors, relative to what the constraints change.

Measured on 1,560 good frames of MuJoCo 4.0.1 and 3.12 (stack, humanoid, gripper, trees; both cones; three
solvers) and of MuJoCo Warp; see ``docs/ci.md``.
"""

from __future__ import annotations

#: By the solver's kind and the bits of its numbers.
LIMITS = {
    ("direct", 64): 1e-6,
    ("newton", 64): 2e-4,
    ("cg", 64): 1e-3,
    ("pgs", 64): 1e-3,
    ("direct", 32): 1e-3,
    ("newton", 32): 1e-3,
    ("cg", 32): 1e-2,
    ("pgs", 32): 1e-2,
}
#: An error above this fraction of its limit is worth a look.
NOTABLE = 0.1
#: Differences between two ways to compute the same number, relative to its terms, by the bits of the engine.
ROUNDING = {64: 1e-6, 32: 1e-3}


def limit_of(method: str, bits: int) -> float:
    """The limit for this kind of solver.

    Raises
    ------
    ValueError
        If there is no such kind.
    """
    if (method, bits) not in LIMITS:
        known = ", ".join(sorted({name for name, _ in LIMITS}))
        raise ValueError(f"method: unknown kind of solver {method!r} with {bits} bits; use one of {known}, with 32 or 64 bits")
    return LIMITS[method, bits]

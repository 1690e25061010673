"""The step of MJX's data, read and not changed: one world with pyramidal cones.

MJX has rows for all possible contacts; rows without entries are not in use. What kind a row is, and M, come from
MuJoCo's own data of the same position.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from lcplab._receipt import mujoco
from lcplab._receipt.step import Array, Row, Step, stored

PYRAMIDAL = 0


def is_mine(data: Any) -> bool:
    """Whether these are data of MJX."""
    return type(data).__module__.startswith("mujoco.mjx")


def read(model: Any, data: Any, qpos: Array) -> Step:
    """The step of a MuJoCo model's MJX data that was solved at this position.

    Raises
    ------
    TypeError
        If the cones are elliptic, or there are several worlds.
    """
    import mujoco as engine

    if int(model.opt.cone) != PYRAMIDAL:
        raise TypeError("MJX data with elliptic cones cannot be read; use pyramidal cones")
    if np.ndim(data.qpos) != 1:
        raise TypeError("data has several worlds: pass one of them, jax.tree.map(lambda value: value[0], data)")
    own = engine.MjData(model)
    own.qpos[:] = qpos
    for name in ("mocap_pos", "mocap_quat", "eq_active"):
        if hasattr(data, name):
            getattr(own, name)[:] = np.asarray(getattr(data, name))
    engine.mj_fwdPosition(model, own)
    jacobian, softness = _rows_of(data, "efc_J").reshape(-1, model.nv), _rows_of(data, "efc_D")
    # Comparisons with NaN are false, so that a row with NaN is kept, and rejected later.
    kept = np.flatnonzero(~((np.abs(jacobian).max(axis=1, initial=0.0) == 0) | np.isinf(softness) | (softness <= 0)))
    lo, hi, kinds = _bounds(own, len(jacobian))
    step = mujoco.read(model, own)
    return replace(
        step,
        engine="MJX",
        mass=stored(np.triu(mujoco.full_mass(model, own))),
        jacobian=stored(jacobian[kept]),
        bias=-_rows_of(data, "efc_aref")[kept],
        compliance=1 / softness[kept],
        target=np.array(data.qacc_smooth, dtype=float),
        motion=np.array(data.qacc, dtype=float),
        forces=_rows_of(data, "efc_force")[kept],
        lo=lo[kept],
        hi=hi[kept],
        friction_index=np.full(len(kept), -1, dtype=np.int64),
        mu=np.zeros(len(kept)),
        rows=[Row(f"{kinds[row]} {row}", kinds[row]) for row in kept],
        bits=8 * np.asarray(data.qacc).dtype.itemsize,
        iterations=0,
        has_converged=True,
        reported_push=np.array(data.qfrc_constraint, dtype=float),
        time=float(data.time),
        not_checked=["solver: the number of iterations, which MJX does not report"],
    )


def _rows_of(data: Any, name: str) -> Array:
    """An array of the rows; later versions have it in ``_impl``."""
    values = getattr(data, name) if hasattr(data, name) else getattr(data._impl, name)
    return np.asarray(values, dtype=float)


def _bounds(own: Any, n: int) -> tuple[Array, Array, list[str]]:
    """Equalities, then friction losses, then limits and contacts."""
    equalities, losses = int(own.ne), int(own.nf)
    lo, hi = np.zeros(n), np.full(n, np.inf)
    lo[:equalities] = -np.inf
    friction = slice(equalities, equalities + losses)
    hi[friction] = np.asarray(own.efc_frictionloss)[friction]
    lo[friction] = -hi[friction]
    rest = n - equalities - losses
    return lo, hi, ["equality"] * equalities + ["friction loss"] * losses + ["limit or contact"] * rest

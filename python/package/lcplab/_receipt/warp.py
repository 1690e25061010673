"""The step of one world of MuJoCo Warp's data, read and not changed.

M comes from MuJoCo's own data of the same position.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from lcplab._receipt import mujoco
from lcplab._receipt.step import Array, Row, Rows, Step, stored


def is_mine(data: Any) -> bool:
    """Whether these are data of MuJoCo Warp."""
    return type(data).__module__.startswith("mujoco_warp")


def worlds(data: Any) -> int:
    """The number of worlds."""
    return int(data.nworld)


def read(model: Any, data: Any, world: int, qpos: Array | None = None) -> Step:
    """The step of a world of a MuJoCo model's Warp data, solved at this position or at that of the data."""
    import mujoco as engine

    own = engine.MjData(model)
    own.qpos[:] = _of(data.qpos, world) if qpos is None else qpos
    engine.mj_fwdPosition(model, own)
    n = int(np.ravel(data.nefc.numpy())[world])
    rows = data.efc
    kinds, ids = (np.asarray(part.numpy()[world][:n], dtype=int) for part in (rows.type, rows.id))
    losses = _of(rows.frictionloss, world)[:n] if hasattr(rows, "frictionloss") else np.zeros(n)
    lo, hi = np.zeros(n), np.full(n, np.inf)
    lo[kinds == mujoco.EQUALITY] = -np.inf
    friction = (kinds == mujoco.FRICTION_DOF) | (kinds == mujoco.FRICTION_TENDON)
    lo[friction], hi[friction] = -losses[friction], losses[friction]
    index, mu = _cones(data, kinds, ids)
    lo[index >= 0] = -np.inf
    return replace(
        mujoco.read(model, own),
        engine="MuJoCo Warp",
        version=_version(),
        mass=stored(np.triu(mujoco.full_mass(model, own))),
        jacobian=stored(_jacobian(model, rows, world, n)),
        bias=-_of(rows.aref, world)[:n],
        compliance=1 / _of(rows.D, world)[:n],
        target=_of(data.qacc_smooth, world),
        motion=_of(data.qacc, world),
        forces=_of(rows.force, world)[:n],
        lo=lo,
        hi=hi,
        friction_index=index,
        mu=mu,
        rows=[_row(kind, number) for kind, number in zip(kinds, ids)],
        bits=32,
        iterations=int(np.ravel(data.solver_niter.numpy())[world]),
        has_converged=int(np.ravel(data.solver_niter.numpy())[world]) < int(model.opt.iterations),
        reported_push=_of(data.qfrc_constraint, world),
        time=float(np.ravel(data.time.numpy())[world]),
        not_checked=[],
    )


def _of(array: Any, world: int) -> Array:
    return np.array(array.numpy()[world], dtype=float)


def _version() -> str:
    from importlib.metadata import version

    return version("mujoco-warp")


def _jacobian(model: Any, rows: Any, world: int, n: int) -> Array:
    """J, (n, nv): dense, or by the columns of each row."""
    reported = np.array(rows.J.numpy()[world], dtype=float)
    if reported.ndim == 2 and reported.shape[1] >= model.nv > 1 and reported.shape[0] >= n:
        return reported[:n, : model.nv]
    values, columns = reported.reshape(-1), np.ravel(rows.J_colind.numpy()[world])
    counts, starts = np.ravel(rows.J_rownnz.numpy()[world]), np.ravel(rows.J_rowadr.numpy()[world])
    dense = np.zeros((n, model.nv))
    for row in range(n):
        own = slice(starts[row], starts[row] + counts[row])
        dense[row, columns[own]] = values[own]
    return dense


def _cones(data: Any, kinds: Rows, ids: Rows) -> tuple[Rows, Array]:
    """The normal row of each row of friction, and its coefficient."""
    index, mu = np.full(len(kinds), -1, dtype=np.int64), np.zeros(len(kinds))
    elliptic = np.flatnonzero(kinds == mujoco.ELLIPTIC)
    if len(elliptic) == 0:
        return index, mu
    contact = data.contact
    places, coefficients = contact.efc_address.numpy(), contact.friction.numpy()
    sizes = contact.dim.numpy()
    for number in np.unique(ids[elliptic]):
        rows = places[number][: sizes[number]]
        index[rows[1:]], mu[rows[1:]] = rows[0], coefficients[number][: sizes[number] - 1]
    return index, mu


def _row(kind: int, number: int) -> Row:
    import mujoco as engine

    word = engine.mjtConstraint(int(kind)).name.removeprefix("mjCNSTR_").lower().replace("_", " ")
    return Row(f"{word} {int(number)}", word)

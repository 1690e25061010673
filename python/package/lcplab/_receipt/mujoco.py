"""The step of MuJoCo's data, read and not changed.

MuJoCo's forces f minimize ½ fᵀ(A + R) f + fᵀ(J a* - aref) with A = J M⁻¹Jᵀ over boxes (pyramids, limits,
friction losses) or elliptic cones. So the motion is an acceleration (m/s²), x a force (N), R the compliance and
-aref the bias. After ``mj_step`` these are still those of the step that was taken.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import numpy as np

from lcplab._receipt.step import Array, Row, Rows, Step, Triplets, stored

METHODS = {0: "pgs", 1: "cg", 2: "newton"}
RK4, IMPLICIT_FAST = 1, 3
EQUALITY, FRICTION_DOF, FRICTION_TENDON, LIMIT_JOINT, LIMIT_TENDON, FRICTIONLESS, PYRAMID, ELLIPTIC = range(8)


def is_mine(model: Any) -> bool:
    """Whether this is a model of MuJoCo."""
    return type(model).__name__ == "MjModel"


def read(model: Any, data: Any) -> Step:
    """The step of these data."""
    import mujoco

    n = int(data.nefc)
    kinds = np.array(data.efc_type[:n], dtype=int)
    lo, hi = _bounds(data, kinds)
    index, mu = _cones(data, kinds)
    lo[index >= 0] = -np.inf
    scale = float(model.stat.meaninertia) * max(1, model.nv)
    most = int(model.opt.iterations)
    iterations = int(np.max(np.atleast_1d(data.solver_niter))) if n else 0
    mass = full_mass(model, data)
    return Step(
        engine="MuJoCo",
        version=mujoco.__version__,
        level="acceleration",
        mass=stored(np.triu(mass)),
        jacobian=jacobian(model, data),
        bias=-np.array(data.efc_aref[:n]),
        compliance=np.array(data.efc_R[:n]),
        target=np.array(data.qacc_smooth),
        motion=np.array(data.qacc),
        forces=np.array(data.efc_force[:n]),
        lo=lo,
        hi=hi,
        friction_index=index,
        mu=mu,
        rows=_rows(model, data, kinds),
        gravity=_gravity(model),
        method=METHODS[int(model.opt.solver)],
        iterations=iterations,
        has_converged=iterations < most,
        own_tolerance=float(np.sqrt(2 * model.opt.tolerance * scale)),
        reported_push=np.array(data.qfrc_constraint),
        settings=_settings(model),
        name=names_of(model).model,
        time=float(data.time),
        dof_bodies=names_of(model).dofs,
        not_checked=["solver: some trees are asleep"] if are_asleep(data) else [],
        no_bound=_no_bound(model, kinds),
    )


def full_mass(model: Any, data: Any) -> Array:
    """M, (nv, nv)."""
    import mujoco

    mass = np.zeros((model.nv, model.nv))
    try:
        mujoco.mj_fullM(model, data, mass)
    except TypeError:  # before MuJoCo 4
        mujoco.mj_fullM(model, mass, data.qM)
    return mass


def jacobian(model: Any, data: Any) -> Triplets:
    """The entries of J, (nefc, nv), that are not 0."""
    import mujoco

    n = int(data.nefc)
    values = np.asarray(data.efc_J).reshape(-1)
    if n == 0 or not mujoco.mj_isSparse(model):
        return stored(values[: n * model.nv].reshape(n, model.nv))
    columns = np.asarray(data.efc_J_colind).reshape(-1)
    counts, starts = np.asarray(data.efc_J_rownnz).reshape(-1)[:n], np.asarray(data.efc_J_rowadr).reshape(-1)[:n]
    # The entries of row i are at starts[i], starts[i] + 1, ...
    rows = np.repeat(np.arange(n), counts)
    places = np.arange(len(rows)) + np.repeat(starts - np.cumsum(counts) + counts, counts)
    kept = values[places] != 0
    places = places[kept]
    return rows[kept], columns[places].astype(np.int64), values[places].astype(float)


def _bounds(data: Any, kinds: Rows) -> tuple[Array, Array]:
    lo, hi = np.zeros(len(kinds)), np.full(len(kinds), np.inf)
    lo[kinds == EQUALITY] = -np.inf
    losses = (kinds == FRICTION_DOF) | (kinds == FRICTION_TENDON)
    loss = np.array(data.efc_frictionloss[: len(kinds)])
    lo[losses], hi[losses] = -loss[losses], loss[losses]
    return lo, hi


def _cones(data: Any, kinds: Rows) -> tuple[Rows, Array]:
    """The normal row of each row of friction, and its coefficient."""
    index, mu = np.full(len(kinds), -1, dtype=np.int64), np.zeros(len(kinds))
    elliptic = np.flatnonzero(kinds == ELLIPTIC)
    if len(elliptic) == 0:
        return index, mu
    numbers = np.array(data.efc_id)[elliptic]
    # The place of a row in its contact: 0 for the normal.
    place = elliptic - np.array(data.contact.efc_address)[numbers]
    friction = place > 0
    index[elliptic[friction]] = (elliptic - place)[friction]
    mu[elliptic[friction]] = np.array(data.contact.friction)[numbers[friction], place[friction] - 1]
    return index, mu


class Names:
    """The names of a compiled model, which do not change."""

    def __init__(self, model: Any) -> None:
        import mujoco

        self.objects = mujoco.mjtObj
        body = self.objects.mjOBJ_BODY
        self.model = model.names.split(b"\0")[0].decode() or "model"
        self.bodies = [_name(model, body, number) for number in range(model.nbody)]
        self.dofs = [self.bodies[number] for number in model.dof_bodyid]
        self.geoms = [self.bodies[number] for number in model.geom_bodyid]
        words = (kind.name.removeprefix("mjCNSTR_").lower().replace("_", " ") for kind in map(mujoco.mjtConstraint, range(8)))
        self.kinds = list(words)


_names: tuple[Any, Names] | None = None


def names_of(model: Any) -> Names:
    """The names of the model that was read last are kept, together with it, because threads may read several."""
    global _names
    kept = _names
    if kept is None or kept[0] is not model:
        kept = _names = model, Names(model)
    return kept[1]


_last_rows: tuple[Any, list[bytes], tuple[Row, ...]] | None = None


def _rows(model: Any, data: Any, kinds: Rows) -> tuple[Row, ...]:
    """The names of all rows; those of the step that was read last are kept, if this step has the same rows."""
    global _last_rows
    numbers, shapes = np.array(data.efc_id[: len(kinds)]), shapes_of(data)
    key, kept = [kinds.tobytes(), numbers.tobytes(), shapes.tobytes()], _last_rows
    if kept is None or kept[0] is not model or kept[1] != key:
        names, listed = names_of(model), shapes.tolist()
        pairs = list(zip(kinds.tolist(), numbers.tolist()))
        own = {pair: _row(model, names, listed, *pair) for pair in dict.fromkeys(pairs)}
        kept = _last_rows = model, key, tuple(own[pair] for pair in pairs)
    return kept[2]


def _row(model: Any, names: Names, shapes: list[list[int]], kind: int, number: int) -> Row:
    """The names of the rows of an equality, a limit, a friction loss or a contact."""
    objects, word = names.objects, names.kinds[kind]
    if kind == EQUALITY:
        return Row(f"{word} {_name(model, objects.mjOBJ_EQUALITY, number)}", word)
    if kind == FRICTION_DOF:
        return Row(f"{word} {number}", word, (names.dofs[number],))
    if kind == LIMIT_JOINT:
        label = f"{word} {_name(model, objects.mjOBJ_JOINT, number)}"
        return Row(label, word, (names.bodies[model.jnt_bodyid[number]],))
    if kind in (FRICTION_TENDON, LIMIT_TENDON):
        return Row(f"{word} {_name(model, objects.mjOBJ_TENDON, number)}", word)
    first, second = (names.geoms[geom] if geom >= 0 else "flex" for geom in shapes[number])
    return _contact_row(word, number, first, second)


@lru_cache(4096)
def _contact_row(word: str, number: int, first: str, second: str) -> Row:
    return Row(f"{word} {number}: {first}, {second}", word, (first, second))


def shapes_of(data: Any) -> Rows:
    """The numbers of the two shapes of each contact, (ncon, 2); -1 for a flex."""
    return np.array(data.contact.geom, dtype=np.int64).reshape(-1, 2)


def _name(model: Any, kind: Any, number: int) -> str:
    import mujoco

    word = kind.name.removeprefix("mjOBJ_").lower()
    return str(mujoco.mj_id2name(model, kind, int(number)) or f"{word} {int(number)}")


def _gravity(model: Any) -> float:
    """The change of the motion by gravity, in the norm of M, 0 where it is disabled."""
    if is_disabled(model, "GRAVITY"):
        return 0.0
    moving = float(np.sum(model.body_mass[model.body_weldid > 0]))
    return float(np.linalg.norm(model.opt.gravity) * np.sqrt(moving))


def _settings(model: Any) -> dict[str, Any]:
    names = ("timestep", "integrator", "cone", "jacobian", "solver", "tolerance", "iterations", "ls_iterations",
             "ls_tolerance", "impratio", "noslip_iterations", "disableflags", "enableflags")
    return {name: getattr(model.opt, name) for name in names if hasattr(model.opt, name)}


def _no_bound(model: Any, kinds: Rows) -> str:
    """Why the motion of these rows has no bound; "" if it has one."""
    if model.opt.noslip_iterations and np.isin(kinds, [FRICTION_DOF, FRICTION_TENDON, PYRAMID, ELLIPTIC]).any():
        return "because noslip iterations change the forces after the solve"
    if has_effective_mass(model):
        return "because the integrator solves with an effective mass, which lcplab does not read"
    return ""


def has_effective_mass(model: Any) -> bool:
    """Whether u* and the solve use M + h B + h² K: the integrator ``discrete``, and others that are newer."""
    return int(model.opt.integrator) > IMPLICIT_FAST


def never_checked(model: Any, data: Any) -> list[str]:
    """The parts of a step of this model that no check covers."""
    parts = ["write-back: the position after the step"]
    if data.nefc:
        parts.append("assembly: compliance of rows (solref, solimp, impratio), margins and gaps of contacts")
    if np.any(model.tendon_limited) or np.any(model.tendon_frictionloss):
        parts.append("assembly: rows of limits and friction losses of tendons (presence, J, distance, bounds)")
    if np.any(model.eq_type > 2):
        parts.append("assembly: rows of equalities of tendons and flexes (presence)")
    if model.nu:
        parts.append("assembly: transmissions of actuators")
    return parts


def are_asleep(data: Any) -> bool:
    """Whether some trees are asleep."""
    trees = getattr(data, "tree_asleep", None)
    return trees is not None and bool((trees >= 0).any())


def is_disabled(model: Any, *names: str) -> bool:
    """Whether one of these flags is set, as far as this version has them."""
    import mujoco

    flags = mujoco.mjtDisableBit
    bits = [getattr(flags, f"mjDSBL_{name}", None) for name in names]
    return any(bit is not None and model.opt.disableflags & int(bit) for bit in bits)

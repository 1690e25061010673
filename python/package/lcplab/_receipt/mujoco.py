"""The step of MuJoCo's data, read and not changed.

MuJoCo's forces f minimize ½ fᵀ(A + R) f + fᵀ(J a* - aref) with A = J M⁻¹Jᵀ over boxes (pyramids, limits,
friction losses) or elliptic cones. So the motion is an acceleration (m/s²), x a force (N), R the compliance and
-aref the bias. After ``mj_step`` these are still those of the step that was taken.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt.step import Array, Row, Rows, Step, stored

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
        jacobian=stored(jacobian(model, data)),
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
        name=model.names.split(b"\0")[0].decode() or "model",
        time=float(data.time),
        dof_bodies=[_name(model, mujoco.mjtObj.mjOBJ_BODY, body) for body in model.dof_bodyid],
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


def jacobian(model: Any, data: Any) -> Array:
    """J, (nefc, nv)."""
    import mujoco

    n = int(data.nefc)
    dense = np.zeros((n, model.nv))
    if n == 0:
        return dense
    if not mujoco.mj_isSparse(model):
        return np.array(data.efc_J).reshape(-1)[: n * model.nv].reshape(n, model.nv)
    values, columns = np.asarray(data.efc_J).reshape(-1), np.asarray(data.efc_J_colind).reshape(-1)
    counts, starts = np.asarray(data.efc_J_rownnz).reshape(-1), np.asarray(data.efc_J_rowadr).reshape(-1)
    for row in range(n):
        own = slice(starts[row], starts[row] + counts[row])
        dense[row, columns[own]] = values[own]
    return dense


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
    row = 0
    while row < len(kinds):
        if kinds[row] != ELLIPTIC:
            row += 1
            continue
        contact = data.contact[int(data.efc_id[row])]
        friction = slice(row + 1, row + contact.dim)
        index[friction], mu[friction] = row, contact.friction[: contact.dim - 1]
        row += int(contact.dim)
    return index, mu


def _rows(model: Any, data: Any, kinds: Rows) -> list[Row]:
    numbers = np.array(data.efc_id[: len(kinds)]).tolist()
    own: dict[tuple[int, int], Row] = {}
    for kind, number in dict.fromkeys(zip(kinds.tolist(), numbers)):
        own[kind, number] = _row(model, data, kind, number)
    return [own[pair] for pair in zip(kinds.tolist(), numbers)]


def _row(model: Any, data: Any, kind: int, number: int) -> Row:
    """The names of the rows of an equality, a limit, a friction loss or a contact."""
    import mujoco

    objects = mujoco.mjtObj
    word = mujoco.mjtConstraint(kind).name.removeprefix("mjCNSTR_").lower().replace("_", " ")

    def body(place: int) -> str:
        return _name(model, objects.mjOBJ_BODY, place)

    if kind == EQUALITY:
        return Row(f"{word} {_name(model, objects.mjOBJ_EQUALITY, number)}", word)
    if kind == FRICTION_DOF:
        return Row(f"{word} {number}", word, (body(model.dof_bodyid[number]),))
    if kind == LIMIT_JOINT:
        label = f"{word} {_name(model, objects.mjOBJ_JOINT, number)}"
        return Row(label, word, (body(model.jnt_bodyid[number]),))
    if kind in (FRICTION_TENDON, LIMIT_TENDON):
        return Row(f"{word} {_name(model, objects.mjOBJ_TENDON, number)}", word)
    shapes = shapes_of(data.contact[number])
    pair = tuple(body(model.geom_bodyid[geom]) if geom >= 0 else "flex" for geom in shapes)
    return Row(f"{word} {number}: {pair[0]}, {pair[1]}", word, pair)


def shapes_of(contact: Any) -> tuple[int, ...]:
    """The numbers of a contact's two shapes; -1 for a flex."""
    return tuple(int(geom) for geom in np.ravel(contact.geom))


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
    if data.ncon:
        parts.append("collision: positions and normals of contacts")
    if data.nefc:
        parts.append("assembly: coefficients of friction, and compliance of rows (solref, solimp)")
    if np.any(model.jnt_limited) or np.any(model.tendon_limited):
        parts.append("assembly: rows of limits (presence, J, distance)")
    if np.any(model.dof_frictionloss) or np.any(model.tendon_frictionloss):
        parts.append("assembly: rows of friction losses (presence, J, bounds)")
    if np.any(model.eq_type > 2):
        parts.append("assembly: rows of equalities of tendons and flexes (presence)")
    if model.nu:
        parts.append("assembly: transmissions of actuators")
    return parts


def are_asleep(data: Any) -> bool:
    """Whether some trees are asleep."""
    return bool(np.any(getattr(data, "tree_asleep", np.array([-1])) >= 0))


def is_disabled(model: Any, *names: str) -> bool:
    """Whether one of these flags is set, as far as this version has them."""
    import mujoco

    flags = mujoco.mjtDisableBit
    bits = [getattr(flags, f"mjDSBL_{name}", None) for name in names]
    return any(bit is not None and model.opt.disableflags & int(bit) for bit in bits)

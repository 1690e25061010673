"""The stage assembly of MuJoCo: M, J, bias forces, u* and the reference accelerations, computed independently.

Masses and Jacobians come from differences of poses, so that a wrong arm, sign or missing J̇v shows. Errors of entries
are relative to their terms; errors of generalized forces f are what they change, |M⁻¹f|_M, relative to the larger of
the change that the constraints cause and of u*.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from lcplab._receipt import mujoco as reader
from lcplab._receipt import mujoco_contacts, mujoco_limits, mujoco_presence
from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.kept import Kept
from lcplab._receipt.kinematics import Kinematics, cross, interval, scratch
from lcplab._receipt.step import Array, Rows, Step

#: The largest accepted errors of first and second differences of poses, and of reference accelerations with J̇v.
FIRST, SECOND, REFERENCE = 1e-5, 1e-4, 1e-2
#: The largest accepted error of a violation, relative to itself and the distance of the bodies from the origin, at least 1 m.
VIOLATION = 1e-9
#: The largest number of degrees of freedom: with more, differences of poses take too long.
MOST_DOFS = 3_000
#: Equalities whose reference contains J̇v: connect and weld.
BENT = (0, 1)
#: Actuators of groups 0 to 30 can be disabled.
GROUPS = 31

Flags = NDArray[np.bool_]


def check(model: Any, data: Any, step: Step, qpos: Array, qvel: Array) -> Report:
    """All parts of the assembly that can be computed independently, at the state of the step."""
    report = Report()
    if model.nv > MOST_DOFS:
        report.not_checked.append(f"assembly: the model has more than {MOST_DOFS} degrees of freedom")
        return report
    if model.nv == 0:
        return report
    motion = Kinematics(model, data, qpos)
    report.add(_mass(model, step, motion))
    actuators = _actuators(model, data)
    passive, unknown = _passive(model, data, qpos, qvel)
    if reader.has_effective_mass(model):
        report.not_checked.append("assembly: u* and reference accelerations, which contain the integrator's effective mass")
    forces = [_bias_forces(model, data, motion, qvel), _free_motion(model, data, step, motion), passive]
    report.findings += _forces(step, [own for own in forces if own is not None])
    report.add(actuators)
    report.not_checked += unknown
    report.add(mujoco_presence.check(model, data, motion))
    report.add(mujoco_limits.check(model, data, step, qpos))
    if len(step):
        report.add(mujoco_contacts.check(model, data, step, motion))
        report.add(_equalities(model, data, step, motion))
    if len(step) and not reader.has_effective_mass(model):
        report.add(_references(model, data, step, motion, qvel))
        report.add(_dual(data, step))
    return report


def _has_armature(model: Any) -> bool:
    """Whether tendons or actuators have armature, which adds to M and to the bias forces."""
    return _has_any(model, "tendon_armature", "actuator_armature")


def _worst(what: str, difference: Array, terms: Array, limit: float, rows: Rows | None = None) -> Finding:
    """The largest difference relative to its terms, which count at least a millionth of the largest."""
    floor = 1e-6 * max(float(np.abs(terms).max(initial=0.0)), 1e-300)
    errors = np.abs(difference) / np.maximum(np.abs(terms), floor)
    row = None if rows is None else int(rows[np.argmax(errors)])
    return Finding("assembly", what, float(errors.max(initial=0.0)), limit, row)


def _inertia(model: Any, motion: Kinematics) -> Array:
    """Moments of inertia in world axes, (bodies, 3, 3)."""
    axes = motion.axes
    return np.asarray(np.einsum("bij,bj,bkj->bik", axes, model.body_inertia, axes), dtype=float)


def _mass(model: Any, step: Step, motion: Kinematics) -> Report:
    if _has_armature(model):
        return Report(not_checked=["assembly: M and bias forces, because of armature of tendons or actuators"])
    inertia, own = _inertia(model, motion), np.zeros((model.nv, model.nv))
    for bodies, dofs in motion.trees:
        linear, angular = motion.of_trees(bodies, dofs)
        masses = np.asarray(model.body_mass)[bodies][:, :, None, None]
        turned = inertia[bodies] @ angular
        parts = ((linear, masses * linear), (angular, turned))
        flat = [[part.reshape(len(bodies), -1, dofs.shape[1]) for part in pair] for pair in parts]
        blocks = sum(np.swapaxes(left, 1, 2) @ right for left, right in flat)
        own[dofs[:, :, None], dofs[:, None, :]] = blocks
    own += np.diag(model.dof_armature)
    root = np.sqrt(np.diag(own))
    return Report([_worst("M is not that of masses and differences of poses", step.dense_mass() - own, np.outer(root, root), FIRST)])


@dataclass(frozen=True)
class Difference:
    """A difference of generalized forces, its limit, and the size of terms that may cancel."""

    what: str
    values: Array
    limit: float
    size: float = 0.0


def _forces(step: Step, differences: Sequence[Difference]) -> list[Finding]:
    """Errors of generalized forces, as the motions that they cause."""
    if not differences:
        return []
    changes = step.mass_blocks.solve(np.column_stack([own.values for own in differences])).T
    least = max(step.effect, step.norm(step.target), 1e-300)
    findings = []
    for own, change in zip(differences, changes):
        worst = int(np.argmax(np.abs(change)))
        bodies = (step.dof_bodies[worst],) if worst < len(step.dof_bodies) else ()
        error = step.norm(change) / max(least, own.size)
        findings.append(Finding("assembly", own.what, error, own.limit, None, bodies))
    return findings


def _bias_forces(model: Any, data: Any, motion: Kinematics, qvel: Array) -> Difference | None:
    if _has_armature(model):
        return None
    linear, angular = motion.accelerations(qvel)
    gravity = np.zeros(3) if reader.is_disabled(model, "GRAVITY") else np.asarray(model.opt.gravity)
    inertia = _inertia(model, motion)
    turning = motion.angular @ qvel
    forces = model.body_mass[:, None] * (linear - gravity)
    momentum = np.einsum("bij,bj->bi", inertia, turning)
    torques = np.einsum("bij,bj->bi", inertia, angular) + cross(turning, momentum)
    own = _to_dofs(motion, forces, torques)
    what = "the bias forces (gravity, Coriolis, centrifugal) differ from those computed from poses"
    size = float(np.sqrt(np.sum(model.body_mass * np.sum(linear**2, axis=1))))
    size += motion.rounding(qvel) * float(np.sqrt(model.body_mass.sum())) / SECOND
    return Difference(what, data.qfrc_bias - own, SECOND, size)


def _to_dofs(motion: Kinematics, forces: Array, torques: Array) -> Array:
    linear, angular = motion.flat()
    return np.asarray(forces.ravel() @ linear + torques.ravel() @ angular)


def _free_motion(model: Any, data: Any, step: Step, motion: Kinematics) -> Difference | None:
    """M u* against the sum of the forces, outer ones by differences of poses."""
    if reader.has_effective_mass(model):
        return None
    outer = _to_dofs(motion, data.xfrc_applied[:, :3], data.xfrc_applied[:, 3:])
    parts = [data.qfrc_passive, -data.qfrc_bias, data.qfrc_applied, data.qfrc_actuator, outer]
    what = "the motion without constraints u* does not follow from the applied, passive, bias and actuator forces"
    return Difference(what, step.times_mass(step.target) - np.sum(parts, axis=0), FIRST)


def _actuators(model: Any, data: Any) -> Report:
    """Forces of actuators without dynamics and with a gain that is a number, from the controls."""
    if model.nu == 0 or reader.is_disabled(model, "ACTUATION"):
        return Report()
    if len(data.actuator_force) != model.nu or len(model.actuator_gainprm) != model.nu:
        return Report(not_checked=["assembly: forces of actuators, some of which have several controls or outputs"])
    plain = _are_plain(model)
    report = Report()
    if not plain.all():
        why = "dynamics, gains that are not constant, or a limit of their tendon's force"
        report.not_checked.append(f"assembly: forces of {int(np.sum(~plain))} actuators with {why}")
    force, terms = _actuator_forces(model, data)
    difference = np.where(plain, data.actuator_force - force, 0.0)
    what = "the force of an actuator does not follow from its control"
    report.findings.append(_worst(what, difference, terms, FIRST))
    return report


def _are_plain(model: Any) -> Flags:
    """The actuators whose force follows from their control, length and velocity, (nu,)."""
    import mujoco

    plain: Flags = np.asarray(model.actuator_dyntype) == int(mujoco.mjtDyn.mjDYN_NONE)
    plain &= model.actuator_gaintype == int(mujoco.mjtGain.mjGAIN_FIXED)
    plain &= model.actuator_biastype <= int(mujoco.mjtBias.mjBIAS_AFFINE)
    delayed = np.asarray(getattr(model, "actuator_history", np.zeros((model.nu, 1)))).reshape(model.nu, -1)
    plain &= ~delayed.any(axis=1)
    limited = np.asarray(getattr(model, "tendon_actfrclimited", np.zeros(model.ntendon)), dtype=bool)
    is_tendon = model.actuator_trntype == int(mujoco.mjtTrn.mjTRN_TENDON)
    tendons = model.actuator_trnid[is_tendon, 0]
    plain[is_tendon] &= ~limited[tendons]
    return plain


def _actuator_forces(model: Any, data: Any) -> tuple[Array, Array]:
    """The forces of plain actuators, 0 in disabled groups, and the sums of the sizes of their terms, (nu,)."""
    import mujoco

    limited = np.asarray(model.actuator_ctrllimited, dtype=bool) & (not reader.is_disabled(model, "CLAMPCTRL"))
    low, high = model.actuator_ctrlrange.T
    control = np.where(limited, np.clip(data.ctrl, low, high), data.ctrl)
    bias = model.actuator_biasprm[:, :3].copy()
    bias[model.actuator_biastype == int(mujoco.mjtBias.mjBIAS_NONE)] = 0.0
    terms = np.array([model.actuator_gainprm[:, 0] * control, bias[:, 0], bias[:, 1] * data.actuator_length,
                      bias[:, 2] * data.actuator_velocity])
    force = terms.sum(axis=0)
    bounded = np.asarray(model.actuator_forcelimited, dtype=bool)
    low, high = model.actuator_forcerange.T
    force = np.where(bounded, np.clip(force, low, high), force)
    groups = np.asarray(model.actuator_group)
    disabled = (groups >= 0) & (groups < GROUPS) & ((int(model.opt.disableactuator) >> np.clip(groups, 0, GROUPS)) & 1 > 0)
    return np.where(disabled, 0.0, force), np.abs(terms).sum(axis=0)


def _passive(model: Any, data: Any, qpos: Array, qvel: Array) -> tuple[Difference | None, list[str]]:
    """Springs and dampers of joints, or what is not checked."""
    found, springs = _springs(model)
    if np.any(getattr(data, "qfrc_adhesion", 0.0)):
        found = [*found, "adhesion"]
    if found or springs is None:
        return None, [f"assembly: passive forces, because of {', '.join(found)}"]
    damper = -springs.damping * qvel
    damper[springs.dofs] -= springs.stiffness * (qpos[springs.places] - springs.rest)
    what = "the passive forces differ from those of the joints' springs and dampers"
    return Difference(what, data.qfrc_passive - damper, FIRST), []


@dataclass(frozen=True)
class Springs:
    """Springs and dampers of joints.

    Attributes
    ----------
    damping : (k,)
        That of each degree of freedom (N s/m, N m s/rad).
    dofs, places, stiffness, rest : arrays
        Degree of freedom, place in qpos, stiffness (N/m, N m/rad) and position at rest (m, rad) of each joint with one axis.
    """

    damping: Array
    dofs: Rows
    places: Rows
    stiffness: Array
    rest: Array


def _springs_of(model: Any) -> tuple[list[str], Springs | None]:
    """What makes passive forces something else than springs and dampers of joints, and these."""
    import mujoco

    others = {
        "tendons": model.ntendon and (_has_any(
            model, "tendon_stiffness", "tendon_damping", "tendon_stiffnesspoly", "tendon_dampingpoly")),
        "fluid": model.opt.density or model.opt.viscosity,
        "flexes": getattr(model, "nflex", 0),
        "gravity compensation": np.any(model.body_gravcomp),
        "plug-ins": model.nplugin,
        "actuators with damping": np.any(getattr(model, "actuator_damping", 0.0)),
        "plastic springs": getattr(model, "nplastic", 0),
    }
    stiffness, damping = _linear(model.jnt_stiffness), _linear(model.dof_damping)
    turning = np.isin(model.jnt_type, [int(mujoco.mjtJoint.mjJNT_FREE), int(mujoco.mjtJoint.mjJNT_BALL)])
    found = [name for name, has in others.items() if has]
    is_linear = not _has_any(model, "jnt_stiffnesspoly", "dof_dampingpoly", "actuator_dampingpoly")
    if not is_linear or stiffness is None or damping is None or np.any(stiffness[turning]):
        found.append("springs and dampers that are not linear")
    if reader.is_disabled(model, "PASSIVE", "SPRING", "DAMPER"):
        found.append("disabled passive forces")
    if stiffness is None or damping is None:
        return found, None
    straight = np.flatnonzero(~turning)
    places = np.array(model.jnt_qposadr)[straight]
    dofs, rest = np.array(model.jnt_dofadr)[straight], np.array(model.qpos_spring)[places]
    return found, Springs(damping.copy(), dofs, places, stiffness[straight], rest)


_springs = Kept(
    _springs_of, "opt.disableflags", "opt.density", "opt.viscosity", "tendon_stiffness", "tendon_damping",
    "tendon_stiffnesspoly", "tendon_dampingpoly", "body_gravcomp", "actuator_damping", "actuator_dampingpoly",
    "jnt_stiffness", "jnt_stiffnesspoly", "dof_damping", "dof_dampingpoly", "qpos_spring",
)


def _has_any(owner: Any, *names: str) -> bool:
    """Whether one of these arrays, as far as this version has them, has an entry that is not 0."""
    return any(np.any(getattr(owner, name, 0.0)) for name in names)


def _linear(coefficients: Any) -> Array | None:
    """Coefficients of linear springs or dampers; None where there are others."""
    table = np.asarray(coefficients, dtype=float)
    if table.ndim == 1:
        return table
    return None if np.any(table[:, 1:]) else table[:, 0]


def _equalities(model: Any, data: Any, step: Step, motion: Kinematics) -> Report:
    """J of equalities, from differences of their violations along a velocity with all degrees of freedom."""
    rows = np.flatnonzero(np.array(data.efc_type[: len(step)]) == reader.EQUALITY)
    if len(rows) == 0:
        return Report()
    velocity = np.random.default_rng(0).normal(size=model.nv)
    size = motion.first / float(np.abs(velocity).max())
    violations = _violations(model, data, len(rows), motion.qpos, velocity, size)
    if violations is None:
        return Report(not_checked=["assembly: J of equalities, whose number of rows changes"])
    rate = (violations[2] - violations[0]) / (2 * size)
    scale = step.size_along(velocity)[rows] + np.abs(rate)
    what = "J of an equality is not the rate of its violation"
    report = Report([_worst(what, step.along(velocity)[rows] - rate, scale, SECOND, rows)])
    off = np.array(data.efc_pos)[rows] - violations[1]
    # Positions are rounded at the distance from the origin, and a violation is their difference.
    terms = np.abs(violations[1]) + motion.reach
    report.findings.append(_worst("the violation of an equality is not that of its poses", off, terms, VIOLATION, rows))
    return report


def _references(model: Any, data: Any, step: Step, motion: Kinematics, qvel: Array) -> Report:
    """The reference accelerations of all rows, from their springs and dampers, and J̇v of equalities."""
    n = len(step)
    spring, damper, impedance = np.array(data.efc_KBIP[:n]).reshape(n, 4)[:, :3].T
    position = np.array(data.efc_pos[:n]) - np.array(data.efc_margin[:n])
    bends = _bends(model, data, n, motion, qvel)
    if bends is None:
        return Report(not_checked=["assembly: reference accelerations, because the number of equality rows changes"])
    terms = np.array([damper * step.along(qvel), spring * impedance * position, bends])
    sizes = np.abs(terms).sum(axis=0)
    # The terms of J v may cancel; with J̇v the limit is wide enough for that.
    sizes += np.where(bends != 0, 0.0, np.abs(damper) * step.size_along(qvel))
    difference = np.abs(np.array(data.efc_aref[:n]) + terms.sum(axis=0))
    report = Report()
    special = _with_own_references(model, data, n)
    if special.any():
        report.not_checked.append("assembly: reference accelerations of contacts with adhesion or a surface velocity")
        difference[special] = 0.0
    scale = np.maximum(sizes, 1e-6 * max(float(sizes.max(initial=0.0)), step.gravity))
    scale += np.where(bends != 0, motion.rounding(qvel) / REFERENCE, 0.0)
    limits = np.where(bends != 0, REFERENCE, FIRST)
    errors = difference / np.maximum(scale, 1e-300)
    worst = int(np.argmax(errors / limits))
    what = "the reference acceleration of a row does not follow from its spring, damper and J̇v"
    report.findings.append(
        Finding("assembly", what, float(errors[worst]), float(limits[worst]), worst, step.rows[worst].bodies)
    )
    return report


def _bends(model: Any, data: Any, n: int, motion: Kinematics, qvel: Array) -> Array | None:
    """J̇v of the rows of connect and weld, 0 of others, (n,); None if the number of equality rows changes."""
    bends, size = np.zeros(n), interval(model, qvel)
    rows = np.flatnonzero(np.array(data.efc_type[:n]) == reader.EQUALITY)
    if len(rows) == 0:
        return bends
    violations = _violations(model, data, len(rows), motion.qpos, qvel, size)
    if violations is None:
        return None
    before, now, after = violations
    has_bend = np.isin(np.array(model.eq_type)[np.array(data.efc_id)[rows]], BENT)
    bends[rows] = np.where(has_bend, (after - 2 * now + before) / size**2, 0.0)
    return bends


def _with_own_references(model: Any, data: Any, n: int) -> Flags:
    """The rows of contacts with adhesion or a surface velocity, which enter their references too, (n,)."""
    special = np.zeros(n, dtype=bool)
    if not data.ncon or not _has_any(model, "geom_adhesion", "geom_surfacevel", "pair_adhesion"):
        return special
    starts, numbers = np.array(data.contact.efc_address), np.array(data.efc_id[:n])
    for name in ("adhesion", "surfacevel"):
        for number in np.flatnonzero(_have(model, data, name) & (starts >= 0)).tolist():
            special |= (np.arange(n) >= starts[number]) & (numbers == number)
    return special


def _have(model: Any, data: Any, name: str) -> Flags:
    """The contacts with adhesion or a surface velocity: their own, or one of their shapes, (ncon,)."""
    contacts = np.reshape(getattr(data.contact, name, np.zeros(data.ncon)), (data.ncon, -1)) != 0
    of_shape = np.reshape(getattr(model, f"geom_{name}", np.zeros(model.ngeom)), (model.ngeom, -1)) != 0
    shapes = reader.shapes_of(data)
    own = np.any(of_shape, axis=1)[shapes] & (shapes >= 0)
    return np.asarray(np.any(contacts, axis=1) | np.any(own, axis=1), dtype=bool)


def _violations(
    model: Any, data: Any, count: int, qpos: Array, velocity: Array, size: float
) -> tuple[Array, Array, Array] | None:
    """The violations of equalities a time step before, at, and after a position that moves with a constant velocity.

    None if their number is not ``count``.
    """
    import mujoco

    own = scratch(model, data)
    own.eq_active[:] = data.eq_active
    found = []
    for time in (-size, 0.0, size):
        moved = qpos.copy()
        mujoco.mj_integratePos(model, moved, np.ascontiguousarray(velocity), time)
        own.qpos[:] = moved
        mujoco.mj_fwdPosition(model, own)
        if int(own.ne) != count:
            return None
        found.append(np.array(own.efc_pos[:count]))
    return found[0], found[1], found[2]


def _dual(data: Any, step: Step) -> Report:
    """A + R where the engine makes it: for its dual solver."""
    reported = np.asarray(getattr(data, "efc_AR", np.zeros(0))).reshape(-1)
    if step.method != "pgs" or len(reported) != len(step) ** 2:
        return Report()
    whole = step.dense_jacobian()
    own = whole @ step.mass_blocks.solve(whole.T) + np.diag(step.compliance)
    scale = np.sqrt(np.outer(np.diag(own), np.diag(own)))
    return Report([_worst("A is not J M⁻¹Jᵀ + R", reported.reshape(own.shape) - own, scale, FIRST)])

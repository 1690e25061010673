"""The problem of MuJoCo's last step from MuJoCo's own functions, without lcplab's reader."""

import mujoco
import numpy as np

from exact import Problem

EQUALITY, FRICTION, ELLIPTIC = 0, (1, 2), 7


def problem(model, data):
    size, n = model.nv, data.nefc
    mass, jacobian = np.zeros((size, size)), np.zeros((n, size))
    for column, unit in enumerate(np.eye(size)):
        mujoco.mj_mulM(model, data, mass[column], unit)
        row = np.zeros(n)
        mujoco.mj_mulJacVec(model, data, row, unit)
        jacobian[:, column] = row
    kinds = np.array(data.efc_type[:n])
    lo, hi = np.zeros(n), np.full(n, np.inf)
    lo[kinds == EQUALITY] = -np.inf
    for kind in FRICTION:
        own = kinds == kind
        lo[own], hi[own] = -data.efc_frictionloss[:n][own], data.efc_frictionloss[:n][own]
    cones = []
    for contact in data.contact:
        first = contact.efc_address
        if first >= 0 and kinds[first] == ELLIPTIC:
            cones.append((np.arange(first, first + contact.dim), contact.friction[: contact.dim - 1].copy()))
    return Problem(
        (mass + mass.T) / 2, jacobian, -data.efc_aref[:n].copy(), data.efc_R[:n].copy(), data.qacc_smooth.copy(), lo, hi, cones
    )


def gravity(model, data, own):
    """The change of the acceleration by gravity, in the norm of M."""
    push = np.zeros(model.nv)
    for body in range(1, model.nbody):
        rows = np.zeros((3, model.nv))
        mujoco.mj_jacBodyCom(model, data, rows, None, body)
        push += model.body_mass[body] * rows.T @ model.opt.gravity
    return float(np.linalg.norm(np.linalg.solve(np.linalg.cholesky(own.mass), push)))

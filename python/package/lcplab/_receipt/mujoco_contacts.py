"""Rows of MuJoCo's contacts: the velocity at the contact point along the contact's axes, by differences of poses."""

from __future__ import annotations

from typing import Any

import numpy as np

from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.kinematics import Kinematics
from lcplab._receipt.step import Array, Rows, Step

#: The largest accepted error, relative to the velocities of the two points.
LIMIT = 1e-5
ELLIPTIC = 1
#: The number of contacts whose rows are in memory at a time.
TOGETHER = 64


def check(model: Any, data: Any, step: Step, motion: Kinematics) -> Report:
    """The row of J that differs most."""
    if not data.ncon:
        return Report()
    contacts = data.contact
    geoms, starts = np.array(contacts.geom), np.array(contacts.efc_address)
    report = Report()
    has_rows = starts >= 0
    is_rigid = geoms.min(axis=1) >= 0
    if (has_rows & ~is_rigid).any():
        report.not_checked.append("assembly: J of contacts of flexes")
    sizes, whole = np.array(contacts.dim), step.dense_jacobian()
    worst, row = 0.0, None
    for size in np.unique(sizes):
        same = np.flatnonzero((sizes == size) & has_rows & is_rigid)
        for first in range(0, len(same), TOGETHER):
            own = same[first : first + TOGETHER]
            lines, terms = _rows(model, contacts, own, int(size), motion)
            rows = starts[own][:, None] + np.arange(lines.shape[1])
            errors = np.abs(whole[rows] - lines).max(axis=2) / np.maximum(terms, 1e-300)
            place = np.unravel_index(np.argmax(errors), errors.shape)
            if not errors[place] <= worst:
                worst, row = float(errors[place]), int(rows[place])
    what = "a contact's row of J differs from the velocity of its point along its axis"
    bodies = step.rows[row].bodies if row is not None and row < len(step.rows) else ()
    report.findings.append(Finding("assembly", what if row is not None else "", worst, LIMIT, row, bodies))
    return report


def _rows(model: Any, contacts: Any, own: Rows, size: int, motion: Kinematics) -> tuple[Array, Array]:
    """The rows of contacts with as many axes, (contacts, rows, k), and the sum of the two bodies' norms for each row."""
    axes = np.array(contacts.frame)[own].reshape(-1, 3, 3)
    bodies = np.asarray(model.geom_bodyid)[np.array(contacts.geom)[own]]
    at = np.array(contacts.pos)[own]

    def velocities(body: Rows) -> Array:
        along = axes @ motion.points(body, at)
        if size <= 3:
            return along[:, :size]
        turning = axes @ motion.angular[body]
        return np.concatenate([along, turning], axis=1)[:, :size]

    before, after = velocities(bodies[:, 0]), velocities(bodies[:, 1])
    every = after - before
    terms = np.linalg.norm(before, axis=2) + np.linalg.norm(after, axis=2)
    if size == 1 or model.opt.cone == ELLIPTIC:
        return every, terms
    friction = np.array(contacts.friction)[own][:, : size - 1]
    slopes = np.stack([friction, -friction], axis=2).reshape(len(own), -1)  # of the edges normal ± mu tangent
    along = np.repeat(np.arange(1, size), 2)
    sides = every[:, :1] + slopes[:, :, None] * every[:, along]
    return sides, terms[:, :1] + np.abs(slopes) * terms[:, along]

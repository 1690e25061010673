"""Receipts: the verification report of a step of an engine, and of runs of steps."""

from __future__ import annotations

from typing import Any

from lcplab._receipt.checks import Adapter, State, read
from lcplab._receipt.receipt import Receipt
from lcplab._receipt.runs import Run, receipts
from lcplab._receipt.solver import bounds_of
from lcplab._receipt.step import Row, Step

__all__ = ["Adapter", "Receipt", "Row", "Run", "State", "Step", "receipt", "receipts"]


def receipt(
    model: Any,
    data: Any = None,
    *,
    adapter: Adapter | None = None,
    before: State | None = None,
    limit: float | None = None,
) -> Receipt:
    """The receipt of one step: a verdict for collision, assembly, solver and write-back. Nothing is changed.

    Parameters
    ----------
    model, data
        A model of MuJoCo with its data, those of MJX (pyramidal cones) or of MuJoCo Warp (one world), after
        ``mj_forward`` or ``mj_step``; or an :class:`EngineStep` alone.
    adapter : Adapter, optional
        Reads the step of another engine: an object with ``problem(model, data)`` that returns an
        :class:`EngineStep`.
    before : (qpos, qvel), optional
        Copies of the state at the start of a step, if data are those after ``mj_step``: without them assembly and
        the new velocity are not checked then.
    limit : float, optional
        The largest motion error, as a part of what the constraints change; without it that of the kind of solver.

    Returns
    -------
    Receipt

    Examples
    --------
    >>> import lcplab
    >>> step = lcplab.EngineStep.of("mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], compliance=0.5,
    ...                             target=[-3.0], forces=[3.0], motion=[-1.5])
    >>> lcplab.receipt(step).ok
    True
    """
    step, report = read(model, data, adapter, before)
    return Receipt(step, bounds_of([step])[0], report, limit)

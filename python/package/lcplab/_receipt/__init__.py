"""Receipts: the verification report of a step of an engine, and of runs of steps."""

from __future__ import annotations

from typing import Any

from lcplab._receipt.attribution import Attribution, attribution
from lcplab._receipt.checks import Adapter, State, read
from lcplab._receipt.receipt import Receipt, receipts_of
from lcplab._receipt.runs import Run, receipts
from lcplab._receipt.step import Row, Step

__all__ = ["Adapter", "Attribution", "Receipt", "Row", "Run", "State", "Step", "attribution", "receipt", "receipts"]


def receipt(
    model: Any,
    data: Any = None,
    *,
    adapter: Adapter | None = None,
    before: State | None = None,
    limit: float | None = None,
) -> Receipt:
    """The receipt of one step: a verdict on collision, assembly, solver and write-back. The data are not changed.

    Parameters
    ----------
    model, data
        A model of MuJoCo with its data, those of MJX (pyramidal cones) or of MuJoCo Warp (one world), after
        ``mj_forward`` or ``mj_step``; a world of DART; a discrete plant of Drake with its context; or an
        :class:`EngineStep` alone.
    adapter : Adapter, optional
        Reads the step of another engine: an object with ``problem(model, data)`` that returns an
        :class:`EngineStep`.
    before : (qpos, qvel), optional
        Copies of the state at the start of a step, for data after ``mj_step``. Without them, assembly and the new
        velocity of such data are not checked. DART and Drake need them: ``lcplab.dart.state(world)``,
        ``lcplab.drake.state(plant, context)``.
    limit : float, optional
        The largest accepted motion error, or else residual. The default depends on the kind of solver and on the
        engine's own tolerance (``docs/ci.md``).

    Returns
    -------
    Receipt

    Raises
    ------
    TypeError
        If no adapter reads this kind of model.
    ValueError
        If ``before`` is a view of the data or does not fit the model, or ``limit`` is negative.

    Examples
    --------
    >>> import lcplab
    >>> step = lcplab.EngineStep.of("mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], compliance=0.5,
    ...                             target=[-3.0], forces=[3.0], motion=[-1.5])
    >>> lcplab.receipt(step).ok
    True
    """
    step, report = read(model, data, adapter, before)
    return receipts_of([(step, report)], limit)[0]

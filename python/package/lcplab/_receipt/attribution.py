"""Whose part of the difference of two steps of the same state is: the solvers', the assembly's or the collision's."""

from __future__ import annotations

from collections import Counter
from dataclasses import dataclass, replace

import numpy as np

from lcplab._lcplab import InputError
from lcplab._receipt.receipt import Receipt
from lcplab._receipt.step import Array, Step
from lcplab._solve import solve

#: The scaled residual of the exact motions.
TOLERANCE = 1e-11


@dataclass(frozen=True)
class Attribution:
    """How far the motions of two steps of the same state are apart, and which part is whose.

    The parts are changes of the motion whose sum is the difference, each as its length in the norm of the first step's M,
    relative to the first step's ``effect``. The lengths do not add up.

    Attributes
    ----------
    difference : float
        The distance of both engines' motions.
    solver : (float, float)
        The distance of each engine's motion from the exact motion of its own problem.
    free_motion : float
        What another M and another motion without constraints u* change: assembly.
    rows : float
        What other constraint rows change.
    rows_are_of : str
        ``"collision"`` if the two steps have other rows, ``"assembly"`` if the same rows have other numbers.
    engines : (str, str)
        The engines with their versions; if these are equal, followed by ``(first)`` and ``(second)``.
    """

    difference: float
    solver: tuple[float, float]
    free_motion: float
    rows: float
    rows_are_of: str
    engines: tuple[str, str]

    def __str__(self) -> str:
        lines = [
            f"{' and '.join(self.engines)}: motions differ by {self.difference:.2g} of the effect",
            *(f"  {part:.2g}  solver of {engine}" for engine, part in zip(self.engines, self.solver)),
            f"  {self.free_motion:.2g}  assembly: M and free motion",
            f"  {self.rows:.2g}  {self.rows_are_of}: rows",
        ]
        return "\n".join(lines)


def attribution(first: Receipt | Step, second: Receipt | Step) -> Attribution:
    """Divide the difference of two engines, versions or precisions on the same state into the parts of their stages.

    Between the two motions lie the exact motions of three problems: that of the first step, the same rows with M and u* of the
    second one, and that of the second step. Compare the solvers of two engines by ``solver``: each is measured on its
    engine's own rows.

    Parameters
    ----------
    first, second : Receipt or EngineStep
        Steps of the same state, with the same degrees of freedom.

    Returns
    -------
    Attribution

    Raises
    ------
    InputError
        If the numbers of degrees of freedom differ, or lcplab does not solve one of the three problems, such as one with
        elliptic cones of more than two friction rows (MuJoCo's condim 4 and 6).

    Examples
    --------
    >>> import lcplab
    >>> step = lambda x, v: lcplab.EngineStep.of("mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], compliance=0.5,
    ...                                          target=[-3.0], forces=[x], motion=[v])
    >>> parts = lcplab.attribution(step(3.0, -1.5), step(2.0, -2.0))
    >>> [round(part, 6) for part in (*parts.solver, parts.free_motion, parts.rows)]
    [0.0, 0.333333, 0.0, 0.0]
    """
    one, other = (own.step if isinstance(own, Receipt) else own for own in (first, second))
    if len(one.target) != len(other.target):
        sizes = f"{len(one.target)} and {len(other.target)}"
        raise InputError(f"attribution: the steps have {sizes} degrees of freedom; they must be the same")
    between = replace(one, mass=other.mass, target=other.target)
    exact = [_exact(step) for step in (one, between, other)]
    effect = max(one.effect, 1e-300)

    def part(motion: Array) -> float:
        return one.norm(motion) / effect

    return Attribution(
        difference=part(one.motion - other.motion),
        solver=(part(one.motion - exact[0]), part(other.motion - exact[2])),
        free_motion=part(exact[0] - exact[1]),
        rows=part(exact[1] - exact[2]),
        rows_are_of="assembly" if _kinds(one) == _kinds(other) else "collision",
        engines=_names(one, other),
    )


def _exact(step: Step) -> Array:
    """The exact motion of the problem that a step poses, up to the tolerance."""
    if len(step) == 0:
        return step.target
    jacobian = step.dense_jacobian()
    matrix = jacobian @ step.mass_blocks.solve(jacobian.T) + np.diag(step.compliance)
    is_friction = step.friction_index >= 0
    bounds = np.where(is_friction, -np.inf, step.lo), np.where(is_friction, np.inf, step.hi)
    has_friction = bool(is_friction.any())
    unsolved = f"attribution: lcplab does not solve the problem of {_name(step)}"
    try:
        answer = solve(
            (matrix + matrix.T) / 2, step.along(step.target) + step.bias, *bounds, prove=False, tolerance=TOLERANCE,
            friction_index=step.friction_index if has_friction else None, mu=step.mu if has_friction else None,
            model=step.model if has_friction else None,
        )
    except InputError as error:  # such as a cone with torsional or rolling friction
        raise InputError(f"{unsolved}: {error}") from error
    if answer.status != "solved":
        raise InputError(f"{unsolved}: {answer.message}")
    return step.target + step.mass_blocks.solve(step.push(answer.x))


def _kinds(step: Step) -> Counter[tuple[str, ...]]:
    """The rows by kind and bodies, in any order."""
    if len(step.rows) != len(step):
        return Counter({("rows",): len(step)})
    return Counter((row.kind, *sorted(row.bodies)) for row in step.rows)


def _names(first: Step, second: Step) -> tuple[str, str]:
    """The engines with their versions; where these are equal, also which step it is."""
    names = _name(first), _name(second)
    return names if names[0] != names[1] else (f"{names[0]} (first)", f"{names[1]} (second)")


def _name(step: Step) -> str:
    return f"{step.engine} {step.version}".strip()

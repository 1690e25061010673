"""Comparison of solvers."""

from __future__ import annotations

import csv
import io
import json
import os
from collections.abc import Iterable, Sequence
from html import escape
from typing import Any

import numpy as np

from lcplab import _lcplab
from lcplab._problem import Array, named
from lcplab._solve import Solver, settings


class Comparison:
    """A comparison of solvers, with one row for each pair of problem and solver.

    Attributes
    ----------
    rows : list of dict
        Rows with the keys ``family`` (the problem), ``model``, ``solver``, ``claimed``, ``accepted``, ``proved``,
        ``rejected_claims``, ``iterations``, ``multiplications``, ``worst_residual``, ``seconds``, ``trouble`` and others.
    """

    _COLUMNS = (
        "family", "model", "solver", "claimed", "accepted", "proved", "iterations", "multiplications", "seconds", "trouble",
    )

    def __init__(self, rows: list[dict[str, Any]], text: str) -> None:
        self.rows = rows
        self._text = text

    def __str__(self) -> str:
        return self._text

    __repr__ = __str__

    def to_csv(self, path: str | os.PathLike[str] | None = None) -> str:
        """Return all rows as CSV, and write them to ``path`` if it is given."""
        out = io.StringIO()
        writer = csv.DictWriter(out, list(self.rows[0]) if self.rows else [], lineterminator="\n")
        writer.writeheader()
        writer.writerows(self.rows)
        if path is not None:
            with open(path, "w", encoding="utf-8", newline="") as file:
                file.write(out.getvalue())
        return out.getvalue()

    def profile(self) -> dict[str, tuple[Array, Array]]:
        """Performance profile (Dolan & Moré) of the times: for each solver, arrays of tau and of the share solved."""
        problems: dict[tuple[Any, Any], dict[str, float]] = {}
        names: list[str] = []
        for row in self.rows:
            names += [row["solver"]] if row["solver"] not in names else []
            solved = row["accepted"] == row["claimed"] == row["problems"] and row["problems"] > 0
            cost = max(row["seconds"], 1e-9) if solved else np.inf
            problems.setdefault((row["family"], row["model"]), {})[row["solver"]] = cost
        best = {key: min(costs.values()) for key, costs in problems.items()}
        solvable = [key for key in problems if np.isfinite(best[key])]
        curves = {}
        for name in names:
            ratios = np.sort([problems[key].get(name, np.inf) / best[key] for key in solvable])
            ratios = ratios[np.isfinite(ratios)]
            share = np.arange(1, len(ratios) + 1) / max(len(solvable), 1)
            curves[name] = (ratios, share)
        return curves

    def plot(self, ax: Any = None) -> Any:
        """Draw the performance profile with matplotlib, and return the axes."""
        import matplotlib.pyplot as plt

        if ax is None:
            _, ax = plt.subplots()
        curves = self.profile()
        end = 2 * max((ratios[-1] for ratios, _ in curves.values() if len(ratios)), default=1.0)
        for name, (ratios, share) in curves.items():
            tau, rho = np.append(ratios, end), np.append(share, share[-1] if len(share) else 0.0)
            ax.step(tau, rho, where="post", label=name)
        ax.set(xscale="log", ylim=(0, 1.02), xlabel="τ: time relative to the fastest solver", ylabel="share solved")
        ax.legend()
        return ax

    def _repr_html_(self) -> str:
        def cell(value: Any) -> str:
            shown = "" if value is None else f"{value:.3g}" if isinstance(value, float) else str(value)
            return f"<td>{escape(shown)}</td>"

        head = "".join(f"<th>{name}</th>" for name in self._COLUMNS)
        body = "".join(
            "<tr>" + "".join(cell(row.get(name)) for name in self._COLUMNS) + "</tr>" for row in self.rows
        )
        return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def compare(
    problems: Any,
    solvers: Iterable[Solver] | None = None,
    *,
    models: Sequence[str] = (),
    tolerance: float = 1e-8,
    max_iterations: int = 10_000,
    omega: float | None = None,
) -> Comparison:
    """Solve every problem with every solver, and judge every answer.

    Parameters
    ----------
    problems : Problem, str, tuple, or an iterable or mapping of them
        Problems, file names, ``(A, b)`` or ``(A, b, lo, hi)``.
    solvers : iterable of str or callable
        Solvers as in :func:`solve`. The default is one solver of each kind. If a function raises an exception, or a solver
        does not support the friction model of a problem, its row has the reason under ``trouble``.
    models : sequence of str
        The friction models for problems with friction. The default is the model of each problem.

    Examples
    --------
    >>> table = compare({"two": ([[2, -1], [-1, 2]], [-1, 2])}, ["pgs", "dantzig"])
    >>> [(row["solver"], row["proved"]) for row in table.rows]
    [('pgs', 1), ('dantzig', 1)]
    """
    given = [(name, [problem._inner]) for name, problem in named(problems)]
    chosen = [] if solvers is None else list(solvers)
    options = settings(tolerance, max_iterations, omega, chosen)
    rows, text = _lcplab.compare(given, chosen, list(models), options)
    return Comparison(json.loads(rows), text)

"""What was found, as the JSON that ``lcplab report engines`` draws."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from lcplab.cards._frames import frames
from lcplab.cards._phenomenon import Phenomenon
from lcplab.cards._run import Column, _named
from lcplab.cards._solver import SolverPart
from lcplab.cards.phenomena import PHENOMENA
from lcplab.engines import NAMES, Array, by_name

#: The version of the format.
FORMAT = 1


def record(columns: Sequence[tuple[str, Column]]) -> dict[str, Any]:
    """The record of columns, each with the name of its phenomenon.

    An engine that does not fly as a stone does with other settings than its defaults was translated wrongly:
    it is left out.
    """
    wrong = {
        column.engine
        for name, column in columns
        if name == PHENOMENA[0].name and column.settings != "defaults" and not column.holds
    }
    columns = [(name, column) for name, column in columns if column.engine not in wrong]
    engines = list(dict.fromkeys(column.engine for _, column in columns))
    names = list(dict.fromkeys(name for name, _ in columns))
    return {
        "format": FORMAT,
        "engines": [_engine(name) for name in engines],
        "frames": [frame for name in engines for frame in frames(name)],
        "phenomena": [
            _phenomenon(_named(PHENOMENA, name), [column for own, column in columns if own == name])
            for name in names
        ],
    }


def merged(records: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """One record of several, whose engines were run in environments of their own.

    Raises
    ------
    ValueError
        If two records have different versions of an engine.
    """
    engines: dict[str, Any] = {}
    phenomena: dict[str, Any] = {}
    for record in records:
        for engine in record["engines"]:
            known = engines.setdefault(engine["name"], engine)
            if known["version"] != engine["version"]:
                raise ValueError(f"{engine['name']}: the records have the versions {known['version']} and {engine['version']}")
        for phenomenon in record["phenomena"]:
            kept = phenomena.setdefault(phenomenon["name"], {**phenomenon, "columns": []})
            kept["columns"] = kept["columns"] + phenomenon["columns"]
            for axis, values in (("x", "values"), ("y", "law")):
                if not kept[axis][values]:
                    kept[axis] = phenomenon[axis]
    order = {name: place for place, name in enumerate(NAMES)}
    for phenomenon in phenomena.values():
        phenomenon["columns"] = sorted(phenomenon["columns"], key=lambda column: order[column["engine"]])
    frames = [frame for record in records for frame in record["frames"]]
    return {
        "format": FORMAT,
        "engines": sorted(engines.values(), key=lambda engine: order[engine["name"]]),
        "frames": sorted(frames, key=lambda frame: order[frame["engine"]]),
        "phenomena": [phenomena[own.name] for own in PHENOMENA if own.name in phenomena],
    }


def _engine(name: str) -> dict[str, Any]:
    engine = by_name(name)
    settings = [{"name": own.name, "words": own.words, "dt": own.dt} for own in engine.settings]
    return {
        "name": name,
        "title": engine.title,
        "package": engine.package,
        "version": engine.version,
        "settings": settings,
    }


def _phenomenon(of: Phenomenon, columns: Sequence[Column]) -> dict[str, Any]:
    drawn = next((column for column in columns if column.curve is not None), Column("", ""))
    return {
        "name": of.name,
        "question": of.question,
        "matters": of.matters,
        "law": of.law,
        "allowed": of.allowed,
        "reported": of.reported,
        "duration": of.duration,
        "scene": of.scene,
        "set": [dict(variant) for variant in of.variants],
        "log": of.log,
        "x": {"name": of.x[0], "unit": of.x[1], "values": _numbers(drawn.curve.x) if drawn.curve else []},
        "y": {"name": of.y[0], "unit": of.y[1], "law": [] if drawn.exact is None else _numbers(drawn.exact)},
        "columns": [_column(column) for column in columns],
    }


def _column(column: Column) -> dict[str, Any]:
    reported: dict[str, Any] = {"engine": column.engine, "settings": column.settings}
    for key in ("unsupported", "failed"):
        if (why := getattr(column, key)) is not None:
            return reported | {key: why}
    assert column.curve is not None and column.exact is not None
    reported["measured"] = [
        {
            "what": m.what,
            "value": _number(m.value),
            "law": _number(m.law),
            "tolerance": _number(m.tolerance),
            "unit": m.unit,
            "holds": m.holds,
        }
        for m in column.measured
    ]
    reported["y"] = _numbers(column.curve.y)
    if column.solver is not None:
        reported["solver"] = _solver(column.solver)
    if column.pace is not None:
        reported["pace"] = _number(column.pace, 2)
    return reported


def _solver(part: SolverPart) -> dict[str, Any]:
    if part.why:
        return {"why": part.why}
    error = _number(part.error, 2)
    return {"steps": part.steps, "above": part.above, "error": error, "limit": part.limit, "is_bound": part.is_bound}


def _number(value: float, digits: int = 6) -> float | str:
    """The number with these digits, enough for plots and tables; a value that is not finite as a word."""
    if math.isfinite(value):
        return float(f"{value:.{digits}g}") + 0.0
    return "nan" if math.isnan(value) else "inf" if value > 0 else "-inf"


def _numbers(values: Array) -> list[float | str]:
    return [_number(float(value), 4) for value in np.asarray(values)]

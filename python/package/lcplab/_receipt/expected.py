"""The stage assembly of an engine's step whose adapter computes parts of the problem on its own."""

from __future__ import annotations

import numpy as np

from lcplab._receipt.findings import Finding, Report
from lcplab._receipt.limits import ROUNDING
from lcplab._receipt.step import Step


def check(step: Step) -> Report:
    """Compare the engine's bias and free motion with those that its model and state ask for, where they are given."""
    report, parts = Report(), []
    for found, part in ((_bias(step), "the bias"), (_target(step), "the free motion")):
        if found:
            report.findings.append(found)
            parts.append(part)
    report.not_checked.append(f"assembly: all but {' and '.join(parts)}" if parts else "assembly")
    return report


def _bias(step: Step) -> Finding | None:
    """The largest difference of a bias, relative to its terms and to those of J u*."""
    if step.expected_bias is None or len(step) == 0:
        return None
    terms = np.abs(step.bias) + np.abs(step.expected_bias) + step.size_along(step.target)
    errors = np.abs(step.bias - step.expected_bias) / np.maximum(terms, 1e-300)
    row = int(np.argmax(errors))
    bodies = step.rows[row].bodies if row < len(step.rows) else ()
    what = "the bias of a row is not the one that model and state ask for"
    return Finding("assembly", what, float(errors[row]), ROUNDING[step.bits], row, bodies)


def _target(step: Step) -> Finding | None:
    """The difference of u* in the norm of M."""
    if step.expected_target is None:
        return None
    scale = max(step.norm(step.expected_target), float(step.gravity), 1e-300)
    error = step.norm(step.target - step.expected_target) / scale
    what = "the motion without constraints is not the one that model and state ask for"
    return Finding("assembly", what, error, ROUNDING[step.bits])

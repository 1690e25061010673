"""Solve, judge and explain linear complementarity problems of contact.

The problem is ``w = A x + b`` with ``lo <= x <= hi``, where ``w[i] > 0`` only if ``x[i] == lo[i]`` and
``w[i] < 0`` only if ``x[i] == hi[i]``. Rows of friction have the bounds ``±mu[i] * max(x[k], 0)`` with
``k = friction_index[i]``.

>>> import lcplab
>>> r = lcplab.solve([[2, -1], [-1, 2]], [-1, 2])
>>> r.x.tolist(), r.verdict
([0.5, 0.0], 'proved')
"""

from typing import TYPE_CHECKING, Any

from lcplab._lcplab import InputError, __version__
from lcplab import testing, textbook
from lcplab._compare import Comparison, compare
from lcplab._gradient import Gradient, gradient
from lcplab._hunt import Finding, hunt
from lcplab._problem import Problem
from lcplab._proof import Proof, check, prove
from lcplab._qp import QPSolution, solve_qp
from lcplab._scene import Scene, Step
from lcplab._solutions import Face, Solutions, solutions
from lcplab._solve import Document, Result, Verdict, explain, judge, solve, solvers

if TYPE_CHECKING:
    from lcplab import _receipt
    from lcplab._receipt import Attribution, Receipt, Row as EngineRow, Run, Step as EngineStep, receipts

    attribution, receipt = _receipt.attribution, _receipt.receipt

#: The names of receipts, and their names in ``lcplab._receipt``, which takes three quarters of the time of an import and
#: is therefore imported when one of them is used.
_RECEIPTS = {
    "Attribution": "Attribution",
    "EngineRow": "Row",
    "EngineStep": "Step",
    "Receipt": "Receipt",
    "Run": "Run",
    "attribution": "attribution",
    "receipt": "receipt",
    "receipts": "receipts",
}

__all__ = [
    "Attribution",
    "Comparison",
    "Document",
    "EngineRow",
    "EngineStep",
    "Face",
    "Finding",
    "Gradient",
    "InputError",
    "Problem",
    "Proof",
    "QPSolution",
    "Receipt",
    "Result",
    "Run",
    "Scene",
    "Solutions",
    "Step",
    "Verdict",
    "__version__",
    "attribution",
    "check",
    "compare",
    "explain",
    "gradient",
    "hunt",
    "judge",
    "prove",
    "receipt",
    "receipts",
    "solutions",
    "solve",
    "solve_qp",
    "solvers",
    "testing",
    "textbook",
]


def __getattr__(name: str) -> Any:
    if name not in _RECEIPTS:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    from lcplab import _receipt

    value = globals()[name] = getattr(_receipt, _RECEIPTS[name])
    return value


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__} - {"Any", "TYPE_CHECKING"})

"""Values that depend on a compiled model only, computed once for it and again after one of its arrays was changed."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Generic, TypeVar

import numpy as np

Value = TypeVar("Value")


class Kept(Generic[Value]):
    """The value of a function of the model that was read last.

    Parameters
    ----------
    compute : callable
        The function.
    names : str
        The arrays of the model and, as ``opt.name``, the options that it depends on; those that a version of the engine
        does not have are skipped.
    """

    def __init__(self, compute: Callable[[Any], Value], *names: str) -> None:
        self._compute = compute
        self._options = [name.removeprefix("opt.") for name in names if name.startswith("opt.")]
        self._arrays = [name for name in names if not name.startswith("opt.")]
        # In one tuple, because threads may read several models.
        self._kept: tuple[Any, list[str], list[str], list[bytes], Value] | None = None

    def __call__(self, model: Any) -> Value:
        """The value for this model as it is now."""
        kept = self._kept
        if kept is None or kept[0] is not model:
            options = [name for name in self._options if hasattr(model.opt, name)]
            arrays = [name for name in self._arrays if hasattr(model, name)]
        else:
            options, arrays = kept[1:3]
        opt = model.opt
        state = [np.asarray(getattr(opt, name)).tobytes() for name in options]
        state += [np.asarray(getattr(model, name)).tobytes() for name in arrays]
        if kept is not None and kept[0] is model and kept[3] == state:
            return kept[4]
        value = self._compute(model)
        self._kept = model, options, arrays, state, value
        return value

"""Runs: the receipts of many steps, their quantiles, and how they compare with a recorded run."""

from __future__ import annotations

import json
import os
from collections.abc import Iterable, Iterator, Mapping
from concurrent.futures import ThreadPoolExecutor
from functools import cached_property
from pathlib import Path
from typing import Any

from lcplab import _lcplab
from lcplab._lcplab import InputError
from lcplab._receipt.checks import Adapter, of_world, read, worlds
from lcplab._receipt.findings import Report
from lcplab._receipt.receipt import Receipt, receipts_of
from lcplab._receipt.step import Step

#: The number of steps that are checked together.
TOGETHER = 64


class Run:
    """The receipts of the steps of a run.

    Attributes
    ----------
    ok : bool
        Whether enough frames were checked, the baseline lists all rejected ones, nothing of the baseline is lost, and
        the errors are not larger than the baseline's (``docs/ci.md``).
    receipts : dict of str to Receipt
        The receipt of each frame, by its name.
    rejected, known, unconverged : list of str
        The rejected frames, those of them that the baseline lists with the same stage, and frames above their limit
        because the engine stopped early.
    errors : list of float
        The motion errors, or else residuals, of the frames that have one, sorted.
    counts : dict of str to int
        The number of errors above 1e-6, 1e-5, 1e-4 and 1e-3.
    quantiles : dict of str to float
        Quantiles of the errors.
    fixed : list of str
        Frames that the baseline lists as rejected, and that no longer are.
    missing : list of str
        The frames of the baseline that are not in this run.
    lost : list of str
        What the baseline checked and this run does not, as sentences.
    worse : list of str
        The levels that more errors exceed than in the baseline and than chance explains, as sentences.
    worst : list of str
        The ten worst of the rejected and unconverged frames: first the rejected ones, then those with the largest motion errors.
    stages : dict of str to int
        The number of frames that are rejected at each stage.
    unchecked : str or None
        Why the run does not count as checked, as a sentence: no frame is ok or wrong or, without a baseline,
        in less than half of the frames with rows.
    """

    def __init__(self, receipts: Mapping[str, Receipt], baseline: tuple[str, str] | None = None) -> None:
        self.receipts = dict(receipts)
        self._own = _lcplab.RunReport.of([(name, own._own) for name, own in self.receipts.items()], baseline)
        written: dict[str, Any] = json.loads(self._own.summary())
        self.ok: bool = written["ok"]
        self.counts: dict[str, int] = written["counts"]
        self.quantiles = {part: float(value) for part, value in written["quantiles"].items()}
        self.rejected: list[str] = list(written["rejected"])
        self.unconverged: list[str] = written["unconverged"]
        self.known: list[str] = written["known"]
        self.fixed: list[str] = written["fixed"]
        self.missing: list[str] = written["missing"]
        self.lost: list[str] = written["lost"]
        self.worse: list[str] = written["worse"]
        self.worst: list[str] = written["worst"]
        self.stages: dict[str, int] = written["stages"]
        self.unchecked: str | None = written["unchecked"]

    @cached_property
    def errors(self) -> list[float]:
        errors = (own.residual if own.motion_error is None else own.motion_error for own in self.receipts.values())
        return sorted(error for error in errors if error is not None)

    def __bool__(self) -> bool:
        return self.ok

    def __repr__(self) -> str:
        return f"<lcplab.Run {'ok' if self.ok else 'not ok'}: {len(self.receipts)} frames, {len(self.rejected)} rejected>"

    def __str__(self) -> str:
        return self._own.text()

    def to_json(self) -> dict[str, Any]:
        """The run as a baseline, with which ``receipts`` compares later runs."""
        baseline: dict[str, Any] = json.loads(self._own.baseline())
        return baseline

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the run as a baseline."""
        Path(path).write_text(self._own.baseline(), encoding="utf-8")

    def save_worst(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Write a folder for each of the worst frames; their paths."""
        return [self.receipts[name].save(Path(folder) / _file_name(name)) for name in self.worst]


def receipts(
    frames: Iterable[Any] | str | os.PathLike[str],
    *,
    baseline: Mapping[str, Any] | str | os.PathLike[str] | None = None,
    adapter: Adapter | None = None,
    limit: float | None = None,
) -> Run:
    """The receipts of a run.

    One frame does not distinguish two releases of an engine; a run does.

    Parameters
    ----------
    frames : iterable or path
        A path as below, or an iterable of frames:
        Pairs ``(model, data)``, which may be the same objects after each step, or ``(model, data, before)`` with the
        ``before`` of :func:`receipt`; :class:`EngineStep`; paths of frames or of their folders: problem files
        (JSON or .npz) with the key ``motion`` whose answer is next to them, ``STEM.x.json``, or inside, ``answer``.
        Each world of MuJoCo Warp's data is a frame.
    baseline : mapping or path, optional
        A recorded run of a trusted release, as ``Run.save`` writes it.
    adapter, limit
        As :func:`receipt` takes them.

    Returns
    -------
    Run

    Raises
    ------
    InputError
        If a file is invalid, or a file of a folder has no partner.

    Examples
    --------
    >>> import lcplab
    >>> step = lcplab.EngineStep.of("mine", mass=[[2.0]], jacobian=[[1.0]], bias=[0.0], compliance=0.5,
    ...                             target=[-3.0], forces=[3.0], motion=[-1.5])
    >>> run = lcplab.receipts([step, step])
    >>> run.ok, run.counts["1e-6"]
    (True, 0)
    """
    known = load(baseline)
    if isinstance(frames, (str, os.PathLike)):
        frames = [frames]
    found: dict[str, Receipt] = {}
    waiting: list[tuple[str, Step, Report | None]] = []
    # Steps are checked without the GIL while the next ones are read.
    with ThreadPoolExecutor(1) as pool:
        checked = []
        for number, (name, step, report) in enumerate(_read(frames, adapter)):
            waiting.append((name or f"{step.name or step.engine} {number}", step, report))
            if len(waiting) == TOGETHER:
                checked.append(pool.submit(_checked, waiting, limit))
                waiting = []
        checked.append(pool.submit(_checked, waiting, limit))
        for part in checked:
            found |= part.result()
    return Run(found, known)


def load(baseline: Mapping[str, Any] | str | os.PathLike[str] | None) -> tuple[str, str] | None:
    """The name and the text of a recorded run, None for None.

    Raises
    ------
    InputError
        If the file cannot be read.
    """
    if baseline is None:
        return None
    if isinstance(baseline, Mapping):
        return "baseline", json.dumps(baseline)
    try:
        return str(baseline), Path(baseline).read_text(encoding="utf-8")
    except FileNotFoundError as error:
        raise InputError(f"{baseline}: no such file; record the baseline first") from error
    except (OSError, ValueError) as error:
        raise InputError(f"{baseline}: {error}") from error


def _read(frames: Iterable[Any], adapter: Adapter | None) -> Iterator[tuple[str, Step, Report | None]]:
    for frame in frames:
        if isinstance(frame, (str, os.PathLike)):
            for path in _lcplab.frame_files(os.fspath(frame)):
                yield path, Step._of_frame(_lcplab.read_frame(path)), None
        elif isinstance(frame, tuple):
            model, data, *before = frame
            if worlds(data) > 1:
                yield from (("", *of_world(model, data, world)) for world in range(worlds(data)))
            else:
                yield ("", *read(model, data, adapter, before[0] if before else None))
        else:
            yield ("", *read(frame, None, adapter, None))


def _checked(waiting: list[tuple[str, Step, Report | None]], limit: float | None) -> dict[str, Receipt]:
    receipts = receipts_of([(step, report) for _, step, report in waiting], limit)
    return {name: own for (name, _, _), own in zip(waiting, receipts)}


def _file_name(name: str) -> str:
    return "".join(letter if letter.isalnum() or letter in "-_." else "-" for letter in name).strip("-.") or "frame"

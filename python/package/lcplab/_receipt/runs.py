"""Runs: the receipts of many steps, their quantiles, and how they compare with a recorded run."""

from __future__ import annotations

import json
import math
import os
from collections.abc import Iterable, Iterator, Mapping
from pathlib import Path
from typing import Any

from lcplab._lcplab import InputError
from lcplab._receipt import files
from lcplab._receipt.checks import Adapter, of_step, of_world, read, worlds
from lcplab._receipt.findings import Report
from lcplab._receipt.limits import limit_of
from lcplab._receipt.receipt import Receipt
from lcplab._receipt.solver import bounds_of
from lcplab._receipt.step import Step

#: Frames are counted above these motion errors.
LEVELS = (1e-6, 1e-5, 1e-4, 1e-3)
QUANTILES = (0.5, 0.9, 0.99)
#: A quantile's spread is that of its rank within this number of standard deviations: 99 % of samples.
DEVIATIONS = 2.58
#: Quantiles below this fraction of the limit never count as worse.
FLOOR = 1e-3
#: The number of steps whose bounds are computed together.
TOGETHER = 64
WORST = 10


class Run:
    """The receipts of the steps of a run.

    Attributes
    ----------
    ok : bool
        Whether some frames were checked, the baseline lists all rejected ones, and no quantile of the motion error is
        worse than the baseline's by more than the baseline's spread.
    receipts : dict of str to Receipt
        The receipt of each frame, by its name.
    rejected, known, unconverged : list of str
        The rejected frames, those of them that the baseline lists with the same stage, and frames above their limit
        at the engine's iteration cap.
    counts : dict of str to int
        The number of frames with a motion error above 1e-6, 1e-5, 1e-4 and 1e-3.
    quantiles : dict of str to float
        Quantiles of the motion errors.
    fixed : list of str
        Frames that the baseline lists as rejected, and that no longer are.
    worse : list of str
        The quantiles that are worse than the baseline's, as sentences.
    unchecked : str or None
        Why no frame counts as checked, as a sentence: each is unconverged, or has no rows, or nothing of it was compared.
    """

    def __init__(self, receipts: Mapping[str, Receipt], baseline: Mapping[str, Any] | None = None) -> None:
        self.receipts = dict(receipts)
        every = self.receipts.items()
        self.errors = sorted(r.motion_error for r in self.receipts.values() if r.motion_error is not None)
        self.counts = {f"{level:.0e}": sum(error > level for error in self.errors) for level in LEVELS}
        self.quantiles = {str(part): quantile(self.errors, part) for part in QUANTILES} if self.errors else {}
        self.rejected = [name for name, receipt in every if receipt.is_rejected]
        self.unconverged = [name for name, receipt in every if receipt.verdict == "unconverged"]
        self.not_checked = [name for name, receipt in every if receipt.verdict == "not checked"]
        self.without_rows = [name for name, receipt in every if receipt.verdict == "no rows"]
        known = baseline["rejected"] if baseline else {}
        self.known = [name for name in self.rejected if is_known(name, self.receipts[name], known)]
        self.fixed = sorted(name for name in known.keys() - set(self.rejected) if name in self.receipts)
        self.worse = _worse(self.errors, baseline, self._floor()) if baseline else []
        self.unchecked = self._unchecked()

    def _floor(self) -> float:
        return FLOOR * min((receipt.limit for receipt in self.receipts.values()), default=0.0)

    def _unchecked(self) -> str | None:
        without = [name for name in self.not_checked if not self.receipts[name].findings]
        kinds = {"unconverged": self.unconverged, "without any comparison": without, "without rows": self.without_rows}
        if sum(map(len, kinds.values())) < len(self.receipts):
            return None
        counts = ", ".join(f"{len(names)} {kind}" for kind, names in kinds.items() if names)
        return f"no frame was checked: {counts or 'there are no frames'}"

    @property
    def ok(self) -> bool:
        """Whether frames were checked, the baseline lists all rejected ones, and no quantile is worse than the baseline's."""
        return self.unchecked is None and len(self.known) == len(self.rejected) and not self.worse

    @property
    def worst(self) -> list[str]:
        """The ten worst frames: first the rejected ones, then those with the largest motion errors."""

        def size(name: str) -> tuple[bool, float]:
            receipt = self.receipts[name]
            return not receipt.is_rejected, -(receipt.motion_error or 0.0)

        return sorted(self.receipts, key=size)[:WORST]

    @property
    def stages(self) -> dict[str, int]:
        """The number of frames that are rejected at each stage."""
        found: dict[str, int] = {}
        for name in self.rejected:
            stage = self.receipts[name].stage or ""
            found[stage] = found.get(stage, 0) + 1
        return found

    def __bool__(self) -> bool:
        return self.ok

    def __repr__(self) -> str:
        return f"<lcplab.Run {'ok' if self.ok else 'not ok'}: {len(self.receipts)} frames, {len(self.rejected)} rejected>"

    def __str__(self) -> str:
        lines = [
            f"{'ok' if self.ok else 'not ok'}: {len(self.receipts)} frames, {len(self.rejected)} rejected "
            f"({len(self.known)} known), {len(self.unconverged)} unconverged, {len(self.without_rows)} without rows"
            + (f", {len(self.not_checked)} without a bound on the motion" if self.not_checked else ""),
            "motion error above " + ", ".join(f"{level}: {count}" for level, count in self.counts.items())
            + f" of {len(self.errors)} frames",
        ]
        if self.quantiles:
            lines.append("quantiles " + ", ".join(f"{part}: {value:.1e}" for part, value in self.quantiles.items()))
        lines += [f"rejected at {stage}: {count}" for stage, count in self.stages.items()]
        lines += [*([self.unchecked] if self.unchecked else []), *self.worse]
        lines += [f"{name} is no longer rejected: record the baseline again" for name in self.fixed]
        for name in self.worst:
            receipt = self.receipts[name]
            if receipt.is_rejected or receipt.verdict == "unconverged":
                lines += [name, *(f"  {line}" for line in str(receipt).splitlines())]
        return "\n".join(lines)

    def to_json(self) -> dict[str, Any]:
        """The run as a baseline, with which ``receipts`` compares later runs."""
        return {
            "frames": len(self.receipts),
            "counts": self.counts,
            "quantiles": self.quantiles,
            "spreads": {str(part): spread(self.errors, part) for part in QUANTILES} if self.errors else {},
            "rejected": {name: self.receipts[name].stage for name in self.rejected},
            "unconverged": self.unconverged,
            "versions": sorted({f"{r.step.engine} {r.step.version}" for r in self.receipts.values()}),
        }

    def save(self, path: str | os.PathLike[str]) -> None:
        """Write the run as a baseline."""
        Path(path).write_text(json.dumps(self.to_json(), indent=1) + "\n", encoding="utf-8")

    def save_worst(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Write a folder for each rejected frame among the ten worst; their paths."""
        names = [name for name in self.worst if self.receipts[name].is_rejected]
        return [self.receipts[name].save(Path(folder) / _file_name(name)) for name in names]


def receipts(
    frames: Iterable[Any],
    *,
    baseline: Mapping[str, Any] | str | os.PathLike[str] | None = None,
    adapter: Adapter | None = None,
    limit: float | None = None,
) -> Run:
    """The receipts of a run.

    One frame does not distinguish two releases of an engine; a run does.

    Parameters
    ----------
    frames : iterable
        Pairs ``(model, data)``, which may be the same objects after each step, or ``(model, data, before)`` with the
        ``before`` of :func:`receipt`; :class:`EngineStep`; paths of problem files with the key ``motion`` whose answer
        is next to them, ``STEM.x.json``, or of folders of such files. Each world of MuJoCo Warp's data is a frame.
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
    >>> run.ok, run.counts["1e-06"]
    (True, 0)
    """
    known = baseline if baseline is None or isinstance(baseline, Mapping) else load(baseline)
    found: dict[str, Receipt] = {}
    waiting: list[tuple[str, Step, Report]] = []
    for number, (name, step, report) in enumerate(_read(frames, adapter)):
        limit_of(step.method, step.bits)
        waiting.append((name or f"{step.name or step.engine} {number}", step, report))
        if len(waiting) == TOGETHER:
            found |= _bounded(waiting, limit)
            waiting = []
    found |= _bounded(waiting, limit)
    return Run(found, known)


def is_known(name: str, receipt: Receipt, rejected: Mapping[str, str | None]) -> bool:
    """Whether a baseline lists this frame as rejected at the same stage."""
    return name in rejected and rejected[name] == receipt.stage


def load(path: str | os.PathLike[str]) -> dict[str, Any]:
    """A recorded run.

    Raises
    ------
    InputError
        If the file cannot be read, or is not a recorded run.
    """
    try:
        loaded = json.loads(Path(path).read_text(encoding="utf-8"))
    except (OSError, ValueError) as error:
        raise InputError(f"{path}: {error}") from error
    if not isinstance(loaded, dict) or not isinstance(loaded.get("rejected"), dict):
        raise InputError(f"{path}: rejected: is missing: this file is not a recorded run")
    return loaded


def _read(frames: Iterable[Any], adapter: Adapter | None) -> Iterator[tuple[str, Step, Report]]:
    for frame in frames:
        if isinstance(frame, (str, os.PathLike)):
            for path in frame_files(Path(frame)):
                step = files.read(path)
                yield str(path), step, of_step(step)
        elif isinstance(frame, tuple):
            model, data, *before = frame
            if worlds(data) > 1:
                yield from (("", *of_world(model, data, world)) for world in range(worlds(data)))
            else:
                yield ("", *read(model, data, adapter, before[0] if before else None))
        else:
            yield ("", *read(frame, None, adapter, None))


def frame_files(path: Path) -> list[Path]:
    """The problem files of a folder, or the file itself.

    Raises
    ------
    InputError
        If a problem of the folder has no answer next to it, or an answer has no problem; one line for each. Files
        ``receipt.json``, which ``Receipt.save`` writes, are neither.
    """
    if not path.is_dir():
        return [path]
    frames = {file for file in path.rglob("*.json") if file.name != "receipt.json"}
    answers = {file for file in frames if file.name.endswith(files.ANSWER)}
    problems = {files.answer_of(file): file for file in frames - answers}
    alone = [f"{problems[own]}: its answer {own.name} is missing" for own in problems.keys() - answers]
    stems = ((own, own.name.removesuffix(files.ANSWER)) for own in answers - problems.keys())
    alone += [f"{own}: its problem {stem}.json is missing" for own, stem in stems]
    if alone:
        raise InputError("\n".join(sorted(alone)))
    return sorted(problems.values())


def _bounded(waiting: list[tuple[str, Step, Report]], limit: float | None) -> dict[str, Receipt]:
    bounds = bounds_of([step for _, step, _ in waiting])
    return {name: Receipt(step, own, report, limit) for (name, step, report), own in zip(waiting, bounds)}


def quantile(ordered: list[float], part: float) -> float:
    """The value that this fraction of the values do not exceed."""
    return ordered[min(len(ordered) - 1, max(0, math.ceil(part * len(ordered)) - 1))]


def spread(ordered: list[float], part: float) -> float | None:
    """The upper end of the quantile's range in samples of this size; None where the largest value is within it."""
    count = len(ordered)
    rank = math.ceil(part * count + DEVIATIONS * math.sqrt(count * part * (1 - part)))
    return ordered[rank - 1] if rank < count else None


def _worse(errors: list[float], baseline: Mapping[str, Any], floor: float) -> list[str]:
    worse = []
    for part in QUANTILES:
        most = baseline.get("spreads", {}).get(str(part))
        if most is None or not errors:
            continue
        own = quantile(errors, part)
        if own > max(float(most), floor):
            error = f"quantile {part} of the motion error is {own:.1e}, at most {most:.1e}"
            worse.append(f"worse than the baseline: {error}")
    return worse


def _file_name(name: str) -> str:
    return "".join(letter if letter.isalnum() or letter in "-_." else "-" for letter in name).strip("-.") or "frame"

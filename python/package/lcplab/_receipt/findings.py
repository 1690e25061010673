"""The findings of a stage: differences, measured and compared with their limits."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

from lcplab._receipt.step import number

#: The stages in the order in which an engine passes them.
STAGES = ("collision", "assembly", "solver", "write-back")


@dataclass(frozen=True)
class Finding:
    """A measured error of a stage; rejected if it is above its limit."""

    stage: str
    #: What was compared, as a sentence.
    what: str
    #: The error without unit, and the largest that is accepted.
    error: float
    limit: float
    row: int | None = None
    bodies: tuple[str, ...] = ()

    @property
    def is_rejected(self) -> bool:
        """Whether the error is above the limit, or not a number."""
        return not self.error <= self.limit


    def to_json(self) -> dict[str, Any]:
        """The finding as JSON."""
        return {"stage": self.stage, "what": self.what, "error": number(self.error), "limit": number(self.limit),
                "row": None if self.row is None else int(self.row), "bodies": list(self.bodies)}

    @classmethod
    def of(cls, written: Mapping[str, Any]) -> Finding:
        """The finding of its JSON."""
        error, limit = float(written["error"]), float(written["limit"])
        return cls(written["stage"], written["what"], error, limit, written["row"], tuple(written["bodies"]))


@dataclass
class Report:
    """The findings of a stage, and the parts that were not checked."""

    findings: list[Finding] = field(default_factory=list)
    not_checked: list[str] = field(default_factory=list)

    def add(self, other: Report) -> None:
        """Add the findings of another report."""
        self.findings += other.findings
        self.not_checked += other.not_checked

    def to_json(self) -> dict[str, Any]:
        """The report as JSON."""
        return {"findings": [finding.to_json() for finding in self.findings], "not_checked": list(self.not_checked)}

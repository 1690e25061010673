"""The findings of a stage: differences, measured and compared with their limits."""

from __future__ import annotations

from dataclasses import dataclass, field

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


@dataclass
class Report:
    """The findings of a stage, and the parts that were not checked."""

    findings: list[Finding] = field(default_factory=list)
    not_checked: list[str] = field(default_factory=list)

    def add(self, other: Report) -> None:
        """Add the findings of another report."""
        self.findings += other.findings
        self.not_checked += other.not_checked

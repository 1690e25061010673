"""The parts of a model that a scene cannot express, and notes on the translation."""

from __future__ import annotations

from dataclasses import dataclass, field


@dataclass(frozen=True)
class Refusal:
    """An element of a model that has no counterpart in a scene."""

    #: The tag of the element in the file, such as ``joint``.
    element: str
    name: str
    reason: str
    #: The body of the element, if it has one.
    body: str = ""
    #: Where the element is in the compiled model: its kind, and its number among them.
    place: tuple[str, int] | None = None

    def __str__(self) -> str:
        where = f" of body {self.body!r}" if self.body and self.element != "body" else ""
        return f"<{self.element}> {self.name!r}{where}: {self.reason}"


@dataclass
class Log:
    """What an import refused, and what it translated with a remark."""

    refusals: list[Refusal] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def refuse(
        self, element: str, name: str, reason: str, body: str = "", place: tuple[str, int] | None = None
    ) -> None:
        """Add an element that has no counterpart."""
        self.refusals.append(Refusal(element, name, reason, body, place))

    def note(self, text: str) -> None:
        """Add a remark, once."""
        if text not in self.notes:
            self.notes.append(text)

"""Lines of the elements of an MJCF or URDF file, for messages."""

from __future__ import annotations

from pathlib import Path
from xml.parsers import expat

#: The elements of a file that become these of the compiled model.
TAGS = {
    "body": ("body", "link"),
    "actuator": ("motor", "position", "velocity", "intvelocity", "damper", "cylinder", "muscle", "adhesion", "general"),
    "tendon": ("fixed", "spatial"),
}


class Lines:
    """The file and line of each named element, included files too."""

    def __init__(self, path: Path) -> None:
        self._path = path
        self._lines: dict[tuple[str, str], str] = {}
        self._read(path)

    def _read(self, path: Path) -> None:
        parser = expat.ParserCreate()

        def start(tag: str, attributes: dict[str, str]) -> None:
            place = f"{path}:{parser.CurrentLineNumber}"
            if (name := attributes.get("name")) is not None:
                self._lines.setdefault((tag, name), place)
            if tag == "include" and (included := path.parent / attributes.get("file", "")).is_file():
                self._read(included)

        parser.StartElementHandler = start
        parser.Parse(path.read_bytes(), True)

    def place(self, element: str, name: str, body: str) -> str:
        """FILE:LINE of an element, else that of its body, else FILE."""
        own = [(tag, name) for tag in TAGS.get(element, (element,))] + [(tag, body) for tag in TAGS["body"]]
        return next((self._lines[key] for key in own if key in self._lines), str(self._path))

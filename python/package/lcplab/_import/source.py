"""Lines of the elements of an MJCF or URDF file, for messages."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any
from xml.parsers import expat

from lcplab._import.refused import Refusal

#: The elements of a file that become these of the compiled model.
TAGS = {
    "body": ("body", "link"),
    "joint": ("joint", "freejoint"),
    "actuator": ("motor", "position", "velocity", "intvelocity", "damper", "cylinder", "muscle", "adhesion", "dcmotor", "general"),
    "tendon": ("fixed", "spatial"),
}
#: The sections of a file whose children are numbered in their order.
SECTIONS = ("actuator", "tendon", "equality")


@dataclass
class Element:
    """An element of the file, with those of included files in place of ``include``."""

    tag: str
    attributes: dict[str, str]
    place: str
    children: list[Element] = field(default_factory=list)

    def all(self) -> Iterator[Element]:
        """This element and all inside it, in their order."""
        yield self
        for child in self.children:
            yield from child.all()


class Lines:
    """The file and line of each element of a file that MuJoCo compiles to this model."""

    def __init__(self, path: Path, model: Any) -> None:
        self._path = path
        root = _parsed(path)
        self._named: dict[tuple[str, str], str] = {}
        self._attributes: dict[tuple[str, str], str] = {}
        for element in root.all():
            if (name := element.attributes.get("name")) is not None:
                self._named.setdefault((element.tag, name), element.place)
            for attribute in element.attributes:
                self._attributes.setdefault((element.tag, attribute), element.place)
        counts = {
            "body": model.nbody, "joint": model.njnt, "geom": model.ngeom, "actuator": model.nu,
            "tendon": model.ntendon, "equality": model.neq, "pair": model.npair,
        }
        # Where MuJoCo makes several elements of one, such as a cable, their numbers do not tell which.
        self._numbered = {
            kind: places for kind, places in _numbered(root).items() if len(places) == counts[kind]
        }

    def place(self, refusal: Refusal) -> str:
        """FILE:LINE of an element, else that of its body, else FILE."""
        element, name = refusal.element, refusal.name
        for tag in TAGS.get(element, (element,)):
            if (tag, name) in self._named:
                return self._named[tag, name]
        if element in ("option", "flag") and (element, name) in self._attributes:
            return self._attributes[element, name]
        if refusal.place is not None:
            kind, number = refusal.place
            if kind in self._numbered:
                return self._numbered[kind][number]
        bodies = [self._named[tag, refusal.body] for tag in TAGS["body"] if (tag, refusal.body) in self._named]
        return bodies[0] if bodies else str(self._path)


def _parsed(path: Path) -> Element:
    """The root of a file."""
    parser = expat.ParserCreate()
    open_elements = [Element("", {}, str(path))]

    def start(tag: str, attributes: dict[str, str]) -> None:
        element = Element(tag, attributes, f"{path}:{parser.CurrentLineNumber}")
        included = path.parent / attributes.get("file", "")
        if tag == "include" and included.is_file():
            open_elements[-1].children += _parsed(included).children
        else:
            open_elements[-1].children.append(element)
        open_elements.append(element)

    def end(tag: str) -> None:
        open_elements.pop()

    parser.StartElementHandler, parser.EndElementHandler = start, end
    parser.Parse(path.read_bytes(), True)
    return open_elements[0].children[0]


def _numbered(root: Element) -> dict[str, list[str]]:
    """The places of the elements of each kind, in the order of the compiled model."""
    found: dict[str, list[str]] = {kind: [] for kind in (*SECTIONS, "pair")}
    bodies = [root.place]
    of_bodies: dict[str, list[list[str]]] = {"joint": [[]], "geom": [[]]}

    def visit(parent: Element, body: int) -> None:
        for element in parent.children:
            if element.tag == "body":
                bodies.append(element.place)
                for places in of_bodies.values():
                    places.append([])
                visit(element, len(bodies) - 1)
            elif element.tag == "frame":
                visit(element, body)
            elif element.tag == "replicate":
                for _ in range(int(element.attributes.get("count", "1"))):
                    visit(element, body)
            for kind, places in of_bodies.items():
                if element.tag in TAGS.get(kind, (kind,)):
                    places[body].append(element.place)

    for section in root.children:
        if section.tag == "worldbody":
            visit(section, 0)
        elif section.tag in SECTIONS:
            found[section.tag] += [element.place for element in section.children]
        elif section.tag == "contact":
            found["pair"] += [element.place for element in section.children if element.tag == "pair"]
    found |= {kind: [place for own in places for place in own] for kind, places in of_bodies.items()}
    return found | {"body": bodies}

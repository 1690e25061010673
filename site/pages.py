"""Sections, groups and pages, and where each source file of the repository is found on the site."""

from dataclasses import dataclass, field
from pathlib import Path


@dataclass
class Page:
    """A page: `body` is what stands in its <main>, `whole` a document that lcplab wrote; `weight` is what its words count
    in the search, which does not know pages of weight 0."""

    address: str
    title: str
    about: str = ""
    short: str = ""
    source: str = ""
    body: str = ""
    whole: str = ""
    headings: list[tuple[str, str]] = field(default_factory=list)
    weight: float = 1.0
    listed: bool = True

    @property
    def label(self) -> str:
        return self.short or self.title


@dataclass
class Group:
    title: str
    pages: list[Page]


@dataclass
class Section:
    name: str
    title: str
    lead: str
    groups: list[Group] = field(default_factory=list)

    @property
    def address(self) -> str:
        return f"{self.name}/index.html"

    @property
    def pages(self) -> list[Page]:
        return [page for group in self.groups for page in group.pages]

    @property
    def order(self) -> list[Page]:
        """The pages that a reader turns: without those that only a table lists."""
        return [page for page in self.pages if page.listed]


def relative(address: str, start: str) -> str:
    """The link to `address` in a page that stands at `start`."""
    target, fragment = (address.split("#", 1) + [""])[:2]
    up = "../" * start.count("/")
    while up and "/" in target and start.split("/")[0] == target.split("/")[0]:
        start, target, up = start.split("/", 1)[1], target.split("/", 1)[1], up[3:]
    return up + target + (f"#{fragment}" if fragment else "")


def write(out: Path, address: str, text: str) -> None:
    path = out / address
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(text, encoding="utf-8")

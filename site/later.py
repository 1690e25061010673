"""Long pages in parts: the text at once; tables, data and drawings after it.

A report holds megabytes of drawings, and a live page its solvers, so that each is one file. A reader of the site would wait
for all of that before the first word. later.js puts the parts into their places and runs the script of the page."""

import hashlib
import json
import re
from pathlib import Path

from pages import relative, write

SHORTEST = 2000  # characters that are worth a place of their own
LONG = 200_000  # characters of parts that make a page long
FILE = 100_000  # characters of drawings in a file, about

NOTE = "<noscript><p>The figures of this page need JavaScript.</p></noscript>"

PLACES = re.compile(
    r"(?P<fold><details\b(?![^>]*\bopen\b)[^>]*>)|(?P<unfold></details>)"
    r"|<(?P<name>svg|table|script)\b(?P<attributes>[^>]*)>(?P<inside>.*?)</(?P=name)>",
    re.DOTALL,
)
OWN_SCRIPT = re.compile(r"<script>(.*?)</script>\n?", re.DOTALL)


def split(text: str, address: str, out: Path) -> str:
    """The page without its long parts, which are written to files; pages with the same parts share them."""
    first: dict[str, str] = {}  # what the page's script needs: data, folded tables, drawings that it moves
    drawings: dict[str, str] = {}
    depth = 0

    def place(found: re.Match[str]) -> str:
        nonlocal depth
        if found["fold"] or found["unfold"]:
            depth += 1 if found["fold"] else -1 if depth else 0
            return found[0]
        name, attributes, inside = found["name"], found["attributes"], found["inside"]
        can_wait = {"svg": True, "table": depth > 0, "script": "type=" in attributes}[name]
        if not can_wait or len(inside) < SHORTEST:
            return found[0]
        key = str(len(first) + len(drawings))
        (drawings if name == "svg" and "class=" not in attributes else first)[key] = inside
        return f'<{name}{attributes} data-later="{key}"></{name}>'

    head, body = text.split("<body", 1)
    body = PLACES.sub(place, body)
    scripts = OWN_SCRIPT.findall(body)
    if sum(map(len, [*first.values(), *drawings.values()])) < LONG or len(scripts) != 1:
        return text

    def stored(content: str) -> str:
        name = f"parts/{hashlib.sha256(content.encode()).hexdigest()[:16]}.js"
        write(out, name, content)
        return relative(name, address)

    def parts(group: dict[str, str]) -> str:
        return stored(f"globalThis.parts = {json.dumps(group, ensure_ascii=False)};\n")

    rest = " ".join(parts(group) for group in grouped(drawings))
    later = (
        f'<script async src="{relative("later.js", address)}" data-first="{parts(first)}" '
        f'data-own="{stored(scripts[0])}" data-rest="{rest}"></script>\n'
    )
    body = OWN_SCRIPT.sub(lambda _: later, body).replace("</h1>", f"</h1>\n{NOTE}", 1)
    return re.sub(r"script-src 'sha256-[^' ]*'", "script-src 'self'", head) + "<body" + body


def grouped(parts: dict[str, str]) -> list[dict[str, str]]:
    groups: list[dict[str, str]] = []
    for key, part in parts.items():
        if not groups or sum(map(len, groups[-1].values())) > FILE:
            groups.append({})
        groups[-1][key] = part
    return groups

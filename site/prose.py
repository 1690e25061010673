"""Markdown of the repository as HTML: headings with anchors, colored code, links that lead to the site's pages."""

import html
import posixpath
import re
from collections.abc import Callable
from dataclasses import dataclass
from itertools import count

from markdown_it import MarkdownIt
from mdit_py_plugins.anchors import anchors_plugin
from pygments.lexers import get_lexer_by_name
from pygments.token import Comment, Generic, Keyword, Number, String
from pygments.util import ClassNotFound

# The classes are those of the pages that lcplab writes.
COLORS = [
    (Comment, "comment"),
    (Generic.Prompt, "comment"),
    (Keyword, "word"),
    (String, "text"),
    (Number, "number"),
]


@dataclass
class Prose:
    title: str
    body: str
    headings: list[tuple[str, str]]


def slug(title: str) -> str:
    """The anchor of a heading, as forges make it."""
    return re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")


def colored(code: str, language: str, _attributes: str = "") -> str:
    try:
        lexer = get_lexer_by_name(language, stripnl=False)
    except ClassNotFound:
        return html.escape(code, quote=False)
    parts = []
    for kind, text in lexer.get_tokens(code):
        name = next((name for token, name in COLORS if kind in token), None)
        text = html.escape(text, quote=False)
        parts.append(f'<span class="{name}">{text}</span>' if name and text.strip() else text)
    return "".join(parts)


def parser() -> MarkdownIt:
    markdown = MarkdownIt("commonmark", {"highlight": colored}).enable(["table", "strikethrough"])
    return markdown.use(anchors_plugin, max_level=4, slug_func=slug)


def render(text: str, source: str, link: Callable[[str], str]) -> Prose:
    """Renders the file `source`; `link` turns a path in the repository into the address to write."""
    tokens = parser().parse(text)
    for token in tokens:
        for child in token.children or []:
            for key in ("href", "src"):
                target = child.attrGet(key)
                if isinstance(target, str) and not re.match(r"[a-z]+:|#|$", target):
                    child.attrSet(key, link(resolved(target, source)))
    markdown = parser()
    body = markdown.renderer.render(tokens, markdown.options, {})
    # A wide table or listing scrolls in its own frame, which the keyboard can reach.
    numbers = count(1)
    frame = '<div class="scroll" tabindex="0" role="region" aria-label="Table {}"><table>'
    body = re.sub("<table>", lambda _: frame.format(next(numbers)), body)
    body = body.replace("</table>", "</table></div>").replace("<pre>", '<pre tabindex="0">')
    body = re.sub(r"<td(.*?)>(.*?)</td>", wide, body, flags=re.DOTALL)
    body = re.sub(r"<th( style=\"[^\"]*\")?></th>", r"<td\1></td>", body)
    titles = [
        (t.attrGet("id"), plain(tokens[i + 1])) for i, t in enumerate(tokens) if t.type == "heading_open"
    ]
    levels = [t.tag for t in tokens if t.type == "heading_open"]
    headings = [
        (str(name), title) for (name, title), level in zip(titles, levels, strict=True) if level == "h2"
    ]
    return Prose(titles[0][1] if titles else source, body, headings)


LONG = 60


def wide(cell: re.Match[str]) -> str:
    """A cell with a sentence gets room for it."""
    words = re.sub("<.*?>", "", cell[2])
    return f'<td{cell[1]} class="long">{cell[2]}</td>' if len(words) > LONG else cell[0]


def plain(heading) -> str:
    return "".join(child.content for child in heading.children or [] if child.type in ("text", "code_inline"))


def resolved(target: str, source: str) -> str:
    path, mark, fragment = target.partition("#")
    return posixpath.normpath(posixpath.join(posixpath.dirname(source), path)) + mark + fragment

"""The frame around a page: header, contents of its section, previous and next, footer."""

import html
import json
import re

from pages import Page, Section, relative

# What a page of the site may load: its own files, and nothing from elsewhere.
POLICY = (
    "default-src 'none'; script-src 'self'{wasm}; style-src 'self' 'unsafe-inline'; img-src 'self' data:; "
    "font-src 'self' data:; {search}base-uri 'none'; form-action 'self'"
)
SEARCH_POLICY = POLICY.format(wasm=" 'wasm-unsafe-eval'", search="connect-src 'self'; worker-src 'self'; ")
PAGE_POLICY = POLICY.format(wasm="", search="")

ICON = (
    "data:image/svg+xml,%3Csvg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 16 16'%3E%3Cg fill='%233b82c4'%3E"
    "%3Crect x='4.5' y='1' width='7' height='4' rx='.7'/%3E%3Crect x='3' y='6' width='10' height='4' rx='.7'/%3E"
    "%3Crect x='1.5' y='11' width='13' height='4' rx='.7'/%3E%3C/g%3E%3C/svg%3E"
)

MOON = (
    '<svg viewBox="0 0 16 16" aria-hidden="true"><circle cx="8" cy="8" r="6.2"/>'
    '<path d="M8 1.8a6.2 6.2 0 0 1 0 12.4z"/></svg>'
)


class Frame:
    def __init__(self, sections: list[Section], version: str, commit: str) -> None:
        self.sections, self.version, self.commit = sections, version, commit

    def document(
        self,
        page: Page,
        main: str,
        section: Section | None = None,
        policy: str = PAGE_POLICY,
        script: str = "",
        found: bool = True,
    ) -> str:
        """A whole page with `main` in it; the search knows it if `found` and its weight is above 0."""

        def to(address: str) -> str:
            return relative(address, page.address)

        title = page.title if page.title == "lcplab" else f"{page.title} · lcplab"
        scripts = f'<script type="module" src="{to(script)}"></script>\n' if script else ""
        indexed = f" {self.indexed(page)}" if found and page.weight else ""
        meta = self.described(page, section) if section else ""
        side = self.side(page, section) if section else ""
        return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta name="color-scheme" content="light dark">
<meta name="description" content="{html.escape(page.about or page.title)}">
<title>{html.escape(title)}</title>
<link rel="icon" href="{ICON}">
<link rel="stylesheet" href="{to("site.css")}">
{scripts}</head>
<body class="{"plain" if not section else "sided"}">
<a class="skip" href="#content">Skip to the content</a>
{self.header(page, section)}
{side}<script src="{to("site.js")}"></script>
<main id="content" tabindex="-1"{indexed}>{meta}
{main}
</main>
{self.pager(page, section)}{self.footer(page)}
</body>
</html>
"""

    @staticmethod
    def indexed(page: Page) -> str:
        """What tells the search to read an element, and how much its words count."""
        return "data-pagefind-body" + (f' data-pagefind-weight="{page.weight:g}"' if page.weight != 1 else "")

    @staticmethod
    def described(page: Page, section: Section) -> str:
        """What the search shows of a page besides its words, and also looks into."""
        facts = {"section": section.title, "about": page.about.replace("`", "")}
        if page.title == "lcplab":
            facts["title"] = page.label
        return "".join(
            f'<span data-pagefind-meta="{name}[title]" title="{html.escape(text)}" hidden></span>'
            for name, text in facts.items()
        )

    def header(self, page: Page, section: Section | None) -> str:
        links = []
        for other in self.sections:
            here = ' aria-current="true"' if other is section else ""
            links.append(
                f'<li><a href="{relative(other.address, page.address)}"{here}>{other.title}</a></li>'
            )
        home, search = relative("index.html", page.address), relative("search.html", page.address)
        return f"""<header class="top">
<a class="brand" href="{home}"><img src="{ICON}" alt="" width="20" height="20"> lcplab</a>
<nav aria-label="Sections"><ul>{"".join(links)}</ul></nav>
<form action="{search}" method="get" role="search"><input type="search" name="q" aria-label="Search this site" placeholder="Search" autocomplete="off"></form>
<button type="button" class="theme" hidden aria-pressed="false" aria-label="Dark colors">{MOON}</button>
</header>"""

    def side(self, page: Page, section: Section) -> str:
        """The pages of the section, with the headings of this one."""
        parts = []
        for group in section.groups:
            items = []
            for other in (other for other in group.pages if other.listed):
                here = other is page
                inside = "".join(
                    f'<li><a href="#{name}">{html.escape(title)}</a></li>' for name, title in page.headings
                )
                inside = f"<ul>{inside}</ul>" if here and inside else ""
                mark = ' aria-current="page"' if here else ""
                link = relative(other.address, page.address)
                items.append(f'<li><a href="{link}"{mark}>{html.escape(other.label)}</a>{inside}</li>')
            parts.append(f"<h2>{html.escape(group.title)}</h2>\n<ul>{''.join(items)}</ul>")
        return f"""<nav class="side" aria-label="{section.title}"><details open>
<summary>{section.title}</summary>
{chr(10).join(parts)}
</details></nav>
"""

    def pager(self, page: Page, section: Section | None) -> str:
        before, after = neighbors(page, section)
        if not before and not after:
            return ""
        links = [
            f'<a rel="{rel}" href="{relative(other.address, page.address)}"><span>{word}</span> {html.escape(other.label)}</a>'
            for other, rel, word in ((before, "prev", "Previous"), (after, "next", "Next"))
            if other
        ]
        return f'<nav class="pager" aria-label="Previous and next">{"".join(links)}</nav>\n'

    def footer(self, page: Page) -> str:
        def link(address: str, text: str) -> str:
            return f'<a href="{relative(address, page.address)}">{text}</a>'

        return f"""<footer>
<p>lcplab {self.version}, commit {self.commit}. MIT or Apache-2.0. {link("reference/changes.html", "Changes")},
{link("reference/cite.html", "how to cite")}, {link("reference/limitations.html", "limitations")}.</p>
</footer>"""

    def barred(self, page: Page, section: Section) -> str:
        """A document that lcplab wrote, with a bar that leads back, also out of a frame, and made findable."""
        before, after = neighbors(page, section)
        turns = [
            f'<a target="_top" rel="{rel}" href="{relative(other.address, page.address)}" title="{html.escape(other.label)}" '
            f'aria-label="{word}: {html.escape(other.label)}">{arrow}</a>'
            for other, rel, word, arrow in ((before, "prev", "Previous", "←"), (after, "next", "Next", "→"))
            if other
        ]
        bar = (
            f'<style>{BAR}</style>\n<nav class="site-bar" aria-label="lcplab">'
            f'<a target="_top" href="{relative("index.html", page.address)}">lcplab</a>'
            f'<a target="_top" href="{relative(section.address, page.address)}">{section.title}</a>'
            f'<a target="_top" href="{relative("search.html", page.address)}">Search</a><span>{"".join(turns)}</span></nav>\n'
        )
        about = html.escape(page.about.replace("`", "") or page.title)
        text = page.whole.replace("<title>", f'<meta name="description" content="{about}">\n<title>', 1)
        skip = '<a class="skip" href="#content">Skip to the content</a>\n'
        if skip in text:
            bar = skip + bar
            text = text.replace(skip, "", 1)
        text = re.sub(r"<body[^>]*>\n?", lambda body: body[0] + bar, text, count=1)
        text = re.sub(
            '<main id="content"([^>]*)>',
            lambda main: f'<main {self.indexed(page)} id="content"{main[1]}>{self.described(page, section)}',
            text,
            count=1,
        )
        return text.replace("</main>", f"{self.pager(page, section)}</main>", 1)


# The bar takes the colors of the page that it stands on.
BAR = """
.site-bar { position: absolute; inset: 0 0 auto 0; display: flex; gap: 1.2rem; align-items: center; height: 2.75rem;
  padding: 0 1rem; border-bottom: 1px solid var(--rule); background: var(--paper);
  font: 0.9rem/1 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif; }
.site-bar a { color: var(--link); text-decoration: none; padding: 0.6rem 0; }
.site-bar a:hover { text-decoration: underline; }
.site-bar a:first-child { font-weight: 700; }
.site-bar span { margin-left: auto; white-space: nowrap; }
.site-bar span a { padding: 0.6rem 0.8rem; }
.pager { display: flex; justify-content: space-between; gap: 1rem; flex-wrap: wrap; margin: 3rem 0 0;
  font: 0.95rem/1.4 system-ui, -apple-system, "Segoe UI", Roboto, "Noto Sans", "Liberation Sans", Arial, sans-serif; }
.pager span { display: block; color: var(--faint); font-size: 0.8rem; }
.pager [rel="next"] { margin-left: auto; text-align: right; }
@media screen { body { padding-top: 4.4rem !important; } }
@media print { .site-bar, .pager { display: none; } }
"""


def neighbors(page: Page, section: Section | None) -> tuple[Page | None, Page | None]:
    order = section.order if section else []
    if page not in order:
        return None, None
    k = order.index(page)
    return (order[k - 1] if k else None), (order[k + 1] if k + 1 < len(order) else None)


def index(section: Section, start: str) -> str:
    """The first page of a section: every page of it, with a line about each."""
    parts = [f"<h1>{section.title}</h1>", f'<p class="lead">{html.escape(section.lead)}</p>']
    for group in section.groups:
        parts.append(f'<h2>{html.escape(group.title)}</h2>\n<ul class="entries">')
        for page in (page for page in group.pages if page.listed):
            link = f'<a href="{relative(page.address, start)}">{html.escape(page.label)}</a>'
            parts.append(f"<li>{link}<p>{html.escape(page.about)}</p></li>".replace("`", ""))
        parts.append("</ul>")
    return "\n".join(parts)


def island(name: str, value: object) -> str:
    """Data for a script of the page."""
    text = json.dumps(value, separators=(",", ":")).replace("<", "\\u003c")
    return f'<script type="application/json" id="{name}">{text}</script>'

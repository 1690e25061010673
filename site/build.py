"""Builds the site of lcplab: `python3 site/build.py --out FOLDER`. README.md here says what is needed."""

import argparse
import os
import re
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

import home
import later
import problem_set
import prose
from frame import SEARCH_POLICY, Frame, index
from made import FONT, Maker
from pages import Group, Page, Section, relative, write

HERE = Path(__file__).resolve().parent
ROOT = HERE.parent


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Build the site of lcplab as a folder of static files.")
    parser.add_argument("--out", type=Path, required=True, help="folder to write; what is in it is replaced")
    parser.add_argument(
        "--work",
        type=Path,
        default=ROOT / "target/site",
        help="what lcplab has written; kept and used again (default: target/site)",
    )
    parser.add_argument(
        "--lcplab",
        type=Path,
        default=ROOT / "target/release/lcplab",
        help="the program (default: target/release/lcplab)",
    )
    parser.add_argument(
        "--rustdoc",
        type=Path,
        help="folder that `cargo doc --workspace --no-deps` wrote; without it the Rust reference is left out",
    )
    parser.add_argument(
        "--pyodide",
        type=Path,
        help="unpacked Pyodide distribution, with which the Python cells of the lessons run in the browser",
    )
    parser.add_argument("--quick", action="store_true", help="leave out the reports that have to be solved")
    return parser.parse_args()


def main() -> None:
    given = arguments()
    out = given.out.resolve()
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    given.work.mkdir(parents=True, exist_ok=True)
    pyodide = given.pyodide and given.pyodide.resolve()
    maker = Maker(ROOT, given.work.resolve(), given.lcplab.resolve(), given.quick, pyodide)
    sections = planned(maker, out, given.rustdoc)
    add_unlisted(sections)
    sources = Sources(sections, out)
    for section in sections:
        for page in section.pages:
            if page.source.endswith(".md") and not page.whole:
                fill(page, sources, maker.work)
    frame = Frame(sections, version(), commit())
    for section in sections:
        for page in section.pages:
            if page.whole:
                text = later.split(linked(frame.barred(page, section), page, sources), page.address, out)
            else:
                text = frame.document(page, page.body, section)
            if page.address != RUST:
                write(out, page.address, text)
        first = Page(section.address, section.title, section.lead)
        write(
            out, section.address, frame.document(first, index(section, section.address), section, found=False)
        )
    front = home.page(maker, sections)
    write(out, front.address, frame.document(front, front.body, script="home.js", found=False))
    search = Page("search.html", "Search", "Search the pages of lcplab.")
    write(
        out,
        search.address,
        frame.document(search, SEARCH, policy=SEARCH_POLICY, script="search.js", found=False),
    )
    for missing in sources.shown:
        write(out, missing.address, frame.document(missing, missing.body))
    for name in ("site.js", "home.js", "later.js", "search.js"):
        shutil.copy(HERE / name, out / name)
    shutil.copy(ROOT / "crates/page/src/assets" / FONT, out / FONT)
    (out / "site.css").write_text(style(), encoding="utf-8")
    subprocess.run(
        [
            sys.executable,
            "-m",
            "pagefind",
            "--site",
            str(out),
            "--exclude-selectors",
            "svg,.pager,.anchor,section pre",  # code of lessons has names that are words elsewhere
            "--quiet",
        ],
        check=True,
    )
    print(f"{out}: {sum(len(section.pages) for section in sections)} pages")


SEARCH = """<h1>Search</h1>
<form><input type="search" name="q" aria-label="Words to search for" placeholder="scaled residual" autocomplete="off" autofocus></form>
<p id="state" role="status"></p>
<ol id="results"></ol>
<noscript><p>The search needs JavaScript. Every page is listed on the <a href="index.html">first page</a>.</p></noscript>"""

def linked(text: str, page: Page, sources: "Sources") -> str:
    """A document that lcplab wrote, with the pages that it names as files of the repository as links."""

    def link(named: re.Match[str]) -> str:
        return f'<a href="{sources.link(named[1], page.address)}">{named[0]}</a>'

    return re.sub(r"<code>((?:docs|notebooks)/\w+\.md)</code>(?![^<]*</a>)", link, text)


RUST = "reference/rust/lcplab/index.html"


def planned(maker: Maker, out: Path, rustdoc: Path | None) -> list[Section]:
    """The sections of contents.toml; what lcplab writes is written here."""
    groups = {
        "lessons": lambda: maker.lessons(out),
        "live": maker.live,
        "teaching": maker.teaching,
        "chapter": maker.chapter,
        "problem_set": lambda: problem_set.pages(maker, out),
        "reports": lambda: maker.reports(out),
        "interfaces": lambda: [maker.options(), *rust(rustdoc, out)],
    }
    sections = []
    for entry in tomllib.loads((HERE / "contents.toml").read_text(encoding="utf-8"))["section"]:
        section = Section(entry["name"], entry["title"], entry["lead"])
        for group in entry["group"]:
            pages = [of_file(section, page) for page in group.get("pages", [])]
            if made := group.get("made"):
                pages += groups[made]()
            section.groups.append(Group(group["title"], pages))
        sections.append(section)
    return sections


def add_unlisted(sections: list[Section]) -> None:
    """Pages of docs without a line in contents.toml follow in the last group."""
    listed = {page.source for section in sections for page in section.pages}
    for file in sorted(ROOT.glob("docs/*.md")):
        source = file.relative_to(ROOT).as_posix()
        if source not in listed:
            sections[-1].groups[-1].pages.append(of_file(sections[-1], {"page": source, "about": ""}))


def of_file(section: Section, entry: dict[str, Any]) -> Page:
    name = entry.get("name") or Path(entry["page"]).stem
    weight = float(entry.get("weight", 1))
    return Page(
        f"{section.name}/{name}.html", name, entry["about"], entry.get("short", ""), entry["page"], weight=weight
    )


def fill(page: Page, sources: "Sources", work: Path) -> None:
    text = (ROOT / page.source).read_text(encoding="utf-8")
    if page.source == "docs/cite.md":
        text = problem_set.cited(text, work / "set")
    done = prose.render(text, page.source, lambda target: sources.link(target, page.address))
    page.title, page.body, page.headings = done.title, done.body, done.headings


def rust(rustdoc: Path | None, out: Path) -> list[Page]:
    """The pages that cargo doc wrote, as they are."""
    if not rustdoc:
        return []
    leave = shutil.ignore_patterns("*.lock", ".*")
    shutil.copytree(rustdoc, out / "reference/rust", ignore=leave, dirs_exist_ok=True)
    return [Page(RUST, "Rust library", "Every crate, type and function, as cargo doc writes them.")]


LANGUAGES = {"rs": "rust", "py": "python", "cpp": "c++", "js": "javascript"}


class Sources:
    """Where a file of the repository is found: its page, or else a page that shows its text."""

    def __init__(self, sections: list[Section], out: Path) -> None:
        self.out = out
        self.shown: list[Page] = []
        pages = [page for section in sections for page in section.pages if page.source]
        self.addresses = {page.source: page.address for page in pages}
        self.wholes = {page.address: page.whole for page in pages}
        for source, address in list(self.addresses.items()):
            if source.startswith("notebooks/"):
                self.addresses[source.removesuffix(".md") + ".ipynb"] = address
        self.addresses["notebooks/README.md"] = "learn/index.html"
        self.addresses["docs"] = "guide/index.html"

    def link(self, target: str, start: str) -> str:
        path, mark, fragment = target.partition("#")
        address = self.addresses.get(path) or self.addresses.get(f"{path}/README.md") or self.show(path)
        whole = self.wholes.get(address)
        if whole and f'id="{fragment}"' not in whole:
            mark = fragment = ""  # lcplab numbers the parts of a lesson: they have no anchors by title
        return relative(address + mark + fragment, start)

    def show(self, path: str) -> str:
        file = ROOT / path
        if file.is_dir():
            names = sorted(
                p.name + "/" * p.is_dir() for p in file.iterdir() if not p.name.startswith(("__", "."))
            )
            text, language = "\n".join(names), ""
        elif file.suffix in (".png", ".svg", ".npz", ".ipynb"):
            address = f"files/{path}"
            (self.out / address).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy(file, self.out / address)
            return self.known(path, address)
        else:
            text, language = file.read_text(encoding="utf-8"), file.suffix[1:]
        code = prose.colored(text, LANGUAGES.get(language, language or "text"))
        body = f"<h1><code>{path}</code></h1>\n<p>From the repository of lcplab.</p>\n"
        body += f'<pre tabindex="0"><code>{code}</code></pre>'
        page = Page(f"files/{path}.html", path, f"The file {path} of the repository.", body=body, weight=0)
        self.shown.append(page)
        return self.known(path, page.address)

    def known(self, path: str, address: str) -> str:
        self.addresses[path] = address
        return address


def style() -> str:
    """The style sheet, with the colors and fonts of the pages that lcplab writes."""
    assets = ROOT / "crates/page/src/page"
    light = re.search(r":root \{.*?\n\}", (assets / "page.css").read_text(encoding="utf-8"), re.DOTALL)[0]
    dark = (assets / "dark.css").read_text(encoding="utf-8")
    themes = (
        f'@media screen and (prefers-color-scheme: dark) {{ :root:not([data-theme="light"]) {{\n{dark}}} }}\n'
    )
    themes += f'@media screen {{ :root[data-theme="dark"] {{\n{dark}}} }}\n'
    return f"{light}\n{themes}{(HERE / 'site.css').read_text(encoding='utf-8')}"


def version() -> str:
    return tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]["version"]


def commit() -> str:
    done = subprocess.run(
        ["git", "-C", str(ROOT), "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True
    )
    return done.stdout.strip() or os.environ.get("LCPLAB_COMMIT", "unknown")


if __name__ == "__main__":
    main()

"""Pages that lcplab writes: lessons, live pages, reports, the chapter, and the options of every command."""

import html
import re
import shutil
import subprocess
from dataclasses import dataclass
from pathlib import Path

from pages import Page, relative

# The font of formulas, once for all pages.
FONT = "lcplab-math.woff2"

# Shipped reports, with what each answers.
REPORTS = {
    "standard": "Which solver for contacts and joints, by size and load, and are lcplab's results correct?",
    "engines": "Which laws of mechanics do physics engines obey?",
    "receipts": "Do receipts find known defects of released physics engines?",
    "solvers": "Every solver on every problem family: which succeed, what they cost, and what theory predicts.",
    "schemes": "Time-stepping schemes compared: drift, penetration, energy, order of accuracy.",
    "friction": "Friction models compared with closed-form solutions, and Painlevé's rod, for which no forces exist.",
    "verification": "Closed-form and reference solutions compared with the computed values.",
    "scenes": "Animations of the shipped scenes, with their forces.",
    "chapter": "The chapter by Kenwright & Morgan, with every example and figure recomputed.",
}
DRAWN = ["engines", "receipts"]  # without solving: recorded results
LIVE = {
    "two_rows": "Change A and b, and follow six methods in the plane of x.",
    "stack": "Change masses, step through rows, sweeps and pivots, and simulate two seconds.",
    "friction": "Drag the push, and compare the friction of the square, the polygon and the disk.",
    "cone_proof": "How a box around a contact impulse shows that an exact impulse is in it, or why it does not.",
    "painleve": "Painlevé's paradox: a sliding rod for which one, no or two contact forces exist.",
    "problem": "Enter a problem of up to 60 rows, solve it, and check or prove any answer x.",
}
AROUND = {
    "guide": "A plan of 45 minutes for each lesson.",
    "projects": "Four larger tasks, with milestones and marks.",
    "rust": "The Rust that the lessons use, on one page.",
}
CHAPTER = {
    "errata": "What is printed, what is right, and an example that runs.",
    "references": "The literature that lcplab follows.",
}


@dataclass
class Maker:
    """Runs lcplab; what stands in `work` already is taken from there."""

    root: Path
    work: Path
    lcplab: Path
    quick: bool
    pyodide: Path | None = None

    def run(self, *arguments: str, good: tuple[int, ...] = (0,)) -> str:
        command = [str(self.lcplab), *arguments]
        done = subprocess.run(command, cwd=self.work, capture_output=True, text=True)
        if done.returncode not in good:
            words = (done.stderr or done.stdout).strip()[-2000:]
            raise SystemExit(f"{' '.join(command)} ended with code {done.returncode}:\n{words}")
        return done.stdout

    def kept(self, path: str, *arguments: str, good: tuple[int, ...] = (0,)) -> Path:
        """The file or folder that a command writes, unless it is there; `good` are the exit codes that are no error."""
        target = self.work / path
        if not target.exists():
            target.parent.mkdir(parents=True, exist_ok=True)
            self.run(*arguments, good=good)
        return target

    def whole(self, file: Path, address: str, about: str, up: str) -> Page:
        text = file.read_text(encoding="utf-8").replace('href="live/', f'href="{up}live/')
        text = lightened(text, f"{up}live/", relative(FONT, address))
        title = html.unescape(re.search("<title>(.*?)</title>", text)[1])
        title = title.removesuffix(" · lcplab").removeprefix("lcplab: ")
        return Page(address, title[0].upper() + title[1:], about, whole=text)

    def lessons(self, out: Path) -> list[Page]:
        pages = []
        folder = "lessons_with_python" if self.pyodide else "lessons"
        python = ["--pyodide", str(self.pyodide)] if self.pyodide else []
        for source in sorted((self.root / "notebooks").glob("[0-9][0-9]_*.md")):
            file = self.kept(f"{folder}/{source.stem}.html", "lesson", source.stem, *python, "--out", folder)
            page = self.whole(file, f"learn/{file.name}", question(source), "")
            page.source = f"notebooks/{source.name}"
            pages.append(page)
        if self.pyodide:
            shutil.copytree(self.work / folder / "python", out / "learn/python")
            for name in ("engine.py", "arrays.py"):
                shutil.copy(self.work / folder / name, out / "learn" / name)
        return pages

    def teaching(self) -> list[Page]:
        pages = []
        for name, about in AROUND.items():
            file = self.kept(f"lessons/{name}.html", "lesson", name, "--out", "lessons")
            page = self.whole(file, f"learn/{name}.html", about, "")
            page.source = f"notebooks/{name}.md"
            pages.append(page)
        return pages

    def live(self) -> list[Page]:
        pages, folder = [], self.kept("live", "live", "--all", "--out", "live")
        for name, about in LIVE.items():
            file = folder / f"{name}.html"
            page = self.whole(file, f"learn/live/{name}.html", about, "")
            page.source = f"live/{name}.html"
            page.whole = landmarked(page.whole)
            page.weight = 0.5  # few words, which explain less than those of a lesson
            pages.append(page)
        return pages

    def chapter(self) -> list[Page]:
        pages = []
        for name, about in CHAPTER.items():
            file = self.kept(f"{name}.html", "chapter", name, "--format", "html", "--out", f"{name}.html")
            pages.append(self.whole(file, f"learn/{name}.html", about, ""))
        return pages

    def reports(self, out: Path) -> list[Page]:
        pages, names = [], DRAWN if self.quick else list(REPORTS)
        for name in names:
            folder = self.kept(
                f"reports/{name}/index.html", "report", name, "--out", f"reports/{name}"
            ).parent
            page = self.whole(
                folder / "index.html", f"reports/{name}/index.html", REPORTS[name], "../../learn/"
            )
            for other in (other for other in names if other != name):
                command = f"<code>lcplab report {other}</code>"
                page.whole = page.whole.replace(command, f'<a href="../{other}/index.html">{command}</a>')
            page.weight = 0.5  # long pages have every word
            pages.append(page)
            for beside in (part for part in folder.iterdir() if part.is_dir() and part.name != "live"):
                shutil.copytree(beside, out / f"reports/{name}/{beside.name}")
        return pages

    def options(self) -> Page:
        """Every command with its options, as --help prints them."""
        commands = re.findall(r"^  ([a-z][a-z-]+)  ", self.run("--help"), flags=re.MULTILINE)
        parts = [
            "<h1>Commands and options</h1>",
            "<p>What <code>lcplab COMMAND --help</code> prints, for every command.</p>",
        ]
        for name in commands:
            text = html.escape(self.run(name, "--help"), quote=False)
            parts.append(f'<h2 id="{name}">lcplab {name}</h2>\n<pre tabindex="0"><code>{text}</code></pre>')
        about = "Every command of the program, with every option."
        headings = [(name, name) for name in commands]
        return Page(
            "reference/options.html", "Commands and options", about, body="\n".join(parts), headings=headings
        )


def lightened(text: str, live: str, font: str) -> str:
    """A page without what the site has once: the live pages, which it opens in frames, and the font."""
    text = re.sub(
        r'<script type="application/json" id="live-[a-z_]+">.*?</script>\n?', "", text, flags=re.DOTALL
    )
    text = re.sub(
        r'<details class="live" data-page="([a-z_]+)" data-state="([^"]*)"><summary>(.*?)</summary></details>',
        rf'<details class="live"><summary>\3</summary>'
        rf'<iframe loading="lazy" title="\3" src="{live}\1.html#\2"></iframe></details>',
        text,
    )
    text, found = re.subn(r"data:font/woff2;base64,[A-Za-z0-9+/=]+", font, text, count=1)
    if found:  # before the text, so that formulas do not move it
        early = f'<link rel="preload" as="font" type="font/woff2" href="{font}" crossorigin>'
        text = text.replace("<title>", f"{early}\n<title>", 1)
    return text.replace("font-src data:;", "font-src 'self'; frame-src 'self';", 1)


def landmarked(text: str) -> str:
    """A live page with its content in <main>, for the search and for screen readers."""
    text = re.sub(
        r"<body[^>]*>\n", lambda body: body[0] + '<main id="content" tabindex="-1">\n', text, count=1
    )
    return re.sub(r"<script type=\"application/octet", lambda script: "</main>\n" + script[0], text, count=1)


def question(source: Path) -> str:
    """The question that the course's first page gives a lesson."""
    table = (source.parent / "README.md").read_text(encoding="utf-8")
    row = re.search(rf"\({re.escape(source.name)}\) \| ([^|]*) \|", table)
    return row[1] if row else ""

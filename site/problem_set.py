"""The problem set: a table, a card of each problem, proofs, and an archive that can be cited."""

import csv
import hashlib
import html
import json
import re
import shutil
import subprocess
import zipfile
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from made import Maker
from pages import Page

# The largest number of rows with a proof; larger problems take minutes.
MOST_ROWS = 50

CLAIMS = {
    "no-solution": "no solution exists",
    "unique": "exactly one solution exists, and it is stated",
    "not-unique": "two different solutions are stated",
    "solution": "an exact solution is stated",
    "motion": "a bound on the error of the motion",
    "within": "an answer with its exact residual",
}


def pages(maker: Maker, out: Path) -> list[Page]:
    folder = maker.kept("set/index.csv", "problems", "--export", "set").parent
    rows = list(csv.DictReader((folder / "index.csv").open(encoding="utf-8")))
    proofs = proved(maker, folder, rows)
    target = out / "problems/set"
    shutil.copytree(folder, target, dirs_exist_ok=True)
    shutil.copytree(maker.work / "proofs", out / "problems/proofs", dirs_exist_ok=True)
    archive = out / "problems/lcplab-lcp-set.zip"
    pack(archive, [*sorted(folder.iterdir()), *sorted((maker.work / "proofs").iterdir())])
    cards = [card(row, proofs.get(row["file"])) for row in rows]
    return [table(folder, archive, rows, proofs), *cards]


def proved(maker: Maker, folder: Path, rows: list[dict[str, str]]) -> dict[str, dict]:
    """The strongest proof of each small problem, where there is one."""
    out = maker.work / "proofs"
    if not out.exists():
        out.mkdir()
        small = [row["file"] for row in rows if int(row["rows"]) <= MOST_ROWS]

        def prove(name: str) -> None:
            command = [str(maker.lcplab), "prove", str(folder / name), "--out", str(out / name)]
            # Code 2 says that there is none: of a friction cone only "no solution" can be proved.
            subprocess.run(command, capture_output=True)

        with ThreadPoolExecutor(2) as pool:
            list(pool.map(prove, small))
    return {file.name: json.loads(file.read_text()) for file in sorted(out.iterdir())}


def pack(archive: Path, files: list[Path]) -> None:
    """The same files give the same bytes: no times, one order."""
    with zipfile.ZipFile(archive, "w", zipfile.ZIP_DEFLATED, compresslevel=9) as box:
        for file in files:
            name = f"lcplab-lcp-set/{'proofs/' if file.parent.name == 'proofs' else ''}{file.name}"
            box.writestr(zipfile.ZipInfo(name), file.read_bytes(), zipfile.ZIP_DEFLATED, 9)


def sha256(file: Path) -> str:
    return hashlib.sha256(file.read_bytes()).hexdigest()


def version(folder: Path) -> str:
    lines = (folder / "CITATION.cff").read_text(encoding="utf-8").splitlines()
    return next(line.split(":", 1)[1].strip().strip('"') for line in lines if line.startswith("version:"))


def bibtex(folder: Path, count: int) -> str:
    return f"""@misc{{lcplab-lcp-set,
  author = {{{{The lcplab developers}}}},
  title  = {{lcplab problem set {version(folder)}: {count} linear complementarity problems of contact}},
  note   = {{Version {version(folder)}; SHA-256 of index.csv:
            {sha256(folder / "index.csv")}}}
}}"""


def cited(text: str, folder: Path) -> str:
    """A text with the entry of the problem set: it gets version and hash."""
    count = len((folder / "index.csv").read_text(encoding="utf-8").splitlines()) - 1
    text, found = re.subn(r"@misc\{lcplab-lcp-set,.*?\n\}", lambda _: bibtex(folder, count), text, flags=re.DOTALL)
    assert found == 1, "the text has no entry of the problem set"
    return text


def claim(proof: dict | None) -> str:
    return proof["kind"] if proof else ""


def stem(row: dict[str, str]) -> str:
    return row["file"].removesuffix(".json")


def table(folder: Path, archive: Path, rows: list[dict[str, str]], proofs: dict[str, dict]) -> Page:
    lines = []
    for row in rows:
        kind = claim(proofs.get(row["file"]))
        lines.append(
            f'<tr><td class="number">{row["file"][:3]}</td><td class="long"><a href="cards/{stem(row)}.html">{html.escape(row["name"])}</a></td>'
            f'<td class="number">{row["rows"]}</td><td class="number">{row["coupled"]}</td><td class="whole">{row["class"]}</td>'
            f'<td class="number">{condition(row)}</td><td class="whole" data-pagefind-ignore>{kind}</td></tr>'
        )
    title = f"Problem set {version(folder)}"
    body = f"""<h1>{title}</h1>
<p class="lead">{len(rows)} linear complementarity problems of contact: published and hard families, generated problems with known
solutions, steps of scenes, and problems that physics engines pose. {len(proofs)} of them have a proof file.</p>
<p><a href="{archive.name}" download>lcplab-lcp-set.zip</a>: all problems, their index and their proofs, {archive.stat().st_size / 1e6:.1f} MB,
SHA-256 <code class="hash">{sha256(archive)}</code>. The index alone: <a href="set/index.csv">index.csv</a>. The same files are written by
<code>lcplab problems --export set</code>. What the keys of a file mean is stated in <a href="formats.html">Problem files</a>, and what a proof
states in <a href="../guide/proofs.html">Proof files</a>.</p>
<h2 id="cite">Cite it</h2>
<p>Cite the version. The SHA-256 of <code>index.csv</code> identifies the set, since the index has that of every file.</p>
<pre tabindex="0"><code>{html.escape(bibtex(folder, len(rows)), quote=False)}</code></pre>
<h2 id="cards">All problems</h2>
<p><i>Rows</i>: the size of A. <i>Coupled</i>: friction rows, whose bounds depend on a normal force. <i>Condition</i>: the largest
singular value of A by the smallest that is not 0. <i>Proof</i>: the <a href="../guide/proofs.html#the-proof">strongest statement</a> that was proved.</p>
<div class="scroll problems" tabindex="0" role="region" aria-label="All problems"><table>
<thead><tr><th class="number">No</th><th>Problem</th><th class="number">Rows</th><th class="number">Coupled</th><th>Class of A</th><th class="number">Condition</th><th>Proof</th></tr></thead>
<tbody>
{chr(10).join(lines)}
</tbody></table></div>"""
    about = "All problems in a table, as an archive, and how to cite them."
    headings = [("cite", "Cite it"), ("cards", "All problems")]
    return Page("problems/set.html", title, about, short="Table and archive", body=body, headings=headings)


def condition(row: dict[str, str]) -> str:
    return f"{float(row['condition']):.3g}" if row["condition"] else "–"


def card(row: dict[str, str], proof: dict | None) -> Page:
    name = html.escape(row["name"])
    facts = [
        ("Origin", html.escape(row["source"])),
        (
            "Rows",
            f"{row['rows']}, of which {row['coupled']} are coupled to a normal force and {row['equations']} are equations",
        ),
        ("Class of A", row["class"] or "not determined"),
        ("Rank of A", row["rank"] or "not computed"),
        ("Condition", condition(row)),
        ("Known", html.escape(row["known"]) or "no solution is stated in the file"),
        ("Problem file", f'<a href="../set/{row["file"]}" download>{row["file"]}</a>'),
        ("SHA-256", f'<code class="hash">{row["sha256"]}</code>'),
    ]
    if proof:
        kind = claim(proof)
        facts.append(
            ("Proof", f'<a href="../proofs/{row["file"]}" download>{kind}</a>: {CLAIMS.get(kind, kind)}')
        )
    elif int(row["rows"]) > MOST_ROWS:
        facts.append(("Proof", f"none here: proofs are written for up to {MOST_ROWS} rows"))
    else:
        facts.append(
            ("Proof", "none: the problem states a friction cone, of which only “no solution” can be proved")
        )
    lines = "\n".join(f"<div><dt>{key}</dt> <dd>{value}</dd></div>" for key, value in facts)
    check = f"lcplab solve {row['file']}"
    if proof:
        check += f"\nlcplab check {row['file']} proof.json\npython3 proofs/lcpcheck.py {row['file']} proof.json   # an independent checker"
    body = f"""<p class="trail"><a href="../set.html">Problem set</a></p>
<h1>{name}</h1>
<dl class="facts">
{lines}
</dl>
<pre tabindex="0"><code>{html.escape(check, quote=False)}</code></pre>"""
    address = f"problems/cards/{stem(row)}.html"
    return Page(
        address,
        row["name"],
        f"Problem {row['file'][:3]} of the set: {row['source']}",
        body=body,
        weight=0,  # the table names it
        listed=False,
    )

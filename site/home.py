"""The first page: one sentence, one picture that moves, three doors."""

import csv
import html
import json
from pathlib import Path

from frame import island
from made import Maker
from pages import Page, Section

SCENE = "mass_ratio3"
EVERY = 4  # steps between two poses that are kept
SWEEPS = [10, 50, 200, 2000]
EXACT = "dantzig"

DOORS = [
    (
        "Engineer",
        "A stack sinks or a joint drifts, and you can't tell whether the solver is to blame.",
        "lcplab diagnose stack --solver pgs --sweeps 10",
        [
            ("guide/verdicts.html", "Check an answer"),
            ("guide/commands.html", "Find the cause"),
            ("guide/ci.html", "Check an engine in CI"),
        ],
    ),
    (
        "Teacher",
        "Students see formulas and an animation, but not how one leads to the other.",
        "lcplab lesson 1 --open",
        [
            ("learn/01_complementarity.html", "First lesson"),
            ("learn/live/stack.html", "Play with a stack"),
            ("learn/guide.html", "Teacher's guide"),
        ],
    ),
    (
        "Researcher",
        "You need to test a new solver on hard problems with known solutions.",
        "lcplab hunt --plugin ./my_solver",
        [
            ("guide/plugins.html", "Plug in a solver"),
            ("problems/set.html", "Problem set"),
            ("guide/hunt.html", "Break a solver"),
        ],
    ),
]


def run(maker: Maker, *settings: str) -> tuple[Path, dict]:
    """A run of the scene: its folder and what it found. Code 1 says that answers were rejected, which is the point."""
    name = "-".join(["home", *(setting.strip("-") for setting in settings)])
    results = maker.kept(f"{name}/results.json", "simulate", SCENE, *settings, "--out", name, good=(0, 1))
    return results.parent, json.loads(results.read_text(encoding="utf-8"))


def poses(folder: Path) -> list[list[list[float]]]:
    """Position (m) and quaternion of every box, at every EVERY-th step."""
    steps: dict[int, list[list[float]]] = {}
    with (folder / "trajectory.csv").open(encoding="utf-8") as file:
        for row in csv.DictReader(file):
            if row["body"].startswith("box") and int(row["step"]) % EVERY == 0:
                keys = ("x (m)", "y (m)", "z (m)", "qw", "qx", "qy", "qz")
                steps.setdefault(int(row["step"]), []).append([round(float(row[key]), 4) for key in keys])
    return [steps[step] for step in sorted(steps)]


def picture(maker: Maker) -> str:
    """Two stacks from the same start: sweeps that stop early, and the exact answer."""
    runs = []
    for sweeps in SWEEPS:
        folder, found = run(maker, "--solver", "pgs", "--sweeps", str(sweeps))
        moves = poses(folder)
        sunk = 1000 * (moves[0][-1][2] - moves[-1][-1][2])
        runs.append(
            {
                "name": f"{sweeps} sweeps",
                "sunk": round(sunk),
                "accepted": found["accepted"],
                "of": found["problems"],
                "poses": moves,
            }
        )
    folder, found = run(maker, "--solver", EXACT)
    exact = poses(folder)
    sunk = round(1000 * (exact[0][-1][2] - exact[-1][-1][2]))
    runs.append(
        {
            "name": "Dantzig",
            "sunk": sunk,
            "accepted": found["accepted"],
            "of": found["problems"],
            "poses": exact,
        }
    )
    first = runs[0]
    choices = "".join(
        f'<label><input type="radio" name="sweeps" value="{k}"{" checked" if not k else ""}> {sweeps}</label>'
        for k, sweeps in enumerate(SWEEPS)
    )
    return f"""<figure class="stacks" data-pagefind-ignore>
<figcaption><b>Four boxes of 1, 10, 100 and 1000 kg, one second after they were stacked.</b>
Left, projected Gauss-Seidel with a fixed number of sweeps per step; right, Dantzig's pivoting method.</figcaption>
<div class="scenes">
<div><svg id="left" viewBox="-1.6 -4.35 3.2 4.8" role="img" aria-label="The stack stepped by projected Gauss-Seidel">{still(first["poses"][-1])}</svg>
<p id="said" aria-live="polite">{said(first)}</p></div>
<div><svg id="right" viewBox="-1.6 -4.35 3.2 4.8" role="img" aria-label="The stack stepped by Dantzig's method">{still(exact[-1])}</svg>
<p>{said(runs[-1])}</p></div>
</div>
<fieldset hidden><legend>Sweeps per step</legend>{choices}<button type="button" id="play">Play</button></fieldset>
</figure>
{island("runs", runs)}"""


def said(found: dict) -> str:
    sinks = f"sinks {found['sunk'] / 10:g} cm" if found["sunk"] > 0 else "does not sink"
    good = found["accepted"] == found["of"]
    mark = "good" if good else "bad"
    return f'<b>{found["name"]}</b>: the top box {sinks}.<br><span class="{mark}">{found["accepted"]} of {found["of"]} steps accepted</span>'


def still(boxes: list[list[float]]) -> str:
    """The boxes seen from the front, as home.js draws them too."""
    parts = ['<path class="ground" d="M-9 0H9V.5H-9z"/>']
    for k, box in enumerate(boxes):
        points = hull([(x, -z) for x, z in corners(box)])
        path = "M" + "L".join(f"{x:.3f} {y:.3f}" for x, y in points) + "z"
        parts.append(
            f'<path class="box" d="{path}"/><text x="{box[0]:.3f}" y="{-box[2]:.3f}">{10**k} kg</text>'
        )
    return "".join(parts)


def corners(box: list[float]) -> list[tuple[float, float]]:
    px, _, pz, w, x, y, z = box
    across = (1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y))
    up = (2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y))
    signs = [(i, j, k) for i in (-0.5, 0.5) for j in (-0.5, 0.5) for k in (-0.5, 0.5)]
    return [
        (px + sum(a * s for a, s in zip(across, t)), pz + sum(a * s for a, s in zip(up, t))) for t in signs
    ]


def hull(points: list[tuple[float, float]]) -> list[tuple[float, float]]:
    """The convex hull, by Andrew's monotone chain."""

    def chain(ordered: list[tuple[float, float]]) -> list[tuple[float, float]]:
        line: list[tuple[float, float]] = []
        for p in ordered:
            while len(line) > 1 and cross(line[-2], line[-1], p) <= 1e-9:
                line.pop()
            line.append(p)
        return line[:-1]

    ordered = sorted(set(points))
    return chain(ordered) + chain(ordered[::-1])


def cross(o: tuple[float, float], a: tuple[float, float], b: tuple[float, float]) -> float:
    return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])


def page(maker: Maker, sections: list[Section]) -> Page:
    doors = []
    for who, trouble, command, links in DOORS:
        items = "".join(f'<li><a href="{address}">{text}</a></li>' for address, text in links)
        words = " ".join(f"<span>{html.escape(word)}</span>" for word in command.split())
        doors.append(
            f'<section class="door"><h3>{who}</h3><p>{trouble}</p><pre tabindex="0"><code>{words}</code></pre><ul>{items}</ul></section>'
        )
    everything = []
    for section in sections:
        parts = [f'<h3><a href="{section.address}">{section.title}</a></h3>']
        for group in section.groups:
            pages = [page for page in group.pages if page.listed]
            items = "".join(f'<li><a href="{page.address}">{html.escape(page.label)}</a></li>' for page in pages)
            if items:
                parts.append(f"<h4>{html.escape(group.title)}</h4><ul>{items}</ul>")
        everything.append(f"<div>{''.join(parts)}</div>")
    body = f"""<div class="hero">
<div class="claim"><h1>Is your contact solver right?</h1>
<p class="lead">lcplab solves the contact problems of rigid-body simulation by sweeps, pivoting and Newton methods, and checks every answer independently,
down to proofs in exact arithmetic.</p>
<p class="calls"><a class="call" href="guide/install.html">Install</a> <a class="call second" href="guide/overview.html">Overview</a></p></div>
{picture(maker)}
</div>
<h2 class="ask">Where to start</h2>
<div class="doors">
{chr(10).join(doors)}
</div>
<section class="map">
<h2>Everything on this site</h2>
<div class="everything">
{chr(10).join(everything)}
</div>
</section>"""
    about = "Solve the contact problems of rigid-body simulation and check every answer independently."
    return Page("index.html", "lcplab", about, body=body)

"""A page about a rejected step: its receipt, and a picture of the laws of its rows."""

from __future__ import annotations

from html import escape

import numpy as np

from lcplab._receipt.step import Array, Step

#: The size of the picture and its margins (px).
WIDTH, HEIGHT, MARGIN = 560, 360, 60

PAGE = """<!doctype html>
<html lang="en"><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>{title}</title>
<style>
:root {{ color-scheme: light dark; --ink: light-dark(#222, #ddd); --pale: light-dark(#999, #777); --bad: light-dark(#c22, #f66);
--row: light-dark(#26c, #7af); }}
body {{ font: 16px/1.5 system-ui, sans-serif; max-width: 46em; margin: 2em auto; padding: 0 1em; color: var(--ink);
background: light-dark(#fff, #181818); }}
pre {{ overflow-x: auto; font-size: 14px; }} svg {{ max-width: 100%; height: auto; }} text {{ fill: var(--ink); font-size: 13px; }}
</style>
<h1>{title}</h1>
<pre>{receipt}</pre>
{figure}
<h2>Files of this folder</h2>
<pre>{files}</pre>
"""


def page(step: Step, receipt: str, row: int | None, has_shrunk: bool) -> str:
    """The page as HTML."""
    engine = f"{step.engine} {step.version}".strip()
    title = f"{engine}: a rejected step of {step.name or 'a scene'} at {step.time:.4g} s"
    files = ["lcplab judge frame.json frame.x.json     # the problem and the engine's answer"]
    if has_shrunk:
        files.append("lcplab judge shrunk.json shrunk.x.json   # fewer rows that show the same error")
    return PAGE.format(
        title=escape(title), receipt=escape(receipt), figure=picture(step, row), files=escape("\n".join(files))
    )


def picture(step: Step, worst: int | None) -> str:
    """The force x of each row of a contact, limit or equation, and what remains in the row, w, as SVG.

    Rows of friction are left out, because their law is not in this plane.
    """
    w = step.along(step.motion) + step.bias + step.compliance * step.forces
    rows = np.flatnonzero((step.friction_index < 0) & np.isfinite(step.forces) & np.isfinite(w))
    if not len(rows):
        return ""
    x, w = step.forces[rows], w[rows]
    across, up = _place(x, MARGIN, WIDTH - 20), _place(w, HEIGHT - MARGIN, 20)
    origin = _place(x, MARGIN, WIDTH - 20, 0.0), _place(w, HEIGHT - MARGIN, 20, 0.0)
    unit_x, unit_w = ("N s", "m/s") if step.level == "velocity" else ("N", "m/s²")
    marks = []
    for number, horizontal, vertical in zip(rows.tolist(), across, up):
        style = f'style="fill: var({"--bad" if number == worst else "--row"})"'
        label = escape(step.rows[number].label if len(step.rows) == len(step) else f"row {number}")
        circle = f'<circle cx="{horizontal:.1f}" cy="{vertical:.1f}" r="4" {style}>'
        marks.append(f"{circle}<title>{label}</title></circle>")
        if number == worst:
            side = "end" if horizontal > WIDTH / 2 else "start"
            at = f'x="{horizontal:.1f}" y="{vertical - 8:.1f}" text-anchor="{side}"'
            marks.append(f"<text {at} {style}>{label}</text>")
    line = 'stroke="currentColor" style="color: var(--pale)"'
    return f"""<h2>Forces, and what remains in the rows</h2>
<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="forces and remaining motion of {len(rows)} rows">
<line x1="{MARGIN}" x2="{WIDTH - 20}" y1="{origin[1][0]:.1f}" y2="{origin[1][0]:.1f}" {line}/>
<line x1="{origin[0][0]:.1f}" x2="{origin[0][0]:.1f}" y1="20" y2="{HEIGHT - MARGIN}" {line}/>
<text x="{WIDTH / 2}" y="{HEIGHT - 30}" text-anchor="middle">force x of a row ({unit_x}): {x.min():.3g} to {x.max():.3g}</text>
<text transform="translate(24 {HEIGHT / 2}) rotate(-90)" text-anchor="middle">\
w ({unit_w}): {w.min():.3g} to {w.max():.3g}</text>
{"".join(marks)}
</svg>
<p>The lines are x = 0 and w = 0. A contact or a limit obeys its law on two half lines: it pushes (x &gt; 0, w = 0), or it opens
(x = 0, w &gt; 0). An equation obeys its law at w = 0. Rows of friction are not shown.</p>"""


def _place(values: Array, low: float, high: float, *of: float) -> Array:
    """Pixels of the values, or of others on their scale, which contains 0."""
    least, most = min(float(values.min()), 0.0), max(float(values.max()), 0.0)
    span = most - least or 1.0
    own = np.array(of) if of else values
    return np.asarray(low + (own - least) / span * (high - low))

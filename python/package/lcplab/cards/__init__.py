"""Engine cards: one benchmark a phenomenon, with a closed form and a tolerance that is derived, on any engine.

``python -m lcplab.cards --engine mujoco,pybullet --out results.json`` runs them; ``lcplab report engines``
draws the page. A :class:`Phenomenon` says what it asks, which law answers, and how far off an answer may be
before anything is run; an adapter of :mod:`lcplab.engines` brings its scene into an engine.

Two amounts make up every tolerance: a hundredth of what is measured (of the body's size, of the distance, of
the energy at play), and what a step of first order may be off at this length of step, in closed form.

>>> from lcplab import cards
>>> column = cards.run("lcplab", "velocity", "stopping")
>>> [(m.what, m.holds) for m in column.measured]
[('stops after', True), ('leaves its line by', True)]
"""

from lcplab.cards._phenomenon import Curve, Measurement, Phenomenon, Run
from lcplab.cards._record import merged, record
from lcplab.cards._run import Column, run, simulate
from lcplab.cards.phenomena import PHENOMENA

__all__ = [
    "PHENOMENA",
    "Column",
    "Curve",
    "Measurement",
    "Phenomenon",
    "Run",
    "merged",
    "record",
    "run",
    "simulate",
]

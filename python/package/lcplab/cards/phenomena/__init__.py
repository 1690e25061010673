"""The phenomena, in the order of the page."""

from lcplab.cards._phenomenon import Phenomenon
from lcplab.cards.phenomena.flight import ANGULAR_MOMENTUM, BOUNCE, FREE_FALL
from lcplab.cards.phenomena.friction import CREEP, DIRECTIONS, LIFT, ROLLING, STOPPING
from lcplab.cards.phenomena.joints import CLOSED_LOOP, PENDULUM
from lcplab.cards.phenomena.stacks import MASS_RATIO, REPEAT, TOWER, WEIGHT

#: All of them; the first is the adapters' own test.
PHENOMENA: tuple[Phenomenon, ...] = (
    FREE_FALL,
    CREEP,
    LIFT,
    STOPPING,
    DIRECTIONS,
    ROLLING,
    WEIGHT,
    MASS_RATIO,
    TOWER,
    BOUNCE,
    PENDULUM,
    ANGULAR_MOMENTUM,
    CLOSED_LOOP,
    REPEAT,
)

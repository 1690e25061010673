"""The phenomena, in the order of the page."""

from lcplab.cards._phenomenon import Phenomenon
from lcplab.cards.phenomena.flight import ANGULAR_MOMENTUM, BOUNCE, BULLET, FREE_FALL
from lcplab.cards.phenomena.friction import CREEP, DIRECTIONS, LIFT, PREDICTABILITY, ROLLING, STOPPING
from lcplab.cards.phenomena.joints import CHAIN, CLOSED_LOOP, PENDULUM
from lcplab.cards.phenomena.painleve import PAINLEVE
from lcplab.cards.phenomena.stacks import MASS_RATIO, REPEAT, TOWER, WALL, WEIGHT
from lcplab.cards.phenomena.top import TOP

#: All of them; the first is the adapters' own test.
PHENOMENA: tuple[Phenomenon, ...] = (
    FREE_FALL,
    CREEP,
    WALL,
    LIFT,
    STOPPING,
    PREDICTABILITY,
    DIRECTIONS,
    ROLLING,
    PAINLEVE,
    WEIGHT,
    MASS_RATIO,
    TOWER,
    BOUNCE,
    BULLET,
    PENDULUM,
    CHAIN,
    ANGULAR_MOMENTUM,
    TOP,
    CLOSED_LOOP,
    REPEAT,
)

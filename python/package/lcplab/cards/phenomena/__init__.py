"""The phenomena, in the order of the page."""

from lcplab.cards._phenomenon import Phenomenon
from lcplab.cards.phenomena.bricard import BRICARD
from lcplab.cards.phenomena.capstan import CAPSTAN
from lcplab.cards.phenomena.flight import ANGULAR_MOMENTUM, BOUNCE, BULLET, FREE_FALL
from lcplab.cards.phenomena.friction import CREEP, DIRECTIONS, LIFT, PREDICTABILITY, ROLLING, STOPPING
from lcplab.cards.phenomena.joints import CHAIN, CLOSED_LOOP, ORDER, PENDULUM, SPRING
from lcplab.cards.phenomena.painleve import PAINLEVE
from lcplab.cards.phenomena.stacks import MASS_RATIO, REPEAT, TOWER, WALL, WEIGHT
from lcplab.cards.phenomena.top import TOP
from lcplab.cards.phenomena.trees import FLYING_TREE, STANDING_TREE

#: All of them; the first is the adapters' own test.
PHENOMENA: tuple[Phenomenon, ...] = (
    FREE_FALL,
    SPRING,
    CREEP,
    WALL,
    CAPSTAN,
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
    ORDER,
    CHAIN,
    ANGULAR_MOMENTUM,
    FLYING_TREE,
    STANDING_TREE,
    TOP,
    CLOSED_LOOP,
    BRICARD,
    REPEAT,
)

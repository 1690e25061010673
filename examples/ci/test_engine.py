"""The engine's tests: each step is checked by lcplab."""

import pytest

from adapter import Adapter, pile, sliding


@pytest.mark.parametrize("scene", [sliding, pile])
def test_steps_are_solved(scene, lcplab_receipts):
    world = scene()
    for _ in range(60):
        world.step()
        lcplab_receipts(world, adapter=Adapter())

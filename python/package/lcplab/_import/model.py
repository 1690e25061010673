"""MuJoCo's compiled model, its names, and its groups of bodies that are welded to each other."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


class Model:
    """A model at one state; the caller's data are not changed."""

    def __init__(self, model: Any, data: Any = None) -> None:
        import mujoco

        self.mujoco, self.model = mujoco, model
        self.data = mujoco.MjData(model)
        if data is not None:
            mujoco.mj_copyData(self.data, model, data)
        mujoco.mj_forward(model, self.data)
        self.names = self._body_names()
        #: The bodies of each group, by its root; group 0 is the world.
        self.groups: dict[int, list[int]] = {}
        for body, root in enumerate(model.body_weldid):
            self.groups.setdefault(int(root), []).append(body)

    def name(self, kind: str, number: int) -> str:
        """The name of an object, or its kind and number if it has none."""
        found = self.mujoco.mj_id2name(self.model, getattr(self.mujoco.mjtObj, f"mjOBJ_{kind.upper()}"), int(number))
        return str(found or f"{kind} {int(number)}")

    def root(self, body: int) -> int:
        """The first body of the group of a body."""
        return int(self.model.body_weldid[body])

    def parent(self, root: int) -> int:
        """The group that a group hangs from."""
        return self.root(int(self.model.body_parentid[root]))

    def is_fixed(self, root: int) -> bool:
        """Whether a group does not move by itself: the world, and bodies that only the user moves."""
        return root == 0 or self.model.body_dofnum[root] == 0

    def moving(self) -> list[int]:
        """The groups that move, parents first."""
        return [root for root in self.groups if not self.is_fixed(root)]

    def bodies_of(self, *roots: int) -> list[str]:
        """The names of these groups in a scene; a fixed one is the world and has none."""
        return [self.names[root] for root in roots if not self.is_fixed(root)]

    def _body_names(self) -> list[str]:
        taken: set[str] = set()
        names = []
        for body in range(self.model.nbody):
            name = self.name("body", body)
            while name in taken:
                name += "'"
            taken.add(name)
            names.append(name)
        return names

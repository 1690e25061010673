"""DART: joint coordinates, contacts and loops as a boxed LCP at velocity level.

Of two shapes the smaller friction counts, so equal ones are translated as they are. The restitutions of two
shapes are multiplied, so each gets the square root. Nothing that comes slower than 0.1 m/s bounces; that
threshold is built in.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from lcplab.engines import Array, Description, Engine, Joint, Settings, Unsupported
from lcplab.engines import conjugate, joints, one_value, pose, relative, shape, turned


class Model:
    """A scene in DART: a skeleton for each body that nothing holds, one for each tree of joints."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        import dartpy

        self.dart = dartpy
        self.world = dartpy.simulation.World()
        self.world.setTimeStep(settings.dt)
        self.world.setGravity(scene["gravity"])
        self._set(settings)
        self.surface = (one_value(scene, "friction"), math.sqrt(one_value(scene, "restitution")))
        self.nodes: list[Any] = [None] * len(scene["bodies"])
        self._bodies(scene["bodies"], joints(scene))
        self.dt = settings.dt

    def _set(self, settings: Settings) -> None:
        """The solver and what else the settings change."""
        solver = self.world.getConstraintSolver()
        if "friction" in settings.values:
            options = self.dart.constraint.NsgsFrictionSolver.Options()
            for key, value in settings.values["friction"].items():
                setattr(options, key, value)
            solver.setBoxedLcpSolver(self.dart.constraint.NsgsFrictionSolver(options))
        if not settings.values.get("sleep", True):
            options = self.world.getDeactivationOptions()
            options.mEnabled = False
            self.world.setDeactivationOptions(options)

    def _bodies(self, bodies: Any, every: list[Joint]) -> None:
        hangs = {joint.child: joint for joint in every if not joint.closes}
        ordered = [joint.child for joint in every if not joint.closes]
        for k in [k for k in range(len(bodies)) if k not in hangs] + ordered:
            joint = hangs.get(k)
            parent = None if joint is None or joint.parent is None else joint.parent
            skeleton = self.dart.dynamics.Skeleton(bodies[k]["name"])
            if parent is not None:
                skeleton = self.nodes[parent].getSkeleton()
            self.nodes[k] = self._body(skeleton, bodies, k, joint)
            if parent is None:
                self.world.addSkeleton(skeleton)
        ignored = self.world.getConstraintSolver().getCollisionOption().collisionFilter
        for joint in every:
            if joint.parent is not None:
                ignored.addBodyNodePairToBlackList(self.nodes[joint.parent], self.nodes[joint.child])
            if joint.closes:
                self._close(joint)

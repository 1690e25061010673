"""Newton, in single precision on the processor: bodies in world coordinates, by two of its solvers.

The defaults are those of its position-based solver for rigid bodies, XPBD; the accurate settings take its solver for
articulated bodies, which is MuJoCo Warp on a model that Newton makes. Both take the mean or the larger of two shapes'
frictions, so equal ones are translated as they are. Shapes weigh nothing; a body has its own mass and moments.
"""

from __future__ import annotations

from dataclasses import replace
from typing import Any

import numpy as np

from lcplab import EngineStep
from lcplab._receipt import warp as receipt
from lcplab.engines import Array, Description, Engine, Joint, Settings, Unsupported
from lcplab.engines import conjugate, joints, one_value, pose, shape, turned
from lcplab.engines.warp import CONTACTS, ROWS, geom_forces

#: The world as the parent of a shape or a joint.
GROUND = -1
#: The first steps compile and allocate; later ones are replayed from a recording, with the same bits, because
#: Python takes far longer to launch a step's kernels than the processor to run them.
FIRST = 2


class Model:
    """A scene in Newton."""

    def __init__(self, scene: Description, settings: Settings) -> None:
        import newton
        import warp

        warp.config.log_level = warp.LOG_WARNING
        warp.set_device("cpu")
        self.newton, self.array, self.dt = newton, warp, settings.dt
        builder: Any = newton.ModelBuilder(gravity=scene["gravity"])
        surface = {"mu": one_value(scene, "friction"), "restitution": one_value(scene, "restitution")}
        self.shape = newton.ModelBuilder.ShapeConfig(
            density=0.0, mu_torsional=0.0, mu_rolling=0.0, **surface, **settings.values.get("shape", {})
        )
        #: The shape of each body.
        self.shapes: list[int] = []
        self.bodies = [self._body(builder, body) for body in scene["bodies"]]
        self.starts = np.array([pose(body) for body in scene["bodies"]])
        self._join(builder, scene)
        self.model: Any = builder.finalize()
        self.now, self.next = self.model.state(), self.model.state()
        self._start(scene)
        kind = settings.values["solver"]
        self.solver: Any = getattr(newton.solvers, kind)(self.model, **settings.values.get("options", {}))
        self.control = self.model.control()
        self.has_rows = kind == "SolverMuJoCo"
        self.contacts = None if self.has_rows else self.model.contacts()
        self.steps = 0
        #: Recordings of a step, from one of the two states to the other and back.
        self.graphs: list[Any] = []

    def _body(self, builder: Any, body: Any) -> int:
        """The number of a body, GROUND of a fixed one, which is a shape of the world."""
        kind, size = shape(body)
        placed = self._transform(pose(body))
        number = GROUND
        if not body["fixed"]:
            number = builder.add_link(
                xform=placed, mass=body["mass"], inertia=self.array.mat33(*np.diag(body["inertia"]).ravel().tolist()),
                com=(0.0, 0.0, 0.0), lock_inertia=True, label=body["name"],
            )
            placed = self._transform(np.array([0, 0, 0, 1.0, 0, 0, 0]))
        if kind == "plane":
            if size != [0, 0, 1] or not body["fixed"]:
                raise Unsupported("planes across other axes than z, or that move")
            made = builder.add_shape_plane(body=number, xform=placed, width=0.0, length=0.0, cfg=self.shape)
        elif kind == "box":
            hx, hy, hz = (edge / 2 for edge in size)
            made = builder.add_shape_box(number, xform=placed, hx=hx, hy=hy, hz=hz, cfg=self.shape)
        elif kind == "sphere":
            made = builder.add_shape_sphere(number, xform=placed, radius=size, cfg=self.shape)
        elif kind == "capsule":
            made = builder.add_shape_capsule(
                number, xform=placed, radius=size["radius"], half_height=size["length"] / 2, cfg=self.shape
            )
        else:
            raise Unsupported(f"a body of shape {kind}")
        self.shapes.append(int(made))
        return number

    def _transform(self, placed: Array) -> Any:
        """A pose with the quaternion (w, x, y, z), as Newton writes it: (x, y, z, w)."""
        w, *vector = placed[3:].tolist()
        return self.array.transform(placed[:3].tolist(), (*vector, w))

    def _join(self, builder: Any, scene: Description) -> None:
        """Joints, those of a tree from its root on; bodies without one are free."""
        found = joints(scene)
        hangs = {joint.child: joint for joint in found if not joint.closes}
        children: dict[int | None, list[int]] = {}
        for joint in hangs.values():
            children.setdefault(joint.parent, []).append(joint.child)
        movable = [k for k, number in enumerate(self.bodies) if number != GROUND]
        for root in (k for k in movable if k not in hangs or hangs[k].parent is None):
            waiting, made = [root], []
            while waiting:
                k = waiting.pop(0)
                made.append(self._joint(builder, scene, hangs[k]) if k in hangs else builder.add_joint_free(self.bodies[k]))
                waiting += children.get(k, [])
            builder.add_articulation(made)
        for joint in found:
            if joint.closes:
                self._joint(builder, scene, joint)

    def _joint(self, builder: Any, scene: Description, joint: Joint) -> int:
        """A joint by its point and axis in the axes of both bodies, which do not collide."""
        frames = []
        for k in (joint.parent, joint.child):
            placed = np.array([0, 0, 0, 1.0, 0, 0, 0]) if k is None else self.starts[k]
            back = conjugate(placed[3:])
            frames.append(self._transform(np.concatenate([turned(back, joint.point - placed[:3]), back])))
        parent = GROUND if joint.parent is None else self.bodies[joint.parent]
        ends = {"parent_xform": frames[0], "child_xform": frames[1], "collision_filter_parent": True}
        rest = {"armature": 0.0, "damping": 0.0, "friction": 0.0}
        if joint.kind == "hinge":
            # Both frames have the axes of the world at the start.
            return int(builder.add_joint_revolute(
                parent, self.bodies[joint.child], axis=joint.axis.tolist(), **ends, **rest
            ))
        return int(builder.add_joint_ball(parent, self.bodies[joint.child], **ends, **rest))

    def _start(self, scene: Description) -> None:
        movable = [(number, body) for number, body in zip(self.bodies, scene["bodies"]) if number != GROUND]
        speeds = np.zeros((len(movable), 6), dtype=np.float32)
        for number, body in movable:
            speeds[number] = [*body["velocity"], *body["angular_velocity"]]
        if not len(speeds):
            return
        self.now.body_qd.assign(speeds)
        self.newton.eval_ik(self.model, self.now, self.now.joint_q, self.now.joint_qd)

    def step(self) -> None:
        if self.steps < FIRST:
            self._launch()
        else:
            if len(self.graphs) < 2:
                with self.array.ScopedCapture("cpu") as recording:
                    self._launch()
                self.graphs.append(recording.graph)
            self.array.capture_launch(self.graphs[self.steps % 2])
        self.now, self.next = self.next, self.now
        self.steps += 1

    def _launch(self) -> None:
        """All kernels of a step."""
        if self.contacts is not None:
            self.model.collide(self.now, self.contacts)
        self.now.clear_forces()
        self.solver.step(self.now, self.next, self.control, self.contacts, self.dt)

    def reported_step(self) -> EngineStep:
        if not self.has_rows:
            self.step()
            raise Unsupported("Newton's position-based solver does not report its problem")
        before = self.solver.mjw_data.qpos.numpy()[0].astype(float)
        self.step()
        own = receipt.read(self.solver.mj_model, self.solver.mjw_data, 0, before)
        return replace(own, engine="Newton", version=self.newton.__version__)

    def poses(self) -> Array:
        found = self.starts.copy()
        every = self.now.body_q.numpy() if self.model.body_count else []
        for row, number in zip(found, self.bodies):
            if number != GROUND:
                row[:] = every[number][[0, 1, 2, 6, 3, 4, 5]]
        return found

    def velocities(self) -> Array:
        found = np.zeros((len(self.bodies), 6))
        every = self.now.body_qd.numpy() if self.model.body_count else []
        for row, number in zip(found, self.bodies):
            if number != GROUND:
                row[:] = every[number]
        return found

    def forces(self) -> Array | None:
        """Those of MuJoCo's rows; XPBD's documentation calls its own approximate, so they are not read."""
        if not self.has_rows:
            return None
        by_geom = geom_forces(self.solver.mj_model, self.solver.mjw_data)
        # A geom has the number of its shape; fixed bodies are shapes of the world.
        numbers = self.solver.mjc_geom_to_newton_shape.numpy()[0]
        found = np.zeros((len(self.bodies), 3))
        for own, force in zip(numbers, by_geom):
            if own >= 0:
                found[self.shapes.index(int(own))] += force
        return found


ENGINE = Engine(
    name="newton",
    package="newton",
    module="newton",
    settings=(
        Settings(
            "defaults",
            "the position-based solver SolverXPBD as installed, on the processor: 2 iterations, no restitution, steps of 2 ms "
            "as in Newton's first example",
            0.002,
            {"solver": "SolverXPBD"},
        ),
        Settings(
            "accurate",
            "SolverMuJoCo, elliptic cones, impratio 100, tolerance 1e-6 in 100 iterations, implicitfast, contacts as stiff as "
            "the step allows (a time constant of 2 dt), steps of 1 ms",
            0.001,
            {
                "solver": "SolverMuJoCo",
                "options": {"cone": "elliptic", "impratio": 100.0, "tolerance": 1e-6, "iterations": 100,
                            "integrator": "implicitfast", "nconmax": CONTACTS, "njmax": ROWS},
                "shape": {"ke": 2.5e5, "kd": 1e3},
            },
        ),
    ),
    build=Model,
)

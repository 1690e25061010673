"""MuJoCo: joint coordinates, soft contacts whose forces minimize a convex function. A spring is a tendon.

The larger friction of two geoms counts, so equal ones are translated as they are. MuJoCo has no coefficient
of restitution: by default nothing bounces, and its documentation says to lower the damping of a contact
(a negative ``solref``); the accurate settings take the damping that leaves the speed asked for.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from lcplab import EngineStep, Problem
from lcplab._receipt import mujoco as receipt
from lcplab.engines import Array, Description, Engine, Joint, Posed, Settings, Unsupported
from lcplab.engines import joints, one_value, pose, rates, relative, shape, springs, turned

#: The time (s) that a bounce takes where the accurate settings make one.
BOUNCE = 0.02


class Model:
    """A scene in MuJoCo."""

    #: What else contacts without friction get.
    FRICTIONLESS: dict[str, Any] = {}

    def __init__(self, scene: Description, settings: Settings) -> None:
        import mujoco

        self.mujoco = mujoco
        spec = mujoco.MjSpec()
        options = {"timestep": settings.dt, "gravity": scene["gravity"], **settings.values}
        for key, value in options.items():
            setattr(spec.option, key, value)
        self.contact: dict[str, Any] = {"friction": [one_value(scene, "friction"), 0.005, 0.0001]}
        if one_value(scene, "friction") == 0:
            self.contact |= self.FRICTIONLESS
        accurate = settings.name == "accurate"
        if accurate:
            self.contact |= {"solref": [2 * settings.dt, 1.0]}
        restitution = one_value(scene, "restitution")
        if accurate and restitution > 0:
            self.contact |= {"solref": bouncing(restitution), "solimp": [0.99, 0.99, 0.001, 0.5, 2.0]}
        self.joints = joints(scene, besides=("spring",))
        self._bodies(spec, scene)
        self.model = spec.compile()
        self.data = mujoco.MjData(self.model)
        names = [body["name"] for body in scene["bodies"]]
        self.ids = [mujoco.mj_name2id(self.model, mujoco.mjtObj.mjOBJ_BODY, name) for name in names]
        hung = {joint.child: joint for joint in self.joints if not joint.closes}
        for k, body in enumerate(scene["bodies"]):
            self._set_going(scene["bodies"], k, hung.get(k))
        mujoco.mj_forward(self.model, self.data)

    def _bodies(self, spec: Any, scene: Description) -> None:
        bodies = scene["bodies"]
        hangs = {joint.child: joint for joint in self.joints if not joint.closes}
        made: dict[int, Any] = {}
        pending = list(range(len(bodies)))
        while pending:
            k = pending.pop(0)
            joint = hangs.get(k)
            if joint and joint.parent is not None and joint.parent not in made:
                pending.append(k)
                continue
            parent = made[joint.parent] if joint and joint.parent is not None else spec.worldbody
            base = bodies[joint.parent] if joint and joint.parent is not None else None
            made[k] = self._body(parent, base, bodies[k], joint)
        for joint in self.joints:
            if joint.parent is not None:
                pair = [bodies[k]["name"] for k in (joint.parent, joint.child)]
                spec.add_exclude(bodyname1=pair[0], bodyname2=pair[1])
            if joint.closes:
                self._close(spec, bodies, joint)
        for spring in springs(scene):
            tendon = spec.add_tendon(stiffness=[spring.stiffness, 0, 0], springlength=[spring.length] * 2)
            for number, point in spring.ends:
                body = spec.worldbody if number is None else made[number]
                site = body.add_site(name=f"site {len(spec.sites)}", pos=point)
                tendon.wrap_site(site.name)

    def _body(self, parent: Any, base: Any, body: Any, joint: Joint | None) -> Any:
        own = pose(body)
        placed = relative(pose(base), own) if base else own
        kind, size = shape(body)
        made = parent.add_body(name=body["name"], pos=placed[:3], quat=placed[3:])
        if not body["fixed"]:
            made.mass, made.ipos, made.iquat = body["mass"], [0, 0, 0], [1, 0, 0, 0]
            made.inertia, made.explicitinertial = body["inertia"], True
            if joint is None:
                made.add_freejoint()
            else:
                at = relative(own, np.concatenate([joint.point, [1, 0, 0, 0]]))[:3]
                axis = turned(own[3:] * [1, -1, -1, -1], joint.axis)
                kinds = self.mujoco.mjtJoint
                made.add_joint(type=kinds.mjJNT_HINGE if joint.kind == "hinge" else kinds.mjJNT_BALL,
                               pos=at, axis=axis)
        geom = self.mujoco.mjtGeom
        if kind == "plane":
            if size != [0, 0, 1]:
                raise Unsupported("planes across other axes than z")
            made.add_geom(type=geom.mjGEOM_PLANE, size=[10, 10, 1], **self.contact)
        elif kind == "box":
            made.add_geom(type=geom.mjGEOM_BOX, size=[edge / 2 for edge in size], **self.contact)
        elif kind == "sphere":
            made.add_geom(type=geom.mjGEOM_SPHERE, size=[size, 0, 0], **self.contact)
        elif kind == "capsule":
            made.add_geom(type=geom.mjGEOM_CAPSULE, size=[size["radius"], size["length"] / 2, 0], **self.contact)
        else:
            raise Unsupported(f"a body of shape {kind}")
        return made

    def _close(self, spec: Any, bodies: Any, joint: Joint) -> None:
        """A loop's last joint as equalities: a hinge is two points of its axis that stay together."""
        parent = "world" if joint.parent is None else bodies[joint.parent]["name"]
        own = pose(bodies[joint.child])
        sides = (0,) if joint.kind == "ball" else (-0.05, 0.05)
        for point in (joint.point + side * joint.axis for side in sides):
            at = relative(own, np.concatenate([point, [1, 0, 0, 0]]))[:3]
            equality = spec.add_equality(
                type=self.mujoco.mjtEq.mjEQ_CONNECT,
                objtype=self.mujoco.mjtObj.mjOBJ_BODY,
                name1=bodies[joint.child]["name"],
                name2=parent,
            )
            equality.data[:3] = at
            if "solref" in self.contact:
                equality.solref = self.contact["solref"]

    def _set_going(self, bodies: Any, k: int, hung: Joint | None) -> None:
        body = bodies[k]
        velocity = [*body["velocity"], *body["angular_velocity"]]
        if body["fixed"] or not any(velocity):
            return
        joint = self.data.joint(int(self.model.body(body["name"]).jntadr[0]))
        if len(joint.qvel) != 6:
            joint.qvel[:] = rates(hung, bodies, k)
            return
        joint.qvel[:3] = velocity[:3]
        # In the body's axes.
        joint.qvel[3:] = turned(pose(body)[3:] * [1, -1, -1, -1], np.array(velocity[3:]))

    def step(self) -> None:
        """Go on by a step; places and velocities of bodies, which MuJoCo leaves at the step's start, follow."""
        self.mujoco.mj_step(self.model, self.data)
        for follow in (self.mujoco.mj_kinematics, self.mujoco.mj_comPos, self.mujoco.mj_comVel):
            follow(self.model, self.data)

    def reported_step(self) -> EngineStep:
        self.step()
        step = receipt.read(self.model, self.data)
        if int(self.model.opt.integrator) == receipt.RK4:
            return step.with_motion_of_forces("which is a mean of the stages of RK4")
        return step

    def poses(self) -> Array:
        return np.hstack([self.data.xpos[self.ids], self.data.xquat[self.ids]])

    def velocities(self) -> Array:
        found = np.zeros((len(self.ids), 6))
        for row, body in zip(found, self.ids):
            self.mujoco.mj_objectVelocity(self.model, self.data, self.mujoco.mjtObj.mjOBJ_BODY, body, row, 0)
        return found[:, [3, 4, 5, 0, 1, 2]]  # MuJoCo puts the turning first

    def forces(self) -> Array | None:
        every, wrench = np.zeros((self.model.nbody, 3)), np.zeros(6)
        for k in range(self.data.ncon):
            contact = self.data.contact[k]
            self.mujoco.mj_contactForce(self.model, self.data, k, wrench)
            force = contact.frame.reshape(3, 3).T @ wrench[:3]  # on the second geom
            first, second = self.model.geom_bodyid[contact.geom]
            every[first] -= force
            every[second] += force
        return every[self.ids]

    def problem(self) -> Posed:
        """The contact problem of this moment as MuJoCo poses and softens it, and MuJoCo's own forces for it.

        w = (J M⁻¹Jᵀ + R) f + J a − a*, where a are the accelerations without contacts and a* those that are
        asked for. It is an LCP where cones are pyramids, each edge of which has a force of its own.
        """
        mujoco, model, data = self.mujoco, self.model, self.data
        mujoco.mj_forward(model, data)
        if model.opt.cone != mujoco.mjtCone.mjCONE_PYRAMIDAL:
            raise Unsupported("elliptic cones as an LCP")
        if (data.efc_type != mujoco.mjtConstraint.mjCNSTR_CONTACT_PYRAMIDAL).any():
            raise Unsupported("rows other than contacts")
        jacobian = np.zeros((data.nefc, model.nv))
        if mujoco.mj_isSparse(model):
            mujoco.mju_sparse2dense(jacobian, data.efc_J, data.efc_J_rownnz, data.efc_J_rowadr, data.efc_J_colind)
        else:
            jacobian[:] = data.efc_J.reshape(data.nefc, model.nv)
        moved = np.zeros_like(jacobian)
        mujoco.mj_solveM(model, data, moved, jacobian)
        matrix = jacobian @ moved.T + np.diag(data.efc_R)
        matrix = (matrix + matrix.T) / 2
        problem = Problem(matrix, jacobian @ data.qacc_smooth - data.efc_aref)
        return Posed(problem, data.efc_force.copy(), "forces (N), pyramids with a row an edge")


def bouncing(restitution: float) -> list[float]:
    """``solref`` of a contact that leaves this part of the speed of approach.

    A spring and damper with damping ratio ζ that can push but not pull lets go when its force is 0, with
    e = exp(−ζ/√(1−ζ²) · θ) of the speed, where cos θ = 2ζ² − 1 and sin θ = 2ζ√(1−ζ²).
    """

    def left(zeta: float) -> float:
        root = math.sqrt(1 - zeta * zeta)
        return math.exp(-zeta / root * math.atan2(2 * zeta * root, 2 * zeta * zeta - 1))

    low, high = 1e-9, 1 - 1e-9
    for _ in range(60):
        middle = (low + high) / 2
        low, high = (middle, high) if left(middle) > restitution else (low, middle)
    omega = math.pi / BOUNCE
    return [-omega * omega, -2 * low * omega]


ENGINE = Engine(
    name="mujoco",
    package="mujoco-core",
    module="mujoco",
    settings=(
        Settings("defaults", "as installed: Newton's method, pyramids for cones, Euler, steps of 2 ms", 0.002),
        Settings(
            "accurate",
            "elliptic cones, impratio 100, tolerance 1e-12 in 100 iterations, RK4, contacts as stiff as the "
            "step allows (solref 2 dt), steps of 1 ms; where bodies bounce, a bounce takes 20 ms, of three lengths "
            "that were tried the one whose height is right",
            0.001,
            {"cone": 1, "impratio": 100.0, "tolerance": 1e-12, "iterations": 100, "integrator": 1},
        ),
    ),
    build=Model,
)

"""What MuJoCo says of a model, in the coordinates of a scene's bodies: for tests of the import."""

import mujoco
import numpy as np

import lcplab
from lcplab import _import
from lcplab._receipt.mujoco import full_mass

#: A radius (m) so small that balls in place of all shapes touch nothing.
TINY = 1e-6


class Reference:
    """A model without what an import skips, at the imported state."""

    def __init__(self, model, data=None):
        self.model = model
        self.data = mujoco.MjData(model)
        if data is not None:
            mujoco.mj_copyData(self.data, model, data)
        self.data.eq_active[:] = 0  # qacc_smooth is that of the tree
        self.imported = _import.scene(model, self.data)
        drop_skipped(model, self.imported.refusals)
        mujoco.mj_forward(model, self.data)
        moving = [body for body in self.imported.scene["bodies"] if not body.get("fixed")]
        self.names = [body["name"] for body in moving]
        self.bodies = [mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_BODY, name) for name in self.names]
        self.bodies = [k if k >= 0 else int(name.split()[1]) for k, name in zip(self.bodies, self.names)]
        self.centers = [np.array(body["position"]) for body in moving]

    def motions(self):
        """The rows of the Jacobian of [v; ω] of each body's center of mass, and its derivative times qvel."""
        rows, moved = [], []
        for body, center in zip(self.bodies, self.centers):
            both = np.zeros((2, 3, self.model.nv))
            mujoco.mj_jac(self.model, self.data, both[0], both[1], center, body)
            rows.append(both.reshape(6, -1).copy())
            mujoco.mj_jacDot(self.model, self.data, both[0], both[1], center, body)
            moved.append(both.reshape(6, -1) @ self.data.qvel)
        return np.vstack(rows), np.concatenate(moved)

    def accelerations(self):
        """The accelerations without contacts, limits and friction losses, (6 bodies,)."""
        jacobian, moved = self.motions()
        return jacobian @ self.data.qacc_smooth + moved

    def without_contacts(self):
        """The scene with its joints, springs and dampers, but without contacts, limits and motors."""
        scene = self.imported.scene
        bodies = [
            {key: value for key, value in body.items() if key != "without_contact"} | {"shape": {"sphere": TINY}}
            for body in scene["bodies"] if not body.get("fixed")
        ]
        constraints = [c for c in scene.get("constraints", []) if not c["kind"].startswith("limit")]
        # A motor of speed 0 is dry friction; others exert their whole effort.
        constraints = [c for c in constraints if c.get("speed") != 0]
        # An explicit integrator takes springs and dampers as forces, as qacc_smooth does.
        step = {"dt": 1e-3, "scheme": "acceleration", "integrator": "explicit-euler", "events": False}
        return {"gravity": scene["gravity"], "bodies": bodies, "constraints": constraints, "step": step}

    def contact_rows(self):
        """The engine's contacts: rows of J for normal and tangents, in joint coordinates and in those of the bodies."""
        jacobian, _ = self.motions()
        own, maximal = [], []
        for contact in self.data.contact:
            frame, point = contact.frame.reshape(3, 3), contact.pos
            row, wide = np.zeros((3, self.model.nv)), np.zeros((3, 6 * len(self.bodies)))
            for geom, sign in zip(contact.geom, (-1, 1)):
                body = int(self.model.geom_bodyid[geom])
                at = np.zeros((3, self.model.nv))
                mujoco.mj_jac(self.model, self.data, at, None, point, body)
                row += sign * frame @ at
                root = int(self.model.body_weldid[body])
                if root in self.bodies:
                    k = self.bodies.index(root)
                    arm = point - self.centers[k]
                    cross = np.array([np.cross(arm, axis) for axis in frame])
                    wide[:, 6 * k : 6 * k + 6] += sign * np.hstack([frame, cross])
            own.append(row)
            maximal.append(wide)
        return np.vstack(own), np.vstack(maximal)

    def delassus(self, rows):
        """J M⁻¹Jᵀ of rows in joint coordinates."""
        return rows @ np.linalg.solve(self.mass_matrix(), rows.T)

    def mass_matrix(self):
        """M in joint coordinates."""
        return full_mass(self.model, self.data)


def drop_skipped(model, refusals):
    """Remove from a model what the import skips, as far as it acts without contacts."""
    model.dof_armature[:] = 0
    model.opt.density, model.opt.viscosity, model.opt.wind = 0, 0, 0
    for field in ("actuator_armature", "actuator_damping", "actuator_dampingpoly", "tendon_armature"):
        if hasattr(model, field):
            getattr(model, field)[:] = 0
    for refusal in refusals:
        if refusal.element == "actuator":
            model.actuator_gear[refusal.place[1]] = 0
        if refusal.element == "tendon" and "equality" not in refusal.reason:
            for field in ("stiffness", "damping"):
                getattr(model, f"tendon_{field}")[refusal.place[1]] = 0
        if refusal.element == "joint":
            joint = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_JOINT, refusal.name)
            joint = joint if joint >= 0 else int(refusal.name.split()[1])
            count = {0: 6, 1: 3}.get(int(model.jnt_type[joint]), 1)
            dofs = slice(model.jnt_dofadr[joint], model.jnt_dofadr[joint] + count)
            if refusal.reason.startswith("stiffness"):
                model.jnt_stiffness[joint] = 0
            if "damping" in refusal.reason.split(":")[0] or refusal.reason.startswith("stiffness:"):
                model.dof_damping[dofs] = 0
    mujoco.mj_setConst(model, mujoco.MjData(model))  # M of bodies with slides alone is a constant of the model


def mass_of(description):
    """M of the bodies of a scene, (6 bodies, 6 bodies), from its own fields."""
    blocks = []
    for body in description["bodies"]:
        axes = np.zeros(9)
        mujoco.mju_quat2Mat(axes, np.array(body["rotation"]["quaternion"]))
        axes = axes.reshape(3, 3)
        blocks += [body["mass"] * np.eye(3), axes @ np.diag(body["inertia"]) @ axes.T]
    mass = np.zeros((3 * len(blocks),) * 2)
    for k, block in enumerate(blocks):
        mass[3 * k : 3 * k + 3, 3 * k : 3 * k + 3] = block
    return mass


def measured(description):
    """The accelerations of lcplab's bodies, (6 bodies,), from one step."""
    scene = lcplab.Scene.of(description)
    before = scene.velocities.copy()
    scene.step("dantzig")
    return ((scene.velocities - before) / description["step"]["dt"]).ravel()


def eliminated(mass, joints, rows):
    """J M⁻¹Jᵀ of rows after the rows of the joints are eliminated, by an orthogonal basis of what the joints push."""
    root = np.linalg.cholesky(mass)
    pushed, signed = np.linalg.solve(root, joints.T), np.linalg.solve(root, rows.T)
    basis, sizes, _ = np.linalg.svd(pushed, full_matrices=False)
    basis = basis[:, sizes > 1e-10 * sizes[0]]
    free = signed - basis @ (basis.T @ signed)
    return free.T @ free


def joint_rows(description):
    """Masses and the rows of joints of a scene without its springs, from the problem of its first step."""
    rigid = [c for c in description["constraints"] if not c["kind"].startswith(("spring", "motor"))]
    scene = lcplab.Scene.of({**description, "constraints": rigid})
    scene.step("dantzig")
    problem = scene.problem().to_json()
    motion, rows = problem["motion"], len(problem["b"])
    size = len(motion["target"])
    mass, jacobian = np.zeros((size, size)), np.zeros((rows, size))
    for i, j, value in motion["mass"]:
        mass[i, j] = mass[j, i] = value
    for i, j, value in motion["jacobian"]:
        jacobian[i, j] = value
    return mass, jacobian

"""The defects: what was wrong, in which release, and which stage a receipt names."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Defect:
    """A released defect and its mended release.

    Attributes
    ----------
    name : str
        The name of its scene in ``lcplab.defects.scenes``.
    what, source : str
        What was wrong, and where the engine says so.
    stage : str
        The stage of an engine's step that was wrong.
    bad, mended : tuple of str
        What ``pip install`` takes, or ``npm:`` and what ``npm install`` takes.
    """

    name: str
    what: str
    source: str
    stage: str
    bad: tuple[str, ...]
    mended: tuple[str, ...]


def _mjx(version: str) -> tuple[str, ...]:
    return (f"mujoco=={version}", f"mujoco-mjx=={version}", "jax==0.4.30", "jaxlib==0.4.30")


def _warp(version: str) -> tuple[str, ...]:
    mujoco = ".".join([*version.split(".")[:2], "0"])
    return (f"mujoco-warp=={version}", f"mujoco=={mujoco}", "warp-lang==1.15.0")


def _newton(version: str) -> tuple[str, ...]:
    return (f"newton=={version}", "warp-lang==1.17.0")


def _drake(version: str) -> tuple[str, ...]:
    return (f"drake=={version}", "numpy==1.26.4")


DEFECTS = (
    Defect(
        "sparse_factor",
        "Newton's sparse factor merges rows with different descendants: slow, wrong or diverging",
        "MuJoCo 4.0.1, #3767",
        "solver",
        ("mujoco-core==4.0.0",),
        ("mujoco-core==4.0.1",),
    ),
    Defect(
        "uncoupled_hessian",
        "Newton's Hessian lacks the coupling between trees",
        "MJX 3.1.3",
        "solver",
        _mjx("3.1.2"),
        _mjx("3.1.3"),
    ),
    Defect(
        "implicit_damping",
        "implicit damping goes to wrong entries of a dense mass matrix",
        "MJX 3.1.3",
        "write-back",
        _mjx("3.1.2"),
        _mjx("3.1.3"),
    ),
    Defect(
        "connect_bias",
        "the bias of connect rows lacks J̇v",
        "MuJoCo 3.7.0",
        "assembly",
        ("mujoco==3.6.0",),
        ("mujoco==3.7.0",),
    ),
    Defect(
        "sphere_in_box",
        "the depth of a sphere whose center is inside a box is its radius",
        "MuJoCo 3.2.7, #2206",
        "collision",
        ("mujoco==3.2.6",),
        ("mujoco==3.2.7",),
    ),
    Defect(
        "box_in_plate",
        "boxes that overlap by more than half the thickness of the thinner one have no contact",
        "MuJoCo 3.12.0, #1800",
        "collision",
        ("mujoco==3.11.0",),
        ("mujoco==3.12.0",),
    ),
    Defect(
        "world_of_zeros",
        "the generalized forces of a world that converges before others are written back as 0",
        "MuJoCo Warp 3.10.0.2, #1501",
        "write-back",
        _warp("3.10.0.1"),
        _warp("3.10.0.2"),
    ),
    Defect(
        "lost_improvements",
        "Newton's line search compares costs in single precision: small improvements of a large cost are lost by rounding",
        "MuJoCo Warp 3.10.0, #1374",
        "solver",
        _warp("3.9.0"),
        _warp("3.10.0"),
    ),
    Defect(
        "welded_chain",
        "redundant equations of a closed loop: the pivoting method meets a singular pivot and ends too early",
        "DART 6.18.0, #2903",
        "solver",
        ("dartpy==6.17.1",),
        ("dartpy==6.18.0",),
    ),
    Defect(
        "resting_cube",
        "reported impulses of contacts are too large by the factor (n + 1)/n with n substeps",
        "Rapier 0.35.2 (npm 0.21.0), #992",
        "write-back",
        ("npm:@dimforge/rapier3d-compat@0.20.0",),
        ("npm:@dimforge/rapier3d-compat@0.21.0",),
    ),
    Defect(
        "floating_gripper",
        "the coupler of SAP reads positions at the indices of velocities, which is wrong after a joint with a quaternion",
        "Drake 1.20.0, #19902",
        "assembly",
        _drake("1.19.0"),
        _drake("1.20.0"),
    ),
    Defect(
        "driven_slider",
        "the feed-forward force of an actuator with PD gains counts twice",
        "Drake 1.22.0, #20259",
        "assembly",
        _drake("1.21.0"),
        _drake("1.22.0"),
    ),
    Defect(
        "sliding_block",
        "friction of the penalty solvers exceeds the cone at slips below 1 m/s",
        "Newton 1.8.0, #4010",
        "solver",
        _newton("1.7.0"),
        _newton("1.8.0"),
    ),
    Defect(
        "bouncing_ball",
        "the prediction distance of contacts makes bounces too slow",
        "Rapier 0.35.0 (npm 0.20.0), #974",
        "assembly",
        ("npm:@dimforge/rapier3d-compat@0.19.3",),
        ("npm:@dimforge/rapier3d-compat@0.20.0",),
    ),
)

"""One setting: receipts with default arguments, and the true motion error of the same steps. Prints the counts as JSON."""

import collections
import itertools
import json
import sys

import numpy as np

import lcplab
import exact
import scenes

#: Keys of the list that are not arguments of the scene.
FACTS = ("name", "packages", "scene", "frames", "every")
#: The own error of the independent solve may be this part of the limit.
EXACT = 0.1
#: Sweeps of the independent solve of rigid contacts with Coulomb's law, and the change of x at which it ends.
SWEEPS, STILL = 20_000, 1e-13


def problem_of(step):
    """The problem of a step that another engine than MuJoCo reports; bounds that depend on normal forces are those of the answer."""
    lo, hi, cones = step.lo.copy(), step.hi.copy(), []
    for normal in np.unique(step.friction_index[step.friction_index >= 0]):
        rows = np.flatnonzero(step.friction_index == normal)
        if step.model is None:
            hi[rows] = step.mu[rows] * max(step.forces[normal], 0.0)
            lo[rows] = -hi[rows]
        else:
            cones.append((np.concatenate([[normal], rows]), step.mu[rows]))
    return exact.Problem(step.dense_mass(), step.dense_jacobian(), step.bias, step.compliance, step.target, lo, hi, cones)


def swept(problem, start):
    """The motion under Coulomb's law with rigid contacts, by projected Gauss-Seidel from the engine's impulses, and its last change."""
    pushed = np.linalg.solve(problem.mass, problem.jacobian.T)
    found, now = start.copy(), problem.target + pushed @ start
    diagonal = np.einsum("ij,ji->i", problem.jacobian, pushed)
    for _ in range(SWEEPS):
        last = now
        for rows, mu in problem.cones:
            old = found[rows].copy()
            normal, sides = rows[0], rows[1:]
            found[normal] = max(0.0, found[normal] - (problem.jacobian[normal] @ now + problem.bias[normal]) / diagonal[normal])
            now = now + pushed[:, normal] * (found[normal] - old[0])
            step = (problem.jacobian[sides] @ now + problem.bias[sides]) / diagonal[sides].max()
            wanted, limit = found[sides] - step, mu[0] * found[normal]
            size = np.linalg.norm(wanted)
            found[sides] = wanted if size <= limit else wanted * limit / size
            now = now + pushed[:, sides] @ (found[sides] - old[1:])
        if problem.norm(now - last) <= STILL * problem.norm(now - problem.target):
            break
    return now, problem.norm(now - last)


def true_error(frame, receipt):
    """The distance of the engine's motion from the true one relative to the effect, and the solve's own error, relative too."""
    if len(frame) > 1 and type(frame[1]).__name__ == "MjData":
        import mujoco_problem

        model, data = frame[:2]
        problem, motion = mujoco_problem.problem(model, data), data.qacc.copy()
        fall = mujoco_problem.gravity(model, data, problem)
    else:
        step = receipt.step
        problem, motion, fall = problem_of(step), step.motion, step.gravity
    if problem.compliance.min() > 0:
        true, own = exact.motion(problem, motion)
    else:
        true, own = swept(problem, receipt.step.forces)
    effect = max(problem.norm(true - problem.target), 1e-6 * problem.norm(problem.target), fall)
    return problem.norm(motion - true) / effect, own / effect


def main(setting):
    frames = getattr(scenes, setting["scene"])(**{key: value for key, value in setting.items() if key not in FACTS})
    every, verdicts = setting.get("every", 5), collections.Counter()
    good = rejected = rows = seen = 0
    largest, alarms, limit = 0.0, [], 0.0
    for number, frame in enumerate(itertools.islice(frames, 0, None, every)):
        if number > 50 * setting["frames"]:
            raise SystemExit("there are too few steps with rows")
        frame = frame if isinstance(frame, tuple) else (frame,)
        before = frame[2] if len(frame) > 2 else None
        receipt = lcplab.receipt(*frame[:2], before=before)
        if not len(receipt.step):
            continue
        verdicts[receipt.verdict] += 1
        error, own = true_error(frame, receipt)
        limit, rows = receipt.limit, max(rows, len(receipt.step))
        if own > EXACT * limit:
            raise SystemExit(f"step {number}: the independent solve is not accurate: {own:.1e}")
        is_good = error < limit
        good += is_good
        rejected += is_good and receipt.is_rejected
        if is_good and receipt.is_rejected:
            alarms.append(f"step {number}: {receipt.rejected.stage}: {receipt.rejected.what}, true error {error:.1e}")
        largest, seen = max(largest, error), seen + 1
        if seen == setting["frames"]:
            break
    print(json.dumps({"frames": seen, "rows": rows, "verdicts": verdicts, "good": int(good), "rejected": int(rejected),
                      "largest": largest, "limit": limit, "alarms": alarms[:10]}))


if __name__ == "__main__":
    main(json.loads(sys.argv[1]))

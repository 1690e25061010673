"""The exercises in Python: right programs pass, and wrong ones are refused with a sentence that says what is wrong."""

import inspect
import subprocess
import sys
import warnings
from pathlib import Path

import numpy as np
import pytest

NOTEBOOKS = Path(__file__).parent.parent.parent / "notebooks"
sys.path.insert(0, str(NOTEBOOKS / "exercises"))

import checks
from checking import verdict
from mutants import mutants
from test_exercises import FILES, answer

NAMES = [file.stem for file in FILES]

# Changes that do not change what is asked for: at a tie both sides of a comparison are right, entries of J are ±1, a
# factor in a sweep changes its speed but not its end, or a value is never used.
EQUIVALENT = {
    "e01_1_hand": ["x = max(0.0, -m * v) if z <= 1e-09 else 0.0"],
    "e01_3_two_rows": ["if (x >= 0).all() and (A @ x + b > -1e-12).all():"],
    "e01_b_two_contacts": [
        "if b[0] > 0 and b[1] >= 0:",
        "if b[0] >= 0 and b[1] > 0:",
        "if push > 0 and opens >= 0:",
        "if push >= 0 and opens > 0:",
    ],
    "e03_1_column": ["while groups and groups[-1][1] / groups[-1][0] >= group[1] / group[0]:"],
    "e03_b_step": ["A = J @ (inverse_mass / J)"],
    "e08_1_scaled": ["if terms >= 0:"],
    "e08_2_repair": [
        "F = np.flatnonzero(np.diag(A) * x >= A @ x + b)",
        "if (exact >= 0).all() and (A @ exact + b > -1e-12).all():",
    ],
    "e08_b_stop": ["for sweep in range(1, 1002):", "if residual < tolerance:", "return (x, 1001)"],
    "e10_2_bias": ["return c / dt if c >= 0 else beta / dt * min(c + slop, 0.0)"],
    "e11_1_nearest": [
        "lost = 0.0 if x + y < limit else (x + y - limit) / 2 if abs(x - y) <= limit else max(x, y) - limit",
        "lost = 0.0 if x + y <= limit else (x + y - limit) / 2 if abs(x - y) < limit else max(x, y) - limit",
    ],
    "e11_2_cone": ["if t < mu * n:", "if mu * t < -n:"],
    "e11_3_uphill": ["if t <= stops_at:"],
    "e11_b_pressed": ["v, x_n, speeds = (0.0, 1.0, [])"],
    "e12_b_bounce": ["if free + bias <= 0:"],
    "e13_1_all_answers": [
        "return [0.0] * (b >= 0) + [-b / a] * (-b / a > 0)",
        "return [0.0] * (b > 0) + [-b / a] * (-b / a >= 0)",
        "return [0.0] * (b > 0) + [-b / a] * (-b * a > 0)",
    ],
    "e14_2_colors": ["colors.append(min(set(range(i + 2)) - taken))"],
    "e14_b_assembled": ["entries[i, k] = entries.get((i, k), 0.0) + J_i * inverse_mass[body] / J_k"],
    "e15_b_kept": [
        "below, give = (u[k - 1], 1 * masses[k - 1]) if k else (0.0, 0.0)",
        "below, give = (u[k - 1], 2 / masses[k - 1]) if k else (0.0, 0.0)",
        "below, give = (u[k - 1], 1 / masses[k]) if k else (0.0, 0.0)",
        "below, give = (u[k - 1], 1 / masses[k - 2]) if k else (0.0, 0.0)",
        "below, give = (u[k - 1], 1 / masses[k - 1]) if k else (0.0, 1.0)",
        "push = max(-x[k], -(u[k] - below) / (1 / masses[k]))",
        "push = max(-x[k], -(u[k] - below) / (1 * masses[k] + give))",
        "push = max(-x[k], -(u[k] - below) / (2 / masses[k] + give))",
        "push = max(-x[k], -u[k] / (1 / masses[k] + give))",
    ],
    "e17_1_skier": ["A, b = (J @ J / m, -9.81 / J[1] - bend * v_x ** 2)"],
    "e17_2_tested": ["if abs(j[k] - slope) >= 1e-05 * np.linalg.norm(j):"],
    "e17_b_bead": ["limit = mu * x * size"],
}

# What students write: an idea that is wrong.
MISTAKES = [
    ("e01_2_one_row", lambda a, b, lo, hi: min(max(-b / a, 0), hi)),
    ("e01_2_one_row", lambda a, b, lo, hi: np.clip(-b, lo, hi)),
    ("e01_3_two_rows", lambda A, b: np.maximum(-b / np.diag(A), 0)),
    ("e01_3_two_rows", lambda A, b: np.maximum(np.linalg.solve(A, -b), 0)),
    ("e02_1_rod", lambda p, v: (p / np.linalg.norm(p), 0.0)),
    ("e02_1_rod", lambda p, v: (p, v @ v / np.linalg.norm(p))),
    (
        "e02_2_nail",
        lambda r: np.hstack([np.eye(3), np.array([[0, -r[2], r[1]], [r[2], 0, -r[0]], [-r[1], r[0], 0]])]),
    ),
    ("e03_1_column", lambda m, u: [-sum(m[j] * u[j] for j in range(k, len(m))) for k in range(len(m))]),
    ("e03_2_delassus", lambda J, inverse_mass: J.T @ np.diag(inverse_mass) @ J),
    ("e03_3_two_levels", lambda m, l, g, phi, omega, dt: (-dt * m * g * np.cos(phi), -m * g * np.cos(phi))),
    ("e04_1_sweep", lambda A, b, lo, hi, x: np.clip(x - (A @ x + b) / np.diag(A), lo, hi)),
    (
        "e04_1_sweep",
        lambda A, b, lo, hi, x: [float(np.clip(v, lo[i], hi[i])) for i, v in enumerate(np.linalg.solve(A, -b))],
    ),
    ("e04_2_impulse", lambda v, inverse_mass, total: (max(v, 0.0), total + max(0.0, -v / inverse_mass))),
    ("e05_1_extrapolate", lambda sweeps: sweeps[2]),
    ("e06_1_active_set", lambda A, b, free: np.maximum(np.linalg.solve(A, -b), 0) * free),
    ("e07_1_murty", lambda x, w: int(np.argmin(np.minimum(x, w)))),
    ("e07_2_ratio", lambda constant, rate: int(np.argmin(rate)) if (rate < 0).any() else None),
    ("e08_1_scaled", lambda A, b, lo, hi, x: abs(x - np.clip(x - (A @ x + b), lo, hi)).max()),
    ("e09_1_farkas", lambda A, b, d: (d >= 0).all() and (A @ d <= 0).all() and b @ d < 0),
    ("e09_1_farkas", lambda A, b, d: (A.T @ d <= 0).all() and b @ d < 0),
    ("e09_1_farkas", lambda A, b, d: (d >= 0).all() and (A.T @ d <= 0).all() and b @ d <= 0),
    ("e09_1_farkas", lambda A, b, d: (d >= 0).all() and np.allclose(A.T @ d, 0) and b @ d < 0),
    ("e10_1_tangent", lambda l, v, dt: (v * dt) ** 2 / (2 * l)),
    ("e10_2_bias", lambda c, dt, beta, slop: beta / dt * min(c + slop, 0.0)),
    ("e10_3_spring", lambda k, d, dt: (1 / (dt * k + d), dt * k / (dt * k + d))),
    (
        "e11_1_nearest",
        lambda p, limit: (np.clip(p, -1, 1), p / max(1, np.linalg.norm(p)), p / max(1, abs(p).sum())),
    ),
    (
        "e11_2_cone",
        lambda p, mu: np.append(max(p[0], 0), p[1:] * min(1, mu * max(p[0], 0) / (np.hypot(*p[1:]) + 1e-300))),
    ),
    ("e11_3_uphill", lambda theta, mu, v0, t: v0 - 9.81 * (np.sin(theta) + mu * np.cos(theta)) * t),
    ("e12_1_two_balls", lambda m, v, e: (v[0] - e * (v[0] - v[1]), v[1] + e * (v[0] - v[1]))),
    ("e13_1_all_answers", lambda a, b: [x for x in (0.0, 0.5) if a * x + b >= 0 and abs(x * (a * x + b)) < 1e-12]),
    ("e13_1_all_answers", lambda a, b: [max(0.0, -b / a)]),
    ("e14_3_pattern", lambda rows: sum(any(k in b for k in a) for a in rows for b in rows)),
    ("e14_3_pattern", lambda rows: 3 * len(rows) - 2),
    ("e15_1_layers", lambda masses, g, dt: [mass * g * dt for mass in masses]),
    ("e15_3_sweeps", lambda below, above, reduction: int(np.log(reduction) / np.log(above / (below + above)))),
    ("e17_1_skier", lambda m, slope, bend, v_x: [0.0, m * 9.81]),
]


def solution(name):
    return answer(NOTEBOOKS / "solutions" / f"{name}.py")


def judged(name, program):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # a wrong program may divide by 0
        return verdict(getattr(checks, name), program)


def is_sentence(text):
    """Whether a verdict is one line of words that begins with an input or with what the program did."""
    return text is not None and 4 <= len(text.split()) <= 110 and "\n" not in text and "Assertion" not in text


def test_every_exercise_has_a_solution_and_a_line_in_its_lesson():
    assert {file.stem for file in (NOTEBOOKS / "solutions").glob("e[0-9]*.py")} == set(NAMES)
    for name in NAMES:
        lesson, number, _ = name[1:].split("_", 2)
        (text,) = (page.read_text(encoding="utf-8") for page in NOTEBOOKS.glob(f"{lesson}_*.md"))
        assert f"- **{int(lesson)}.{number}**: " in text, name


@pytest.mark.parametrize("file", FILES, ids=NAMES)
def test_a_solution_passes_and_a_hole_or_a_bug_does_not(file):
    assert judged(file.stem, solution(file.stem)) is None
    said = judged(file.stem, answer(file))
    assert is_sentence(said)
    assert (said == "the gap is not filled in yet") == ("_b_" not in file.stem)


@pytest.mark.parametrize("name", NAMES)
def test_a_program_with_one_change_is_refused_with_a_sentence(name):
    source = (NOTEBOOKS / "solutions" / f"{name}.py").read_text(encoding="utf-8")
    accepted = []
    for line, program in mutants(source):
        said = judged(name, program)
        if said is None:
            accepted.append(line)
        else:
            assert is_sentence(said), (line, said)
    assert sorted(accepted) == sorted(EQUIVALENT.get(name, []))


@pytest.mark.parametrize("name, program", MISTAKES)
def test_a_wrong_idea_is_refused_with_a_sentence(name, program):
    said = judged(name, program)
    assert is_sentence(said) and "the program stopped" not in said, said


@pytest.mark.parametrize("value", [None, "x", float("nan"), [], [1, 2, 3, 4, 5, 6, 7], ([0.5], None)], ids=str)
@pytest.mark.parametrize("name", NAMES)
def test_an_answer_of_another_kind_is_refused_with_a_sentence(name, value):
    said = judged(name, lambda *inputs: value)
    assert is_sentence(said) and "the program stopped" not in said, said


def plain(value):
    """The same answer in Python's own types, numbers as ints where they are whole."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, dict):
        return {place: plain(entry) for place, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(part) for part in value]
    if isinstance(value, float) and value.is_integer():
        return int(value)
    return value


def numpy_like(value):
    """The same answer in NumPy's types."""
    if isinstance(value, dict):
        return {place: numpy_like(entry) for place, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return tuple(numpy_like(part) for part in value)
    return value if value is None or isinstance(value, np.ndarray) else np.array(value)[()]


@pytest.mark.parametrize("form", [plain, numpy_like], ids=["lists and ints", "tuples and NumPy's numbers"])
@pytest.mark.parametrize("name", NAMES)
def test_a_right_answer_is_accepted_in_other_forms(name, form):
    program = solution(name)
    assert judged(name, lambda *inputs: form(program(*inputs))) is None


def test_an_error_in_a_program_is_told_with_its_line():
    def program(a, b, lo, hi):
        return b[0]

    line = inspect.getsourcelines(program)[1] + 1
    said = judged("e01_2_one_row", program)
    assert said.startswith(f"the program stopped with TypeError in line {line}: ")


def test_a_message_names_the_row_that_has_not_changed_and_the_part_that_should_be_left():
    def divides_by_no_change(sweeps):
        with np.errstate(divide="ignore", invalid="ignore"):
            rho = (sweeps[2] - sweeps[1]) / (sweeps[1] - sweeps[0])
            return sweeps[2] + (sweeps[2] - sweeps[1]) * rho / (1 - rho)

    assert judged("e05_1_extrapolate", divides_by_no_change).endswith("; x[1] has not changed in these sweeps")
    removes_half = lambda c, dt, beta, slop: c / dt if c > 0 else beta / dt * min(c + slop, 0.0) / 2
    assert judged("e10_2_bias", removes_half).endswith("overlap beyond the slop is left, not 1 − β = 0.8")


def test_pytest_prints_the_sentence_and_no_source_of_a_check(tmp_path):
    for file in ["checks.py", "checking.py", "test_exercises.py"]:
        (tmp_path / file).write_text((NOTEBOOKS / "exercises" / file).read_text(encoding="utf-8"), encoding="utf-8")
    wrong = "def answer(A, b, d):\n    return (A.T @ d <= 0).all() and b @ d < 0\n"
    (tmp_path / "e09_1_farkas.py").write_text(wrong, encoding="utf-8")
    (tmp_path / "e10_1_tangent.py").write_text("def answer(l, v dt):\n", encoding="utf-8")
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", str(tmp_path)]
    said = subprocess.run(command, cwd=tmp_path, capture_output=True, text=True).stdout
    assert (
        "e09_1_farkas.py: A = [[1, 0], [0, 1]], b = [1, 1], d = [-1, -1]: the program says True, but x = (0, 0)"
        in said
    )
    assert "e10_1_tangent.py cannot be loaded: SyntaxError" in said
    assert "require(" not in said and "Traceback" not in said

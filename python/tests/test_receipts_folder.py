"""The folder of a rejected step: the problem, fewer rows that show the same error, and a page with a picture."""

import json
from html.parser import HTMLParser

import numpy as np
import pytest

import lcplab


def pushed(factor=1.0, friction=False):
    """Thirty contacts of ten bodies; the engine's largest force is wrong by this factor."""
    random = np.random.default_rng(5)
    jacobian = np.repeat(np.eye(10), 3, axis=0) + 0.1 * random.standard_normal((30, 10))
    matrix, offset = jacobian @ jacobian.T + 0.1 * np.eye(30), jacobian @ -np.ones(10)
    index = np.full(30, -1)
    if friction:
        index[1::3] = index[2::3] = np.arange(0, 30, 3)
    more = {"friction_index": index, "mu": np.where(index < 0, 0.0, 0.4), "lo": np.where(index < 0, 0.0, -np.inf), "model": None}
    x = np.zeros(30)
    for _ in range(3000):
        for i in range(30):
            most = np.inf if index[i] < 0 else 0.4 * x[index[i]]
            least = 0.0 if index[i] < 0 else -most
            x[i] = min(max(least, x[i] - (matrix[i] @ x + offset[i]) / matrix[i, i]), most)
    worst = int(np.argmax(np.where(index < 0, x, 0.0)))
    x[worst] *= factor
    rows = [lcplab.EngineRow(f"row <{i}>", "contact", ("a", "b")) for i in range(30)]
    step = lcplab.EngineStep.of("mine", np.eye(10), jacobian, np.zeros(30), -np.ones(10), x, compliance=0.1, method="pgs",
                                rows=rows, **more)
    return step, worst


@pytest.mark.parametrize("friction", [False, True])
def test_a_rejected_step_is_shrunk_to_rows_that_show_the_same_error(friction):
    step, worst = pushed(0.6, friction)
    receipt = lcplab.receipt(step)
    smaller = receipt.shrunk()
    assert receipt.stage == "solver" and 1 <= len(smaller) <= 6
    assert worst // 3 in [int(row.label[5:-1]) // 3 for row in smaller.rows]  # of the same body
    own = lcplab.receipt(smaller)
    assert own.stage == "solver" and own.rejected.error * own.effect >= receipt.rejected.error * receipt.effect / 2
    # The forces of the removed rows are a part of the free motion: the motion is still that of all forces.
    np.testing.assert_allclose(smaller.target + smaller.push(smaller.forces), step.motion, rtol=1e-12)
    assert all(k < 0 or smaller.rows[k].label == f"row <{int(row.label[5:-1]) // 3 * 3}>"
               for k, row in zip(smaller.friction_index, smaller.rows))


def test_an_accepted_step_and_one_that_is_rejected_elsewhere_are_not_shrunk():
    assert lcplab.receipt(pushed()[0]).shrunk() is None
    single = lcplab.EngineStep.of("mine", [[1.0]], [[1.0]], [0.0], [-1.0], [0.5], compliance=0.1)
    assert lcplab.receipt(single).is_rejected and lcplab.receipt(single).shrunk() is None


class Words(HTMLParser):
    """The texts and the elements of a page."""

    def __init__(self):
        super().__init__()
        self.texts, self.tags = [], []

    def handle_starttag(self, tag, attrs):
        self.tags.append(tag)

    def handle_data(self, data):
        self.texts.append(data)


def test_the_folder_has_a_page_with_a_picture_and_files_that_the_command_judges(tmp_path, capfd):
    step, worst = pushed(0.6)
    lcplab.receipt(step).save(tmp_path)
    names = {"frame.json", "frame.x.json", "shrunk.json", "shrunk.x.json", "receipt.json", "receipt.txt", "receipt.html"}
    assert {path.name for path in tmp_path.iterdir()} == names
    page = Words()
    page.feed((tmp_path / "receipt.html").read_text(encoding="utf-8"))
    assert page.tags.count("circle") == 30 and f"row <{worst}>" in page.texts and "wrong: solver" in "".join(page.texts)
    from lcplab import _lcplab

    for stem in ("frame", "shrunk"):
        problem = json.loads((tmp_path / f"{stem}.json").read_text(encoding="utf-8"))
        assert {"mass", "jacobian", "target"} <= set(problem["motion"])
        assert _lcplab.run(["lcplab", "receipts", str(tmp_path / f"{stem}.json")]) == 1
        assert "1 rejected" in capfd.readouterr().out


def test_a_step_with_a_cone_that_the_judge_does_not_take_has_a_folder_too(tmp_path, capfd):
    # Unit masses and rows: x = (5, 1 * 3, 0.25 * 4) is on the cone with the coefficients 1 and 0.25. Half of it is no solution.
    eye, x = np.eye(3), np.array([5.0, 3.0, 1.0])
    step = lcplab.EngineStep.of("mine", eye, eye, np.zeros(3), [-5.0, -9.0, -18.0], x / 2, compliance=1.0, lo=[0, -np.inf, -np.inf],
                                friction_index=[-1, 0, 0], mu=[0, 1.0, 0.25])
    receipt = lcplab.receipt(step)
    assert receipt.stage == "solver"
    receipt.save(tmp_path)
    with pytest.raises(lcplab.InputError, match="two equal coefficients"):
        receipt.write(tmp_path / "a.json", tmp_path / "a.x.json")
    from lcplab import _lcplab

    assert _lcplab.run(["lcplab", "receipts", str(tmp_path / "frame.json")]) == 1
    assert "rejected at solver: 1" in capfd.readouterr().out

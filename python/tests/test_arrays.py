"""Lessons run without NumPy: arrays.py gives the cells what NumPy gives them."""

import itertools
import json
import re
import sys
from pathlib import Path

import numpy as np
import pytest
from numpy.testing import assert_allclose, assert_array_equal

NOTEBOOKS = Path(__file__).parent.parent.parent / "notebooks"
sys.path.insert(0, str(NOTEBOOKS))

import arrays
import cells


# Hilbert's matrix has the condition 1.5e7, so two ways of inverting it agree to 1e-16 times this.
CONDITIONED = {("08_is_it_solved", "factor"): 4e-9}


@pytest.mark.parametrize("lesson", cells.lessons(), ids=lambda path: path.stem)
def test_every_cell_has_the_results_of_numpy(lesson):
    printed, numbers = cells.results(lesson)
    own_printed, own_numbers = cells.results(lesson, numpy="arrays")
    assert own_printed == printed
    assert own_numbers.keys() == numbers.keys()
    for name, value in numbers.items():
        if is_numeric(value):
            rtol = CONDITIONED.get((lesson.stem, name), 1e-12)
            assert_allclose(own_numbers[name], value, rtol=rtol, atol=1e-12, err_msg=name)


def is_numeric(value):
    try:
        return np.asarray(value).dtype.kind in "bif"
    except ValueError:  # rows of different lengths
        return False


def test_it_stays_short_and_needs_no_package():
    text = (NOTEBOOKS / "arrays.py").read_text(encoding="utf-8")
    assert len(text.splitlines()) <= 250 and max(map(len, text.splitlines())) <= 110
    assert set(re.findall(r"^(?:from|import) (\w+)", text, re.M)) == {"itertools", "math", "operator"}


def both(values):
    return arrays.array(values), np.array(values)


SAMPLES = [
    [1.5, -2.0, 0.25],
    [3, 0, -7],
    [True, False, True],
    [[1.0, -2.0, 0.5], [4.0, 0.0, 1.0], [2.0, 2.0, -3.0]],
    [[1, 2, 3]],
    [[2], [5], [7]],
    2.5,
    -3,
]


@pytest.mark.parametrize("a, b", list(itertools.product(SAMPLES, repeat=2)))
def test_operations_broadcast_as_in_numpy(a, b):
    if not isinstance(a, list) and not isinstance(b, list):
        return
    [a, A], [b, B] = (both(value) if isinstance(value, list) else (value, value) for value in (a, b))
    for f in (lambda x, y: 1.0 * x + y, lambda x, y: 1.0 * x - y, lambda x, y: 1.0 * x * y, lambda x, y: x < y):
        own, theirs = f(a, b), f(A, B)
        assert_array_equal(own.tolist(), theirs)
        assert own.shape == theirs.shape


INDICES = [0, -1, slice(None), slice(None, None, -1), slice(1, 3), [2, 0], []]


@pytest.mark.parametrize("index", INDICES + list(itertools.product(INDICES[:5], INDICES)), ids=str)
def test_indices_pick_what_they_pick_in_numpy_and_slices_are_views(index):
    own, theirs = both([[float(4 * i + j) for j in range(4)] for i in range(3)])
    picked, expected = own[index], theirs[index]
    if isinstance(picked, arrays.ndarray):
        assert picked.shape == expected.shape and picked.flat() == expected.ravel().tolist()
    else:
        assert picked == expected
    own[index] = theirs[index] = -1
    assert_array_equal(own.tolist(), theirs)
    if isinstance(picked, arrays.ndarray):
        picked += 10
        expected += 10
        assert_array_equal(own.tolist(), theirs)


def test_masks_pick_numbers_rows_and_columns():
    own, theirs = both([[1.0, -2.0], [-3.0, 4.0]])
    assert_array_equal(own[own > 0].tolist(), theirs[theirs > 0])
    assert_array_equal(own[own[0] > 0].tolist(), theirs[theirs[0] > 0])
    one, two = (np.array([False, True]), arrays.array([False, True]))
    assert_array_equal(own[arrays.ix_(two, two)].tolist(), theirs[np.ix_(one, one)])
    own[own < 0] = theirs[theirs < 0] = 0
    assert_array_equal(own.tolist(), theirs)


PRINTED = [
    [0.5, 0.0],
    [1 / 3, -2 / 3, 100.0],
    [1e-5, 1.0],
    [1e9, 1.5],
    [0.0, -0.0],
    [float("nan"), 1.25],
    [float("inf"), -1.25],
    [1000.25, 0.5],
    [],
    [1, -20],
    [True, False],
    [[1.0, 0.5], [-2.25, 3.0]],
    [[True, False]],
    list(range(60)),
    [k / 7 for k in range(60)],
    [[k / 7 for k in range(30)], [k * 1.5 for k in range(30)]],
]


@pytest.mark.parametrize("values", PRINTED, ids=str)
def test_arrays_are_printed_as_by_numpy(values):
    own, theirs = both(values)
    assert str(own) == str(theirs)
    if values:
        assert repr(own) == repr(theirs)


def test_random_numbers_are_printed_as_by_numpy():
    generator = np.random.default_rng(4)
    for size, scale in itertools.product(range(1, 5), 10.0 ** np.arange(-6, 7)):
        values = (scale * generator.normal(size=size)).round(5).tolist()
        assert str(arrays.array(values)) == str(np.array(values))


def test_linear_algebra_agrees_with_numpy():
    generator = np.random.default_rng(5)
    for n in range(1, 8):
        A, b, B = generator.normal(size=(n, n)), generator.normal(size=n), generator.normal(size=(n, 3))
        own_A, own_b, own_B = (arrays.array(value.tolist()) for value in (A, b, B))
        assert_allclose(arrays.linalg.solve(own_A, own_b).tolist(), np.linalg.solve(A, b), rtol=1e-9)
        assert_allclose(arrays.linalg.solve(own_A, own_B).tolist(), np.linalg.solve(A, B), rtol=1e-9)
        assert_allclose((own_A @ own_B).tolist(), A @ B, atol=1e-13)
        assert_allclose((own_b @ own_A @ own_b), b @ A @ b, atol=1e-13)
        assert_allclose(arrays.linalg.norm(own_b), np.linalg.norm(b))
        thin = A[:, : n // 2 + 1]
        low = arrays.array((thin @ thin.T).tolist())
        assert arrays.linalg.matrix_rank(low) == n // 2 + 1 if n > 1 else 1
    with pytest.raises(ValueError, match="Singular"):
        arrays.linalg.solve(arrays.ones((2, 2)), arrays.ones(2))


def test_mistakes_are_errors_with_a_message():
    whole = arrays.array([1, 2])
    with pytest.raises(AttributeError, match="has no fft"):
        arrays.fft
    with pytest.raises(ValueError, match="all\\(\\) or any\\(\\)"):
        bool(whole > 0)
    with pytest.raises(TypeError, match="cannot hold floats"):
        whole += 0.5
    with pytest.raises(ValueError, match="do not fit"):
        whole + arrays.ones(3)
    with pytest.raises(ValueError, match="product"):
        whole @ arrays.ones(3)
    with pytest.raises(IndexError):
        whole[0, 1]
    with pytest.raises(ValueError, match="different lengths"):
        arrays.array([[1.0], [1.0, 2.0]])

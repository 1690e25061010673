"""Reads what a student's program returns, and says in one sentence what is wrong with it."""

import operator
import traceback

import numpy as np


class Wrong(Exception):
    """What is wrong with an answer, without the way to mend it."""


def require(holds, sentence):
    """Raises `Wrong` with the sentence unless the condition holds; a comparison with NaN does not."""
    if not holds:
        raise Wrong(sentence)


def show(value):
    """A value in a sentence: six digits, arrays as lists."""
    if isinstance(value, np.ndarray):
        value = value.tolist()
    if isinstance(value, (list, tuple)):
        return f"[{', '.join(map(show, value))}]"
    if isinstance(value, (float, np.floating)):
        return f"{value:.6g}"
    return str(value)


def numbers(value, shape, what):
    """An array of this shape, from anything that holds these numbers: arrays, lists, tuples, ints."""
    require(value is not None, f"the program returned None instead of {what}")
    try:
        array = np.array(value, dtype=float)
    except (TypeError, ValueError):
        raise Wrong(f"the program returned {show(value)}, which is not {what}") from None
    same = array.shape == shape or array.squeeze().shape == tuple(n for n in shape if n != 1)
    require(same, f"the program returned {show(value)}, which is not {what}")
    require(np.isfinite(array).all(), f"the program returned {show(value)}: not all numbers are finite")
    return array.reshape(shape)


def number(value, what):
    """One number."""
    return float(numbers(value, (), what))


def is_one_number(value):
    return isinstance(value, np.ndarray) and value.shape == ()


def parts(value, count, what):
    """The parts of an answer that consists of several; of any number of them if the count is None."""
    found = list(value) if isinstance(value, (list, tuple, np.ndarray)) and not is_one_number(value) else None
    right = found is not None and (count is None or len(found) == count)
    require(right, f"the program returned {show(value)} instead of {what}")
    return found


def whole(value, what):
    """A whole number."""
    try:
        return operator.index(value)
    except TypeError:
        found = number(value, what)
        require(found.is_integer(), f"the program returned {show(value)}, which is not {what}")
        return int(found)


def truth_value(value):
    """True or False, also from NumPy."""
    is_one = isinstance(value, (bool, np.bool_)) or is_one_number(value)
    require(is_one, f"the program returned {show(value)} instead of True or False")
    return bool(value)


def verdict(check, answer):
    """None if the answer passes the check, otherwise a sentence: what is wrong."""
    try:
        check(answer)
    except Wrong as wrong:
        return str(wrong)
    except NotImplementedError:
        return "the gap is not filled in yet"
    except Exception as error:
        own = answer.__code__.co_filename
        lines = [frame.lineno for frame in traceback.extract_tb(error.__traceback__) if frame.filename == own]
        place = f" in line {lines[-1]}" if lines else ""
        return f"the program stopped with {type(error).__name__}{place}: {error}"

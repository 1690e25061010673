"""What the lessons use of NumPy, in plain Python, for pages that run where NumPy is missing.

Arrays have one or two axes of float, int or bool. As in NumPy an int or a slice as an index gives a
view of the same numbers, a list or an array of bool a copy, and operations broadcast.
"""

import math
import operator
from itertools import accumulate, chain, compress, repeat

pi, inf, nan = math.pi, math.inf, math.nan


def __getattr__(name):
    raise AttributeError(f"NumPy is missing here, and arrays.py, which replaces it, has no {name}")


class ndarray:
    """The numbers data[place] of its places, row by row."""

    def __init__(self, data, shape, dtype, places):
        self.data, self.shape, self.dtype, self.places = data, shape, dtype, places
        self.ndim = len(shape)

    T = property(lambda self: transpose(self))
    __len__ = lambda self: self.shape[0]
    __str__ = lambda self: written(self, " ", 0)
    __repr__ = lambda self: f"array({written(self, ', ', 6)})"
    __matmul__, __rmatmul__ = lambda self, other: dot(self, other), lambda self, other: dot(other, self)
    flat = lambda self: list(map(self.data.__getitem__, self.places))
    tolist = lambda self: self.flat() if self.ndim == 1 else [row.flat() for row in self]
    astype = lambda self, dtype: made(self.flat(), self.shape, dtype)
    copy = lambda self: self.astype(self.dtype)
    round = lambda self, digits=0: each(lambda value: round(value, digits), self)
    max, min, all, any = (lambda self, f=f: f(self.flat()) for f in (max, min, all, any))
    sum = lambda self: total(self.flat())

    def __iter__(self):
        return iter(self.flat()) if self.ndim == 1 else (self[i] for i in range(len(self)))

    def __bool__(self):
        if len(self.places) != 1:
            raise ValueError("several values are neither true nor false together: use all() or any()")
        return bool(self.flat()[0])

    def __getitem__(self, key):
        places, shape, is_view = self.selected(key)
        if not shape:
            return self.data[places[0]]
        part = ndarray(self.data, shape, self.dtype, places)
        return part if is_view else part.copy()

    def __setitem__(self, key, value):
        places, shape, _ = self.selected(key)
        for place, number in zip(places, spread(operand(value), shape)):
            self.data[place] = self.dtype(number)

    def selected(self, key):
        """The places and the shape of self[key], and whether it is a view."""
        if isinstance(key, int) and self.ndim == 1:
            return [self.places[key]], (), True
        if isinstance(key, ndarray) and key.dtype is bool and key.shape == self.shape:
            places = list(compress(self.places, key.flat()))
            return places, (len(places),), False
        keys = key if isinstance(key, tuple) else (key,)
        lists = [k for k in keys if not isinstance(k, (int, slice))]
        if len(keys) > self.ndim or len(lists) > 1 and not isinstance(keys, Outer):
            raise IndexError(f"arrays.py has no such index for an array with {self.ndim} axes")
        chosen, shape = [], []
        for size, k in zip(self.shape, keys + (slice(None),) * (self.ndim - len(keys))):
            whole = range(size)
            own = [whole[k]] if isinstance(k, int) else whole[k] if isinstance(k, slice) else picked(k)
            chosen.append(own if isinstance(own, range) else [whole[i] for i in own])
            shape += [] if isinstance(k, int) else [len(own)]
        rows, columns = chosen if self.ndim == 2 else ([0], chosen[0])
        return [self.places[i * self.shape[-1] + j] for i in rows for j in columns], tuple(shape), not lists

    def changed(self, result):  # by += and the like
        if result.dtype is float is not self.dtype:
            raise TypeError(f"an array of {self.dtype.__name__} cannot hold floats: begin with floats")
        self[:] = result
        return self


operand = lambda value: array(value) if isinstance(value, (list, tuple)) else value
Outer = type("Outer", (tuple,), {"__doc__": "An index whose lists pick whole rows and columns."})
ix_ = lambda rows, columns: Outer((rows, columns))
picked = lambda k: list(compress(range(len(k)), k)) if array(k).dtype is bool else list(k)


def made(values, shape, dtype=None):
    """An array of these values; its dtype is theirs if none is given."""
    values = list(values)
    kinds = set(map(type, values))
    dtype = dtype or max(kinds, key=[bool, int, float].index, default=float)
    values = values if kinds == {dtype} else [dtype(value) for value in values]
    return ndarray(values, shape, dtype, range(len(values)))


def array(values, dtype=None):
    if isinstance(values, ndarray):
        return values.astype(dtype or values.dtype)
    rows = [list(v) if hasattr(v, "__iter__") else v for v in values]
    lengths = {len(row) if isinstance(row, list) else None for row in rows}
    if len(lengths) > 1:
        raise ValueError("the rows of an array have different lengths")
    return made(*(rows, (len(rows),)) if lengths <= {None} else (chain(*rows), (len(rows), *lengths)), dtype)


def spread(value, shape):
    """The values of a number or an array, repeated to fill the shape."""
    if not isinstance(value, ndarray):
        return repeat(value, math.prod(shape))
    if value.shape == shape:
        return value.flat()
    (r, c), (rows, columns) = ((1,) * (2 - len(s)) + s for s in (value.shape, shape))
    if r not in (1, rows) or c not in (1, columns):
        raise ValueError(f"the shapes {value.shape} and {shape} do not fit together")
    values = value.flat()
    return [values[i % r * c + j % c] for i in range(rows) for j in range(columns)]


def each(f, *operands):
    """f of numbers, or of the numbers of arrays one by one."""
    operands = list(map(operand, operands))
    shapes = [value.shape for value in operands if isinstance(value, ndarray)]
    if not shapes:
        return f(*operands)
    shape = shapes[0]
    if shapes.count(shape) < len(shapes):
        shape = tuple(map(max, *(((1,) + own)[-2:] for own in shapes)))[-max(map(len, shapes)) :]
    return made(map(f, *[spread(value, shape) for value in operands]), shape)


for name in "add sub mul truediv floordiv mod pow and or xor".split():
    f = getattr(operator, f"__{name}__")
    setattr(ndarray, f"__{name}__", lambda self, other, f=f: each(f, self, other))
    setattr(ndarray, f"__r{name}__", lambda self, other, f=f: each(f, other, self))
    setattr(ndarray, f"__i{name}__", lambda self, other, f=f: self.changed(each(f, self, other)))
for name in "lt le gt ge eq ne".split():
    setattr(ndarray, f"__{name}__", lambda self, other, f=getattr(operator, name): each(f, self, other))
for name, f in ("neg", operator.neg), ("abs", abs), ("invert", operator.not_):
    setattr(ndarray, f"__{name}__", lambda self, f=f: each(f, self))
for name in "sqrt exp log sin cos tan degrees radians".split():
    globals()[name] = lambda a, f=getattr(math, name): each(f, a)
arctan, arctan2 = lambda a: each(math.atan, a), lambda a, b: each(math.atan2, a, b)
abs = lambda a, f=abs: each(f, a)
multiply = lambda a, b: each(operator.mul, a, b)
minimum, maximum = lambda a, b: each(min, a, b), lambda a, b: each(max, a, b)
where = lambda condition, a, b: each(lambda c, x, y: x if c else y, condition, a, b)
clip = lambda a, lo, hi: each(lambda v, least, most: min(max(v, least), most), a, lo, hi)


sized = lambda shape: (shape,) if isinstance(shape, int) else tuple(shape)
full = lambda shape, value, dtype=None: made(repeat(value, math.prod(sized(shape))), sized(shape), dtype)
table = lambda value, m, n: made([value(i, j) for i in range(m) for j in range(n)], (m, n))
zeros, ones = lambda shape, dtype=float: full(shape, 0, dtype), lambda shape: full(shape, 1.0)
eye = lambda n, k=0: table(lambda i, j: float(j == i + k), n, n)
tril = lambda a, k=0: table(lambda i, j: a[i, j] * (j <= i + k), *a.shape)
triu = lambda a, k=0: table(lambda i, j: a[i, j] * (j >= i + k), *a.shape)
arange = lambda *ends: array(range(*ends), int)
diag = lambda a: eye(len(a)) * a if array(a).ndim == 1 else array([a[i, i] for i in range(len(a))])


def transpose(a):
    a = operand(a)
    places = list(chain(*(a.places[j :: a.shape[-1]] for j in range(a.shape[-1]))))
    return a if a.ndim == 1 else ndarray(a.data, a.shape[::-1], a.dtype, places)


def concatenate(parts):
    parts = [array(part) for part in parts]
    return made(chain(*(part.flat() for part in parts)), (sum(map(len, parts)), *parts[0].shape[1:]))


vstack = lambda parts: concatenate([a if array(a).ndim == 2 else [a] for a in parts])
column_stack = lambda parts: vstack([transpose(a) for a in parts]).T
hstack = lambda parts: concatenate(parts) if array(parts[0]).ndim == 1 else column_stack(parts)
append = lambda a, b: concatenate([a if hasattr(a, "__iter__") else [a] for a in (a, b)])
cross = lambda a, b: array([a[i - 2] * b[i - 1] - a[i - 1] * b[i - 2] for i in range(3)])
cumsum = lambda a: made(accumulate(a), (len(a),))
flatnonzero = lambda a: array(picked(each(bool, a)), int)
argmin = lambda a: list(a).index(min(a))
# From the first to the last, which Python's own sum does not do in all versions.
total = lambda values: list(accumulate(values, initial=0))[-1]


def dot(a, b):
    a, b = operand(a), operand(b)
    if a.shape[-1] != len(b):
        raise ValueError(f"the shapes {a.shape} and {b.shape} do not fit together in a product")
    if a.ndim == b.ndim == 1:
        return total(map(operator.mul, a.flat(), b.flat()))
    rows, columns = ([m.flat()] if m.ndim == 1 else m.tolist() for m in (a, b.T))
    values = [total(map(operator.mul, row, column)) for row in rows for column in columns]
    return made(values, a.shape[:-1] + b.shape[1:])


def eliminated(rows, columns, tiny):
    """The rows after elimination, each with a 1 where the others have 0, and their rank."""
    rank = 0
    for j in range(columns):
        pivot = max(range(rank, len(rows)), key=lambda i: abs(rows[i][j]), default=rank)
        if rank == len(rows) or abs(rows[pivot][j]) <= tiny:
            continue
        rows[rank], rows[pivot] = rows[pivot], rows[rank]
        top = rows[rank] = [value / rows[rank][j] for value in rows[rank]]
        for i, row in enumerate(rows):
            if i != rank and row[j]:
                rows[i] = [value - row[j] * other for value, other in zip(row, top)]
        rank += 1
    return rows, rank


class linalg:
    """Norms, ranks and linear systems."""

    norm = staticmethod(lambda a: math.sqrt(total(value * value for value in array(a).flat())))
    matrix_rank = staticmethod(lambda A: eliminated(A.tolist(), A.shape[1], 1e-12 * abs(A).max())[1])

    @staticmethod
    def solve(A, b):
        A, b, n = array(A, float), array(b, float), len(A)
        right = b.tolist() if b.ndim == 2 else [[value] for value in b]
        rows, rank = eliminated([left + own for left, own in zip(A.tolist(), right)], n, 0.0)
        if rank < n:
            raise ValueError("Singular matrix")
        return made(chain(*(row[n:] for row in rows)), b.shape, float)


def written(a, gap, indent):
    """An array as NumPy prints it."""
    words, row, rows = [f" {v}" if v is True else str(v) for v in a.flat()], a.shape[-1], []
    if a.dtype is float:
        finite = [abs(v) for v in a.flat() if math.isfinite(v)]
        sizes = [v for v in finite if v] or [1]
        is_short = max(sizes) < 1e8 and min(sizes) >= 1e-4 and max(sizes) <= 1000 * min(sizes)
        kind = "f" if is_short else "e"
        ends = [f"{v:.8{kind}}".split("e")[0].split(".")[1].rstrip("0") for v in finite]
        words = [f"{v:#.{max(map(len, ends), default=0)}{kind}}" for v in a.flat()]
        words = [word.rstrip("0").ljust(len(word)) if is_short else word for word in words]
    width = max(map(len, words), default=0)
    next_line = gap.rstrip() + "\n" + " " * (indent + a.ndim)
    count = max(1, (75 - indent - 2 * a.ndim + len(gap)) // (width + len(gap)))  # numbers in a line
    for start in range(0, len(words), row or 1):
        own = [word.rjust(width) for word in words[start : start + row]]
        rows.append(next_line.join(gap.join(own[k : k + count]) for k in range(0, row, count)))
    lines = ("[" * a.ndim + f"]{next_line[:-1]}[".join(rows) + "]" * a.ndim).split("\n")
    return "\n".join(map(str.rstrip, lines))

"""Reads Siconos' .dat files by their grammar alone and compares with what lcplab makes of them.

    siconos.py LCPLAB FILE...      LCPLAB: the program, whose `convert` writes each file as JSON

Every grammar below is tried on all numbers of a file. If it takes every one of them, the file holds a problem of
that kind; the numbers must be those that lcplab writes, to the last bit, or, where M v = H r + q is solved for, within
1e-12 of the largest. A file that no grammar takes must be refused by lcplab, and one that two take is reported.

    matrix    0 rows cols rows cols, numbers by columns
              1 rows cols, number of blocks, block rows, block columns, ends of each, length of two lists: the first
              block of each block row and one more, the block column of each block; blocks: index, numbers by columns
              2 rows cols origin, and a listing by CSparse: of triplets (origin 1) or by columns (origin 2)
    lcp       n M q                              0 <= x, w = M x + q
    relay     n M q lb ub                        lb <= x <= ub
    mixed     1 f n m ends flags M q             ends: 0 to n + m; flag 0: w = 0 in the block; f = 1: the parts follow
              0 1 n m A B C D a b                by rows; M = [A C; D B], q = (a, b), the first n rows have w = 0
              either may be followed by n + 2 m - 1 numbers, an answer
    local     d contacts M q mu                  d = 3: rows n, t1, t2 of each contact; d = 2: rows n, t
    global    d contacts M H q b mu              M v = H r + q, u = H' v + b
    cones     n cones M q begins tau             begins: 0, 3, ... n; the associated cone with mu = tau
    generic   M q, and for each block of rows    M in blocks; kind 0: 0 <= x, w >= 0; 2: w = 0; 4 mu: a contact
              its kind

One more 0 or 1 may follow mu and tau. Lines behind the numbers that begin with a word and have more words than numbers are a
comment. Exit code: 1 if anything differs.
"""
import json
import re
import subprocess
import sys
import tempfile
from fractions import Fraction as Q
from pathlib import Path

INF = float("inf")


class Other(Exception):
    """The numbers are not those of this grammar."""


def need(holds):
    if not holds:
        raise Other


def is_number(word):
    try:
        float(word)
        return "_" not in word
    except ValueError:
        return False


def words_of(text):
    lines = text.splitlines()
    while lines:
        words = lines[-1].split()
        numbers = sum(map(is_number, words))
        if words and (is_number(words[0]) or len(words) <= 2 * numbers):
            break
        lines.pop()
    return " ".join(lines).split()


class Numbers:
    def __init__(self, words):
        self.words, self.at = words, 0

    def word(self):
        need(self.at < len(self.words))
        self.at += 1
        return self.words[self.at - 1]

    def whole(self):
        word = self.word()
        need(word.isdecimal())
        return int(word)

    def wholes(self, count):
        return [self.whole() for _ in range(count)]

    def reals(self, count):
        words = [self.word() for _ in range(count)]
        need(all(map(is_number, words)))
        return [float(word) for word in words]

    def matrix(self):
        storage, rows, cols = self.wholes(3)
        need(storage in (0, 1, 2))
        matrix = [[0.0] * cols for _ in range(rows)]
        if storage == 2:
            self.listing(matrix, rows, cols)
            return matrix
        if storage == 0:
            need(self.wholes(2) == [rows, cols])
            for j in range(cols):
                for i in range(rows):
                    matrix[i][j] = self.reals(1)[0]
            return matrix
        count, down, across = self.wholes(3)
        row_ends, col_ends = self.wholes(down), self.wholes(across)
        self.row_ends = row_ends
        lengths = self.wholes(2)
        first, columns = self.wholes(lengths[0]), self.wholes(lengths[1])
        need(down and across and row_ends[-1] == rows and col_ends[-1] == cols)
        need(len(columns) == count == first[-1] and first[0] == 0)
        for row, (begin, end) in enumerate(zip(first, first[1:])):
            for block in range(begin, end):
                need(self.whole() == block and row < down and columns[block] < across)
                top, left = ([0] + row_ends)[row], ([0] + col_ends)[columns[block]]
                for j in range(left, col_ends[columns[block]]):
                    for i in range(top, row_ends[row]):
                        matrix[i][j] = self.reals(1)[0]
        return matrix

    def literal(self, *words):
        for word in words:
            need(self.word() == word)

    def listing(self, matrix, rows, cols):
        origin = self.whole()
        need(origin in (1, 2))
        self.literal("CSparse")
        while not (size := re.fullmatch(r"([0-9]+)-by-([0-9]+),", self.word())):
            pass
        need((int(size[1]), int(size[2])) == (rows, cols))
        self.literal("nzmax:")
        self.whole()
        self.literal("nnz:")
        count = self.word().rstrip(",")
        need(count.isdecimal())
        places = []
        if origin == 1:
            for _ in range(int(count)):
                places.append(self.wholes(2))
                self.entry(matrix, places[-1])
        else:
            self.literal("1-norm:")
            self.reals(1)
            for j in range(cols):
                self.literal("col", str(j), ":", "locations")
                first = self.whole()
                self.literal("to")
                # Without an entry, the last place is one before the first, and may be -1.
                last = self.word()
                need(re.fullmatch(r"-1|[0-9]+", last) and first == len(places))
                for _ in range(first, int(last) + 1):
                    places.append([self.whole(), j])
                    self.entry(matrix, places[-1])
        need(len(places) == int(count))

    def entry(self, matrix, place):
        i, j = place
        self.literal(":")
        need(i < len(matrix) and j < len(matrix[0]))
        matrix[i][j] += self.reals(1)[0]

    def square(self, n):
        matrix = self.matrix()
        need(len(matrix) == n and all(len(row) == n for row in matrix))
        return matrix

    def end(self, has_flag=False):
        if has_flag and self.at == len(self.words) - 1:
            need(self.word() in ("0", "1"))
        need(self.at == len(self.words))


def lcp(t):
    n = t.whole()
    a, b = t.square(n), t.reals(n)
    t.end()
    return a, b, [0.0] * n, [INF] * n, None


def relay(t):
    n = t.whole()
    need(n > 0)
    a, b = t.square(n), t.reals(n)
    lo, hi = t.reals(n), t.reals(n)
    t.end()
    return a, b, lo, hi, None


def mixed(t):
    whole, parts, equations, others = t.wholes(4)
    n = equations + others
    need(whole <= 1 and parts <= 1 and whole + parts)
    if whole:
        ends = [t.whole()]
        while ends[-1] < n:
            ends.append(t.whole())
        flags = t.wholes(len(ends) - 1)
        lo = [(-INF, 0.0)[flag] for flag, i, j in zip(flags, ends, ends[1:]) for _ in range(i, j)]
        need(ends[0] == 0 and ends[-1] == n and lo.count(-INF) == equations)
        a, b = t.square(n), t.reals(n)
    if parts:
        size = {"A": (equations, equations), "B": (others, others), "C": (equations, others), "D": (others, equations)}
        p = {name: [t.reals(cols) for _ in range(rows)] for name, (rows, cols) in size.items()}
        upper, lower = zip(p["A"], p["C"]), zip(p["D"], p["B"])
        by_parts = [x + y for x, y in [*upper, *lower]], t.reals(n), [-INF] * equations + [0.0] * others
        need(not whole or by_parts == (a, b, lo))
        a, b, lo = by_parts
    if t.at < len(t.words):
        t.reals(n + others - 1)
    t.end()
    return a, b, lo, [INF] * n, None


def contacts(t):
    d = t.whole()
    need(d in (2, 3))
    return d, t.whole()


def lower(d, m):
    return [0.0, *[-INF] * (d - 1)] * m


def coupled(d, mu, model):
    """The row that each row is bounded by, its coefficient, and the law, of contacts of d rows; none without contacts."""
    if not mu:
        return None
    index = [-1 if k == 0 else d * contact for contact in range(len(mu)) for k in range(d)]
    return index, [0.0 if k == 0 else own for own in mu for k in range(d)], model


def cone_of(d):
    return "coulomb-cone" if d == 3 else None


def local(t):
    d, m = contacts(t)
    a, b, mu = t.square(d * m), t.reals(d * m), t.reals(m)
    t.end(has_flag=True)
    return a, b, lower(d, m), [INF] * (d * m), coupled(d, mu, cone_of(d))


def cones(t):
    n, m = t.wholes(2)
    a, b = t.square(n), t.reals(n)
    need(m and n == 3 * m and t.wholes(m + 1) == list(range(0, n + 1, 3)))
    tau = t.reals(m)
    t.end(has_flag=True)
    return a, b, lower(3, m), [INF] * n, coupled(3, tau, "associated-cone")


def generic(t):
    need(t.words[:1] == ["1"])
    a = t.matrix()
    n = len(a)
    need(n and all(len(row) == n for row in a))
    b, lo, index, mu = t.reals(n), [], [], []
    for end in t.row_ends:
        first = len(lo)
        rows, kind = end - first, t.whole()
        need(kind in (0, 2) or kind == 4 and rows == 3)
        lo += {0: [0.0] * rows, 2: [-INF] * rows, 4: [0.0, -INF, -INF]}[kind]
        own = t.reals(1)[0] if kind == 4 else 0.0
        index += [first if kind == 4 and k else -1 for k in range(rows)]
        mu += [own if kind == 4 and k else 0.0 for k in range(rows)]
    t.end()
    has_contacts = any(i >= 0 for i in index)
    return a, b, lo, [INF] * n, (index, mu, "coulomb-cone") if has_contacts else None


def solved(m, right):
    """M^-1 times the columns of `right`, exactly, by Gauss and Jordan."""
    rows = [[Q(v) for v in row + more] for row, more in zip(m, right)]
    n = len(rows)
    for k in range(n):
        pivot = next((i for i in range(k, n) if rows[i][k]), None)
        need(pivot is not None)
        rows[k], rows[pivot] = rows[pivot], rows[k]
        rows[k] = [v / rows[k][k] for v in rows[k]]
        for i in (i for i in range(n) if i != k and rows[i][k]):
            rows[i] = [v - rows[i][k] * w for v, w in zip(rows[i], rows[k])]
    return [row[n:] for row in rows]


def global_(t):
    d, m = contacts(t)
    mass = t.matrix()
    k = len(mass)
    h = t.matrix()
    need(all(len(row) == k for row in mass) and len(h) == k and all(len(row) == d * m for row in h))
    q, b, mu = t.reals(k), t.reals(d * m), t.reals(m)
    t.end(has_flag=True)
    inverse = solved(mass, [row + [v] for row, v in zip(h, q)])

    def product(i, j):
        return sum(Q(h[r][i]) * inverse[r][j] for r in range(k))

    n = d * m
    a = [[product(i, j) for j in range(n)] for i in range(n)]
    return a, [product(i, n) + Q(b[i]) for i in range(n)], lower(d, m), [INF] * n, coupled(d, mu, cone_of(d))


KINDS = [lcp, relay, mixed, local, global_, cones, generic]


def kinds(words):
    for kind in KINDS:
        try:
            yield kind, kind(Numbers(words))
        except Other:
            pass


def converted(program, file):
    """What lcplab makes of a file; none if it refuses it."""
    with tempfile.TemporaryDirectory() as folder:
        out = Path(folder) / "out.json"
        run = subprocess.run([program, "convert", file, out], capture_output=True, text=True)
        need(run.returncode in (0, 2))
        return json.loads(out.read_text()) if run.returncode == 0 else None


def dense(a, n):
    if "dense" in a:
        return a["dense"]
    matrix = [[0.0] * n for _ in range(n)]
    for i, j, v in a["triplets"]:
        matrix[i][j] += v
    return matrix


def differences(kind, expected, found):
    a, b, lo, hi, friction = expected
    n = len(b)
    bound = [[{"inf": INF, "-inf": -INF}.get(v, v) for v in found[key]] for key in ("lo", "hi")]
    matrix = [[*row, v] for row, v in zip(dense(found["A"], n), found["b"])]
    largest = max((abs(v) for row in a for v in row), default=0), max(map(abs, b), default=0)
    for i, row in enumerate(a):
        for j, v in enumerate([*row, b[i]]):
            most = largest[j == n] * Q(1, 10**12) if kind is global_ else 0
            if abs(Q(matrix[i][j]) - Q(v)) > most:
                yield f"row {i}, column {j}: {matrix[i][j]}, not {float(v)}"
    if bound != [lo, hi]:
        yield f"bounds {bound}, not {[lo, hi]}"
    index, rows, model = friction or (None, None, None)
    if (found.get("friction_index"), found.get("mu")) != (index, rows):
        yield "another friction"
    if found.get("model") != model:
        yield f"another model, {found.get('model')}"


def main(program, files):
    wrong, read = 0, 0
    for file in files:
        words = words_of(Path(file).read_text())
        takers, found = list(kinds(words)), converted(program, file)
        if len(takers) > 1:
            problems = [f"of several kinds: {[kind.__name__ for kind, _ in takers]}"]
        elif (found is None) != (not takers):
            problems = ["refused" if found is None else "read, but no grammar takes all of its numbers"]
        else:
            problems = [text for kind, expected in takers for text in differences(kind, expected, found)]
        read += found is not None
        wrong += bool(problems)
        for problem in problems[:3]:
            print(f"{file}: {problem}")
    print(f"{len(files)} files of Siconos, {read} read, {wrong} wrong")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1], sys.argv[2:]))

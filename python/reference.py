"""Writes docs/python.md from the docstrings of the package: `python python/reference.py`."""

import inspect
import re
from pathlib import Path

import lcplab

HEAD = """# lcplab for Python

```console
$ pip install ./python        # needs a Rust toolchain; brings the command lcplab too
```

The package needs NumPy alone; SciPy's sparse arrays are taken where they are. A function `f(A, b, lo, hi, **settings)` is a
solver wherever a solver is named: it returns x, or yields its iterates, or returns None where it found nothing; `settings`
are `tolerance`, `max_iterations`, with friction `friction_index` and `mu`, and in scenes `start`. A function that has a
parameter named `model` also gets friction cones: `model` is then `"coupled-box"`, `"associated-cone"` or `"coulomb-cone"`.
It may raise NotImplementedError for a problem that it is not made for. Any other exception is a failed row with its
message, but for those that end more than a function, such as KeyboardInterrupt and SystemExit: they end the call that
asked it. [Examples](../python/examples) and a [notebook](../notebooks/python/quickstart.ipynb) show
it at work.

This page is written by `python python/reference.py` from the docstrings.
"""

#: The order of the page.
NAMES = [
    "solve", "Result", "judge", "Verdict", "prove", "check", "Proof", "Problem", "compare", "Comparison", "hunt", "Finding", "explain",
    "Document", "Scene", "Step", "receipt", "Receipt", "receipts", "Run", "EngineStep", "EngineRow", "solvers", "InputError",
]


def entry(name):
    thing = getattr(lcplab, name)
    text = f"\n## `{name}`\n\n"
    if inspect.isfunction(thing):
        text += f"```python\nlcplab.{name}{signature(thing)}\n```\n\n"
    text += block(inspect.getdoc(thing))
    if inspect.isclass(thing) and name != "InputError":
        for key, value in vars(thing).items():
            function = value.fget if isinstance(value, property) else getattr(value, "__func__", value)
            if not key.startswith("_") and inspect.isfunction(function):
                call = "" if isinstance(value, property) else signature(function)
                text += f"- `{key}{call}`: {inspect.getdoc(function).splitlines()[0]}\n"
    return text


def signature(function):
    parameters = [
        p.replace(annotation=inspect.Parameter.empty)
        for p in inspect.signature(function).parameters.values()
        if p.name not in ("self", "cls")
    ]
    return str(inspect.Signature(parameters))


def block(doc):
    """A docstring in NumPy's style as Markdown: headings bold, examples as code."""
    doc = re.sub(r":(?:class|func):`(\w+)`", r"`\1`", doc).replace("``", "`")
    lines, out, is_code = doc.splitlines(), [], False
    for k, line in enumerate(lines):
        if set(line) == {"-"}:
            continue
        if k + 1 < len(lines) and lines[k + 1] and set(lines[k + 1]) == {"-"}:
            if is_code:
                out.append("```")
                is_code = False
            out += [f"**{line}**", ""]
            if line == "Examples":
                out.append("```python")
                is_code = True
        elif is_code or not line.startswith("    "):
            is_item = not is_code and " : " in line
            out.append(f"- `{line.split(' : ')[0]}`: {line.split(' : ', 1)[1]}" if is_item else line)
        else:
            out.append(f"  {line.strip()}")
    return "\n".join(out + (["```"] if is_code else [])) + "\n\n"


def others():
    from lcplab import testing

    text = "\n## `lcplab.testing`\n\n" + inspect.getdoc(testing).splitlines()[0] + "\n\n"
    for name in ("assert_solves", "assert_honest"):
        function = getattr(testing, name)
        text += f"- `{name}{signature(function)}`: {inspect.getdoc(function).splitlines()[0]}\n"
    text += "\n## `lcplab.textbook`\n\n" + inspect.getdoc(lcplab.textbook) + "\n\n"
    for name in ("jacobi", "gauss_seidel", "murty", "dantzig", "lemke", "interior_point"):
        function = getattr(lcplab.textbook, name)
        text += f"- `{name}{signature(function)}`: {inspect.getdoc(function).splitlines()[0]}\n"
    return text


def reference():
    text = HEAD + "".join(entry(name) for name in NAMES) + others()
    lines = [line.rstrip() for line in text.splitlines()]
    kept = [line for k, line in enumerate(lines) if line or (k and lines[k - 1])]
    return "\n".join(kept).rstrip() + "\n"


if __name__ == "__main__":
    path = Path(__file__).parent.parent / "docs" / "python.md"
    path.write_text(reference(), encoding="utf-8")

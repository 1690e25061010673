"""Write docs/python.md from the docstrings of the package: `python python/reference.py`."""

import inspect
import re
from pathlib import Path

import lcplab

HEAD = """# lcplab for Python

```console
$ pip install ./python        # needs a Rust toolchain; brings the command lcplab too
```

The package needs only NumPy; it also accepts SciPy's sparse arrays. The [glossary](glossary.md) explains the symbols A, b, x, w,
lo and hi. [Examples](../python/examples) and a [notebook](../notebooks/python/quickstart.ipynb) show the package in use.

**Your own solver.** Every argument `solver` accepts a function `f(A, b, lo, hi, **settings)`:

- It returns x, or yields its iterates, or returns None if it found no solution.
- `settings` has `tolerance` and `max_iterations`; for problems with friction also `friction_index` and `mu`; in scenes also `start`.
- A function with a parameter named `model` is also given friction cones; `model` is then `"coupled-box"`, `"associated-cone"` or
  `"coulomb-cone"`.
- It may raise NotImplementedError for a problem that it does not support. Any other exception counts as a failure, with its
  message. KeyboardInterrupt and SystemExit end the call of lcplab.

This page is generated from the docstrings by `python python/reference.py`.
"""

#: The order of the page.
NAMES = [
    "solve", "Result", "judge", "Verdict", "solve_qp", "QPSolution", "solutions", "Solutions", "Face", "gradient", "Gradient", "prove", "check", "Proof", "Problem", "compare", "Comparison", "hunt", "Finding", "explain",
    "Document", "Scene", "Step", "receipt", "Receipt", "receipts", "Run", "attribution", "Attribution", "EngineStep",
    "EngineRow", "solvers", "InputError",
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
                text += f"- `{key}{call}`: {first_line(function)}\n"
    return text


def signature(function):
    parameters = [
        p.replace(annotation=inspect.Parameter.empty)
        for p in inspect.signature(function).parameters.values()
        if p.name not in ("self", "cls")
    ]
    return str(inspect.Signature(parameters))


def first_line(function):
    return markdown(inspect.getdoc(function).splitlines()[0])


def markdown(text):
    """The text with the marks of reStructuredText as code in Markdown."""
    return re.sub(r":(?:class|func):`([\w.]+)`", r"`\1`", text).replace("``", "`")


def block(doc):
    """A docstring in NumPy's style as Markdown: headings bold, examples as code."""
    lines, out, is_code = markdown(doc).splitlines(), [], False
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
            is_described = k + 1 < len(lines) and lines[k + 1].startswith("    ")
            if not is_code and " : " in line:
                line = f"- `{line.split(' : ')[0]}`: {line.split(' : ', 1)[1]}"
            elif not is_code and is_described and not line.startswith("- "):
                line = f"- `{line}`:"
            out.append(line)
        else:
            out.append(f"  {line.strip()}")
    return "\n".join(out + (["```"] if is_code else [])) + "\n\n"


def others():
    from lcplab import testing

    text = "\n## `lcplab.testing`\n\n" + inspect.getdoc(testing).splitlines()[0] + "\n\n"
    for name in ("assert_solves", "assert_no_false_claims"):
        function = getattr(testing, name)
        text += f"- `{name}{signature(function)}`: {first_line(function)}\n"
    text += "\n## `lcplab.textbook`\n\n" + inspect.getdoc(lcplab.textbook) + "\n\n"
    for name in ("jacobi", "gauss_seidel", "murty", "dantzig", "lemke", "interior_point"):
        function = getattr(lcplab.textbook, name)
        text += f"- `{name}{signature(function)}`: {first_line(function)}\n"
    return text


def reference():
    text = HEAD + "".join(entry(name) for name in NAMES) + others()
    lines = [line.rstrip() for line in text.splitlines()]
    kept = [line for k, line in enumerate(lines) if line or (k and lines[k - 1])]
    return "\n".join(kept).rstrip() + "\n"


if __name__ == "__main__":
    path = Path(__file__).parent.parent / "docs" / "python.md"
    path.write_text(reference(), encoding="utf-8")

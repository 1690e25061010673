"""What texts say once a version is published: `python3 release/release.py --prepare URL` writes it.

Each change names a file, what it says before the first release, and what it says then. A dry run checks that every change
still fits its file, so that the texts cannot move away from them. When version 0.1.0 is out, only `heading` is still needed."""

import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# {url} is the address of the repository, {owner} its owner and name, {version} and {date} those of the release.
CHANGES = [
    (
        "Cargo.toml",
        'repository = "https://github.com/OWNER/lcplab" # replace OWNER here before a release, and nowhere else\n',
        'repository = "{url}"\n',
    ),
    (
        "python/pyproject.toml",
        "[project.optional-dependencies]\n",
        '[project.urls]\nRepository = "{url}"\n\n[project.optional-dependencies]\n',
    ),
    ("CITATION.cff", "version: {version}\n", 'version: {version}\ndate-released: {date}\nrepository-code: "{url}"\n'),
    ("CHANGELOG.md", "No version has been released. The promise", "The promise"),
    ("SECURITY.md", "There is no release yet, so\nfixes go to the newest commit.", "Fixes go to\nthe newest version."),
    (
        "README.md",
        """You need a Rust toolchain (1.91 or newer). The first build takes 4 to 6 minutes on two cores.

```console
$ cargo install --path .                 # the command lcplab
$ pip install ./python                   # the Python package; it includes the command
$ cargo run --release -- report          # without installing: writes the standard report
$ cargo test                             # runs the tests, except those in a browser or in Python
```

If you do not install lcplab, write `cargo run --release --` instead of `lcplab` in the examples.
""",
        """```console
$ pip install lcplab                     # the Python package and the command; no compiler needed
$ cargo install lcplab                   # or the command alone, built from source (Rust 1.91 or newer)
```
""",
    ),
    (
        "docs/install.md",
        """lcplab has not been released: there is no package to download yet, so you build it from a copy of this repository. You need
Rust 1.91 or newer. The first build takes 4 to 6 minutes on two cores.

| you want | command, in the repository | you get |
| --- | --- | --- |
| the command line | `cargo install --path .` | the command `lcplab` |
| Python | `pip install ./python` | the module `lcplab` (Python 3.10 or newer, NumPy) and the command `lcplab` |
| the Rust library | `lcplab = { path = "…" }` in your `Cargo.toml` | the crate `lcplab`, or [a smaller one](rust.md); with `default-features = false` it reads no HDF5 files |
| Python in a browser | `python3 release/pyodide.py` | a wheel for [Pyodide](https://pyodide.org) 314, for `micropip.install` |
| to try it first | `cargo run --release -- report` | the standard report; nothing is installed |
""",
        """| you want | command | you get |
| --- | --- | --- |
| Python | `pip install lcplab` | the module `lcplab` (Python 3.10 or newer, NumPy) and the command `lcplab`; no compiler needed |
| Python in a browser | `await micropip.install("lcplab")` | the same module in [Pyodide](https://pyodide.org) 314 |
| the command line | `cargo install lcplab` | the command `lcplab`, built from source (Rust 1.91 or newer, 4 to 6 minutes on two cores) |
| the command line, ready to run | an archive of the [release]({url}/releases) | the command `lcplab`, its completions and man pages |
| the Rust library | `cargo add lcplab` | the crate `lcplab`, or [a smaller one](rust.md); with `default-features = false` it reads no HDF5 files |
| the newest commit | `cargo install --path .` or `pip install ./python` in a copy of [the repository]({url}) | the same, built from source |
""",
    ),
    (
        "docs/rust.md",
        """Nothing has
been released yet, so add them by path, from a copy of this repository:

```toml
[dependencies]
lcplab-lcp = { path = "…/lcplab/crates/lcp" }
lcplab-judge = { path = "…/lcplab/crates/judge" }
```
""",
        """The crates are on
[crates.io](https://crates.io/crates/lcplab):

```console
$ cargo add lcplab-lcp lcplab-judge
```
""",
    ),
    ("docs/rust.md", " Before version 0.1.0 nothing is promised.", ""),
    ("docs/install.md", '`pip install "./python[mujoco,drake]"`', '`pip install "lcplab[mujoco,drake]"`'),
    (
        "docs/cite.md",
        """There is no release yet, so also state the commit: `git rev-parse HEAD` prints it in your copy, and every page of the site shows it at
its foot.
""",
        """State the version that `lcplab --version` prints. Between releases also state the commit: `git rev-parse HEAD` prints it in your
copy, and every page of the site shows it at its foot.
""",
    ),
    ("docs/cite.md", "  version = {{version}},\n", "  version = {{version}},\n  url     = {{url}},\n"),
    (
        "docs/ci.md",
        "`pip install ./python` from its repository (this needs a Rust toolchain)",
        "`pip install lcplab`",
    ),
    (
        "examples/ci/workflow.yml",
        "of your engine, and set OWNER and the folder of the tests.",
        "of your engine, and set the folder of the tests.",
    ),
    (
        "examples/ci/workflow.yml",
        'pip install pytest "lcplab @ git+https://github.com/OWNER/lcplab#subdirectory=python"',
        "pip install pytest lcplab",
    ),
    ("examples/ci/workflow.yml", "uses: OWNER/lcplab@main", "uses: {owner}@v{version}"),
    ("notebooks/projects.md", "`pip install ./python`", "`pip install lcplab`"),
    (
        "python/README.md",
        "`pip install ./python` in a checkout needs a Rust toolchain. The reference is `docs/python.md`.",
        "The reference is [docs/python.md]({url}/blob/v{version}/docs/python.md). The package includes the command `lcplab`.",
    ),
    *(
        (
            name,
            "$ pip install ./python        # needs a Rust toolchain; brings the command lcplab too\n",
            "$ pip install lcplab          # includes the command lcplab\n",
        )
        for name in ("python/reference.py", "docs/python.md")
    ),
    *((name, "pip install ./python", "pip install lcplab") for name in ("src/cli/engines.rs", "tests/suite/cli/report.rs")),
]


def heading(version: str, date: str) -> tuple[str, str, str]:
    """The change of the title of a version's section."""
    return "CHANGELOG.md", f"## {version} (unreleased)\n", f"## {version} ({date})\n"


def prepared(version: str, url: str, date: str) -> dict[str, str]:
    """The new text of each file; ValueError names the changes that do not fit."""
    words = {"{version}": version, "{url}": url, "{date}": date, "{owner}": "/".join(url.split("/")[-2:])}
    texts: dict[str, str] = {}
    wrong = []
    for name, before, after in [heading(version, date), *CHANGES]:
        text = texts.get(name) or (ROOT / name).read_text(encoding="utf-8")
        before, after = filled(before, words), filled(after, words)
        if text.count(before) != 1:
            wrong.append(f"{name}: has {text.count(before)} times {before.strip().splitlines()[0]!r}, not once")
        texts[name] = text.replace(before, after)
    if wrong:
        raise ValueError("\n".join(wrong))
    return texts


def filled(text: str, words: dict[str, str]) -> str:
    for key, word in words.items():
        text = text.replace(key, word)
    return text


if __name__ == "__main__":  # whether every change still fits
    cargo = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["workspace"]["package"]
    if "OWNER" in cargo["repository"]:
        prepared(cargo["version"], cargo["repository"], "2000-01-01")

#!/usr/bin/env python3
"""Links an extension module for Pyodide: rustc calls this script where it expects Emscripten's `emcc`.

Emscripten is not needed, because the module contains no C code, and takes the C library from Pyodide's main module. The linker
is the one that comes with Rust."""

import json
import re
import subprocess
import sys
from pathlib import Path

# A module that Pyodide loads at run time: position-independent, in the memory of the main module.
SIDE_MODULE = ["-shared", "--experimental-pic", "--import-memory", "--unresolved-symbols=import-dynamic"]
# Only what Python looks up is exported; with all symbols the module is half as large again.
SMALL = ["--no-export-dynamic", "--gc-sections", "--strip-all", "-O2"]


def main() -> None:
    words = [argument for word in sys.argv[1:] for argument in read(word)]
    inputs = [word for word in words if word.endswith((".o", ".rlib", ".a"))]
    output = words[words.index("-o") + 1]
    exports = [f"--export={name}" for name in exported(words)]
    sys.exit(subprocess.call([linker(), "-flavor", "wasm", *SIDE_MODULE, *SMALL, *exports, *inputs, "-o", output]))


def read(word: str) -> list[str]:
    """An argument, or those of a file `@NAME`, one a line, with a backslash before each space and backslash."""
    if not word.startswith("@"):
        return [word]
    lines = Path(word[1:]).read_text(encoding="utf-8").splitlines()
    return [re.sub(r"\\(.)", r"\1", line) for line in lines]


def exported(words: list[str]) -> list[str]:
    """The symbol that Python looks up; the others that rustc names belong to dependencies, for other ways to load a module.
    Emscripten puts an underscore before each name."""
    key = "EXPORTED_FUNCTIONS="
    lists = [json.loads(word.removeprefix(key)) for word in words if word.startswith(key)]
    return [name.removeprefix("_") for names in lists for name in names if name.startswith("_PyInit_")]


def linker() -> Path:
    root = subprocess.run(["rustc", "--print", "sysroot"], check=True, stdout=subprocess.PIPE, text=True).stdout.strip()
    found = sorted(Path(root, "lib/rustlib").glob("*/bin/rust-lld*"))
    return found[0] if found else sys.exit("emcc.py: the Rust toolchain has no rust-lld")


if __name__ == "__main__":
    main()

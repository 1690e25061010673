"""Builds the wheel for Pyodide, which is Python in a browser.

`python3 release/pyodide.py [--out FOLDER]` needs `rustup target add wasm32-unknown-emscripten` and maturin, but no Emscripten."""

import argparse
import os
import subprocess
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent

# Pyodide 314: its Python, and the version of its platform, as PEP 783 numbers them.
PYTHON = "3.14"
PLATFORM = "2026_0"


def main() -> None:
    parser = argparse.ArgumentParser(description="Build the wheel for Pyodide.")
    parser.add_argument("--out", type=Path, default=ROOT / "target/wheels", help="folder to write into")
    given = parser.parse_args()
    command = ["maturin", "build", "--quiet", "--release", "--locked", "--compression-level", "9", "--target", "wasm32-unknown-emscripten"]
    command += ["--manifest-path", "python/Cargo.toml", "--target-dir", "target/python", "--out", str(given.out.resolve())]
    subprocess.run(command, cwd=ROOT, env=environment(), check=True)


def environment() -> dict[str, str]:
    return os.environ | {
        "CARGO_TARGET_WASM32_UNKNOWN_EMSCRIPTEN_LINKER": str(ROOT / "release/emcc.py"),
        "CARGO_TARGET_WASM32_UNKNOWN_EMSCRIPTEN_RUSTFLAGS": "-C relocation-model=pic",
        "MATURIN_PYEMSCRIPTEN_PLATFORM_VERSION": PLATFORM,
        "PYO3_CROSS_PYTHON_VERSION": PYTHON,
    }


if __name__ == "__main__":
    main()

#!/usr/bin/env python3
"""Builds the live pages: the module for WebAssembly, and a page around it each, which needs nothing else. They are
written beside this file, or into a folder.

    python3 live/build.py [FOLDER]

It needs `rustup target add wasm32-unknown-unknown`. The pages are committed.
"""
import base64, functools, hashlib, os, subprocess, sys, zlib
from pathlib import Path

LIVE = Path(__file__).parent
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", LIVE.parent / "target" / "live"))
# The title, the features of the module, and the most bytes of a page.
PAGES = {
    "two_rows": ("Two rows", "", 550_000),
    "stack": ("A stack", "", 550_000),
    "friction": ("Friction", "", 550_000),
    "problem": ("Your problem", "study", 1_000_000),
    "painleve": ("Painlevé's rod", "", 550_000),
}


@functools.cache
def module(features):
    """The module, deflated, in base 64."""
    command = ["cargo", "build", "--release", "--locked", "--target", "wasm32-unknown-unknown", "--target-dir", str(TARGET)]
    subprocess.run([*command, "--features", features], cwd=LIVE, check=True)
    code = (TARGET / "wasm32-unknown-unknown" / "release" / "lcplab_live.wasm").read_bytes()
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    return base64.b64encode(packer.compress(code) + packer.flush()).decode()


def page(name, title, packed):
    part = lambda file: (LIVE / "page" / file).read_text(encoding="utf-8")
    script = part("live.js") + part(f"{name}.js")
    digest = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    parts = {"title": f"{title} · lcplab", "style": part("live.css"), "body": part(f"{name}.html"), "hash": digest}
    text = part("frame.html")
    for key, value in {**parts, "script": script, "module": packed}.items():
        text = text.replace(f"@{key}@", value)
    return text


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else LIVE
    folder.mkdir(parents=True, exist_ok=True)
    for name, (title, features, most) in PAGES.items():
        text = page(name, title, module(features))
        size = len(text.encode())
        (folder / f"{name}.html").write_text(text, encoding="utf-8")
        print(f"{name}.html: {size // 1000} kB")
        if size > most:
            sys.exit(f"more than {most // 1000} kB")


if __name__ == "__main__":
    main()

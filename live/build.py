#!/usr/bin/env python3
"""Builds the module of the live pages for WebAssembly and deflates it, into src/live or into a file.

    python3 live/build.py [FILE]

It needs `rustup target add wasm32-unknown-unknown`. The file is committed: a machine without that target cannot build it.
"""
import os, subprocess, sys, zlib
from pathlib import Path

LIVE = Path(__file__).resolve().parent
TARGET = Path(os.environ.get("CARGO_TARGET_DIR", LIVE.parent / "target" / "live"))
LARGEST = 775_000  # bytes


def without_machine_paths():
    """Flags that keep the folder of downloaded crates out of the messages of panics."""
    subprocess.run(["cargo", "fetch", "--locked"], cwd=LIVE.parent, check=True)
    home = Path(os.environ.get("CARGO_HOME", Path.home() / ".cargo"))
    registries = sorted((home / "registry" / "src").glob("*"))
    return "\x1f".join(f"--remap-path-prefix={registry}/=" for registry in registries)


def main():
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else LIVE.parent / "src" / "live" / "module.wasm.deflate"
    command = ["cargo", "build", "--profile", "live", "--locked", "--target", "wasm32-unknown-unknown"]
    command += ["-p", "lcplab-live", "--target-dir", str(TARGET)]
    flags = {"CARGO_ENCODED_RUSTFLAGS": without_machine_paths()}
    subprocess.run(command, cwd=LIVE.parent, check=True, env=os.environ | flags)
    code = (TARGET / "wasm32-unknown-unknown" / "live" / "lcplab_live.wasm").read_bytes()
    packer = zlib.compressobj(9, zlib.DEFLATED, -15)
    packed = packer.compress(code) + packer.flush()
    file.write_bytes(packed)
    print(f"{file}: {len(packed) // 1000} kB")
    if len(packed) > LARGEST:
        sys.exit(f"more than {LARGEST // 1000} kB")


if __name__ == "__main__":
    main()

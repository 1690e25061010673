"""Packs the program into one archive, with its completions, its man pages and the licenses.

`cargo build --release && python3 release/archive.py [--out FOLDER]` writes lcplab-VERSION-TARGET.tar.gz and its SHA-256.
The same files give the same bytes."""

import argparse
import gzip
import hashlib
import io
import re
import subprocess
import tarfile
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
TEXTS = ["README.md", "CHANGELOG.md", "CITATION.cff", "LICENSE-APACHE", "LICENSE-MIT"]

# Each shell finds completions by the name of their file.
COMPLETIONS = {
    "bash": "lcplab.bash",
    "elvish": "lcplab.elv",
    "fish": "lcplab.fish",
    "powershell": "_lcplab.ps1",
    "zsh": "_lcplab",
}


def arguments() -> argparse.Namespace:
    parser = argparse.ArgumentParser(description="Pack the program for those who do not build it.")
    parser.add_argument("--out", type=Path, default=ROOT / "target/released", help="folder to write into")
    parser.add_argument(
        "--lcplab",
        type=Path,
        default=ROOT / "target/release/lcplab",
        help="the program; it is run, so it must be one for this machine (default: target/release/lcplab)",
    )
    return parser.parse_args()


def main() -> None:
    given = arguments()
    name = f"lcplab-{version(given.lcplab)}-{target()}"
    given.out.mkdir(parents=True, exist_ok=True)
    archive = given.out / f"{name}.tar.gz"
    archive.write_bytes(packed(name, contents(given.lcplab)))
    try_out(archive, f"{name}/{program(given.lcplab)}")
    digest = hashlib.sha256(archive.read_bytes()).hexdigest()
    (given.out / f"{archive.name}.sha256").write_text(f"{digest}  {archive.name}\n", encoding="ascii", newline="\n")
    print(f"{archive}: {archive.stat().st_size / 1e6:.1f} MB, SHA-256 {digest}")


def output(*command: str | Path) -> bytes:
    return subprocess.run(command, check=True, stdout=subprocess.PIPE).stdout


def version(lcplab: Path) -> str:
    return output(lcplab, "--version").decode().split()[1]


def target() -> str:
    """The system for which the installed compiler builds, such as x86_64-unknown-linux-gnu."""
    return re.search(r"host: (\S+)", output("rustc", "-vV").decode())[1]


def program(lcplab: Path) -> str:
    return "lcplab" + lcplab.suffix  # .exe on Windows


def contents(lcplab: Path) -> dict[str, bytes]:
    files = {program(lcplab): lcplab.read_bytes()}
    files |= {name: (ROOT / name).read_bytes() for name in TEXTS}
    for shell, name in COMPLETIONS.items():
        files[f"completions/{name}"] = output(lcplab, "completions", shell)
    files["man/man1/lcplab.1"] = output(lcplab, "man")
    for command in commands(lcplab):
        files[f"man/man1/lcplab-{command}.1"] = output(lcplab, "man", command)
    return files


def commands(lcplab: Path) -> list[str]:
    text = output(lcplab, "--help").decode()
    return [name for name in re.findall(r"^  ([a-z][a-z-]+)  ", text, flags=re.MULTILINE) if name != "help"]


def packed(folder: str, files: dict[str, bytes]) -> bytes:
    """The files as a compressed archive, without times and owners."""
    box = io.BytesIO()
    with (
        gzip.GzipFile(fileobj=box, mode="wb", mtime=0) as squeezed,
        tarfile.open(fileobj=squeezed, mode="w") as tar,
    ):
        for name, data in sorted(files.items()):
            entry = tarfile.TarInfo(f"{folder}/{name}")
            entry.size = len(data)
            entry.mode = 0o644 if "/" in name or name in TEXTS else 0o755
            tar.addfile(entry, io.BytesIO(data))
    return box.getvalue()


def try_out(archive: Path, program: str) -> None:
    """Unpacks the archive and runs a scene with what is in it alone."""
    with tempfile.TemporaryDirectory() as place, tarfile.open(archive) as tar:
        tar.extractall(place, filter="data")
        command = [Path(place, program), "simulate", "stack"]
        subprocess.run(command, cwd=place, check=True, stdout=subprocess.DEVNULL)


if __name__ == "__main__":
    main()

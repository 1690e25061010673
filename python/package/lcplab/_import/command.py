"""The command ``lcplab import FILE``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import ParseError
from xml.parsers.expat import ExpatError

from lcplab import _import
from lcplab._import import toml, urdf
from lcplab._import.source import Lines
from lcplab._lcplab import InputError
from lcplab._scene import Scene

EXAMPLES = """\
Examples:
  lcplab import stack.xml --out stack.toml               # then: lcplab diagnose stack.toml
  lcplab import arm.urdf --skip --out arm.toml           # leaves out what has no counterpart, and lists it

The exit code is 0 if the scene was written, and 2 for invalid input, such as an element that has no counterpart in a
scene. With --skip such elements are listed and left out. The import needs MuJoCo: pip install "./python[mujoco]"
in lcplab's repository."""


def main(arguments: Sequence[str]) -> int:
    """Write the scene of an MJCF or URDF file; returns the exit code."""
    parser = argparse.ArgumentParser(
        prog="lcplab import",
        description="Write an MJCF or URDF file as a scene, at its initial state or at one of its keyframes.",
        epilog=EXAMPLES,
        formatter_class=argparse.RawDescriptionHelpFormatter,
    )
    parser.add_argument("file", type=Path, help="an MJCF file (.xml) or a URDF file (.urdf)")
    parser.add_argument("--skip", action="store_true", help="leave out what has no counterpart in a scene")
    parser.add_argument("--keyframe", metavar="NAME", help="import the state of this keyframe of the file")
    parser.add_argument("--out", type=Path, metavar="FILE", help="write the scene here instead of to standard output")
    options = parser.parse_args(arguments)
    try:
        text = _scene(options.file, options.keyframe, options.skip)
        if options.out:
            options.out.write_text(text, encoding="utf-8")
        else:
            sys.stdout.write(text)
    except OSError as error:
        print(f"error: {error.filename}: {error.strerror}", file=sys.stderr)
        return 2
    except InputError as error:
        print("\n".join(f"error: {line}" for line in str(error).splitlines()), file=sys.stderr)
        return 2
    return 0


def _scene(path: Path, keyframe: str | None, skip: bool) -> str:
    """The text of the scene; refusals are reported on standard error."""
    model = compiled(path)
    imported = _import.scene(model, _state(path, model, keyframe))
    listed = [f"{where}: {refusal}" for where, refusal in _places(path, model, imported.refusals)]
    if listed and not skip:
        raise InputError("\n".join([*listed, f"{path}: is not imported; --skip leaves out these parts"]))
    for line in [f"skipped: {line}" for line in listed] + [f"note: {line}" for line in imported.notes]:
        print(line, file=sys.stderr)
    Scene.of(imported.scene)  # reports what lcplab itself does not accept
    comments = [f"Imported from {path.name}.", *(f"Skipped: {line}" for line in listed)]
    return toml.text(imported.scene, comments)


def _places(path: Path, model: Any, refusals: list[_import.Refusal]) -> list[tuple[str, _import.Refusal]]:
    try:
        lines = Lines(path, model)
    except ExpatError:
        return [(str(path), refusal) for refusal in refusals]
    return [(lines.place(refusal), refusal) for refusal in refusals]


def compiled(path: Path) -> Any:
    """The model of a file.

    Raises
    ------
    InputError
        If MuJoCo is not installed or cannot compile the file, or a mesh is not found.
    """
    try:
        import mujoco
    except ImportError as error:
        raise InputError('the import needs MuJoCo: pip install "./python[mujoco]" in the repository of lcplab') from error
    has_packages = urdf.has_packages(path)
    try:
        if has_packages:
            return mujoco.MjModel.from_xml_string(urdf.resolved(path))
        return mujoco.MjModel.from_xml_path(str(path))
    except (ValueError, ParseError) as error:
        if isinstance(error, InputError):
            raise
        reason = " ".join(str(error).split())
        raise InputError(f"{path}: MuJoCo cannot compile it: {reason}") from error


def _state(path: Path, model: Any, keyframe: str | None) -> Any:
    """The initial state, or that of a keyframe."""
    import mujoco

    data = mujoco.MjData(model)
    if keyframe is not None:
        number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_KEY, keyframe)
        if number < 0:
            raise InputError(f"{path}: has no keyframe {keyframe!r}")
        mujoco.mj_resetDataKeyframe(model, data, number)
    return data

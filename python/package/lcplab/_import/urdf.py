"""URDF files with ``package://`` paths, which MuJoCo does not resolve."""

from __future__ import annotations

from pathlib import Path
from xml.etree import ElementTree

from lcplab._lcplab import InputError

PACKAGE = "package://"


def has_packages(path: Path) -> bool:
    """Whether this is a URDF file with paths of packages."""
    text = path.read_bytes()
    return b"<robot" in text and PACKAGE.encode() in text


def resolved(path: Path) -> str:
    """The text of a URDF file with absolute paths of meshes.

    A package is searched in the folders above the file, as ROS lays them out.

    Raises
    ------
    InputError
        With a line for each mesh that is not found.
    """
    root = ElementTree.parse(path).getroot()
    missing = []
    # MuJoCo leaves out the meshes that are only drawn, so these need not exist.
    for mesh in root.findall("./link/collision/geometry/mesh"):
        found = _found(path, mesh.get("filename", ""))
        if found is None:
            missing.append(f"{path}: <mesh> {mesh.get('filename')!r}: the file is not in a folder above")
        else:
            mesh.set("filename", str(found))
    if missing:
        raise InputError("\n".join(dict.fromkeys(missing)))
    own = root.find("mujoco")
    extension = own if own is not None else ElementTree.SubElement(root, "mujoco")
    given = extension.find("compiler")
    compiler = given if given is not None else ElementTree.SubElement(extension, "compiler")
    compiler.set("strippath", "false")
    compiler.set("discardvisual", "true")
    return ElementTree.tostring(root, encoding="unicode")


def _found(path: Path, name: str) -> Path | None:
    """The file of a mesh: relative to the URDF file, or in its package."""
    if not name.startswith(PACKAGE):
        own = (path.parent / name.removeprefix("file://")).resolve()
        return own if own.is_file() else None
    package, _, rest = name.removeprefix(PACKAGE).partition("/")
    for folder in path.resolve().parents:
        for place in (folder / package / rest, folder / rest if folder.name == package else None):
            if place is not None and place.is_file():
                return place
    return None

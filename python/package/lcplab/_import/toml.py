"""Scenes as TOML text. Floats keep all digits."""

from __future__ import annotations

import json
from collections.abc import Mapping
from typing import Any


def text(scene: Mapping[str, Any], comments: list[str]) -> str:
    """The text of a scene file, after these comments."""
    lines = [f"# {comment}" for comment in comments]
    tables = {key: value for key, value in scene.items() if _is_table(value)}
    lines += [f"{key} = {_value(value)}" for key, value in scene.items() if key not in tables]
    for key, value in tables.items():
        for item in [value] if isinstance(value, Mapping) else value:
            lines += ["", f"[{key}]" if isinstance(value, Mapping) else f"[[{key}]]"]
            lines += [f"{name} = {_value(field)}" for name, field in item.items()]
    return "\n".join(lines) + "\n"


def _is_table(value: Any) -> bool:
    return isinstance(value, Mapping) or (isinstance(value, list) and bool(value) and isinstance(value[0], Mapping))


def _value(value: Any) -> str:
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{key} = {_value(field)}" for key, field in value.items()) + " }"
    if isinstance(value, list):
        return "[" + ", ".join(_value(item) for item in value) + "]"
    # A string of JSON is one of TOML; so are numbers and truth values, except those that are not finite.
    return json.dumps(value).replace("Infinity", "inf").replace("NaN", "nan") if not isinstance(value, str) else json.dumps(value)

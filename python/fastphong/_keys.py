"""Writes the keys of a scene as TOML, which the crate reads and checks."""

from __future__ import annotations

import json
import numbers
import operator
import re
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, SupportsFloat, SupportsIndex

import numpy as np

if TYPE_CHECKING:
    from ._types import Keys, Light, Normals, Size, Vector, View

_BARE = re.compile(r"[A-Za-z0-9_-]+")


def toml(value: object) -> str:
    """Return `value` in the notation of TOML."""
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, str):
        text("scene", value)
        return json.dumps(value, ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, Mapping):
        return "{" + ", ".join(_pair(*item) for item in value.items()) + "}"
    if isinstance(value, (Sequence, np.ndarray)) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(map(toml, value)) + "]"
    raise TypeError(f"a key of a scene cannot be {type(value).__name__}: expected what TOML has")


def _pair(key: object, value: object) -> str:
    if not isinstance(key, str):
        raise TypeError(f"a key of a scene cannot be {type(key).__name__}: expected a str")
    key = key if _BARE.fullmatch(key) else toml(key)
    return f"{key} = {toml(value)}"


def _lights(light: Any) -> list[Any]:
    """Return the lights as tables. `light` is a direction, the table of a light, or a list of these."""
    def table(one: Any) -> Any:
        return one if isinstance(one, Mapping) else {"direction": _numbers("light", one, 3)}

    if isinstance(light, Mapping):
        return [light]
    try:
        light = list(light)
    except TypeError:
        raise TypeError(f"`light` is {light!r}: expected a direction, a mapping or a list") from None
    if len(light) == 3 and all(isinstance(c, numbers.Real) for c in light):
        return [table(light)]
    return [table(one) for one in light]


def _numbers(name: str, value: Any, count: int) -> list[float]:
    """Return `count` numbers, or raise a `TypeError` or `ValueError` that names the argument."""
    try:
        found = [_number(name, c) for c in value]
    except TypeError:
        raise TypeError(f"`{name}` is {value!r}: expected {count} numbers") from None
    if len(found) != count:
        raise ValueError(f"`{name}` is {value!r}: expected {count} numbers")
    return found


def text(name: str, value: Any) -> str:
    """Return a text."""
    if not isinstance(value, str):
        raise TypeError(f"`{name}` is {value!r}: expected a str")
    try:
        value.encode()
    except UnicodeEncodeError:
        raise ValueError(f"`{name}` is {value!r}: expected text in UTF-8") from None
    return value


def _number(name: str, value: Any) -> float:
    try:
        if not isinstance(value, (str, bytes, bool, np.bool_)):
            return float(value)
    except (OverflowError, TypeError, ValueError):
        pass
    raise TypeError(f"`{name}` is {value!r}: expected a number")


def whole(name: str, value: Any) -> int:
    """Return a whole number."""
    try:
        if not isinstance(value, (bool, np.bool_)):
            number = operator.index(value)
            # Larger numbers are out of the range of every key, and too long for TOML.
            return max(-(10 ** 17), min(number, 10 ** 17))
    except TypeError:
        pass
    raise TypeError(f"`{name}` is {value!r}: expected a whole number")


def _normals(normals: Normals | None) -> dict[str, Any]:
    """Return the key of an object that says where vertex normals come from, if there is one."""
    if normals is None:
        return {}
    if not isinstance(normals, str):
        return {"crease": _number("normals", normals)}
    if not normals.startswith("crease="):
        return {"normals": normals}
    try:
        return {"crease": float(normals[len("crease="):])}
    except ValueError:
        raise ValueError(f"`normals` is {normals!r}: expected crease=DEGREES") from None


def settings(
    *,
    size: Size | None = None,
    view: View | None = None,
    up: str | Vector | None = None,
    fovy: SupportsFloat | None = None,
    light: Light | None = None,
    background: SupportsFloat | Vector | None = None,
    normals: Normals | None = None,
    weight: str | None = None,
    weld: SupportsFloat | None = None,
    colours: Any = None,
    samples: SupportsIndex | None = None,
    scene: Keys | None = None,
) -> str:
    """Return the arguments of `render` as keys of a scene, in TOML."""
    if not isinstance(scene, (Mapping, type(None))):
        raise TypeError(f"`scene` is {scene!r}: expected a mapping of keys")
    keys: dict[str, Any] = dict(scene or {})
    if "object" in keys:
        raise ValueError("`scene` has the key `object`: expected keys of the scene, as the mesh is its object")

    def put(table: str, key: str, value: Any) -> None:
        given = keys.get(table, {})
        if not isinstance(given, Mapping):
            raise TypeError(f"`scene` has {given!r} for `{table}`: expected a mapping of keys")
        keys[table] = {**given, key: value}

    if size is not None:
        try:
            width, height = size
        except (TypeError, ValueError):
            raise TypeError(f"`size` is {size!r}: expected (width, height)") from None
        put("image", "width", whole("size", width))
        put("image", "height", whole("size", height))
    if view is not None:
        if hasattr(view, "__len__") and len(view) == 2:
            azimuth, elevation = _numbers("view", view, 2)
            put("camera", "azimuth", azimuth)
            put("camera", "elevation", elevation)
        else:
            put("camera", "direction", _numbers("view", view, 3))
    if up is not None:
        put("camera", "up", up if isinstance(up, str) else _numbers("up", up, 3))
    if fovy is not None:
        put("camera", "fovy", _number("fovy", fovy))
    if light is not None:
        keys["light"] = _lights(light)
    if background is not None:
        is_colour = isinstance(background, (str, bytes)) or np.ndim(background) > 0  # type: ignore[arg-type]
        put("image", "background", (_numbers("background", background, 3) if is_colour
                                    else _number("background", background)))
        # Whoever sets a background wants to see it.
        keys["image"].setdefault("alpha", "opaque")
    if samples is not None:
        put("image", "samples", whole("samples", samples))
    if colours is not None:
        keys["colours"] = "on" if colours else "off"
    every = _normals(normals)
    if weight is not None:
        every["normals_weight"] = text("weight", weight)
    if weld is not None:
        every["weld"] = _number("weld", weld)
    if every:
        keys["object"] = [{"mesh": "", **every}]
    return "\n".join(_pair(*item) for item in keys.items())

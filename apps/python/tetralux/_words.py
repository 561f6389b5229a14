# SPDX-License-Identifier: Apache-2.0
"""Transfer functions and lights as people name them."""

from __future__ import annotations

import json
import os
from collections.abc import Mapping
from typing import Any, Optional

import numpy as np

from . import _core
from ._arrays import float_array
from ._camera import triple
from ._errors import InputError


#: Where colours are not named.
DEFAULT_COLORS = "cool-to-warm"


def transfer_function_of(function: Any) -> _core.TransferFunction:
    """Of a preset's name, a file's path, or a mapping as in the JSON file."""
    if isinstance(function, _core.TransferFunction):
        return function
    if isinstance(function, Mapping):
        return _core.TransferFunction.parse(json_of("transfer_function", function))
    if isinstance(function, (str, os.PathLike)):
        name = os.fspath(function)
        return _core.TransferFunction.preset(name) if name in _core.presets() else _core.TransferFunction.load(name)
    raise InputError(
        f"transfer_function: {type(function).__name__} will not do; give a path, a mapping as in the JSON file, "
        f"or one of {', '.join(_core.presets())}"
    )


def _color_nodes(cmap: Any) -> list[list[float]]:
    """Of a colour map as matplotlib has it, or of a list of colours, each for an equal step of the range."""
    if callable(cmap):
        steps = int(getattr(cmap, "N", 256))
        places = np.linspace(0, 1, max(2, steps))
        return [[float(s), *map(float, cmap(float(s))[:3])] for s in places]
    colors = [color_of("cmap", each) for each in cmap]
    if not colors:
        raise InputError("cmap: no colours in it; give at least one")
    ends = np.linspace(0, 1, len(colors) + 1)
    return [[float(s), *color] for i, color in enumerate(colors) for s in (ends[i], ends[i + 1])]


def _opacity(opacity: Any) -> Any:
    if isinstance(opacity, str):
        return opacity
    values = np.atleast_1d(float_array("opacity", opacity))
    if values.ndim != 1 or not values.size or not ((values >= 0) & (values <= 1)).all():
        raise InputError("opacity: give a word, or numbers from 0 to 1 at equal distances over the range")
    if values.size == 1:
        values = np.repeat(values, 2)
    return [[float(s), float(a)] for s, a in zip(np.linspace(0, 1, len(values)), values)]


def clim_of(clim: Any) -> Optional[tuple[float, float]]:
    """(lowest, highest) scalar; one number c stands for (-c, c), as in PyVista."""
    if clim is None:
        return None
    try:
        low, high = (-abs(float(clim)), abs(float(clim))) if np.ndim(clim) == 0 else (float(each) for each in clim)
    except (TypeError, ValueError):
        raise InputError(f"clim: {clim!r} will not do; give (lowest, highest) scalar") from None
    if not (np.isfinite([low, high]).all() and low <= high):
        raise InputError(f"clim: {clim!r} will not do; give two finite scalars, the lower one first")
    return low, high


def function_of_words(
    cmap: Any, opacity: Any, clim: Any, opacity_unit_distance: Any, log_scale: bool
) -> Optional[dict[str, Any]]:
    """The document of a transfer function that these words describe; None if they say nothing."""
    document: dict[str, Any] = {}
    if cmap is not None:
        document.update({"colorMap": cmap} if isinstance(cmap, str) else {"color": _color_nodes(cmap), "normalized": True})
    if opacity is not None:
        document["opacity"] = _opacity(opacity)
    if opacity_unit_distance is not None:
        document["unitDistance"] = opacity_unit_distance
    if log_scale:
        document["logScale"] = True
    if clim is not None:
        document["range"] = clim_of(clim)
    if not document:
        return None
    if "color" in document and opacity is None:
        document["opacity"] = "linear"
    if cmap is None:
        document["colorMap"] = DEFAULT_COLORS
    return document


def json_of(what: str, value: Any) -> str:
    def plain(each: Any) -> Any:
        if hasattr(each, "tolist"):
            return each.tolist()
        raise TypeError(f"{type(each).__name__} has no place in it")

    try:
        return json.dumps(value, default=plain, allow_nan=False)
    except (TypeError, ValueError) as error:
        raise InputError(f"{what}: {error}; give numbers, texts, lists and mappings") from None


def _light(light: Any) -> Any:
    if isinstance(light, Mapping):
        return light
    if isinstance(light, str):
        if light in ("head", "headlight"):
            return {"type": "head"}
        raise InputError(f"lights: there is no '{light}'; give 'headlight', a direction (x, y, z) or a mapping")
    return {"type": "directional", "towards": triple("lights", light)}


def lighting_of(lights: Any) -> str:
    """The JSON document of lights in any form: see `render`."""
    if lights is None or lights is False:
        return "{}"
    if lights is True:
        lights = "headlight"
    if isinstance(lights, Mapping):
        return json_of("lights", lights)
    if isinstance(lights, os.PathLike) or (isinstance(lights, str) and lights.endswith(".json")):
        try:
            with open(lights, encoding="utf-8") as file:
                return file.read()
        except OSError as error:
            raise InputError(f"lights: {os.fspath(lights)}: {error.strerror}; check the path") from None
    try:
        listed = [lights] if isinstance(lights, str) or _is_number(lights[0]) else list(lights)
    except (TypeError, IndexError, KeyError):
        raise InputError(f"lights: {lights!r} will not do; give 'headlight', directions or mappings") from None
    return json_of("lights", {"lights": [_light(each) for each in listed]})


def _is_number(value: Any) -> bool:
    return not isinstance(value, str) and not hasattr(value, "__len__")


def color_of(what: str, color: Any) -> tuple[float, float, float]:
    """(r, g, b) in [0, 1], "#rrggbb", or a name that matplotlib knows."""
    if isinstance(color, str):
        known = {"white": (1.0, 1.0, 1.0), "black": (0.0, 0.0, 0.0)}
        if color in known:
            return known[color]
        text = color.lstrip("#")
        try:
            if color.startswith("#") and len(text) == 6:
                return tuple(int(text[i : i + 2], 16) / 255 for i in (0, 2, 4))  # type: ignore[return-value]
            from matplotlib.colors import to_rgb

            return tuple(float(each) for each in to_rgb(color))  # type: ignore[return-value]
        except (ValueError, ImportError):
            raise InputError(f"{what}: '{color}' is no colour known here; give (r, g, b) or '#rrggbb'") from None
    red, green, blue = triple(what, color)
    if not all(0 <= each <= 1 for each in (red, green, blue)):
        raise InputError(f"{what}: {color!r} lies beyond 0 and 1; give (r, g, b) within")
    return red, green, blue

# SPDX-License-Identifier: Apache-2.0
"""Where a picture is seen from."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, Optional

import numpy as np

from . import _core
from ._errors import InputError
from ._mesh import Mesh

Triple = tuple[float, float, float]


def triple(what: str, value: Any) -> Triple:
    try:
        x, y, z = (float(each) for each in value)
    except (TypeError, ValueError):
        raise InputError(f"{what}: {value!r} will not do; give three numbers") from None
    if not np.isfinite((x, y, z)).all():
        raise InputError(f"{what}: {value!r} is not finite; give three finite numbers")
    return x, y, z


def _number(what: str, value: Any, form: str) -> float:
    try:
        return float(value)
    except (TypeError, ValueError):
        raise InputError(f"{what}: {value!r} will not do; give {form}") from None


@dataclass
class View:
    """A camera as people name it; None: what holds the mesh."""

    eye: Any = None
    target: Any = None
    up: Any = None
    fov: float = 30.0
    height: Optional[float] = None
    window_center: tuple[float, float] = (0.0, 0.0)
    view: Optional[str] = None
    zoom: float = 1.0

    def camera(self, core: _core.Renderer, mesh: Mesh, size: tuple[int, int]) -> _core.Camera:
        up = None if self.up is None else triple("up", self.up)
        fov = _number("fov", self.fov, "degrees between 0 and 180")
        if not 0 < fov < 180:
            raise InputError(f"fov: {fov} degrees; give more than 0 and less than 180")
        height = 0.0 if self.height is None else _number("height", self.height, "mesh units above 0")
        if self.height is not None and not 0 < height < np.inf:
            raise InputError(f"height: {height} mesh units; give a length above 0, or None for perspective")
        zoom = _number("zoom", self.zoom, "a number above 0")
        if not 0 < zoom < np.inf:
            raise InputError(f"zoom: {zoom}; give a number above 0")
        target = None if self.target is None else triple("target", self.target)
        if self.view is not None and not isinstance(self.view, str):
            raise InputError(f"view: {self.view!r} will not do; give a name such as 'xy' or 'iso'")
        if self.eye is None:
            eye, middle, up = core.fitted_camera(self.view, up, fov, height > 0, *size)
            if target is not None:
                eye = triple("eye", [e + (t - m) for e, t, m in zip(eye, target, middle)])
            target = target or middle
        elif self.view is not None:
            raise InputError("view: it says where from, as eye does; leave one of them out")
        else:
            eye, up = triple("eye", self.eye), up or (0.0, 1.0, 0.0)
            if target is None:
                low, high = mesh.bounds
                target = triple("target", [0.5 * a + 0.5 * b for a, b in zip(low, high)])
        return _core.Camera(eye, target, up, min(fov / zoom, 179.0), height / zoom, self.window_center)


def size_of(size: Any) -> tuple[int, int]:
    try:
        width, height = size
        if int(width) != width or int(height) != height:
            raise ValueError
    except (TypeError, ValueError):
        raise InputError(f"size: {size!r} will not do; give (width, height) in whole pixels") from None
    if not (0 < width <= 32768 and 0 < height <= 32768):
        raise InputError(f"size: {width}x{height} pixels; give 1 to 32768 each way")
    return int(width), int(height)

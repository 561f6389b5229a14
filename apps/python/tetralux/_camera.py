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


#: Where the eye stands as seen from the target, and what is up, as PyVista has them.
_VIEWS: dict[str, tuple[Triple, Triple]] = {
    "xy": ((0, 0, 1), (0, 1, 0)),
    "yx": ((0, 0, -1), (1, 0, 0)),
    "xz": ((0, -1, 0), (0, 0, 1)),
    "zx": ((0, 1, 0), (1, 0, 0)),
    "yz": ((1, 0, 0), (0, 0, 1)),
    "zy": ((-1, 0, 0), (0, 1, 0)),
    "iso": ((1, 1, 1), (0, 0, 1)),
}


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

    def camera(self, mesh: Mesh, size: tuple[int, int]) -> _core.Camera:
        towards, view_up = self._named()
        up = view_up if self.up is None else triple("up", self.up)
        fov = _number("fov", self.fov, "degrees between 0 and 180")
        if not 0 < fov < 180:
            raise InputError(f"fov: {fov} degrees; give more than 0 and less than 180")
        height = 0.0 if self.height is None else _number("height", self.height, "mesh units above 0")
        if self.height is not None and not 0 < height < np.inf:
            raise InputError(f"height: {height} mesh units; give a length above 0, or None for perspective")
        own_eye, own_target = (0.0, 0.0, 1.0), (0.0, 0.0, 0.0)
        if self.eye is None or self.target is None:
            like = _core.Camera(own_eye, own_target, up, fov, height, self.window_center)
            own_eye, own_target = _core.camera_holding(mesh._core, *size, like)
            if towards is not None:
                own_eye = _towards(own_eye, own_target, towards)
        zoom = _number("zoom", self.zoom, "a number above 0")
        if not 0 < zoom < np.inf:
            raise InputError(f"zoom: {zoom}; give a number above 0")
        fov, height = min(fov / zoom, 179.0), height / zoom
        eye = own_eye if self.eye is None else triple("eye", self.eye)
        target = own_target if self.target is None else triple("target", self.target)
        return _core.Camera(eye, target, up, fov, height, self.window_center)

    def _named(self) -> tuple[Optional[Triple], Triple]:
        """Direction towards the eye, and up, of the view's name."""
        if self.view is None:
            return None, (0.0, 1.0, 0.0)
        if not isinstance(self.view, str) or self.view not in _VIEWS:
            raise InputError(f"view: there is no {self.view!r}; take one of {', '.join(_VIEWS)}")
        return _VIEWS[self.view]


def _towards(eye: Any, target: Any, direction: Triple) -> Triple:
    """An eye as far away in another direction."""
    distance = np.linalg.norm(np.subtract(eye, target)) / np.linalg.norm(direction)
    x, y, z = np.add(target, distance * np.asarray(direction, float))
    return float(x), float(y), float(z)


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

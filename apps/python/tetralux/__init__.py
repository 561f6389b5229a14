# SPDX-License-Identifier: Apache-2.0
"""Volume rendering of scalar fields on unstructured meshes, exact and fast.

>>> import tetralux
>>> image = tetralux.render("bucky:16", size=(64, 48))
>>> image.rgba.shape
(48, 64, 4)
"""

from __future__ import annotations

from . import _core
from ._errors import CancelledError, Error, FieldError, InputError, UnsupportedError
from ._explore import explore
from ._image import Image
from ._mesh import Mesh, read
from ._renderer import Renderer, render

__version__ = "0.1.0"
__all__ = [
    "CancelledError",
    "Error",
    "FieldError",
    "Image",
    "InputError",
    "Mesh",
    "Renderer",
    "UnsupportedError",
    "color_maps",
    "engines",
    "explore",
    "presets",
    "read",
    "render",
]


def engines() -> list[tuple[str, bool, str]]:
    """(name, whether this machine can run it, why not) of each engine."""
    return list(_core.engines())


def presets() -> list[str]:
    """Names of the transfer functions that come along, which are those of colour maps too."""
    return list(_core.presets())


def color_maps() -> list[str]:
    """Names that ``cmap`` takes; "_r" at the end of any reverses it."""
    return list(_core.color_maps())

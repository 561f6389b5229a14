# SPDX-License-Identifier: Apache-2.0
"""Pictures as numpy arrays."""

from __future__ import annotations

import os
from typing import Any, Optional, Union

import numpy as np
import numpy.typing as npt

from . import _core


class Image:
    """A picture: linear RGBA, premultiplied by alpha, the top row first.

    ``np.asarray(image)`` is `rgba` itself; ``ax.imshow(image)`` shows it right way up, a notebook by itself.
    """

    def __init__(self, rgba: npt.NDArray[np.float32], report: Optional[dict[str, Any]] = None) -> None:
        #: (height, width, 4) float32.
        self.rgba = rgba
        #: How it came about: field, range, engine, milliseconds, cells drawn and skipped, pixels repaired.
        self.report: dict[str, Any] = report or {}

    @property
    def size(self) -> tuple[int, int]:
        """(width, height), pixels."""
        return self.rgba.shape[1], self.rgba.shape[0]

    def __array__(self, dtype: Any = None, copy: Optional[bool] = None) -> npt.NDArray[Any]:
        if dtype is None or np.dtype(dtype) == self.rgba.dtype:
            return self.rgba.copy() if copy else self.rgba
        if copy is False:
            raise ValueError("an array of another type is a copy; leave copy out")
        return self.rgba.astype(dtype)

    def to_uint8(self, *, alpha: bool = False) -> npt.NDArray[np.uint8]:
        """(height, width, 3) bytes over black, those of the PNG; with ``alpha`` (height, width, 4), not premultiplied."""
        values = self.rgba if alpha else self.rgba[..., :3]
        if alpha:
            values = values.copy()
            opacity = values[..., 3:]
            np.divide(values[..., :3], opacity, out=values[..., :3], where=opacity > 0)
        scaled = np.clip(values, np.float32(0), np.float32(1)) * np.float32(255)
        return np.floor(scaled.astype(np.float64) + 0.5).astype(np.uint8)

    def over(self, background: Any) -> Image:
        """The picture over a colour (r, g, b), opaque."""
        color = np.asarray(background, np.float32)
        rgba = np.ones_like(self.rgba)
        rgba[..., :3] = self.rgba[..., :3] + (np.float32(1) - self.rgba[..., 3:]) * color
        return Image(rgba, self.report)

    def save(self, path: Union[str, os.PathLike[str]]) -> None:
        """Writes .png (8 bits, over black where it is not opaque) or .exr (32-bit float RGBA), whole or not at all."""
        _core.write_image(self.rgba, os.fspath(path))

    def _repr_png_(self) -> bytes:
        return _core.encode_png(self.rgba)

    def __repr__(self) -> str:
        return f"<tetralux.Image: {self.size[0]}x{self.size[1]}>"

# SPDX-License-Identifier: Apache-2.0
"""Sliders about a still, in a notebook."""

from __future__ import annotations

import asyncio
import importlib
from typing import Any

import numpy as np

from . import _core
from ._camera import size_of
from ._errors import UnsupportedError
from ._fields import choose
from ._mesh import Source
from ._renderer import Renderer

_COARSE = 3  # each way so many times fewer pixels while something moves
_PAUSE = 0.25  # seconds without a move until the whole picture is drawn
_BINS = 128


def explore(mesh: Source, scalars: Any = None, *, size: tuple[int, int] = (640, 480), **options: Any) -> Any:
    """A picture with sliders for camera and transfer function, as a widget of ipywidgets.

    Where ipyevents is installed too the mouse turns the picture and its wheel zooms. While something moves the picture
    is coarse. ``options`` are those of `Renderer`; ``widget.explorer.renderer`` is the Renderer.

    Raises
    ------
    tetralux.UnsupportedError
        Where ipywidgets is not installed.
    """
    try:
        widgets = importlib.import_module("ipywidgets")
    except ImportError:
        raise UnsupportedError("explore: ipywidgets is not installed; pip install ipywidgets, or use render") from None
    return Explorer(Renderer(mesh, scalars, size=size, **options), widgets).box


class Explorer:
    """What moves a picture: sliders, and the mouse where it is heard."""

    def __init__(self, renderer: Renderer, widgets: Any) -> None:
        self.renderer = renderer
        values = choose(renderer.mesh, renderer.scalars).values
        finite = values[np.isfinite(values)]
        low, high = float(finite.min()), float(finite.max())
        self._direction_of_mesh()
        self.image = widgets.Image(format="png", width=renderer.size[0], height=renderer.size[1])
        slider: dict[str, Any] = {"continuous_update": True, "readout_format": ".3g"}
        self.azimuth = widgets.FloatSlider(value=34, min=-180, max=180, description="azimuth", **slider)
        self.elevation = widgets.FloatSlider(value=21, min=-89, max=89, description="elevation", **slider)
        self.zoom = widgets.FloatLogSlider(value=1, base=10, min=-1, max=1.5, description="zoom", **slider)
        self.cmap = widgets.Dropdown(options=_core.presets(), value="viridis", description="cmap")
        self.opacity = widgets.Dropdown(
            options=["suggested", "linear", "linear_r", "geom", "sigmoid", "sigmoid_5", "foreground"], description="opacity"
        )
        self.distance = widgets.FloatLogSlider(
            value=renderer.mesh.length / 50, base=10, min=np.log10(renderer.mesh.length) - 4,
            max=np.log10(renderer.mesh.length) + 1, description="distance", **slider,
        )
        self.clim = widgets.FloatRangeSlider(
            value=(low, high), min=low, max=high, step=(high - low or 1) / 200, description="clim", **slider
        )
        self.histogram = widgets.HTML(value=_histogram(finite, low, high))
        controls = [self.azimuth, self.elevation, self.zoom, self.cmap, self.opacity, self.distance, self.clim]
        for control in controls:
            control.observe(self._moved, "value")
        self.box = widgets.HBox([self.image, widgets.VBox([*controls, self.histogram])])
        self.box.explorer = self
        self._later: Any = None
        self._listen()
        self.draw()

    def _direction_of_mesh(self) -> None:
        low, high = (np.array(each) for each in self.renderer.mesh.bounds)
        self._target = 0.5 * (low + high)
        like = _core.Camera((0, 0, 1), (0, 0, 0), (0, 1, 0), self.renderer.fov, 0.0, (0.0, 0.0))
        eye, _ = _core.camera_holding(self.renderer.mesh._core, *size_of(self.renderer.size), like)
        self._distance = float(np.linalg.norm(np.array(eye) - self._target))

    def _listen(self) -> None:
        """The mouse, where ipyevents is there to tell of it."""
        try:
            events = importlib.import_module("ipyevents")
        except ImportError:
            return
        heard = ["dragstart", "mousedown", "mousemove", "mouseup", "wheel"]
        self._events = events.Event(source=self.image, watched_events=heard, prevent_default_action=True)
        self._events.on_dom_event(self.mouse)

    def mouse(self, event: dict[str, Any]) -> None:
        """What ipyevents tells: with a button down the picture turns, the wheel zooms."""
        if event["type"] == "wheel":
            self.zoom.value = float(np.clip(self.zoom.value * (0.9 if event["deltaY"] > 0 else 1 / 0.9), 0.1, 30))
        elif event["type"] == "mousemove" and event.get("buttons", 0):
            turn = event.get("movementX", 0) * 0.4
            self.azimuth.value = (self.azimuth.value - turn + 180) % 360 - 180
            self.elevation.value = float(np.clip(self.elevation.value + event.get("movementY", 0) * 0.4, -89, 89))

    def _moved(self, _: Any) -> None:
        """Coarse at once, whole after a pause: where the kernel has a loop that can wait."""
        if self._later is not None:
            self._later.cancel()
            self._later = None
        try:
            loop = asyncio.get_running_loop()
        except RuntimeError:
            self.draw()
            return
        self.draw(_COARSE)
        self._later = loop.call_later(_PAUSE, self.draw)

    def draw(self, coarse: int = 1) -> None:
        """Draws the picture with what the sliders say."""
        renderer = self.renderer
        if renderer.transfer_function is None:
            named = self.opacity.value != "suggested"
            renderer.cmap = self.cmap.value
            renderer.opacity = self.opacity.value if named else None
            renderer.opacity_unit_distance = self.distance.value if named else None
            renderer.clim = tuple(self.clim.value)
        azimuth, elevation = np.radians([self.azimuth.value, self.elevation.value])
        direction = np.array(
            [np.cos(elevation) * np.sin(azimuth), np.sin(elevation), np.cos(elevation) * np.cos(azimuth)]
        )
        image = renderer.render(
            size=tuple(max(1, side // coarse) for side in renderer.size),
            eye=self._target + self._distance * direction,
            target=self._target,
            fov=float(np.clip(renderer.fov / self.zoom.value, 0.01, 170)),
        )
        self.image.value = image._repr_png_()


def _histogram(values: Any, low: float, high: float) -> str:
    """An SVG of how often scalars are, by the square root, so that rare ones show."""
    counts, _ = np.histogram(values, _BINS, (low, high) if high > low else (low, low + 1))
    heights = np.sqrt(counts / max(1, counts.max())) * 60
    bars = "".join(f'<rect x="{2 * i}" y="{60 - h:.1f}" width="2" height="{h:.1f}"/>' for i, h in enumerate(heights))
    return f'<svg width="{2 * _BINS}" height="60" fill="#557">{bars}</svg><br>{low:.4g} … {high:.4g}'

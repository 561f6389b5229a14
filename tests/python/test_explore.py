# SPDX-License-Identifier: Apache-2.0
"""The widget for notebooks."""

from __future__ import annotations

import asyncio
import subprocess
import sys

import pytest

import tetralux

pytest.importorskip("ipywidgets")


def test_sliders_draw(bucky):
    box = tetralux.explore(bucky, size=(64, 48))
    explorer = box.explorer
    seen = {explorer.image.value}
    assert explorer.image.value[1:4] == b"PNG"
    for change in (
        lambda: setattr(explorer.azimuth, "value", 90),
        lambda: setattr(explorer.zoom, "value", 2),
        lambda: setattr(explorer.cmap, "value", "turbo"),
        lambda: setattr(explorer.opacity, "value", "linear"),
        lambda: setattr(explorer.distance, "value", 0.3),
        lambda: setattr(explorer.clim, "value", (0.1, 0.4)),
        lambda: explorer.mouse({"type": "mousemove", "buttons": 1, "movementX": 30, "movementY": 9}),
        lambda: explorer.mouse({"type": "wheel", "deltaY": -1}),
    ):
        change()
        seen.add(explorer.image.value)
    assert len(seen) == 9
    assert "<svg" in explorer.histogram.value


def test_coarse_while_moving(bucky):
    explorer = tetralux.explore(bucky, size=(90, 60)).explorer

    async def move():
        explorer.azimuth.value = 10
        coarse = explorer.image.value
        await asyncio.sleep(1)
        return coarse

    coarse = asyncio.run(move())
    assert len(coarse) < len(explorer.image.value)


def test_without_ipywidgets():
    code = (
        "import sys; sys.modules['ipywidgets'] = None\nimport tetralux\n"
        "try: tetralux.explore('bucky:8')\nexcept tetralux.UnsupportedError as error: print(error)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True)
    assert "pip install ipywidgets" in done.stdout

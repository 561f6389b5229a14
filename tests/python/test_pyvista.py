# SPDX-License-Identifier: Apache-2.0
"""Volumes among the actors of a PyVista plotter, against the reference with the same surfaces."""

from __future__ import annotations

import numpy as np
import pytest

import tetralux

pyvista = pytest.importorskip("pyvista", minversion="0.48")

CENTRE = np.array([0.5, 0.5, 0.5])
CAMERAS = {
    "front": ((0.5, 0.5, 3.2), (0, 1, 0)),
    "corner": ((2.4, 2.1, 2.7), (0, 1, 0)),
    "below": ((0.9, -2.3, 0.2), (0, 0, 1)),
    "tilted": ((-1.8, 1.4, 1.1), (0.3, 1, 0.4)),
    "near": ((1.25, 1.1, 1.2), (0, 1, 0)),
}
FUNCTION = {
    "normalized": True,
    "color": [[0, 0.1, 0.3, 0.9], [0.5, 0.9, 0.9, 0.3], [1, 0.9, 0.1, 0.1]],
    "extinction": [[0, 0.5], [1, 4]],
}
SPHERE = pyvista.Sphere(radius=0.35, center=(0.9, 0.55, 0.6), theta_resolution=24, phi_resolution=24)
SPHERE_COLOR = (1.0, 0.5, 0.2)
BACKGROUND = (0.2, 0.3, 0.4)


def plotter_of(mesh, size=(220, 180), **options):
    plotter = pyvista.Plotter(off_screen=True, window_size=size)
    plotter.disable_anti_aliasing()
    plotter.set_background(BACKGROUND)
    plotter.add_mesh(SPHERE, color=SPHERE_COLOR, lighting=False)
    plotter.tetralux.add_volume(mesh, transfer_function=FUNCTION, show_scalar_bar=False, **options)
    return plotter


def aim(plotter, name, parallel):
    position, up = CAMERAS[name]
    plotter.camera_position = [position, CENTRE, up]
    plotter.camera.view_angle = 30
    plotter.camera.parallel_projection = parallel
    plotter.camera.parallel_scale = 0.8


def reference(mesh, size, name, parallel):
    position, up = CAMERAS[name]
    surface = {"points": SPHERE.points, "triangles": SPHERE.regular_faces, "color": SPHERE_COLOR, "flat": True}
    view = {"eye": position, "target": CENTRE, "up": up, "fov": 30, "height": 1.6 if parallel else None}
    common = {"transfer_function": FUNCTION, "size": size, "background": BACKGROUND, "engine": "reference"}
    with_sphere = tetralux.render(mesh, surfaces=[surface], **view, **common)
    return with_sphere.rgba[..., :3]


def assert_near(screen, right):
    """Within 2/255 wherever both see the same triangles: a pixel through whose middle an outline goes may differ."""
    difference = np.abs(screen[..., :3].astype(float) - 255 * right).max(axis=2)
    edge = (difference > 2).sum()
    assert edge <= max(3, 0.001 * difference.size), (edge, difference.max())
    assert np.median(difference) < 1


@pytest.mark.parametrize("parallel", [False, True], ids=["perspective", "orthographic"])
@pytest.mark.parametrize("camera", CAMERAS)
def test_a_sphere_half_inside(bucky, camera, parallel):
    plotter = plotter_of(bucky)
    aim(plotter, camera, parallel)
    screen = plotter.screenshot()
    plotter.close()
    assert_near(screen, reference(bucky, (220, 180), camera, parallel))


def test_other_window_sizes(bucky):
    plotter = plotter_of(bucky)
    aim(plotter, "corner", False)
    plotter.screenshot()
    for size in ((160, 220), (300, 120)):
        plotter.window_size = size
        assert_near(plotter.screenshot(), reference(bucky, size, "corner", False))
    plotter.close()


def test_without_opaque_actors_and_the_camera_holds_the_volume(bucky):
    plotter = pyvista.Plotter(off_screen=True, window_size=(120, 100))
    plotter.set_background("black")
    plotter.tetralux.add_volume(bucky, show_scalar_bar=False)
    screen = plotter.screenshot()
    low, high = bucky.bounds
    assert np.allclose(plotter.bounds, [low[0], high[0], low[1], high[1], low[2], high[2]])
    plotter.close()
    seen = screen.max(axis=2) > 4
    assert seen.sum() > 800 and not seen[0].any() and not seen[:, 0].any()


def test_renderer_may_be_changed_and_volume_removed(bucky):
    plotter = pyvista.Plotter(off_screen=True, window_size=(120, 100))
    plotter.set_background("black")
    volume = plotter.tetralux.add_volume(bucky, show_scalar_bar=False)
    first = plotter.screenshot()
    volume.renderer.transfer_function = "turbo"
    plotter.render()
    assert np.abs(plotter.screenshot().astype(int) - first).max() > 20
    volume.visible = False
    plotter.render()
    assert plotter.screenshot().max() == 0
    volume.visible = True
    volume.remove()
    plotter.render()
    assert plotter.screenshot().max() == 0
    plotter.close()


def test_scalar_bar_and_words(bucky):
    plotter = pyvista.Plotter(off_screen=True, window_size=(300, 200))
    plotter.tetralux.add_volume(bucky, cmap="viridis", opacity="linear", clim=(0, 1), shade=True, blending="maximum")
    assert len(plotter.scalar_bars) == 1
    assert plotter.screenshot().std() > 5
    with pytest.raises(ValueError, match="blending"):
        plotter.tetralux.add_volume(bucky, blending="nice")
    plotter.close()


def test_subplots_and_movies(bucky, tmp_path):
    pytest.importorskip("imageio")
    plotter = pyvista.Plotter(off_screen=True, window_size=(200, 100), shape=(1, 2), border=False)
    for column in (0, 1):
        plotter.subplot(0, column)
        plotter.set_background("black")
        plotter.add_mesh(SPHERE, color=SPHERE_COLOR)
        plotter.tetralux.add_volume(bucky, show_scalar_bar=False)
    plotter.link_views()
    screen = plotter.screenshot().astype(int)
    assert np.abs(screen[:, :100] - screen[:, 100:]).max() <= 3 and screen.max() > 100
    plotter.open_gif(str(tmp_path / "turn.gif"))
    for _ in range(3):
        plotter.camera.azimuth += 20
        plotter.write_frame()
    plotter.close()
    assert (tmp_path / "turn.gif").stat().st_size > 2000


def test_anti_aliasing_of_pyvista(bucky):
    for kind in ("ssaa", "msaa", "fxaa"):
        plotter = plotter_of(bucky)
        plotter.enable_anti_aliasing(kind)
        aim(plotter, "corner", False)
        screen = plotter.screenshot().astype(float)
        plotter.close()
        right = 255 * reference(bucky, (220, 180), "corner", False)
        assert np.percentile(np.abs(screen[..., :3] - right).max(axis=2), 90) <= 3, kind


def test_a_closed_plotter_lets_go(bucky):
    import gc
    import weakref

    plotter = plotter_of(bucky)
    plotter.screenshot()
    renderers = [weakref.ref(volume.renderer) for scene in plotter.tetralux._scenes.values() for volume in scene.volumes]
    assert renderers
    plotter.close()
    del plotter
    gc.collect()
    assert all(each() is None for each in renderers)

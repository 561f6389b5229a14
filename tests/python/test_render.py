# SPDX-License-Identifier: Apache-2.0
"""Pictures: those of the command line to the bit, and what Renderer keeps."""

from __future__ import annotations

import json
import subprocess

import numpy as np
import pytest

import tetralux

SIZE = (160, 120)
FUNCTION = {
    "normalized": True,
    "color": [[0, 0.1, 0.2, 0.6], [0.6, 1, 0.8, 0.4], [1, 0.9, 0.2, 0.05]],
    "extinction": [[0, 0], [0.3, 1], [1, 40]],
    "isosurfaces": [{"value": 0.63, "opacity": 0.95, "color": [1, 0.5, 0.1]}],
}
EYE = (1.9, 1.4, 2.3)

# what render is told, and what the program is
SCENES = {
    "nothing said": ({}, []),
    "preset": ({"transfer_function": "viridis"}, ["--tf", "viridis"]),
    "function": ({"transfer_function": FUNCTION}, ["--tf", "FUNCTION"]),
    "camera": (
        {"eye": EYE, "target": (0.4, 0.5, 0.6), "up": (0, 1, 0.2), "fov": 24.0},
        ["--eye", "1.9,1.4,2.3", "--target", "0.4,0.5,0.6", "--up", "0,1,0.2", "--fov", "24"],
    ),
    "view by name": ({"view": "iso", "zoom": 1.3}, "--view iso --zoom 1.3".split()),
    "side, orthographic": ({"view": "xz", "height": 1.7}, "--view xz --height 1.7".split()),
    "target alone": ({"target": (0.4, 0.5, 0.7), "up": (1, 0.7, 1.5)}, "--target 0.4,0.5,0.7 --up 1,0.7,1.5".split()),
    "orthographic": ({"height": 1.7}, ["--height", "1.7"]),
    "scale-invariant, silhouettes, light": (
        {
            "transfer_function": FUNCTION,
            "mode": "scale-invariant",
            "silhouette": True,
            "lights": {"lights": [{"type": "directional", "towards": [1, 2, 2]}], "ambient": 0.3, "exponent": 24},
        },
        "--tf FUNCTION --mode scale-invariant --silhouette --light 1,2,2 --ambient 0.3 --exponent 24".split(),
    ),
    "headlight and a direction": ({"lights": [(1, 0, 3), "headlight"]}, ["--headlight", "--light", "1,0,3"]),
    "maximum": ({"mode": "mip"}, ["--mode", "mip"]),
    "absorption": ({"mode": "absorption"}, ["--mode", "absorption"]),
    "samples": ({"samples": 4}, ["--samples", "4"]),
    "background": ({"background": (0.2, 0.4, 1)}, ["--background", "0.2,0.4,1"]),
    "clip": ({"clip": [((0.5, 0.5, 0.5), (1, 0.2, 0))]}, ["--clip-plane", "0.5,0.5,0.5,1,0.2,0"]),
    "words": (
        {"cmap": "viridis", "opacity": "sigmoid_5", "clim": (0.2, 0.8), "opacity_unit_distance": 0.05},
        "--tf viridis --opacity sigmoid_5 --range 0.2,0.8 --opacity-distance 0.05".split(),
    ),
    "a list of opacities": (
        {"cmap": "Turbo_r", "opacity": [0, 0.3, 0.1]},
        ["--tf", "OPACITIES"],
    ),
    "logarithm": ({"cmap": "inferno", "log_scale": True, "clim": (0.01, 1)}, "--tf inferno --log --range 0.01,1".split()),
    "range alone": ({"clim": (0.2, 0.6)}, ["--range", "0.2,0.6"]),
    "function over a range": ({"transfer_function": FUNCTION, "clim": (0, 2)}, "--tf FUNCTION --range 0,2".split()),
    "colours alone": ({"cmap": "coolwarm"}, ["--tf", "coolwarm"]),
    "reference": ({"engine": "reference", "transfer_function": "turbo"}, ["--engine", "reference", "--tf", "turbo"]),
    "one thread": ({"threads": 1}, ["--threads", "1"]),
}


@pytest.mark.parametrize("scene", SCENES)
def test_equals_the_program_to_the_bit(scene, bucky, drawn_by_program, tmp_path):
    options, arguments = SCENES[scene]
    file = tmp_path / "function.json"
    file.write_text(json.dumps(FUNCTION))
    opacities = tmp_path / "opacities.json"
    opacities.write_text('{"colorMap": "turbo_r", "opacity": [[0, 0], [0.5, 0.3], [1, 0.1]]}')
    files = {"FUNCTION": str(file), "OPACITIES": str(opacities)}
    arguments = [files.get(each, each) for each in arguments]
    size = (60, 45) if scene == "reference" else SIZE
    drawn = drawn_by_program("bucky:16", "--size", f"{size[0]}x{size[1]}", *arguments)
    image = tetralux.render(bucky, size=size, **options)
    assert drawn[..., 3].max() > 0.05
    np.testing.assert_array_equal(image.rgba, drawn)


def test_files_equal_those_of_the_program(bucky, program, tmp_path):
    subprocess.run([program, "render", "bucky:16", "--size", "64x48", "-o", tmp_path / "a.png", "--quiet"], check=True)
    image = tetralux.render(bucky, size=(64, 48))
    image.save(tmp_path / "b.png")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()
    assert image._repr_png_() == (tmp_path / "b.png").read_bytes()


def test_arrays_give_what_the_file_gives(bucky):
    points, cells = bucky.tetrahedra
    own = tetralux.Mesh(points, cells.astype(np.int64), point_data={"value": np.asarray(bucky[next(iter(bucky.point_data))])})
    np.testing.assert_array_equal(tetralux.render(own, size=SIZE).rgba, tetralux.render(bucky, size=SIZE).rgba)


def test_image(bucky, tmp_path):
    image = tetralux.render(bucky, size=(40, 30), transfer_function="turbo")
    assert image.rgba.shape == (30, 40, 4) and image.rgba.dtype == np.float32
    assert np.asarray(image) is image.rgba
    assert np.array(image, dtype=float).dtype == float
    assert image.size == (40, 30)
    assert image.to_uint8().shape == (30, 40, 3) and image.to_uint8(alpha=True).shape == (30, 40, 4)
    assert image.report["engine"] == "cpu" and image.report["milliseconds"] > 0
    pillow = pytest.importorskip("PIL.Image")
    image.save(tmp_path / "a.png")
    np.testing.assert_array_equal(np.asarray(pillow.open(tmp_path / "a.png").convert("RGB")), image.to_uint8())
    with pytest.raises(ValueError, match="png"):
        image.save(tmp_path / "a.gif")


def test_image_in_matplotlib(bucky):
    pyplot = pytest.importorskip("matplotlib.pyplot")
    pyplot.switch_backend("agg")
    image = tetralux.render(bucky, size=(40, 30), background=(1, 1, 1))
    shown = pyplot.imshow(image)
    assert shown.get_array().shape == (30, 40, 4)
    pyplot.close("all")


def test_renderer_keeps_and_changes(bucky):
    renderer = tetralux.Renderer(bucky, size=SIZE)
    first = renderer.render()
    renderer.transfer_function = "turbo"
    renderer.mode = "scale-invariant"
    renderer.lights = "headlight"
    changed = renderer.render(eye=EYE)
    fresh = tetralux.render(bucky, size=SIZE, transfer_function="turbo", mode="scale-invariant", lights="headlight", eye=EYE)
    np.testing.assert_array_equal(changed.rgba, fresh.rgba)
    renderer.transfer_function = renderer.lights = None
    renderer.mode = "standard"
    np.testing.assert_array_equal(renderer.render().rgba, first.rgba)


def test_a_field_of_ones_own(bucky):
    renderer = tetralux.Renderer(bucky, bucky.points[:, 1], size=SIZE)
    np.testing.assert_array_equal(renderer.render().rgba, tetralux.render(bucky, "y", size=SIZE).rgba)
    values = np.array(bucky.points[:, 0])
    renderer.scalars = values
    np.testing.assert_array_equal(renderer.render().rgba, tetralux.render(bucky, "x", size=SIZE).rgba)


def test_colour_maps_of_matplotlib_and_lists(bucky):
    matplotlib = pytest.importorskip("matplotlib")
    by_name = tetralux.render(bucky, cmap="viridis", opacity="linear", size=SIZE)
    by_map = tetralux.render(bucky, cmap=matplotlib.colormaps["viridis"], opacity=[0, 1], size=SIZE)
    np.testing.assert_allclose(by_map.rgba, by_name.rgba, atol=0.01)
    red = tetralux.render(bucky, cmap=[(1, 0, 0)], size=SIZE).rgba
    assert red[..., 0].max() > 0.3 and red[..., 1:3].max() == 0
    with pytest.raises(ValueError, match="leave it out"):
        tetralux.render(bucky, transfer_function=FUNCTION, cmap="viridis", size=SIZE)


def test_views_by_name_and_zoom(bucky):
    def seen(**view):
        return tetralux.render(bucky, "x", size=(60, 60), transfer_function="grayscale", **view).rgba

    right, top = seen(view="yz"), seen(view="xy")
    side = seen(view="xz")
    # x grows to the right when seen along z or y, and towards the eye along x
    assert top[20:40, 38:44, 0].mean() > 1.5 * top[20:40, 16:22, 0].mean()
    assert side[20:40, 38:44, 0].mean() > 1.5 * side[20:40, 16:22, 0].mean()
    np.testing.assert_allclose(right[20:40, 20:40].mean(axis=1), right[20:40, 20:40][::-1].mean(axis=1), atol=0.05)
    assert not np.array_equal(seen(view="iso"), seen())
    assert (seen(view="xy", zoom=0.5)[..., 3] > 0).sum() < 0.5 * (top[..., 3] > 0).sum()
    assert (seen(view="xy", height=4, zoom=2)[..., 3] > 0).sum() > 2 * (seen(view="xy", height=4)[..., 3] > 0).sum()


def test_verify_and_probe(bucky):
    renderer = tetralux.Renderer(bucky, size=SIZE)
    with pytest.raises(ValueError, match="render one first"):
        renderer.verify()
    image = renderer.render()
    found = renderer.verify(500)
    assert found["pixels"] == 500 and 0 <= found["rmse"] < 1e-6 and found["rmse"] <= found["bound95"]
    y, x = np.argwhere(image.rgba[..., 3] == image.rgba[..., 3].max())[0]
    probe = renderer.probe(x, y)
    assert probe["hit"] and probe["segments"] and probe["distance"] > 0


def test_depth_limit_ends_the_volume(bucky):
    renderer = tetralux.Renderer(bucky, size=SIZE)
    whole = renderer.render()
    limit = np.full((SIZE[1], SIZE[0]), np.inf)
    # with limits another kernel draws: a float's last digits may differ
    np.testing.assert_allclose(renderer.render(depth_limit=limit).rgba, whole.rgba, atol=2e-6)
    limit[:, : SIZE[0] // 2] = 0
    half = renderer.render(depth_limit=limit)
    assert half.rgba[:, : SIZE[0] // 2].max() == 0
    np.testing.assert_allclose(half.rgba[:, SIZE[0] // 2 :], whole.rgba[:, SIZE[0] // 2 :], atol=2e-6)


def test_progress(bucky):
    told = []
    tetralux.render(bucky, size=SIZE, progress=told.append)
    assert told[0] == 0 and told[-1] == 1 and told == sorted(told)

    def refuse(share):
        raise LookupError("enough")

    with pytest.raises(LookupError, match="enough"):
        tetralux.render(bucky, size=SIZE, progress=refuse)


def test_progress_cannot_draw_with_its_own_renderer(bucky):
    renderer = tetralux.Renderer(bucky, size=SIZE)
    with pytest.raises(ValueError, match="take another renderer"):
        renderer.render(progress=lambda share: renderer.render())
    assert renderer.render().rgba[..., 3].max() > 0


def test_engines_and_presets():
    names = [name for name, available, why in tetralux.engines()]
    assert names[0] == "cpu" and "reference" in names
    assert "viridis" in tetralux.presets()


def test_fields_by_name(bucky):
    points, cells = bucky.tetrahedra
    vector = np.stack([points[:, 0], points[:, 1] ** 2, points[:, 2]], axis=1)
    mesh = tetralux.Mesh(points, cells, point_data={"velocity": vector, "T": points[:, 2]}, cell_data={"T": np.arange(len(cells))})
    mesh.component_names["velocity"] = ["u", "v", "w"]
    same = [("velocity:y", "velocity:v"), ("velocity:1", "velocity:v"), ("T", "T@points"), (points[:, 2], "T")]
    for a, b in same:
        np.testing.assert_array_equal(tetralux.render(mesh, a, size=(32, 24)).rgba, tetralux.render(mesh, b, size=(32, 24)).rgba)
    assert tetralux.render(mesh, size=(8, 8)).report["field"] == "velocity (magnitude)"
    assert tetralux.render(mesh, "T@cells", size=(8, 8)).report["field"] == "T"
    with pytest.raises(KeyError, match="did you mean 'velocity'"):
        tetralux.render(mesh, "velocty", size=(8, 8))
    with pytest.raises(KeyError, match="no component"):
        tetralux.render(mesh, "velocity:q", size=(8, 8))

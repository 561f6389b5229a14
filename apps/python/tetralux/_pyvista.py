# SPDX-License-Identifier: Apache-2.0
"""``dataset.tetralux`` and ``plotter.tetralux``: what PyVista finds by the package's entry points."""

from __future__ import annotations

from typing import Any, Optional

import pyvista

from ._datasets import mesh_of
from ._errors import InputError
from ._fields import choose
from ._image import Image
from ._mesh import Mesh
from ._renderer import Renderer
from ._vtk_scene import SceneVolumes, Volume

#: PyVista's word for how a volume is blended → mode.
_BLENDING = {
    "composite": "standard",
    "maximum": "mip",
    "minimum": "minimum",
    "average": "average",
    "additive": "additive",
}


class DatasetAccessor:
    """``dataset.tetralux``: pictures of any dataset or MultiBlock with cells that have a volume."""

    def __init__(self, dataset: Any) -> None:
        self._dataset = dataset
        self._made: Optional[tuple[int, Mesh]] = None

    @property
    def mesh(self) -> Mesh:
        """The dataset as a tetralux.Mesh, made again when the dataset has changed; arrays are shared where they fit."""
        changed = self._dataset.GetMTime()
        if self._made is None or self._made[0] != changed:
            mesh = mesh_of(self._dataset)
            if mesh is None:
                raise InputError("mesh: the dataset has no cells; give one with cells that have a volume")
            self._made = changed, mesh
        return self._made[1]

    def render(self, scalars: Any = None, **options: Any) -> Image:
        """`tetralux.render` of this dataset; its active scalars where none are named."""
        progress = options.pop("progress", None)
        return self.renderer(scalars, **options).render(progress=progress)

    def renderer(self, scalars: Any = None, **options: Any) -> Renderer:
        """`tetralux.Renderer` of this dataset."""
        return Renderer(self.mesh, scalars, **options)


class PlotterComponent:
    """``plotter.tetralux``: volumes among a plotter's other actors."""

    def __init__(self, plotter: Any) -> None:
        self._plotter = plotter
        self._scenes: dict[Any, SceneVolumes] = {}

    def add_volume(
        self,
        mesh: Any,
        scalars: Any = None,
        *,
        clim: Any = None,
        cmap: Any = None,
        opacity: Any = None,
        opacity_unit_distance: Optional[float] = None,
        log_scale: bool = False,
        transfer_function: Any = None,
        blending: str = "composite",
        shade: bool = False,
        show_scalar_bar: bool = True,
        scalar_bar_args: Optional[dict[str, Any]] = None,
        reset_camera: Optional[bool] = None,
        **options: Any,
    ) -> Volume:
        """Draws a volume with the plotter's camera, in front of and behind its other actors as depth says.

        Words are those of ``Plotter.add_volume``: ``clim``, ``cmap``, ``opacity`` (α over ``opacity_unit_distance``,
        mesh units, 1/50 of the diagonal where nothing is said), ``log_scale``, ``shade`` (a light at the eye),
        ``blending`` ("composite", "maximum", "minimum", "average", "additive"), ``show_scalar_bar``,
        ``scalar_bar_args``. ``transfer_function`` and other ``options`` are those of `tetralux.render`.

        Opaque actors and the volume hide each other as depth says. Translucent actors and several volumes lie over each
        other in the order in which they were added.

        Returns
        -------
        Volume
            ``volume.renderer`` is the tetralux.Renderer, whose properties may be changed; ``volume.visible``;
            ``volume.remove()``.
        """
        if blending not in _BLENDING:
            raise InputError(f"blending: there is no '{blending}'; take one of {', '.join(_BLENDING)}")
        options.setdefault("mode", _BLENDING[blending])
        if shade:
            options.setdefault("lights", "headlight")
        own = mesh.tetralux.mesh if hasattr(mesh, "tetralux") else mesh
        renderer = Renderer(
            own,
            scalars,
            transfer_function=transfer_function,
            cmap=cmap,
            opacity=opacity,
            opacity_unit_distance=opacity_unit_distance,
            clim=clim,
            log_scale=log_scale,
            **options,
        )
        target = self._plotter.renderer
        scene = self._scenes.get(target)
        if scene is None:
            scene = self._scenes[target] = SceneVolumes(target)
        first = not target.actors and not target.camera_set
        volume = scene.add(renderer)
        if show_scalar_bar and transfer_function is None:
            self._scalar_bar(renderer, cmap, clim, log_scale, scalar_bar_args or {})
        if reset_camera or (reset_camera is None and first):
            self._plotter.reset_camera()
        return volume

    def _scalar_bar(self, renderer: Renderer, cmap: Any, clim: Any, log_scale: bool, given: dict[str, Any]) -> None:
        chosen = choose(renderer.mesh, renderer.scalars)
        span = clim or (float(chosen.values.min()), float(chosen.values.max()))
        mapper = pyvista.DataSetMapper()
        mapper.lookup_table = pyvista.LookupTable(cmap=cmap or "coolwarm", scalar_range=span, log_scale=log_scale)
        self._plotter.add_scalar_bar(**{"title": chosen.title, "mapper": mapper, **given})

    def __plotter_close__(self) -> None:
        for scene in self._scenes.values():
            scene.close()
        self._scenes.clear()


for _class in (pyvista.DataSet, pyvista.MultiBlock):
    pyvista.register_dataset_accessor("tetralux", _class)(DatasetAccessor)
pyvista.register_plotter_component("tetralux")(PlotterComponent)

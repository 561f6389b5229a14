# SPDX-License-Identifier: Apache-2.0
"""Volumes among the actors of a vtkRenderer: seen by its camera, ended by its opaque actors."""

from __future__ import annotations

import weakref
from typing import Any, Optional

import numpy as np
import numpy.typing as npt
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkFloatArray, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkTexture

from ._renderer import Renderer


class ViewGeometry:
    """What a vtkCamera sees in a viewport of (width, height) pixels."""

    def __init__(self, camera: Any, size: tuple[int, int]) -> None:
        self.size = width, height = size
        self.eye = np.array(camera.GetPosition())
        self.target = np.array(camera.GetFocalPoint())
        self.view_up = camera.GetViewUp()
        self.center = camera.GetWindowCenter()
        self.near, self.far = camera.GetClippingRange()
        self.parallel = bool(camera.GetParallelProjection())
        self.height = 2.0 * camera.GetParallelScale() if self.parallel else None
        tangent = np.tan(np.radians(0.5 * camera.GetViewAngle()))
        if camera.GetUseHorizontalViewAngle():
            tangent *= height / width
        self.tangent = float(tangent)
        self.fov = float(np.degrees(2 * np.arctan(tangent)))
        self.aspect = width / height
        self.forward = _unit(self.target - self.eye)
        self.right = _unit(np.cross(self.forward, self.view_up))
        self.up = np.cross(self.right, self.forward)

    def camera(self) -> dict[str, Any]:
        """As Renderer.render takes it."""
        return {
            "eye": tuple(self.eye),
            "target": tuple(self.target),
            "up": self.view_up,
            "fov": self.fov,
            "height": self.height,
            "window_center": self.center,
        }

    def distances(self, depth: npt.NDArray[np.float32]) -> npt.NDArray[np.float32]:
        """Of the depth buffer, top row first: along each pixel's ray, infinite where nothing stands."""
        z = depth.astype(np.float64)
        near, far = self.near, self.far
        if self.parallel:
            along = near + z * (far - near)
        else:
            height, width = depth.shape
            x = ((2 * np.arange(width) + 1) / width - 1 + self.center[0]) * self.aspect * self.tangent
            y = (1 - (2 * np.arange(height) + 1) / height + self.center[1]) * self.tangent
            along = near * far / (far - z * (far - near)) * np.sqrt(1 + x[None, :] ** 2 + y[:, None] ** 2)
        along[depth >= 1] = np.inf
        limits: npt.NDArray[np.float32] = along.astype(np.float32)
        return limits

    def near_plane(self) -> npt.NDArray[np.float64]:
        """World from a square of corners (±1, ±1, 0) that fills the viewport just behind the near plane."""
        at = self.near + 1e-3 * (self.far - self.near) if self.parallel else self.near * 1.001
        half = 0.5 * self.height if self.height is not None else at * self.tangent
        x, y = half * self.aspect * self.right, half * self.up
        matrix = np.eye(4)
        matrix[:3, 0], matrix[:3, 1], matrix[:3, 2] = x, y, self.forward
        matrix[:3, 3] = self.eye + at * self.forward + self.center[0] * x + self.center[1] * y
        return matrix


def _unit(vector: npt.NDArray[np.float64]) -> npt.NDArray[np.float64]:
    length = np.linalg.norm(vector)
    return vector / length if length > 0 else vector


def _square_of(points: Any) -> vtkPolyData:
    data = vtkPolyData()
    at = vtkPoints()
    for point in points:
        at.InsertNextPoint(point)
    data.SetPoints(at)
    square = vtkCellArray()
    square.InsertNextCell(4, (0, 1, 2, 3))
    data.SetPolys(square)
    return data


class _Square:
    """A picture over the whole viewport, drawn after what is opaque."""

    def __init__(self) -> None:
        data = _square_of([(-1, -1, 0), (1, -1, 0), (1, 1, 0), (-1, 1, 0)])
        places = numpy_to_vtk(np.array([[0, 0], [1, 0], [1, 1], [0, 1]], np.float32), deep=True)
        places.SetName("texture")
        data.GetPointData().SetTCoords(places)
        mapper = vtkPolyDataMapper()
        mapper.SetInputData(data)
        self.texture = vtkTexture()
        self.texture.SetColorModeToDirectScalars()
        self.texture.SetPremultipliedAlpha(True)
        self.texture.InterpolateOff()
        self.texture.RepeatOff()
        self.actor = vtkActor()
        self.actor.SetMapper(mapper)
        self.actor.SetTexture(self.texture)
        self.actor.ForceTranslucentOn()
        self.actor.UseBoundsOff()
        self.actor.PickableOff()
        self.actor.GetProperty().LightingOff()
        self.actor.GetProperty().SetColor(1, 1, 1)

    def show(self, rgba: npt.NDArray[np.float32], matrix: npt.NDArray[np.float64], smooth: bool) -> None:
        image = vtkImageData()
        height, width = rgba.shape[:2]
        image.SetDimensions(width, height, 1)
        colors = numpy_to_vtk(np.ascontiguousarray(rgba[::-1]).reshape(-1, 4), deep=True)
        colors.SetName("rgba")
        image.GetPointData().SetScalars(colors)
        self.texture.SetInputData(image)
        self.texture.SetInterpolate(smooth)
        placed = vtkMatrix4x4()
        placed.DeepCopy(matrix.ravel().tolist())
        self.actor.SetUserMatrix(placed)


class Volume:
    """One volume of a plotter. ``renderer`` may be changed at any time: the next frame shows it."""

    def __init__(self, scene: SceneVolumes, renderer: Renderer) -> None:
        self.renderer = renderer
        self._scene: Optional[SceneVolumes] = scene
        self._square = _Square()
        low, high = renderer.mesh.bounds
        self._box = vtkActor()  # shows nothing: its bounds are the volume's, for whoever resets the camera
        mapper = vtkPolyDataMapper()
        middle = (low[0], low[1], high[2]), (high[0], high[1], low[2])
        mapper.SetInputData(_square_of([low, middle[0], high, middle[1]]))
        self._box.SetMapper(mapper)
        self._box.GetProperty().SetOpacity(0)
        self._box.PickableOff()
        self._per_pixel = 0.0  # milliseconds of the last frame for each pixel
        for actor in self.actors:
            scene.target.AddActor(actor)

    @property
    def actors(self) -> tuple[Any, Any]:
        """What stands for it in the vtkRenderer."""
        return self._box, self._square.actor

    @property
    def visible(self) -> bool:
        return bool(self._box.GetVisibility())

    @visible.setter
    def visible(self, on: bool) -> None:
        for actor in self.actors:
            actor.SetVisibility(on)

    def remove(self) -> None:
        """Takes the volume out of its plotter."""
        if self._scene is not None:
            self._scene.volumes.remove(self)
            for actor in self.actors:
                self._scene.target.RemoveActor(actor)
            self._scene = None

    def _draw(self, view: ViewGeometry, limits: Optional[npt.NDArray[np.float32]], budget: float) -> None:
        step = self._step(view.size, budget)
        width, height = (max(1, side // step) for side in view.size)
        if step > 1 and limits is not None:
            rows = (np.arange(height) * view.size[1]) // height + step // 2
            columns = (np.arange(width) * view.size[0]) // width + step // 2
            limits = np.ascontiguousarray(limits[np.ix_(rows, columns)])
        image = self.renderer.render(size=(width, height), depth_limit=limits, **view.camera())
        self._per_pixel = image.report["milliseconds"] / (width * height)
        self._square.show(image.rgba, view.near_plane(), step > 1)

    def _step(self, size: tuple[int, int], budget: float) -> int:
        """Each way so many times fewer pixels that the frame keeps within the budget, milliseconds; 0: none."""
        expected = self._per_pixel * size[0] * size[1]
        if not budget or expected <= budget:
            return 1
        return int(min(8, np.ceil(np.sqrt(expected / budget))))


class SceneVolumes:
    """The volumes of one vtkRenderer: before each of its frames they are drawn as its actors let them be seen."""

    def __init__(self, target: Any) -> None:
        self.target = target
        self.volumes: list[Volume] = []
        self._busy = False
        itself = weakref.ref(self)

        def before(*_: Any) -> None:
            scene = itself()
            if scene is not None:
                scene._before_frame()

        self._observer = target.AddObserver("StartEvent", before)
        target.SetUseOIT(False)  # it weighs colours by depth, which is no composition

    def add(self, renderer: Renderer) -> Volume:
        volume = Volume(self, renderer)
        self.volumes.append(volume)
        return volume

    def close(self) -> None:
        self.target.RemoveObserver(self._observer)
        self.target.SetUseOIT(True)
        for volume in list(self.volumes):
            volume.remove()

    def _before_frame(self) -> None:
        shown = [volume for volume in self.volumes if volume.visible]
        if self._busy or not shown or self.target.GetSelector() is not None:
            return
        size = self.target.GetSize()
        if min(size) < 1:
            return
        self._busy = True
        try:
            view = ViewGeometry(self.target.GetActiveCamera(), size)
            limits = self._limits(view)
            rate = self.target.GetRenderWindow().GetDesiredUpdateRate()
            for volume in shown:
                volume._draw(view, limits, 1000 / rate if rate >= 1 else 0.0)
        finally:
            self._busy = False

    def _limits(self, view: ViewGeometry) -> Optional[npt.NDArray[np.float32]]:
        """How far each pixel's ray goes until it meets something opaque; None if nothing is."""
        own = {actor for volume in self.volumes for actor in volume.actors}
        props = self.target.GetViewProps()
        others = [props.GetItemAsObject(i) for i in range(props.GetNumberOfItems())]
        if not any(p.GetVisibility() and p not in own and p.HasOpaqueGeometry() for p in others):
            return None
        squares = [volume._square.actor for volume in self.volumes if volume.visible]
        passes = self.target.GetPass()
        for square in squares:
            square.VisibilityOff()
        try:
            self.target.SetPass(None)  # some of them keep depth to themselves
            self.target.Render()
            depth = self._depth(view.size)
        finally:
            self.target.SetPass(passes)
            for square in squares:
                square.VisibilityOn()
        return view.distances(depth)

    def _depth(self, size: tuple[int, int]) -> npt.NDArray[np.float32]:
        left, bottom = self.target.GetOrigin()
        values = vtkFloatArray()
        self.target.GetRenderWindow().GetZbufferData(
            left, bottom, left + size[0] - 1, bottom + size[1] - 1, values
        )
        depth: npt.NDArray[np.float32] = vtk_to_numpy(values).reshape(size[1], size[0])[::-1]
        return depth

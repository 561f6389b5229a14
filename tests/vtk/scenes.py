# SPDX-License-Identifier: Apache-2.0
"""Windows with a volume for the tests of vtkTetraluxMapper.

TETRALUX_PROGRAM names the program `tetralux`; PYTHONPATH holds the package tetraluxvtk; an X server is there.
"""
import math

import numpy as np
import vtkmodules.vtkInteractionStyle  # noqa: F401
import vtkmodules.vtkRenderingOpenGL2  # noqa: F401
import vtkmodules.vtkRenderingVolumeOpenGL2  # noqa: F401
from grids import COLORS, OPACITIES, program_picture
from tetraluxvtk import vtkTetraluxMapper
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction
from vtkmodules.vtkRenderingCore import (
    vtkColorTransferFunction,
    vtkRenderer,
    vtkRenderWindow,
    vtkVolume,
    vtkWindowToImageFilter,
)

class Scene:
    """A window with one volume."""

    def __init__(self, grid, size=(160, 120), opacities=OPACITIES, colors=COLORS, mapper=None):
        self.size = size
        self.grid = grid
        self.mapper = mapper or vtkTetraluxMapper()
        self.mapper.SetInputData(grid)
        self.volume = vtkVolume()
        self.volume.SetMapper(self.mapper)
        self.property = self.volume.GetProperty()
        self.colors, self.opacities = vtkColorTransferFunction(), vtkPiecewiseFunction()
        for node in colors:
            self.colors.AddRGBPoint(*node)
        for node in opacities:
            self.opacities.AddPoint(*node)
        self.property.SetColor(self.colors)
        self.property.SetScalarOpacity(self.opacities)
        self.renderer = vtkRenderer()
        self.renderer.AddVolume(self.volume)
        self.window = vtkRenderWindow()
        self.window.SetOffScreenRendering(1)
        self.window.SetMultiSamples(0)
        self.window.SetSize(*size)
        self.window.AddRenderer(self.renderer)
        self.camera = self.renderer.GetActiveCamera()
        self.look((3.1, 2.2, 4.3))

    def look(self, eye, target=(0, 0, 0), up=(0, 1, 0), angle=30, height=None):
        self.camera.SetPosition(*eye)
        self.camera.SetFocalPoint(*target)
        self.camera.SetViewUp(*up)
        self.camera.SetViewAngle(angle)
        self.camera.SetParallelProjection(height is not None)
        if height is not None:
            self.camera.SetParallelScale(height / 2)
        self.renderer.ResetCameraClippingRange()

    def picture(self):
        """The mapper's float picture after a frame, rows from the top."""
        self.window.Render()
        return self.last_picture()

    def last_picture(self):
        image = self.mapper.GetLastImage()
        width, height, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, 4)[::-1].copy()

    def shown(self):
        """RGB in 0 … 255 of the window after a frame, rows from the top."""
        grabber = vtkWindowToImageFilter()
        grabber.SetInput(self.window)
        grabber.ReadFrontBufferOff()
        grabber.Update()
        image = grabber.GetOutput()
        width, height, _ = image.GetDimensions()
        return vtk_to_numpy(image.GetPointData().GetScalars()).reshape(height, width, -1)[::-1, :, :3].astype(int)

    def program(self, *options, **more):
        return program_picture(self.grid, self.camera, self.size, *options, **more)


def rotation(axis, degrees):
    a = math.radians(degrees)
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    k = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + math.sin(a) * k + (1 - math.cos(a)) * k @ k

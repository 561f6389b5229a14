#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""vtk_picture.py REQUEST.json: what VTK draws of a file, by its own reader, triangulation and fastest mapper of unstructured grids.

Needs Debian's python3-vtk9 and a display (xvfb-run). VTK's mappers take the opacity function for attenuation per unit distance.
"""
import json
import sys

import vtk


def reader_of(path):
    for ending, kind in ((".vtu", vtk.vtkXMLUnstructuredGridReader), (".vtk", vtk.vtkUnstructuredGridReader), (".ex2", vtk.vtkExodusIIReader)):
        if path.endswith(ending):
            reader = kind()
            reader.SetFileName(path)
            return reader
    sys.exit(f"{path}: no reader for it here")


def main():
    with open(sys.argv[1]) as text:
        request = json.load(text)
    reader = reader_of(request["mesh"])
    hidden = vtk.vtkRemoveGhosts()  # cells that the file says are not to be seen
    hidden.SetInputConnection(reader.GetOutputPort())
    triangles = vtk.vtkDataSetTriangleFilter()
    triangles.SetInputConnection(hidden.GetOutputPort())
    triangles.TetrahedraOnlyOn()
    triangles.Update()
    grid = triangles.GetOutput()
    name, on_points = request["scalar"], True
    field = grid.GetPointData().GetArray(name)
    if field is None:
        field, on_points = grid.GetCellData().GetArray(name), False
    low, high = field.GetRange(-1 if field.GetNumberOfComponents() > 1 else 0)
    if field.GetNumberOfComponents() > 1:  # by magnitude
        magnitude = vtk.vtkDoubleArray()
        magnitude.SetName("magnitude")
        for i in range(field.GetNumberOfTuples()):
            magnitude.InsertNextValue(sum(v * v for v in field.GetTuple(i)) ** 0.5)
        field = magnitude
    (grid.GetPointData() if on_points else grid.GetCellData()).SetScalars(field)

    function = request["function"]
    scale = (lambda s: low + s * (high - low)) if function.get("normalized") else (lambda s: s)
    most = max(tau for _, tau in function["extinction"])
    color, opacity = vtk.vtkColorTransferFunction(), vtk.vtkPiecewiseFunction()
    for s, r, g, b in function["color"]:
        color.AddRGBPoint(scale(s), r, g, b)
    for s, tau in function["extinction"]:
        opacity.AddPoint(scale(s), tau / most)
    volume, mapper = vtk.vtkVolume(), vtk.vtkProjectedTetrahedraMapper()
    mapper.SetInputData(grid)
    volume.SetMapper(mapper)
    volume.GetProperty().SetColor(color)
    volume.GetProperty().SetScalarOpacity(opacity)
    volume.GetProperty().SetScalarOpacityUnitDistance(1 / most)
    volume.GetProperty().ShadeOff()
    volume.GetProperty().SetInterpolationTypeToLinear()

    words = dict(option.split("=") for option in request["camera"])
    triple = lambda key: [float(v) for v in words[key].split(",")]  # noqa: E731
    renderer, window = vtk.vtkRenderer(), vtk.vtkRenderWindow()
    window.SetOffScreenRendering(1)
    window.SetSize(512, 512)
    window.AddRenderer(renderer)
    renderer.AddVolume(volume)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(triple("--eye"))
    camera.SetFocalPoint(triple("--target"))
    camera.SetViewUp(triple("--up"))
    camera.SetViewAngle(float(words["--fov"]))
    renderer.ResetCameraClippingRange()
    window.Render()
    shot = vtk.vtkWindowToImageFilter()
    shot.SetInput(window)
    shot.ReadFrontBufferOff()
    writer = vtk.vtkPNGWriter()
    writer.SetInputConnection(shot.GetOutputPort())
    writer.SetFileName(request["out"])
    writer.Write()


main()

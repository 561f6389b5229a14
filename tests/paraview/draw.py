# SPDX-License-Identifier: Apache-2.0
"""pvbatch draw.py PLUGIN FOLDER: draws the scenes of FOLDER/scenes.json, each into FOLDER/NAME.png. With SERVER_PORT in the
environment as a client of that server."""
import json
import os
import sys

import paraview.simple as pv

plugin, folder = sys.argv[1:3]
pv._DisableFirstRenderCameraReset()
if "SERVER_PORT" in os.environ:
    pv.Connect("localhost", int(os.environ["SERVER_PORT"]))
    pv.LoadPlugin(plugin, remote=True, ns=globals())
pv.LoadPlugin(plugin, remote=False, ns=globals())

for scene in json.load(open(os.path.join(folder, "scenes.json"))):
    sources = [pv.OpenDataFile(os.path.join(folder, file)) for file in scene["files"]]
    for source in sources:
        source.UpdatePipeline()
    source = pv.GroupDatasets(Input=sources) if len(sources) > 1 else sources[0]
    view = pv.CreateView("RenderView")
    view.ViewSize = scene["size"]
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [c / 255 for c in scene["background"]]
    view.UseFXAA = 0  # it blurs the outline of a volume, and in parallel only
    if "SERVER_PORT" in os.environ:
        view.RemoteRenderThreshold = 0
    shown = pv.Show(source, view)
    shown.SetRepresentationType("Tetralux")
    shown.TetraluxThreads = 1
    for name, value in scene.get("properties", {}).items():
        setattr(shown, name, value)
    pv.ColorBy(shown, (scene["on"], "w"))
    shown.SetScalarBarVisibility(view, False)
    colors, opacity = pv.GetColorTransferFunction("w"), pv.GetOpacityTransferFunction("w")
    colors.ColorSpace = "RGB"
    colors.RGBPoints = [x for node in scene["colors"] for x in node]
    opacity.Points = [x for s, o in scene["opacity"] for x in (s, o, 0.5, 0.0)]
    shown.ScalarOpacityUnitDistance = scene["unit"]
    if "sphere" in scene:
        sphere = pv.Sphere(Center=scene["sphere"][:3], Radius=scene["sphere"][3], ThetaResolution=24, PhiResolution=24)
        ball = pv.Show(sphere, view)
        ball.Ambient, ball.Diffuse, ball.Specular = 1.0, 0.0, 0.0
        ball.DiffuseColor = ball.AmbientColor = [1.0, 204 / 255, 51 / 255]
        pv.ColorBy(ball, ("POINTS", ""))
    view.CameraPosition = scene["eye"]
    view.CameraFocalPoint = scene["target"]
    view.CameraViewUp = [0, 1, 0]
    view.CameraViewAngle = scene["angle"]
    if scene.get("height"):
        view.CameraParallelProjection = 1
        view.CameraParallelScale = scene["height"] / 2
    pv.Render(view)
    pv.SaveScreenshot(os.path.join(folder, scene["name"] + ".png"), view, ImageResolution=scene["size"])
    pv.Delete(view)
    if "sphere" in scene:
        pv.Delete(sphere)

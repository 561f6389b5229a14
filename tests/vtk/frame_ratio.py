# SPDX-License-Identifier: Apache-2.0
"""python3 frame_ratio.py GRID.vtu ...: what a frame takes in a VTK window, over the engine's own time, and against VTK's mappers.

512×512, a camera that moves every frame; medians. Needs what scenes.py needs.
"""
import statistics
import sys
import time

from scenes import Scene
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingVolume import vtkUnstructuredGridVolumeRayCastMapper, vtkUnstructuredGridVolumeZSweepMapper
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkOpenGLProjectedTetrahedraMapper


def frames(scene, count):
    """Milliseconds of each frame after the first, and of the engine where there is one."""
    scene.window.Render()
    whole, engine = [], []
    for _ in range(count):
        scene.camera.Azimuth(2.0)
        start = time.perf_counter()
        scene.window.Render()
        whole.append(1e3 * (time.perf_counter() - start))
        engine.append(scene.mapper.GetEngineMilliseconds() if hasattr(scene.mapper, "GetEngineMilliseconds") else 0.0)
    return whole, engine


def main():
    for name in sys.argv[1:]:
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(name)
        reader.Update()
        grid = reader.GetOutput()
        grid.GetPointData().SetActiveScalars(grid.GetPointData().GetArrayName(0))
        low, high = grid.GetPointData().GetArray(0).GetRange()
        colors = [[low, 0, 0, 1], [(low + high) / 2, 1, 1, 1], [high, 1, 0, 0]]
        opacities = [[low, 0], [high, 25]]

        def scene(mapper=None):
            made = Scene(grid, size=(512, 512), colors=colors, opacities=opacities, mapper=mapper)
            made.look((1.9, 1.4, 2.3))
            return made

        whole, engine = frames(scene(), 15)
        ours = statistics.median(whole)
        ratio = statistics.median(w / e for w, e in zip(whole, engine))
        print(f"{name}: {grid.GetNumberOfCells()} cells, frame {ours:.1f} ms, {ratio:.3f} of the engine's", flush=True)
        for mapper in (vtkOpenGLProjectedTetrahedraMapper, vtkUnstructuredGridVolumeZSweepMapper, vtkUnstructuredGridVolumeRayCastMapper):
            made = scene(mapper())
            start = time.perf_counter()
            made.window.Render()
            first = time.perf_counter() - start
            if first > 8:
                print(f"  {mapper.__name__}: the first frame alone takes {first:.0f} s", flush=True)
                continue
            other = statistics.median(frames(made, 3 if first > 3 else 7)[0])
            print(f"  {mapper.__name__}: {other:.0f} ms, {other / ours:.1f} times", flush=True)


if __name__ == "__main__":
    main()

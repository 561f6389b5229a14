# SPDX-License-Identifier: Apache-2.0
"""python3 frame_ratio.py GRID.vtu ...: what a frame takes in a VTK window, over the engine's own time, and against VTK's mappers.

512×512, a camera that moves every frame; medians. Beside wall time, processor time of all threads, which others on the machine disturb
less. Needs what scenes.py needs.
"""
import statistics
import sys
import time

from scenes import Scene
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridReader
from vtkmodules.vtkRenderingVolume import vtkUnstructuredGridVolumeRayCastMapper, vtkUnstructuredGridVolumeZSweepMapper
from vtkmodules.vtkRenderingVolumeOpenGL2 import vtkOpenGLProjectedTetrahedraMapper


# The function "smooth" of `tetralux bench`: share of the range, colour, extinction.
SMOOTH = ((0.0, 0.10, 0.15, 0.60, 0.0), (0.25, 0.10, 0.65, 0.75, 1.5), (0.5, 0.35, 0.80, 0.30, 6.0), (0.75, 0.95, 0.80, 0.20, 14.0),
          (1.0, 0.85, 0.10, 0.10, 25.0))  # fmt: skip


def frames(scene, count):
    """Milliseconds of each frame after the first, of the engine where there is one, and of all processors."""
    scene.window.Render()
    whole, engine, processors = [], [], []
    for _ in range(count):
        scene.camera.Azimuth(2.0)
        start, used = time.perf_counter(), time.process_time()
        scene.window.Render()
        whole.append(1e3 * (time.perf_counter() - start))
        processors.append(1e3 * (time.process_time() - used))
        engine.append(scene.mapper.GetEngineMilliseconds() if hasattr(scene.mapper, "GetEngineMilliseconds") else 0.0)
    return whole, engine, processors


def main():
    for name in sys.argv[1:]:
        reader = vtkXMLUnstructuredGridReader()
        reader.SetFileName(name)
        reader.Update()
        grid = reader.GetOutput()
        grid.GetPointData().SetActiveScalars(grid.GetPointData().GetArrayName(0))
        low, high = grid.GetPointData().GetArray(0).GetRange()
        colors, opacities = [], []
        for share, *color, extinction in SMOOTH:
            colors.append([low + share * (high - low), *color])
            opacities.append([low + share * (high - low), extinction])

        def scene(mapper=None):
            made = Scene(grid, size=(512, 512), colors=colors, opacities=opacities, mapper=mapper)
            made.look((1.9, 1.4, 2.3))
            return made

        whole, engine, processors = frames(scene(), 15)
        ours, our_processors = statistics.median(whole), statistics.median(processors)
        ratio = statistics.median(w / e for w, e in zip(whole, engine))
        print(f"{name}: {grid.GetNumberOfCells()} cells, frame {ours:.1f} ms ({our_processors:.0f} of processors), "
              f"{ratio:.3f} of the engine's", flush=True)  # fmt: skip
        for mapper in (vtkOpenGLProjectedTetrahedraMapper, vtkUnstructuredGridVolumeZSweepMapper, vtkUnstructuredGridVolumeRayCastMapper):
            made = scene(mapper())
            start = time.perf_counter()
            made.window.Render()
            first = time.perf_counter() - start
            if first > 8 and not mapper.__name__.startswith("vtkOpenGL"):
                print(f"  {mapper.__name__}: the first frame alone takes {first:.0f} s", flush=True)
                continue
            whole, _, processors = frames(made, 3 if first > 3 else 7)
            other, other_processors = statistics.median(whole), statistics.median(processors)
            print(f"  {mapper.__name__}: {other:.0f} ms, {other / ours:.1f} times ({other_processors:.0f} of processors, "
                  f"{other_processors / our_processors:.1f} times)", flush=True)  # fmt: skip


if __name__ == "__main__":
    main()

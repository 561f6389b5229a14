# SPDX-License-Identifier: Apache-2.0
"""What is made again when, frames that are stopped or must be quick, picking, and grids that are hard to draw."""
import math
import time
import unittest

import numpy as np
import scenes
from grids import box_grid, grid_of, tetrahedra, wave
from scenes import Scene
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkObject
from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkHardwareSelector, vtkPolyDataMapper


class Frames(unittest.TestCase):
    def made(self, scene):
        scene.window.Render()
        return scene.mapper.GetMeshesMade(), scene.mapper.GetFieldsMade()

    def test_only_what_changed_is_made_again(self):
        points, cells = tetrahedra(5)
        grid = grid_of(points, cells, point_data={"w": wave(points)})
        scene = Scene(grid)
        self.assertEqual(self.made(scene), (1, 1))
        scene.camera.Azimuth(20)
        scene.opacities.AddPoint(0.8, 2.0)
        scene.property.ShadeOn()
        scene.mapper.SetSamples(4)
        self.assertEqual(self.made(scene), (1, 1))
        values = scenes.vtk_to_numpy(grid.GetPointData().GetScalars())
        values *= 0.5
        grid.GetPointData().GetScalars().Modified()
        self.assertEqual(self.made(scene), (1, 2))
        other = vtkUnstructuredGrid()  # as a pipeline hands it on
        other.ShallowCopy(grid)
        scene.mapper.SetInputData(other)
        self.assertEqual(self.made(scene)[0], 1)
        moved = scenes.vtk_to_numpy(grid.GetPoints().GetData())
        moved *= 1.1
        other.Modified()  # of the grid alone
        self.assertEqual(self.made(scene)[0], 2)
        scene.volume.RotateX(10)
        self.assertEqual(self.made(scene)[0], 3)
        self.assertEqual(self.made(scene)[0], 3)

    def test_changes_show(self):
        """Each change gives the picture that a new scene gives."""
        scene = Scene(box_grid(4))
        scene.window.Render()
        for change in (
            lambda s: s.colors.AddRGBPoint(0.5, 0, 0, 0),
            lambda s: s.opacities.AddPoint(0.7, 0.1),
            lambda s: s.property.SetScalarOpacityUnitDistance(0.5),
            lambda s: s.mapper.SetBlendModeToAdditive(),
            lambda s: s.mapper.SetSilhouettes(1),
        ):
            before = scene.last_picture()
            change(scene)
            after = scene.picture()
            fresh = Scene(box_grid(4), mapper=None)
            fresh.volume.SetProperty(scene.property)
            fresh.mapper.SetBlendMode(scene.mapper.GetBlendMode())
            fresh.mapper.SetSilhouettes(scene.mapper.GetSilhouettes())
            self.assertGreater(np.abs(after - before).max(), 1e-3)
            self.assertEqual(np.abs(after - fresh.picture()).max(), 0)

    def test_a_frame_is_stopped(self):
        scene = Scene(box_grid())
        whole = scene.picture()
        self.assertGreater(whole.max(), 0.1)
        tag = scene.window.AddObserver("AbortCheckEvent", lambda *_: scene.window.SetAbortRender(1))
        time.sleep(0.25)  # VTK asks five times a second at most
        scene.window.Render()
        self.assertFalse(scene.mapper.GetComplete())
        scene.window.RemoveObserver(tag)
        self.assertEqual(np.abs(scene.picture() - whole).max(), 0)
        self.assertTrue(scene.mapper.GetComplete())

    def test_progress_is_told(self):
        scene = Scene(box_grid())
        told = []
        scene.mapper.AddObserver("ProgressEvent", lambda *_: told.append(scene.mapper.GetProgress()))
        scene.window.Render()
        self.assertEqual(told[-1], 1.0)
        self.assertEqual(told, sorted(told))
        self.assertGreater(len(told), 2)

    def test_quick_frames_are_coarser(self):
        scene = Scene(box_grid(), size=(300, 200))
        source, mapper, actor = vtkSphereSource(), vtkPolyDataMapper(), vtkActor()
        mapper.SetInputConnection(source.GetOutputPort())
        actor.SetMapper(mapper)
        scene.renderer.AddActor(actor)
        whole = scene.picture()
        self.assertEqual(scene.mapper.GetDrawnSize(), (300, 200))
        scene.window.SetDesiredUpdateRate(1e5)
        coarse = scene.picture()
        self.assertLess(scene.mapper.GetDrawnSize()[0], 300)
        self.assertGreater(scene.mapper.GetTimeToDraw(), 0)
        self.assertLess(np.abs(coarse - whole).mean(), 0.1)
        scene.window.SetDesiredUpdateRate(0.0001)
        self.assertEqual(np.abs(scene.picture() - whole).max(), 0)

    def test_picking(self):
        scene = Scene(box_grid(), opacities=[[0, 1e4]])
        scene.window.Render()
        place = [0.0, 0.0, 0.0]
        self.assertTrue(scene.mapper.PickPosition(80, 60, place))
        self.assertAlmostEqual(max(abs(x) for x in place), 1, places=6)  # on the outside
        self.assertAlmostEqual(scene.mapper.PickScalar(80, 60), wave(np.array([place]))[0], delta=0.05)
        self.assertFalse(scene.mapper.PickPosition(0, 0, place))
        self.assertTrue(math.isnan(scene.mapper.PickScalar(0, 0)))

    def test_hardware_selection_is_left_alone(self):
        scene = Scene(box_grid())
        source, mapper, actor = vtkSphereSource(), vtkPolyDataMapper(), vtkActor()
        source.SetRadius(1.5)
        mapper.SetInputConnection(source.GetOutputPort())
        actor.SetMapper(mapper)
        scene.renderer.AddActor(actor)
        scene.window.Render()
        selector = vtkHardwareSelector()
        selector.SetRenderer(scene.renderer)
        selector.SetArea(75, 55, 85, 65)
        selection = selector.Select()
        self.assertEqual(selection.GetNumberOfNodes(), 1)
        self.assertIs(selection.GetNode(0).GetProperties().Get(selection.GetNode(0).PROP()), actor)

    def test_verification(self):
        scene = Scene(box_grid())
        scene.window.Render()
        self.assertLess(scene.mapper.VerifyLastImage(500), 1e-6)
        self.assertGreaterEqual(scene.mapper.VerifyLastImage(500), 0)

    def test_windows_may_come_and_go(self):
        """The volume goes on in another window when the first is closed."""
        scene = Scene(box_grid(4))
        first = scene.shown()
        scene.renderer.RemoveVolume(scene.volume)
        scene.window.Finalize()
        other = Scene(box_grid(4), mapper=scene.mapper)
        other.property.DeepCopy(scene.property)
        self.assertEqual(np.abs(other.shown() - first).max(), 0)

    def test_messages(self):
        points, cells = tetrahedra(2)
        for fault, word in (("scalars", "no scalars"), ("cells", "no cells"), ("engine", "no engine"), ("components", "components"),
                            ("function", "has no points"), ("mirror", "mirrors")):  # fmt: skip
            with self.subTest(fault):
                vectors = {"v": np.ones((len(points), 2))}
                data = vectors if fault == "components" else {} if fault == "scalars" else {"w": wave(points)}
                scene = Scene(grid_of(points, cells if fault != "cells" else cells[:1], point_data=data))
                if fault == "cells":
                    scene.mapper.SetInputData(vtkUnstructuredGrid())
                    scene.mapper.GetInput().GetPointData().SetScalars(numpy_to_vtk(np.ones(1), deep=1))
                if fault == "engine":
                    scene.mapper.SetEngine("steam")
                if fault == "components":
                    scene.property.IndependentComponentsOff()
                if fault == "function":
                    scene.opacities.RemoveAllPoints()
                if fault == "mirror":
                    mirror = vtkTransform()
                    mirror.Scale(-1, 1, 1)
                    scene.camera.SetUserTransform(mirror)
                told = []
                tag = scene.mapper.AddObserver("ErrorEvent", lambda *_: told.append("error"))
                scene.window.Render()
                self.assertEqual(told, ["error"], word)
                scene.mapper.RemoveObserver(tag)


class HardGrids(unittest.TestCase):
    """What VTK's own mappers get wrong or leave black."""

    def check(self, scene, tolerance=1e-5):
        drawn = scene.picture()
        self.assertGreater(drawn[..., 3].max(), 0.05)
        self.assertLess(np.abs(drawn - scene.program("--engine", "reference")).max(), tolerance)

    def test_the_eye_within(self):
        scene = Scene(box_grid())
        scene.look((0.21, 0.13, 0.05), target=(1, 0.4, -0.3), angle=80)
        self.check(scene)

    def test_far_from_the_origin(self):
        points, cells = tetrahedra(6)
        far = np.array([1e6, -1e6, 1e6])
        scene = Scene(grid_of(points + far, cells, point_data={"w": wave(points)}))
        scene.look(far + [3.1, 2.2, 4.3], target=far)
        self.check(scene)
        near = Scene(grid_of(points, cells, point_data={"w": wave(points)}))
        self.assertLess(np.abs(scene.last_picture() - near.picture()).max(), 1e-3)

    def test_flat_cells(self):
        points, cells = tetrahedra(5)
        flat = np.concatenate([cells, cells[:20, [0, 1, 2, 2]], cells[:20, [0, 0, 0, 1]]])
        self.check(Scene(grid_of(points, flat, point_data={"w": wave(points)})))

    def test_along_an_axis(self):
        scene = Scene(box_grid(6))
        scene.look((0, 0, 5), height=2.5)
        self.check(scene)

    def test_values_that_are_no_numbers(self):
        points, cells = tetrahedra(5)
        values = wave(points)
        values[::17] = math.nan
        values[5] = math.inf
        self.check(Scene(grid_of(points, cells, point_data={"w": values})))

    def test_constant_fields(self):
        points, cells = tetrahedra(3)
        self.check(Scene(grid_of(points, cells, point_data={"w": 0.5 + 0 * wave(points)})))


if __name__ == "__main__":
    vtkObject.GlobalWarningDisplayOff()
    unittest.main()

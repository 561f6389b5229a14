# SPDX-License-Identifier: Apache-2.0
"""The float picture of vtkTetraluxMapper is that of `tetralux render` of the same scene."""
import json
import unittest

import numpy as np
import scenes
from grids import FOLDER, HEXAHEDRON, OPACITIES, PYRAMID, WEDGE, box_grid, grid_of, lattice, program_picture, tetrahedra, wave
from scenes import Scene
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkPiecewiseFunction, vtkPlane
from vtkmodules.vtkCommonMath import vtkMatrix4x4
from vtkmodules.vtkRenderingCore import vtkLight

NEAR = 1e-6


class Pictures(unittest.TestCase):
    def check(self, scene, *options, tolerance=NEAR, expected=None, **more):
        drawn = scene.picture()
        expected = scene.program(*options, **more) if expected is None else expected
        self.assertTrue(scene.mapper.GetComplete())
        self.assertGreater(expected[..., 3].max(), 0.05)  # something shows
        self.assertLess(np.abs(drawn - expected).max(), tolerance)

    def test_points(self):
        self.check(Scene(box_grid()))

    def test_single_precision(self):
        points, cells = tetrahedra(5)
        grid = grid_of(points.astype(np.float32), cells, point_data={"w": wave(points).astype(np.float32)})
        self.check(Scene(grid))

    def test_cells(self):
        points, cells = tetrahedra(5)
        grid = grid_of(points, cells, cell_data={"w": wave(points[cells].mean(1))})
        scene = Scene(grid)
        scene.mapper.SetScalarModeToUseCellData()
        self.check(scene)

    def test_an_array_by_name(self):
        points, cells = tetrahedra(4)
        grid = grid_of(points, cells, point_data={"other": 0 * wave(points), "w": wave(points)})
        scene = Scene(grid)
        scene.mapper.SetScalarModeToUsePointFieldData()
        scene.mapper.SelectScalarArray("w")
        self.check(scene, "--scalar", "w")

    def test_vectors(self):
        points, cells = tetrahedra(4)
        vectors = np.stack([wave(points), 0.5 * wave(points[:, ::-1]), 0.1 * points[:, 0]], 1)
        scene = Scene(grid_of(points, cells, point_data={"v": vectors}))
        scene.colors.SetVectorModeToMagnitude()
        self.check(scene, "--scalar", "v")
        scene.colors.SetVectorModeToComponent()
        scene.colors.SetVectorComponent(1)
        self.check(scene, "--scalar", "v:y")

    def test_mixed_cells(self):
        """A hexahedron, a wedge and a pyramid in turn, as neighbours in a lattice."""
        points, boxes = lattice(4)
        cells, types = [], []
        for number, b in enumerate(boxes):
            hexahedron = [b[i] for i in (0, 4, 6, 2, 1, 5, 7, 3)]
            if number % 2:
                cells.append(hexahedron)
                types.append(HEXAHEDRON)
            else:
                cells += [[b[0], b[2], b[4], b[1], b[3], b[5]], [b[4], b[2], b[6], b[5], b[3], b[7]]]
                types += [WEDGE, WEDGE]
        apex = len(points)
        points = np.vstack([points, [0, 0, 1.6]])
        top = {tuple(np.round(p, 9)): i for i, p in enumerate(points)}
        axis = np.round(np.linspace(-1, 1, 5), 9)
        for x0, x1 in zip(axis, axis[1:]):
            for y0, y1 in zip(axis, axis[1:]):
                cells.append([top[x0, y0, 1.0], top[x1, y0, 1.0], top[x1, y1, 1.0], top[x0, y1, 1.0], apex])
                types.append(PYRAMID)
        self.check(Scene(grid_of(points, cells, types, point_data={"w": wave(points)})))

    def test_curved_cells(self):
        """Tetrahedra with points on their edges."""
        points, cells = tetrahedra(2)
        pairs = [(0, 1), (1, 2), (0, 2), (0, 3), (1, 3), (2, 3)]
        number, more = {}, list(points)
        curved = []
        for cell in cells:
            extra = []
            for a, b in pairs:
                key = tuple(sorted((cell[a], cell[b])))
                if key not in number:
                    number[key] = len(more)
                    more.append(0.5 * (points[key[0]] + points[key[1]]) * 1.02)
                extra.append(number[key])
            curved.append([*cell, *extra])
        more = np.array(more)
        self.check(Scene(grid_of(more, curved, 24, point_data={"w": wave(more)})))

    def test_blending(self):
        for name, mode in (("MaximumIntensity", "mip"), ("MinimumIntensity", "minimum"),
                           ("AverageIntensity", "average"), ("Additive", "additive")):  # fmt: skip
            with self.subTest(mode):
                scene = Scene(box_grid(5))
                getattr(scene.mapper, "SetBlendModeTo" + name)()
                self.check(scene, "--mode", mode)

    def test_isosurfaces(self):
        scene = Scene(box_grid(), opacities=[[0, 0.3], [1, 0.8]])
        scene.mapper.SetBlendModeToIsoSurface()
        values = scene.property.GetIsoSurfaceValues()
        surfaces = []
        for place, value in enumerate((0.35, 0.5, 0.7)):
            values.SetValue(place, value)
            color = list(scene.colors.GetColor(value))
            surfaces.append({"value": value, "opacity": 0.3 + 0.5 * value, "color": color})
        self.check(scene, extinction=None, isosurfaces=surfaces)

    def test_clipping_planes(self):
        scene = Scene(box_grid())
        for origin, normal in (((0.1, 0, 0), (1, 0.5, 0)), ((0, 0, 0.4), (0, 0, -1))):
            plane = vtkPlane()
            plane.SetOrigin(*origin)
            plane.SetNormal(*normal)
            scene.mapper.AddClippingPlane(plane)
        planes = ["--clip-plane", "0.1,0,0,1,0.5,0", "--clip-plane", "0,0,0.4,0,0,-1"]
        self.check(scene, *planes)
        plane.SetOrigin(0, 0, -0.2)  # moved afterwards
        planes[3] = "0,0,-0.2,0,0,-1"
        self.check(scene, *planes)
        scene.mapper.RemoveAllClippingPlanes()
        self.check(scene)

    def test_region(self):
        scene = Scene(box_grid())
        scene.mapper.SetRegion(-0.5, 0.3, -1, 1, -0.2, 2)
        self.check(scene, "--clip-box", "-0.5,0.3,-1,1,-0.2,2", tolerance=NEAR)

    def test_the_volumes_matrix(self):
        points, cells = tetrahedra(5)
        scene = Scene(grid_of(points, cells, point_data={"w": wave(points)}))
        linear = scenes.rotation((1, 2, 3), 40) @ np.diag([1.3, 0.6, 0.9])
        matrix = vtkMatrix4x4()
        for i in range(3):
            for j in range(3):
                matrix.SetElement(i, j, linear[i, j])
            matrix.SetElement(i, 3, 0.1 * i)
        scene.volume.SetUserMatrix(matrix)
        moved = grid_of(points @ linear.T + [0, 0.1, 0.2], cells, point_data={"w": wave(points)})
        scene.renderer.ResetCameraClippingRange()
        self.check(scene, expected=program_picture(moved, scene.camera, scene.size))

    def test_ghosts(self):
        points, cells = tetrahedra(5)
        marks = np.zeros(len(cells), np.uint8)
        marks[::7] = 1  # duplicate
        marks[3::11] = 32  # hidden
        marks[5::13] = 2  # high connectivity: drawn
        grid = grid_of(points, cells, point_data={"w": wave(points)})
        ghosts = numpy_to_vtk(marks, deep=1)
        ghosts.SetName("vtkGhostType")
        grid.GetCellData().AddArray(ghosts)
        rest = grid_of(points, cells[(marks & 33) == 0], point_data={"w": wave(points)})
        scene = Scene(grid)
        self.check(scene, expected=program_picture(rest, scene.camera, scene.size))
        self.assertEqual(scene.mapper.GetCellsDrawn(), np.count_nonzero((marks & 33) == 0))

    def test_own_properties(self):
        scene = Scene(box_grid(5))
        scene.mapper.SetSamples(4)
        self.check(scene, "--samples", "4")
        scene.mapper.SetSamples(1)
        scene.mapper.SetSilhouettes(1)
        self.check(scene, "--silhouette", "exact")
        scene.mapper.SetSilhouettes(2)
        self.check(scene, "--silhouette", "approximate")
        scene.mapper.SetSilhouettes(0)
        scene.mapper.SetEngine("reference")
        self.check(scene, "--engine", "reference")
        scene.mapper.SetEngine("cpu")
        scene.mapper.SetThreads(1)
        self.check(scene)

    def test_scale_invariant(self):
        scene = Scene(box_grid(5))
        scene.mapper.ScaleInvariantOn()
        values = wave(tetrahedra(5)[0])
        share = (values.max() - values.min()) / np.sqrt(12)
        nodes = [[s, tau / share] for s, tau in OPACITIES]
        self.check(scene, "--mode", "scale-invariant", extinction=nodes)

    def test_unit_distance(self):
        scene = Scene(box_grid(5))
        scene.property.SetScalarOpacityUnitDistance(0.25)
        self.check(scene, extinction=[[s, 4 * o] for s, o in OPACITIES])
        alphas = [[0, 0], [0.4, 0.1], [1, 0.7]]
        scene.opacities.RemoveAllPoints()
        for node in alphas:
            scene.opacities.AddPoint(*node)
        scene.mapper.OpacityIsAlphaOn()
        self.check(scene, extinction=None, opacity=alphas, unitDistance=0.25)

    def test_gray(self):
        scene = Scene(box_grid(5))
        gray = [[s, *3 * [min(o, 1.0)]] for s, o in [[0, 0.1], [0.6, 0.9], [1, 0.2]]]
        function = vtkPiecewiseFunction()
        for node in gray:
            function.AddPoint(node[0], node[1])
        scene.property.SetColor(function)
        self.check(scene, colors=gray)

    def test_curved_functions(self):
        """HSV colours and nodes with a sharpness are followed."""
        scene = Scene(box_grid(5))
        scene.colors.SetColorSpaceToHSV()
        scene.opacities.RemoveAllPoints()
        scene.opacities.AddPoint(0, 0, 0.3, 0.5)
        scene.opacities.AddPoint(0.6, 3, 0.5, 1.0)
        scene.opacities.AddPoint(1, 1)
        at = np.linspace(0, 1, 20001)
        colors = [[s, *scene.colors.GetColor(s)] for s in at]
        extinction = [[s, scene.opacities.GetValue(s)] for s in at]
        self.check(scene, colors=colors, extinction=extinction, tolerance=1e-3)

    def test_functions_that_end(self):
        """Without clamping there is nothing beyond the nodes; below-range colours are taken."""
        scene = Scene(box_grid(5), opacities=[[0.3, 2], [0.7, 3]], colors=[[0.45, 1, 0, 0], [0.6, 0, 1, 0]])
        scene.opacities.ClampingOff()
        scene.colors.SetBelowRangeColor(0, 0, 1)
        scene.colors.UseBelowRangeColorOn()
        e = 1e-12
        colors = [[0.45 - e, 0, 0, 1], [0.45 - e, 1, 0, 0], [0.45, 1, 0, 0], [0.6, 0, 1, 0]]
        extinction = [[0.3 - e, 0], [0.3 - e, 2], [0.3, 2], [0.7, 3], [0.7 + e, 3], [0.7 + e, 0]]
        self.check(scene, colors=colors, extinction=extinction)

    def test_light(self):
        scene = Scene(box_grid(6))
        scene.property.ShadeOn()
        scene.property.SetAmbient(0.2)
        scene.property.SetDiffuse(0.7)
        scene.property.SetSpecular(0.4)
        scene.property.SetSpecularPower(8)
        lights = []
        for kind, position, positional in ((3, (1, 2, 3), False), (3, (0, 3, 0), True)):  # scene lights
            light = vtkLight()
            light.SetLightType(kind)
            light.SetPosition(*position)
            light.SetFocalPoint(0, 0, 0)
            light.SetPositional(positional)
            light.SetConeAngle(180)
            light.SetIntensity(0.8)
            light.SetColor(1, 0.9, 0.8)
            scene.renderer.AddLight(light)
            at = {"type": "point", "position": position} if positional else {"type": "directional", "towards": position}
            lights.append({**at, "color": [1, 0.9, 0.8], "intensity": 0.8})
        file = FOLDER / "light.json"
        file.write_text(
            json.dumps(
                {
                    "ambient": 0.2,
                    "exponent": 8,
                    "transmission": False,
                    "material": {"diffuse": 0.7, "specular": 0.4},
                    "lights": lights,
                }
            )
        )
        self.check(scene, "--lighting", str(file))

    def test_parallel_views(self):
        scene = Scene(box_grid())
        scene.look((3, 1, 2), height=3)
        self.check(scene)
        scene.look((5, 0, 0), height=2.5)  # along an axis
        self.check(scene, tolerance=2e-6)  # the program's eye stands elsewhere on the rays: floats round otherwise


if __name__ == "__main__":
    unittest.main()

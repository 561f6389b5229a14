# SPDX-License-Identifier: Apache-2.0
"""Pictures of the plugin by pvbatch, serial and by 2 and 3 processes, and by a client of pvserver, against `tetralux render`.

PARAVIEW names the folder of apps/paraview/unpack_paraview, PLUGIN Tetralux.so, TETRALUX_PROGRAM the program.
"""
import json
import os
import pathlib
import socket
import subprocess
import sys
import tempfile
import time
import unittest

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "vtk"))
from grids import box_grid, grid_of, lattice, program_picture, tetrahedra, wave  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkFiltersGeneral import vtkDataSetTriangleFilter  # noqa: E402
from vtkmodules.vtkFiltersSources import vtkSphereSource  # noqa: E402
from vtkmodules.vtkIOImage import vtkPNGReader  # noqa: E402
from vtkmodules.vtkIOXML import vtkXMLUnstructuredGridWriter  # noqa: E402
from vtkmodules.vtkRenderingCore import vtkCamera  # noqa: E402

HERE = pathlib.Path(__file__).resolve().parent
ROOT = pathlib.Path(os.environ["PARAVIEW"])
PLUGIN = os.environ["PLUGIN"]
COLORS = [[0, 0, 0.1, 1], [0.4, 0, 1, 0], [0.7, 1, 0, 0], [1, 1, 1, 1]]
DENSE = [[0, 0.5], [0.5, 0.9], [1, 0.7]]


def environment():
    env = dict(os.environ)
    env["PATH"] = f"{ROOT}/usr/bin:{env['PATH']}"
    env["PYTHONPATH"] = f"{ROOT}/usr/lib/python3/dist-packages"
    env["OMPI_MCA_btl_vader_single_copy_mechanism"] = "none"  # silent in containers
    return env


def written(folder, name, grid):
    writer = vtkXMLUnstructuredGridWriter()
    writer.SetFileName(str(folder / name))
    writer.SetInputData(grid)
    writer.Write()
    return name


def bracket():
    """Two arms at a right angle, and a block that touches neither."""
    points, cells = tetrahedra(6)
    middle = points[cells].mean(1)
    arm = (middle[:, 0] < -0.35) | (middle[:, 1] < -0.35)
    block = (middle[:, :2] > 0.35).all(1)
    return points, cells[arm | block]


class Scenes:
    """The folder with grids and scenes that all runs draw, and the grids."""

    def __init__(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="tetralux-paraview-"))
        usual = {"size": [200, 150], "background": [51, 77, 102], "on": "POINTS", "colors": COLORS, "opacity": DENSE,
                 "unit": 0.4, "eye": [3.1, 2.2, 4.3], "target": [0, 0, 0], "angle": 30}  # fmt: skip
        self.grids, self.scenes = {}, []

        def add(name, grid, parts=None, **more):
            files = [written(self.folder, f"{name}{i}.vtu", part) for i, part in enumerate(parts or [grid])]
            self.grids[name] = grid
            self.scenes.append({"name": name, "files": files, **usual, **more})

        def points_grid(points, cells):
            return grid_of(points, cells, point_data={"w": wave(points)})

        coarse = points_grid(*tetrahedra(3))
        add("coarse", coarse)
        add("bracket", points_grid(*bracket()), eye=[-2.0, 3.0, 4.5])
        points, cells = tetrahedra(4)
        add("cells", grid_of(points, cells, cell_data={"w": wave(points[cells].mean(1))}), on="CELLS")
        left = points[cells].mean(1)[:, 0] < 0.1
        add("blocks", points_grid(points, cells),
            [points_grid(points, cells[left]), points_grid(points, cells[~left])])  # fmt: skip
        boxes = lattice(4)[1][:, [0, 4, 6, 2, 1, 5, 7, 3]]
        hexahedra = grid_of(lattice(4)[0], boxes, 12, point_data={"w": wave(lattice(4)[0])})
        add("hexahedra", hexahedra)
        split = vtkDataSetTriangleFilter()  # ParaView does so with all but tetrahedra before any mapper sees them
        split.SetInputData(hexahedra)
        split.Update()
        self.grids["hexahedra"] = split.GetOutput()
        add("sphere", coarse, sphere=[0.2, 0.1, 0.3, 0.6])
        add("parallel", coarse, height=3.2)
        add("maximum", coarse, properties={"TetraluxBlending": "Maximum"})
        clip = {"TetraluxClip": 1, "TetraluxClipOrigin": [0.1, 0, 0], "TetraluxClipNormal": [1, 1, 0]}
        add("clip", coarse, properties=clip)
        add("silhouettes", coarse, opacity=[[0, 0.1], [1, 0.3]], properties={"TetraluxSilhouettes": "Exact"})
        (self.folder / "scenes.json").write_text(json.dumps(self.scenes))

    def drawn(self, command, **more):
        for png in self.folder.glob("*.png"):
            png.unlink()
        log = self.folder / "log.txt"  # a pipe would be kept open by what MPI leaves behind
        with open(log, "w") as file:
            subprocess.run([*command, str(HERE / "draw.py"), PLUGIN, str(self.folder)], stdout=file, stderr=file,
                           env={**environment(), **more}, timeout=600)  # fmt: skip
        pictures = {}
        for scene in self.scenes:
            file = self.folder / (scene["name"] + ".png")
            if not file.exists():
                raise AssertionError(f"{command}: no picture {scene['name']}\n{log.read_text()[-3000:]}")
            reader = vtkPNGReader()
            reader.SetFileName(str(file))
            reader.Update()
            width, height, _ = reader.GetOutput().GetDimensions()
            values = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())
            pictures[scene["name"]] = values.reshape(height, width, -1)[::-1, :, :3].astype(int)
        return pictures

    def expected(self, scene):
        camera = vtkCamera()
        camera.SetPosition(scene["eye"])
        camera.SetFocalPoint(scene["target"])
        camera.SetViewAngle(scene["angle"])
        if "height" in scene:
            camera.ParallelProjectionOn()
            camera.SetParallelScale(scene["height"] / 2)
        options = {"maximum": ["--mode", "mip"], "clip": ["--clip-plane", "0.1,0,0,1,1,0"],
                   "silhouettes": ["--silhouette", "exact"]}.get(scene["name"], [])  # fmt: skip
        surface = None
        if "sphere" in scene:
            source = vtkSphereSource()
            source.SetCenter(*scene["sphere"][:3])
            source.SetRadius(scene["sphere"][3])
            source.SetThetaResolution(24)
            source.SetPhiResolution(24)
            source.Update()
            surface = source.GetOutput()
            options += ["--surface-color", f"1,{204 / 255},{51 / 255}"]
        picture = program_picture(self.grids[scene["name"]], camera, scene["size"], *options, colors=scene["colors"],
                                  extinction=None, opacity=scene["opacity"], unitDistance=scene["unit"], surface=surface)
        below = np.array(scene["background"])
        return 255 * picture[..., :3] + (1 - picture[..., 3:]) * below


def mpirun(processes):
    return ["mpirun", "--allow-run-as-root", "--oversubscribe", "--bind-to", "none", "-np", str(processes)]


def free_port():
    with socket.socket() as one:
        one.bind(("localhost", 0))
        return one.getsockname()[1]


class ParaView(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.scenes = Scenes()
        cls.serial = cls.scenes.drawn(["pvbatch"])

    def test_serial(self):
        for scene in self.scenes.scenes:
            with self.subTest(scene["name"]):
                picture = self.serial[scene["name"]]
                self.assertGreater(picture.std(), 5)
                difference = np.abs(picture - self.scenes.expected(scene)).max(2)
                if "sphere" in scene:  # VTK rounds the corners of surfaces: a pixel of the outline may be another
                    self.assertLess(np.count_nonzero(difference > 1), 0.005 * difference.size)
                else:
                    self.assertLessEqual(difference.max(), 1)

    def compare(self, pictures):
        for name, picture in pictures.items():
            if name == "maximum":
                continue  # pictures of parts blend into no picture of a maximum
            with self.subTest(name):
                difference = np.abs(picture - self.serial[name]).max(2)
                if name == "silhouettes":  # a cell that a border divides has the colours of two: see the plugin's page
                    self.assertLessEqual(difference.max(), 16)
                    self.assertLess(difference.mean(), 1)
                    continue
                self.assertLessEqual(difference.max(), 3)
                self.assertLess(np.count_nonzero(difference > 2), 1e-4 * difference.size)

    def test_two_processes(self):
        self.compare(self.scenes.drawn([*mpirun(2), "pvbatch"]))

    def test_three_processes(self):
        self.compare(self.scenes.drawn([*mpirun(3), "pvbatch"]))

    def test_a_client_of_a_server(self):
        port = free_port()
        log = self.scenes.folder / "server.txt"
        with open(log, "w") as file:
            server = subprocess.Popen([*mpirun(2), "pvserver", f"--server-port={port}"], env=environment(), stdout=file,
                                      stderr=file)  # fmt: skip
        try:
            for _ in range(120):
                if "Accepting connection" in log.read_text():
                    break
                time.sleep(0.5)
            self.compare(self.scenes.drawn(["pvpython"], SERVER_PORT=str(port)))
        finally:
            server.terminate()
            server.wait(timeout=60)


if __name__ == "__main__":
    unittest.main()

# SPDX-License-Identifier: Apache-2.0
"""What the window shows: the volume before, about and behind opaque geometry, in every view that VTK's cameras have."""
import math
import unittest

import numpy as np
import scenes
from grids import box_grid, program_picture
from scenes import Scene
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkSphereSource
from vtkmodules.vtkRenderingCore import vtkActor, vtkPolyDataMapper, vtkRenderer, vtkWindowToImageFilter

YELLOW = (1.0, 204 / 255, 51 / 255)
BELOW = (51 / 255, 77 / 255, 102 / 255)  # what bytes hold exactly
VIEWS = {
    "corner": {"eye": (3.1, 2.2, 4.3)},
    "corner behind": {"eye": (-3.0, -2.0, -4.0)},
    "above": {"eye": (0.3, 5.5, 0.2), "up": (0, 0, 1)},
    "along an axis": {"eye": (5.5, 0, 0)},
    "aside": {"eye": (2.0, 1.0, 5.0), "target": (0.4, -0.3, 0.2)},
    "rolled": {"eye": (1.0, -3.0, 4.0), "up": (1, 0.3, 0.2)},
    "wide": {"eye": (1.9, 1.4, 1.2), "angle": 80},
    "narrow": {"eye": (30, 20, 40), "angle": 4},
    "within": {"eye": (0.55, 0.4, 0.62), "target": (-0.1, 0, -0.2), "angle": 70},
    "parallel": {"eye": (2, 3, 4), "height": 3.2},
    "parallel along an axis": {"eye": (0, 0, 5), "height": 2.6},
    "parallel, rolled": {"eye": (-4, 1, 2), "up": (0.4, 1, 0.7), "height": 2.2},
}


def spheres(camera):
    """Three on the way of the view: before the grid where there is room, within it and behind."""
    eye, target = np.array(camera.GetPosition()), np.array(camera.GetFocalPoint())
    side = 0.35 * np.cross(eye - target, camera.GetViewUp())
    side *= 1 / np.linalg.norm(np.cross(eye - target, camera.GetViewUp()))
    direction = (eye - target) / np.linalg.norm(eye - target)
    append = vtkAppendPolyData()
    near = min(1.9, 0.75 * np.linalg.norm(eye - target))
    for reach, shift, radius in ((near, 1, 0.12), (0.1, 0, 0.3), (-2.2, -1.5, 0.5)):
        source = vtkSphereSource()
        source.SetCenter(*(target + reach * direction + shift * side))
        source.SetRadius(radius)
        source.SetThetaResolution(24)
        source.SetPhiResolution(24)
        append.AddInputConnection(source.GetOutputPort())
    append.Update()
    return append.GetOutput()


def actor_of(surface, color=YELLOW):
    mapper = vtkPolyDataMapper()
    mapper.SetInputData(surface)
    mapper.ScalarVisibilityOff()
    actor = vtkActor()
    actor.SetMapper(mapper)
    actor.GetProperty().SetColor(*color)
    actor.GetProperty().LightingOff()
    return actor


def outline(mask):
    """Pixels beside which the mask changes."""
    changes = np.zeros(mask.shape, bool)
    changes[1:] |= mask[1:] != mask[:-1]
    changes[:-1] |= mask[1:] != mask[:-1]
    changes[:, 1:] |= mask[:, 1:] != mask[:, :-1]
    changes[:, :-1] |= mask[:, 1:] != mask[:, :-1]
    return changes


class Windows(unittest.TestCase):
    def compare(self, scene, surface, inner_outlines=0.0):
        """Against a ray caster's surface, which knows of no depth buffer. Which pixels the surface covers VTK decides by
        corners that it rounds to 1/256 of a pixel, so its outlines may be off by a pixel. `inner_outlines`: share of
        pixels that may be off within the surface, where it has outlines before itself and samples are mixed."""
        scene.renderer.SetBackground(*BELOW)
        shown = scene.shown()
        color = ",".join(map(str, YELLOW))
        expected = scene.program("--surface-color", color, surface=surface)
        expected = 255 * (expected[..., :3] + (1 - expected[..., 3:]) * np.array(BELOW))
        alone = scene.program("--surface-color", color, extinction=[[0, 0]], surface=surface)[..., 3]
        off = np.abs(shown - expected).max(2) > 1
        self.assertLessEqual(np.count_nonzero(off & ~outline(alone > 0.5)), inner_outlines * off.size)
        self.assertLess(np.count_nonzero(off), 0.01 * off.size)
        return alone

    def test_opaque_geometry_before_within_and_behind(self):
        for name, view in VIEWS.items():
            with self.subTest(name):
                scene = Scene(box_grid(), size=(200, 150))
                scene.look(**view)
                surface = spheres(scene.camera)
                scene.renderer.AddActor(actor_of(surface))
                scene.renderer.ResetCameraClippingRange()
                alone = self.compare(scene, surface)
                self.assertGreater(np.count_nonzero(alone), 300)
                self.assertEqual(scene.mapper.GetOpaquePixels() > 300, True)

    def test_without_geometry(self):
        scene = Scene(box_grid(), size=(200, 150))
        scene.renderer.SetBackground(*BELOW)
        shown = scene.shown()
        drawn = scene.last_picture()
        self.assertEqual(scene.mapper.GetOpaquePixels(), 0)
        expected = 255 * (drawn[..., :3] + (1 - drawn[..., 3:]) * np.array(BELOW))
        self.assertLess(np.abs(shown - expected).max(), 0.6)

    def test_the_window_centre(self):
        """A view whose centre is moved is a part of a larger picture."""
        scene = Scene(box_grid(), size=(160, 120))
        scene.look((3.1, 2.2, 4.3), angle=14)
        scene.camera.SetWindowCenter(0.5, -0.25)
        drawn = scene.picture()
        scene.camera.SetWindowCenter(0, 0)
        scene.camera.SetViewAngle(2 * math.degrees(math.atan(2 * math.tan(math.radians(7)))))
        larger = program_picture(scene.grid, scene.camera, (320, 240))
        part = larger[60 + 15 : 180 + 15, 80 + 40 : 240 + 40]
        self.assertGreater(part[..., 3].max(), 0.1)
        self.assertLess(np.abs(drawn - part).max(), 1e-5)  # pixels of another camera

    def mask_differs(self, scene, prepare=None):
        """Pixels, away from the outline, where an opaque volume does not cover what VTK's own surface of it does."""
        boundary = vtkGeometryFilter()
        boundary.SetInputData(scene.grid)
        boundary.Update()
        scene.opacities.RemoveAllPoints()
        scene.opacities.AddPoint(0, 1e4)
        scene.renderer.ResetCameraClippingRange()
        if prepare:
            prepare()
        scene.window.Render()
        volume = scene.last_picture()[..., 3] > 0.5
        scene.volume.VisibilityOff()
        actor = actor_of(boundary.GetOutput(), (1, 1, 1))
        scene.renderer.AddActor(actor)
        if prepare:
            prepare()
        surface = scene.shown().max(2) > 128
        self.assertGreater(np.count_nonzero(surface), 500)
        self.assertLess(np.count_nonzero(surface), 0.95 * surface.size)
        return np.count_nonzero((volume != surface) & ~outline(surface)) + np.count_nonzero(volume != surface) // 60

    def test_stereo(self):
        scene = Scene(box_grid(3), size=(200, 150))
        scene.window.SetStereoTypeToLeft()
        scene.window.StereoRenderOn()
        scene.camera.SetEyeAngle(6)
        self.assertEqual(self.mask_differs(scene), 0)

    def test_off_axis_projection(self):
        scene = Scene(box_grid(3), size=(200, 150))
        scene.look((0.4, 0.2, 4.5), target=(0.4, 0.2, 0))
        scene.camera.UseOffAxisProjectionOn()
        scene.camera.SetScreenBottomLeft(-2.2, -1.3, -4.5)
        scene.camera.SetScreenBottomRight(1.8, -1.3, -4.5)
        scene.camera.SetScreenTopRight(1.8, 1.7, -4.5)
        self.assertEqual(self.mask_differs(scene, lambda: scene.camera.SetClippingRange(0.5, 20)), 0)

    def test_view_transform(self):
        scene = Scene(box_grid(3), size=(200, 150))
        turn = vtkTransform()
        turn.RotateZ(25)
        turn.Translate(0.3, -0.2, -0.5)
        scene.camera.SetUserViewTransform(turn)
        self.assertEqual(self.mask_differs(scene), 0)

    def test_stretched_and_sheared_views(self):
        for height in (None, 3.5):
            for change in ("stretch", "shear"):
                with self.subTest(change=change, height=height):
                    scene = Scene(box_grid(3), size=(200, 150))
                    scene.look((3.1, 2.2, 4.3), height=height)
                    if change == "stretch":
                        stretch = vtkTransform()
                        stretch.Scale(1, 0.6, 1)
                        scene.camera.SetUserTransform(stretch)
                    else:
                        scene.camera.SetViewShear(0.2, 0.1, 1)
                    self.assertEqual(self.mask_differs(scene), 0)

    def test_horizontal_angle(self):
        scene = Scene(box_grid(3), size=(200, 150))
        scene.camera.UseHorizontalViewAngleOn()
        self.assertEqual(self.mask_differs(scene), 0)

    def test_viewports(self):
        """Two renderers in one window: each has its part."""
        scene = Scene(box_grid(), size=(300, 120))
        scene.renderer.SetViewport(0, 0, 0.5, 1)
        other = vtkRenderer()
        other.SetViewport(0.5, 0, 1, 1)
        other.SetBackground(1, 0, 0)
        scene.window.AddRenderer(other)
        shown = scene.shown()
        expected = program_picture(scene.grid, scene.camera, (150, 120))
        self.assertLess(np.abs(shown[:, :150] - 255 * expected[..., :3]).max(), 1)
        self.assertTrue((shown[:, 150:] == [255, 0, 0]).all())

    def test_tiles(self):
        """A picture of three times the window's size is made of tiles."""
        scene = Scene(box_grid(), size=(100, 80))
        grabber = vtkWindowToImageFilter()
        grabber.SetInput(scene.window)
        grabber.SetScale(3)
        grabber.ReadFrontBufferOff()
        grabber.Update()
        image = grabber.GetOutput()
        values = scenes.vtk_to_numpy(image.GetPointData().GetScalars()).reshape(240, 300, -1)[::-1, :, :3]
        expected = program_picture(scene.grid, scene.camera, (300, 240))
        self.assertLess(np.abs(values - 255 * expected[..., :3]).max(), 1.01)

    def test_multisampling_and_resizing(self):
        scene = Scene(box_grid(), size=(100, 80))
        scene.window.SetMultiSamples(4)
        scene.renderer.AddActor(actor_of(spheres(scene.camera)))
        scene.shown()
        scene.window.SetSize(160, 120)
        scene.size = (160, 120)
        self.compare(scene, spheres(scene.camera), inner_outlines=0.002)

    def test_two_volumes(self):
        """Both are drawn, the second over the first."""
        scene = Scene(box_grid(4))
        other = Scene(box_grid(4))
        first = scene.picture()
        scene.renderer.AddVolume(other.volume)
        shown = scene.shown()
        both = first[..., :3] + (1 - first[..., 3:]) * first[..., :3]
        self.assertLess(np.abs(shown - 255 * both).max(), 2)


if __name__ == "__main__":
    unittest.main()

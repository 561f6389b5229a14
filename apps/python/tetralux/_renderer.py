# SPDX-License-Identifier: Apache-2.0
"""One object for many pictures, one call for one."""

from __future__ import annotations

import atexit
import threading
import weakref
from collections.abc import Callable, Sequence
from typing import Any, Optional

import numpy as np
import numpy.typing as npt

from . import _core
from ._arrays import array_of, points_array, index_array, whole_array
from ._camera import View, size_of, triple
from ._errors import InputError
from ._fields import choose
from ._image import Image
from ._mesh import Source, as_mesh
from ._words import clim_of, color_of, function_of_words, lighting_of, transfer_function_of

_UNSET: Any = object()
_WORDS = ("transfer_function", "cmap", "opacity", "clim", "opacity_unit_distance", "log_scale")


_open: weakref.WeakSet[Renderer] = weakref.WeakSet()


@atexit.register
def _close_all() -> None:
    """Before the interpreter ends: no frame may still be on its way when it does."""
    for renderer in list(_open):
        renderer._core.close()


class Renderer:
    """Draws one mesh again and again and keeps what can be kept: another camera costs a frame, another transfer
    function, light or cut little more, another field a search of the mesh's gradients.

    Every parameter but ``mesh``, ``engine``, ``context`` and ``threads`` is a property too, to be changed between
    frames, and is explained at `render`. A renderer draws one frame at a time, in a thread of its own; give each of
    your threads a renderer, they share the mesh.

    Examples
    --------
    >>> import tetralux
    >>> renderer = tetralux.Renderer(tetralux.read("bucky:16"), size=(64, 48))
    >>> renderer.transfer_function = "viridis"
    >>> renderer.render(eye=(2, 1, 3)).rgba.shape
    (48, 64, 4)
    """

    def __init__(
        self,
        mesh: Source,
        scalars: Any = None,
        *,
        transfer_function: Any = None,
        cmap: Any = None,
        opacity: Any = None,
        clim: Any = None,
        opacity_unit_distance: Optional[float] = None,
        log_scale: bool = False,
        mode: str = "standard",
        size: Sequence[int] = (1024, 768),
        eye: Optional[Sequence[float]] = None,
        target: Optional[Sequence[float]] = None,
        up: Optional[Sequence[float]] = None,
        fov: float = 30.0,
        height: Optional[float] = None,
        view: Optional[str] = None,
        zoom: float = 1.0,
        silhouette: Any = False,
        lights: Any = None,
        samples: int = 1,
        background: Any = None,
        clip: Sequence[Any] = (),
        surfaces: Sequence[Any] = (),
        engine: str = "auto",
        context: str = "auto",
        threads: int = 0,
    ) -> None:
        self._mesh = as_mesh(mesh)
        try:
            self._core = _core.Renderer(self._mesh._core, engine, context, threads)
        except TypeError:
            raise InputError("renderer: give engine and context as texts and threads as a whole number") from None
        _open.add(self)
        self._lock = threading.RLock()
        self._teller: Optional[int] = None  # the thread in which progress is told
        self._changed: set[str] = set()
        self._title = ""
        self._last: Optional[tuple[_core.Camera, npt.NDArray[np.float32]]] = None
        self.scalars = scalars
        self.transfer_function = transfer_function
        self.cmap = cmap
        self.opacity = opacity
        self.clim = clim
        self.opacity_unit_distance = opacity_unit_distance
        self.log_scale = log_scale
        self.mode = mode
        self.silhouette = silhouette
        self.lights = lights
        self.samples = samples
        self.clip = clip
        self.surfaces = surfaces
        self.background = background
        self.size = size
        self.eye, self.target, self.up = eye, target, up
        self.fov, self.height = fov, height
        self.view, self.zoom = view, zoom

    @property
    def mesh(self) -> Any:
        """The mesh that is drawn."""
        return self._mesh

    @property
    def engine(self) -> str:
        """What draws: "cpu", "gl", "reference"."""
        return self._core.names()[0]

    def __setattr__(self, name: str, value: Any) -> None:
        same = name != "scalars" and isinstance(value, (str, int, float, type(None))) and name in self.__dict__
        if not (same and type(value) is type(self.__dict__[name]) and value == self.__dict__[name]):
            self.__dict__.setdefault("_changed", set()).add(name)
        super().__setattr__(name, value)

    def _send(self, names: tuple[str, ...], send: Callable[[], None]) -> None:
        """Passes on what has been assigned since it was last passed on."""
        if self._changed.isdisjoint(names):
            return
        send()
        self._changed.difference_update(names)

    def _field(self, scalars: Any) -> _core.Field:
        chosen = choose(self._mesh, scalars)
        self._title = chosen.title
        return _core.Field.of(chosen.values, chosen.on_points)

    def _update(self) -> None:
        core = self._core
        self._send(("scalars",), lambda: core.set_field(self._field(self.scalars)))
        self._send(_WORDS, lambda: core.set_transfer_function(self._function()))
        self._send(("mode",), lambda: core.set_mode(_text("mode", self.mode)))
        self._send(("silhouette",), lambda: core.set_silhouettes(_silhouette(self.silhouette)))
        self._send(("lights",), lambda: core.set_lighting(lighting_of(self.lights)))
        self._send(("samples",), lambda: core.set_samples(_whole("samples", self.samples)))
        self._send(("clip",), lambda: core.set_cuts(_cuts(self.clip)))
        self._send(("surfaces",), lambda: core.set_surfaces(_surfaces(self.surfaces)))

    def _function(self) -> Optional[_core.TransferFunction]:
        words = self.cmap, self.opacity, self.clim, self.opacity_unit_distance, self.log_scale
        if self.transfer_function is None:
            document = function_of_words(*words)
            return None if document is None else transfer_function_of(document)
        if any(each is not None for each in (self.cmap, self.opacity, self.opacity_unit_distance)) or self.log_scale:
            raise InputError(
                "transfer_function: it has colours and opacity of its own; leave it out, or cmap, opacity, "
                "opacity_unit_distance and log_scale"
            )
        function = transfer_function_of(self.transfer_function)
        clim = clim_of(self.clim)
        return function if clim is None else function.stretched(*clim)

    def render(
        self,
        *,
        size: Any = _UNSET,
        eye: Any = _UNSET,
        target: Any = _UNSET,
        up: Any = _UNSET,
        fov: Any = _UNSET,
        height: Any = _UNSET,
        view: Any = _UNSET,
        zoom: Any = _UNSET,
        window_center: tuple[float, float] = (0.0, 0.0),
        progress: Optional[Callable[[float], Any]] = None,
        budget: float = 0.0,
        depth_limit: Optional[npt.ArrayLike] = None,
    ) -> Image:
        """One picture; a camera given here counts for this picture only.

        Parameters
        ----------
        size, eye, target, up, fov, height, view, zoom
            As at `tetralux.render`; where not given, the renderer's own.
        window_center : (float, float)
            Where the picture's middle lies beside the optical axis: half widths to the right, half heights up.
        progress : callable, optional
            Called with the share that is done, 0 … 1. What it raises ends the frame.
        budget : float, milliseconds
            Above 0: a coarser picture rather than a later one.
        depth_limit : (height, width) float32, optional
            The volume ends at this distance along each pixel's ray (mesh units from the eye; orthographic: from the
            eye's plane); infinite where nothing stands. For opaque objects of your own.

        Raises
        ------
        ValueError, KeyError, tetralux.Error
            KeyboardInterrupt ends a frame within 50 ms, CancelledError after `cancel`.
        """
        self._check_thread()
        with self._lock:
            self._update()
            width, rows = size_of(self.size if size is _UNSET else size)
            seen = View(
                self.eye if eye is _UNSET else eye,
                self.target if target is _UNSET else target,
                self.up if up is _UNSET else up,
                self.fov if fov is _UNSET else fov,
                self.height if height is _UNSET else height,
                window_center,
                self.view if view is _UNSET else view,
                self.zoom if zoom is _UNSET else zoom,
            )
            camera = seen.camera(self._core, self._mesh, (width, rows))
            background = self._background()
            rgba = np.empty((rows, width, 4), np.float32)
            report = self._core.render(rgba, camera, self._told(progress), float(budget), _depth(depth_limit, rows, width))
            self._last = camera, rgba
        report["field"] = self._title
        image = Image(rgba, report)
        return image if background is None else image.over(background)

    def _told(self, progress: Optional[Callable[[float], Any]]) -> Optional[Callable[[float], Any]]:
        if progress is None:
            return None

        def tell(share: float) -> None:
            self._teller = threading.get_ident()
            progress(share)

        return tell

    def _check_thread(self) -> None:
        """The thread that draws cannot wait for itself."""
        if self._teller == threading.get_ident():
            raise InputError("progress: it must not ask the renderer that it tells of; take another renderer there")

    def _background(self) -> Optional[tuple[float, float, float]]:
        if self.background is None:  # a radiograph is black without light behind it
            return (1.0, 1.0, 1.0) if self.mode == "absorption" else None
        if isinstance(self.background, str) and self.background == "none":
            return None
        return color_of("background", self.background)

    def verify(self, pixels: int = 1000) -> dict[str, Any]:
        """How far the last picture is from the exact one, by so many of its pixels computed again in double precision.

        Returns rmse, max (over RGBA in [0, 1]), bound95 (of the rmse of all pixels, 95 % sure), pixels, unseen_share.
        """
        self._check_thread()
        with self._lock:
            if self._last is None:
                raise InputError("verify: there was no picture yet; render one first")
            self._update()
            return self._core.verify(self._last[1], self._last[0], _whole("pixels", pixels))

    def probe(self, x: int, y: int) -> dict[str, Any]:
        """What the ray through pixel (x, y) of the last picture meets, row 0 at the top.

        Returns hit, and where anything first shows: distance from the eye, position, scalar (all of them of the field
        and in mesh units), and segments: (begin, end, scalar at begin, scalar at end, alpha) nearest first.
        """
        self._check_thread()
        with self._lock:
            if self._last is None:
                raise InputError("probe: there was no picture yet; render one first")
            return self._core.probe(self._last[0], int(x), int(y))

    def cancel(self) -> None:
        """Ends the frame that another thread waits for: its `render` raises CancelledError."""
        self._core.cancel()


def _text(what: str, value: Any) -> str:
    if not isinstance(value, str):
        raise InputError(f"{what}: {value!r} will not do; give a text")
    return value


def _whole(what: str, value: Any) -> int:
    if isinstance(value, (int, np.integer)) and 0 <= value < 2**31:
        return int(value)
    raise InputError(f"{what}: {value!r} will not do; give a whole number")


def _silhouette(value: Any) -> str:
    return "none" if value in (False, None) else "exact" if value is True else _text("silhouette", value)


def _cuts(planes: Any) -> list[tuple[Any, Any]]:
    try:
        return [(triple("clip", point), triple("clip", normal)) for point, normal in planes]
    except (TypeError, ValueError) as error:
        if isinstance(error, InputError):
            raise
        raise InputError(f"clip: {planes!r} will not do; give planes as [(point, normal), …]") from None


def _surfaces(surfaces: Any) -> list[tuple[Any, ...]]:
    result = []
    for surface in surfaces:
        if not isinstance(surface, dict) or not {"points", "triangles"} <= set(surface):
            raise InputError("surfaces: give mappings with points, triangles, and color or flat where wanted")
        points = points_array(surface["points"])
        triangles = whole_array("triangles", surface["triangles"])
        if triangles.ndim != 2 or triangles.shape[1] != 3:
            raise InputError(f"triangles: their shape is {triangles.shape}; give (m, 3)")
        numbers = index_array("triangles", triangles, len(points))
        color = color_of("surfaces", surface.get("color", (0.8, 0.8, 0.8)))
        result.append((points, numbers, color, bool(surface.get("flat", False))))
    return result


def _depth(limit: Any, height: int, width: int) -> Any:
    if limit is None:
        return None
    array = array_of("depth_limit", limit)
    if array.shape != (height, width):
        raise InputError(f"depth_limit: its shape is {array.shape}; give (height, width), here ({height}, {width})")
    return np.ascontiguousarray(array, dtype=np.float32)


def render(
    mesh: Source,
    scalars: Any = None,
    *,
    transfer_function: Any = None,
    cmap: Any = None,
    opacity: Any = None,
    clim: Any = None,
    opacity_unit_distance: Optional[float] = None,
    log_scale: bool = False,
    mode: str = "standard",
    size: Sequence[int] = (1024, 768),
    eye: Optional[Sequence[float]] = None,
    target: Optional[Sequence[float]] = None,
    up: Optional[Sequence[float]] = None,
    fov: float = 30.0,
    height: Optional[float] = None,
    view: Optional[str] = None,
    zoom: float = 1.0,
    silhouette: Any = False,
    lights: Any = None,
    samples: int = 1,
    background: Any = None,
    clip: Sequence[Any] = (),
    surfaces: Sequence[Any] = (),
    engine: str = "auto",
    context: str = "auto",
    threads: int = 0,
    progress: Optional[Callable[[float], Any]] = None,
) -> Image:
    """One picture of a mesh.

    Parameters
    ----------
    mesh : Mesh, path, dataset of PyVista or VTK, or meshio.Mesh
    scalars : str or array_like, optional
        Field: "T", "velocity" (magnitude), "velocity:x", "T@cells"; or one number for each point or cell. None: the
        dataset's active scalars, else the first field.
    transfer_function : str, path or mapping, optional
        A preset's name, a file, or what the file holds: {"normalized": True, "color": [[s, r, g, b], …], "extinction":
        [[s, tau], …], "isosurfaces": [{"value": v, "opacity": a, "color": [r, g, b]}, …]}; tau per mesh unit. None, and
        no words: one that shows the mesh.
    cmap : str, list of colours, or colour map of matplotlib, optional
        Names are matplotlib's and ParaView's, "_r" at the end reverses.
    opacity : str or sequence of float, optional
        "linear", "geom", "sigmoid", "sigmoid_5", "foreground", …, "_r" at the end reverses; or α from 0 to 1 at equal
        distances over the range. α is that of a piece as long as ``opacity_unit_distance``.
    clim : (float, float), optional
        Scalars of the first and the last colour; None: the field's range.
    opacity_unit_distance : float, mesh units, optional
        d in τ = −ln(1 − α)/d; None: a fiftieth of the mesh's diagonal.
    log_scale : bool, default False
        Colours and opacity over the logarithm of the scalar.
    mode : str, default "standard"
        "standard", "scale-invariant", "mip", "minimum", "average", "additive", "additive-scale-invariant", "emission",
        "absorption", "first-hit", "depth".
    size : (int, int), pixels, default (1024, 768)
        Width and height.
    eye, target, up : (float, float, float), mesh units, optional
        Camera; None: a three-quarter view that holds the mesh, y up.
    fov : float, degrees, default 30
        Vertical field of view.
    height : float, mesh units, optional
        Makes the view orthographic: so much over the picture's height.
    view : str, optional
        "xy", "yx", "xz", "zx", "yz", "zy" and "iso" as PyVista has them, "x", "-x", …: from that side, fitted tightly to
        what shows. Not together with an eye.
    zoom : float, default 1
        Above 1: nearer, by a smaller field of view (or height).
    silhouette : bool or "approximate", default False
        Layers seen edge-on become denser.
    lights : optional
        "headlight", a direction (x, y, z) towards the light, a list of these, or a mapping or .json file with lights,
        material, shadows. None: colours are emitted as they are.
    samples : int, 1 to 64, default 1
        Rays a pixel.
    background : (r, g, b), "#rrggbb" or a name, optional
        Put under the picture. None: nothing (white in mode "absorption"); "none": nothing.
    clip : sequence of (point, normal), optional
        Planes; only the side towards which the normal points is shown.
    surfaces : sequence of mappings, optional
        Opaque triangles: points (n, 3), triangles (m, 3), color, flat (unlit).
    engine, context : str, default "auto"
        See `tetralux.engines`; context of OpenGL: "egl", "osmesa".
    threads : int, default 0
        0: as many as the machine has.
    progress : callable, optional
        Called with the share that is done, 0 … 1.

    Returns
    -------
    Image
        The picture of ``tetralux render`` with the same words, to the bit.

    Raises
    ------
    ValueError
        For what is not as said above. KeyError, naming the nearest field, where there is no such field. tetralux.Error
        for what this machine cannot do.
    """
    renderer = Renderer(
        mesh,
        scalars,
        transfer_function=transfer_function,
        cmap=cmap,
        opacity=opacity,
        clim=clim,
        opacity_unit_distance=opacity_unit_distance,
        log_scale=log_scale,
        mode=mode,
        size=size,
        eye=eye,
        target=target,
        up=up,
        fov=fov,
        height=height,
        view=view,
        zoom=zoom,
        silhouette=silhouette,
        lights=lights,
        samples=samples,
        background=background,
        clip=clip,
        surfaces=surfaces,
        engine=engine,
        context=context,
        threads=threads,
    )
    return renderer.render(progress=progress)

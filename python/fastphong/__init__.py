"""Phong shading on a scanline rasterizer, with an f64 reference to check it against.

>>> import fastphong as fp
>>> picture = fp.render("builtin:teapot", size=(320, 240))
>>> picture.shape
(240, 320, 4)
"""

from __future__ import annotations

import os
import warnings
from collections.abc import Iterable
from typing import TYPE_CHECKING, Any, SupportsFloat, SupportsIndex

import numpy as np

from . import _fastphong, _keys
from ._meshes import Mesh
from ._pictures import Difference, Picture, picture as _picture, read as _read

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._types import Encoding, Image, Keys, Light, Look, MeshLike, Normals, PathLike, Size, Vector, View

__all__ = [
    "Difference", "Mesh", "Picture", "Scene", "diff", "methods", "read_picture", "render", "vertex_normals",
]

__version__ = "0.1.0"


def _warn(texts: Iterable[str], level: int) -> None:
    for text in texts:
        warnings.warn(text, stacklevel=level + 1)


class Scene:
    """A mesh or a scene file that is prepared once and drawn many times.

    It accepts the arguments of `render`. Several threads may draw a scene at the same time. The first picture warns
    about everything in `warnings`. Scenes can be pickled: that of a file as the path, others with their mesh.
    """

    def __init__(
        self,
        mesh: MeshLike,
        *,
        size: Size | None = None,
        view: View | None = None,
        up: str | Vector | None = None,
        fovy: SupportsFloat | None = None,
        light: Light | None = None,
        background: SupportsFloat | Vector | None = None,
        normals: Normals | None = None,
        weight: str | None = None,
        weld: SupportsFloat | None = None,
        colours: bool | ArrayLike | None = None,
        samples: SupportsIndex | None = None,
        scene: Keys | None = None,
        look: Look = "shown",
    ) -> None:
        _keys.text("look", look)
        array = colours if colours is not None and not isinstance(colours, (bool, np.bool_)) else None
        settings = _keys.settings(
            size=size, view=view, up=up, fovy=fovy, light=light, background=background, normals=normals,
            weight=weight, weld=weld, colours=colours if array is None else None, samples=samples, scene=scene)
        if isinstance(mesh, (str, bytes, os.PathLike)):
            if array is not None:
                raise TypeError("`colours` is for arrays, but a file has its own: expected True or False")
            self._open(os.fsdecode(mesh), settings, look, [])
        else:
            # The first picture tells the warnings of a mesh that is made here.
            made = Mesh(mesh, colours=array, _level=None)
            self._open(made, settings, look, made.warnings if isinstance(mesh, Mesh) else [])

    def _open(self, source: str | Mesh, settings: str, look: Look, told: list[str] | None) -> None:
        # What `pickle` keeps.
        self._made = (source, settings, look)
        # Warnings that the caller was given before, or None once all were given.
        self._told = told
        if isinstance(source, Mesh):
            self._scene = _fastphong.Scene.of_mesh(source._mesh, settings, look)
        else:
            self._scene = _fastphong.Scene.load(source, settings, look)

    def __reduce__(self) -> Any:
        return _opened, (*self._made, self._told)

    @property
    def size(self) -> tuple[int, int]:
        """The width and the height of the scene's pictures."""
        return self._scene.size

    @property
    def warnings(self) -> list[str]:
        """Warnings to read before you trust a picture, a list of sentences.

        The first use computes them, which takes as long as a picture of the reference.
        """
        return self._scene.warnings

    @property
    def notes(self) -> list[str]:
        """Notes on what the scene leaves unused and on what it chose automatically, a list of sentences."""
        return self._scene.notes

    def render(
        self,
        method: str = "auto",
        *,
        size: Size | None = None,
        view: View | None = None,
        up: str | Vector | None = None,
        fovy: SupportsFloat | None = None,
        light: Light | None = None,
        samples: SupportsIndex | None = None,
        keep_scale: bool = False,
        _level: int = 1,
    ) -> Picture:
        """Return a picture. Arguments that you leave out keep the scene's values.

        The camera is fitted again, unless `keep_scale` is true: then it turns around its target, as for turntables.
        """
        settings = _keys.settings(size=size, view=view, up=up, fovy=fovy, light=light, samples=samples)
        method = _keys.text("method", method)
        picture = _picture(*self._scene.render(method, settings, bool(keep_scale)))
        told, self._told = self._told, None
        if told is not None:
            _warn([text for text in self.warnings if text not in told], _level + 1)
        return picture

    def __repr__(self) -> str:
        return "<Scene: {}x{} pixels>".format(*self.size)


def _opened(source: str | Mesh, settings: str, look: Look, told: list[str] | None) -> Scene:
    """Return the scene that was pickled."""
    scene = Scene.__new__(Scene)
    scene._open(source, settings, look, told)
    return scene


def render(
    mesh: MeshLike,
    method: str = "auto",
    size: Size | None = None,
    view: View | None = None,
    up: str | Vector | None = None,
    fovy: SupportsFloat | None = None,
    light: Light | None = None,
    background: SupportsFloat | Vector | None = None,
    normals: Normals | None = None,
    weight: str | None = None,
    weld: SupportsFloat | None = None,
    colours: bool | ArrayLike | None = None,
    samples: SupportsIndex | None = None,
    scene: Keys | None = None,
    look: Look = "shown",
) -> Picture:
    """Return a picture of a mesh: a new array of (height, width, 4) bytes.

    mesh: the path of a mesh file or a scene file, "builtin:teapot", the name of a shipped scene, a
        trimesh.Trimesh, pyvista.PolyData or meshio.Mesh, a tuple (vertices, faces) or (vertices, faces, normals),
        or a Mesh.
    method: a name of `methods()`, "auto", or "reference".
    size: (width, height) in pixels. Meshes have (640, 480) by default.
    view: the direction to look from: (azimuth, elevation) in degrees, or a vector (x, y, z) toward the eye.
    up: "y", "z", "-x" ... turns the view and the light with the mesh; a vector turns only the picture.
    fovy: the vertical field of view in degrees. It makes the picture perspective.
    light: a vector toward a light, a mapping with the keys of a light, or a list of these.
    background: a linear colour, 0 to 1, which makes the picture opaque. Without it the background is the look's.
    normals: "auto", "averaged", "given", or an angle in degrees up to which edges are smooth.
    weight: the weight of averaged normals: "uniform", "area", "angle" or "max".
    weld: merge vertices that are closer than this fraction of the mesh's size, as 1e-6, so that normals are averaged
        across them.
    colours: true to light the mesh's colours, false to ignore them; or the colours of arrays, as for `Mesh`.
    samples: the samples per pixel along each side: 1, 2, 4 or 8.
    scene: a mapping with further keys of a scene file.
    look: how a mesh looks without a scene file. "shown" draws it as `fastphong render` does: two lights, a dark
        background, sRGB, and 2 x 2 samples per pixel if they cost little. "compared" is for measuring: one white light,
        linear levels, one sample, a transparent background. Other arguments override both.

    It warns (`warnings.warn`) of what you should know before you trust the picture: see `Scene.warnings`.
    """
    kept = Scene(mesh, size=size, view=view, up=up, fovy=fovy, light=light, background=background, normals=normals,
                 weight=weight, weld=weld, colours=colours, samples=samples, scene=scene, look=look)
    return kept.render(method, _level=2)


def read_picture(path: PathLike) -> Picture:
    """Read a picture file in 8 bits. `diff` compares files as they are stored, unrounded."""
    return _read(path, 2)


def diff(a: Image, b: Image, assume: Encoding | None = None) -> Difference:
    """Return the `Difference` of two pictures: arrays of bytes, or paths of picture files.

    assume: the encoding of pictures that state none, "linear" or "srgb". Without it, files are sRGB, PFM files linear,
        and arrays as the other picture.
    """
    return Difference(a, b, assume, _level=2)


def vertex_normals(
    mesh: MeshLike,
    normals: Normals | None = None,
    weight: str | None = None,
    weld: SupportsFloat | None = None,
    *,
    per: str = "vertex",
) -> NDArray[np.float32]:
    """Return unit normals, (n, 3) floats: one for each vertex, or one for each corner of each face in order.

    `normals`, `weight` and `weld` are as in `render`. If the corners at a vertex have different normals, as at a crease,
    `per="vertex"` raises a `ValueError`.
    """
    if per not in ("vertex", "corner"):
        raise ValueError(f"`per` is {per!r}: expected 'vertex' or 'corner'")
    mesh = mesh if isinstance(mesh, Mesh) else Mesh(mesh, _level=2)
    settings = _keys.settings(normals=normals, weight=weight, weld=weld)
    values, entries = _fastphong.vertex_normals(mesh._mesh, settings)
    by_corner: NDArray[np.float32] = np.frombuffer(values, "<f4").reshape(-1, 3)[np.frombuffer(entries, "<u4")]
    if per == "corner":
        return by_corner
    corners = mesh._corners
    by_vertex = np.zeros((len(mesh.vertices), 3), np.float32)
    by_vertex[corners] = by_corner
    differs = np.flatnonzero((by_vertex[corners] != by_corner).any(axis=1))
    if differs.size:
        vertex = corners[differs[0]]
        raise ValueError(f"the corners at vertex {vertex} have different normals: ask for per='corner'")
    return by_vertex


def methods(all: bool = False) -> dict[str, str]:
    """Return what each method does, by its name. With `all`, include methods that are hidden by default."""
    return dict(_fastphong.methods(bool(all)))

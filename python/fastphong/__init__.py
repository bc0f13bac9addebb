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
from typing import TYPE_CHECKING

import numpy as np

from . import _fastphong, _keys
from ._meshes import Mesh
from ._pictures import Difference, Picture, picture as _picture, read as read_picture

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ._types import Image, Keys, Light, MeshLike, Normals, Size, Vector, View

__all__ = [
    "Difference", "Mesh", "Picture", "Scene", "diff", "methods", "read_picture", "render", "vertex_normals",
]

__version__ = "0.1.0"


def _warn(texts: Iterable[str], level: int) -> None:
    for text in texts:
        warnings.warn(text, stacklevel=level + 1)


class Scene:
    """A mesh, or a scene file, that is prepared once and drawn as often as you like.

    Takes the arguments of `render`. Several threads may draw one scene, one picture at a time.
    """

    def __init__(
        self,
        mesh: MeshLike,
        *,
        size: Size | None = None,
        view: View | None = None,
        up: str | Vector | None = None,
        fovy: float | None = None,
        light: Light | None = None,
        background: float | Vector | None = None,
        normals: Normals | None = None,
        weight: str | None = None,
        colours: bool | None = None,
        samples: int | None = None,
        scene: Keys | None = None,
        _level: int = 1,
    ) -> None:
        settings = _keys.settings(
            size=size, view=view, up=up, fovy=fovy, light=light, background=background, normals=normals,
            weight=weight, colours=colours, samples=samples, scene=scene)
        if isinstance(mesh, (str, bytes, os.PathLike)):
            self._scene = _fastphong.Scene.load(os.fsdecode(mesh), settings)
        else:
            self._scene = _fastphong.Scene.of_mesh(Mesh(mesh)._mesh, settings)
        _warn(self._scene.warnings, _level + 1)

    @property
    def size(self) -> tuple[int, int]:
        """Width and height of its pictures."""
        return self._scene.size

    @property
    def warnings(self) -> list[str]:
        """Warnings to read before trusting a picture, a list of sentences."""
        return self._scene.warnings

    @property
    def notes(self) -> list[str]:
        """Notes on what the scene leaves unused, or decided itself, a list of sentences."""
        return self._scene.notes

    def render(
        self,
        method: str = "auto",
        *,
        size: Size | None = None,
        view: View | None = None,
        up: str | Vector | None = None,
        fovy: float | None = None,
        light: Light | None = None,
        samples: int | None = None,
        keep_scale: bool = False,
    ) -> Picture:
        """Return a picture; what is not given is as the scene was made.

        The camera is fitted anew, unless `keep_scale` turns it around the point that it looks at: for turntables.
        """
        settings = _keys.settings(size=size, view=view, up=up, fovy=fovy, light=light, samples=samples)
        return _picture(*self._scene.render(method, settings, bool(keep_scale)))

    def __repr__(self) -> str:
        return "<Scene: {}x{} pixels>".format(*self.size)


def render(
    mesh: MeshLike,
    method: str = "auto",
    size: Size | None = None,
    view: View | None = None,
    up: str | Vector | None = None,
    fovy: float | None = None,
    light: Light | None = None,
    background: float | Vector | None = None,
    normals: Normals | None = None,
    weight: str | None = None,
    colours: bool | None = None,
    samples: int | None = None,
    scene: Keys | None = None,
) -> Picture:
    """Return a picture of a mesh: an array of (height, width, 4) bytes that nothing else refers to.

    mesh: the path of a mesh file or a scene file, "builtin:teapot", the name of a shipped scene, a
        trimesh.Trimesh, pyvista.PolyData or meshio.Mesh, a tuple (vertices, faces) or (vertices, faces, normals),
        or a Mesh.
    method: a name of `methods()`, "auto", or "reference".
    size: (width, height) in pixels, (640, 480) for meshes.
    view: from where to look: (azimuth, elevation) in degrees, or a vector (x, y, z) toward the eye.
    up: "y", "z", "-x" ... turns view and light with it; a vector turns only the picture.
    fovy: the vertical field of view in degrees, for a perspective picture.
    light: a vector toward a light, a mapping with keys of a light, or a list of these.
    background: a colour, linear, 0 to 1, which makes the picture opaque; without it, it is transparent.
    normals: "auto", "averaged", "given", or an angle in degrees up to which edges are smooth.
    weight: the weight of averages: "uniform", "area", "angle" or "max".
    colours: whether colours at vertices are lit.
    samples: 1, 2, 4 or 8: samples of a pixel along each side.
    scene: a mapping with further keys of a scene file.
    """
    kept = Scene(mesh, size=size, view=view, up=up, fovy=fovy, light=light, background=background, normals=normals,
                 weight=weight, colours=colours, samples=samples, scene=scene, _level=2)
    return kept.render(method)


def diff(a: Image, b: Image) -> Difference:
    """Return the `Difference` of two pictures: arrays of bytes, or paths of picture files."""
    return Difference(a, b)


def vertex_normals(
    mesh: MeshLike, normals: Normals | None = None, weight: str | None = None, *, per: str = "vertex"
) -> NDArray[np.float32]:
    """Return unit normals, (n, 3) floats: one for each vertex, or one for each corner of each face in order.

    `normals` and `weight` are as in `render`. Where the corners at a vertex differ, as at a crease, `per="vertex"` is a
    `ValueError`.
    """
    if per not in ("vertex", "corner"):
        raise ValueError(f"`per` is {per!r}: expected 'vertex' or 'corner'")
    mesh = mesh if isinstance(mesh, Mesh) else Mesh(mesh, _level=2)
    source, crease = _keys.source(normals)
    values, entries = _fastphong.vertex_normals(mesh._mesh, source, crease, weight)
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
    """Return the methods: what each does, by its name. With `all`, those too that are shown only where asked for."""
    return dict(_fastphong.methods(bool(all)))

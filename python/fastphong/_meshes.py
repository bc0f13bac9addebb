"""Turns meshes of other libraries, and arrays, into the crate's meshes.

This file imports no other library: it recognises an object by its attributes.
"""

from __future__ import annotations

import itertools
import os
import warnings
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _fastphong

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._types import Faces, MeshLike

    _Array = NDArray[Any]


class Mesh:
    """A mesh of polygons, checked once.

    `Mesh(mesh)` accepts whatever `render` accepts except scene files; `Mesh(vertices, faces)` accepts arrays.
    `faces` are rows of indices, (n, k), or a list of rows whose lengths differ. Polygons are never cut into
    triangles. `normals` are (n, 3), one for each vertex or one for each corner of all faces in order.
    `colours` are (n, 3) or (n, 4), one for each vertex or one for each face. They are bytes, or linear floats
    from 0 to 1; alpha is ignored.
    """

    def __init__(
        self,
        mesh: MeshLike | ArrayLike,
        faces: Faces | None = None,
        normals: ArrayLike | None = None,
        colours: ArrayLike | None = None,
        *,
        _level: int = 1,
    ) -> None:
        is_file = isinstance(mesh, (str, bytes, os.PathLike))
        if (is_file or isinstance(mesh, Mesh)) and not (faces is normals is colours is None):
            raise TypeError(f"{'a file' if is_file else 'a Mesh'} has its own faces, normals and colours: expected arrays")
        if isinstance(mesh, (str, bytes, os.PathLike)):
            self._mesh = _fastphong.Mesh.load(os.fsdecode(mesh))
            for text in self._mesh.warnings:
                warnings.warn(text, stacklevel=_level + 1)
        elif isinstance(mesh, Mesh):
            self._mesh = mesh._mesh
        else:
            name, arrays = ("mesh", (mesh, faces)) if faces is not None else _arrays(mesh)
            vertices, faces, *rest = arrays
            rest += [None] * (2 - len(rest))
            normals = rest[0] if normals is None else normals
            colours = rest[1] if colours is None else colours
            self._mesh = _pack(name, vertices, faces, normals, colours)

    @property
    def vertices(self) -> NDArray[np.float64]:
        """The vertices: (n, 3) floats."""
        return np.frombuffer(self._mesh.vertices, "<f8").reshape(-1, 3)

    @property
    def faces(self) -> NDArray[np.uint32] | list[NDArray[np.uint32]]:
        """The faces: an array (n, k) if all have the same number of corners, else a list of arrays."""
        corners, ends = self._corners, np.frombuffer(self._mesh.ends, "<u4")
        counts = np.diff(ends, prepend=np.uint32(0))
        if len(counts) and (counts == counts[0]).all():
            return corners.reshape(len(counts), counts[0])
        return np.split(corners, ends[:-1]) if len(ends) else corners.reshape(0, 3)

    @property
    def warnings(self) -> list[str]:
        """Warnings about the mesh's file, a list of sentences."""
        return self._mesh.warnings

    @property
    def _corners(self) -> NDArray[np.uint32]:
        return np.frombuffer(self._mesh.corners, "<u4")

    def __repr__(self) -> str:
        vertices, faces = len(self._mesh.vertices) // 24, len(self._mesh.ends) // 4
        return f"<Mesh: {vertices} vertices, {faces} faces>"


def _arrays(mesh: Any) -> tuple[str, Sequence[Any]]:
    """Return a name for a mesh, and its vertices, faces, normals and colours."""
    kind = f"{type(mesh).__module__.split('.')[0]}.{type(mesh).__name__}"
    if isinstance(mesh, (tuple, list)):
        if len(mesh) not in (2, 3):
            raise TypeError(f"a mesh of {len(mesh)} parts: expected (vertices, faces) or (vertices, faces, normals)")
        return "mesh", mesh
    if hasattr(mesh, "geometry") and hasattr(mesh, "to_mesh"):
        return kind, _trimesh(mesh.to_mesh())
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return kind, _trimesh(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return kind, _poly_data(mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "extract_surface"):
        with warnings.catch_warnings():
            # pyvista announces a new default, which changes no surface.
            warnings.filterwarnings("ignore", message="The default value of `algorithm`")
            surface = mesh.extract_surface()
        return kind, _poly_data(surface)
    if hasattr(mesh, "points") and isinstance(getattr(mesh, "cells", None), list):
        return kind, _meshio(mesh)
    raise TypeError(
        f"{kind} is no mesh: expected a path, (vertices, faces), trimesh.Trimesh, pyvista.PolyData, meshio.Mesh or Mesh"
    )


def _trimesh(mesh: Any) -> tuple[Any, ...]:
    """Return the arrays of a `trimesh.Trimesh`.

    Its normals are left out: it computes them on demand, and does not say if they are the mesh's own.
    """
    visual: Any = getattr(mesh, "visual", None)
    colours = None
    if getattr(visual, "kind", None) == "vertex":
        colours = visual.vertex_colors
    elif getattr(visual, "kind", None) == "face":
        colours = visual.face_colors
    return mesh.vertices, mesh.faces, None, colours


def _poly_data(mesh: Any) -> tuple[Any, ...]:
    """Return the arrays of a `pyvista.PolyData`: its polygons and strips. Lines and points are left out."""
    faces = _prefixed("faces", mesh.faces)
    strips = getattr(mesh, "strips", None)
    if strips is not None and len(strips):
        faces = list(faces)
        for strip in _prefixed("strips", strips):
            rows = np.stack([strip[:-2], strip[1:-1], strip[2:]], axis=1)
            # Every other triangle of a strip is wound the other way.
            rows[1::2] = rows[1::2, ::-1]
            faces.extend(rows)
    data = getattr(mesh, "point_data", {})
    colours = _colours_of(data, getattr(data, "active_scalars_name", None))
    return mesh.points, faces, _named(data, "Normals"), colours


def _prefixed(name: str, flat: Any) -> Any:
    """Return the polygons of a VTK array, in which the corner count of each polygon stands before its corners."""
    flat = np.asarray(flat)
    width = int(flat[0]) + 1 if len(flat) else 1
    if width > 1 and len(flat) % width == 0 and (flat[::width] == width - 1).all():
        return flat.reshape(-1, width)[:, 1:]
    at, found = 0, list[Any]()
    while at < len(flat):
        count = int(flat[at])
        if count < 0 or at + 1 + count > len(flat):
            raise ValueError(f"{name}: entry {at} counts {count} corners: expected those that follow")
        found.append(flat[at + 1:at + 1 + count])
        at += 1 + count
    return found


def _named(data: Any, *names: str) -> _Array | None:
    """Return the first array of `data` that has one of these names."""
    for name in names:
        if name in data:
            return np.asarray(data[name])
    return None


def _colours_of(data: Any, active: str | None = None) -> _Array | None:
    """Return the point colours: an array with a usual name for colours, or bytes that are shown as colours."""
    found = _named(data, "RGBA", "RGB", "rgba", "rgb", "colors", "Colors")
    if found is None and active is not None:
        found = np.asarray(data[active])
        if found.dtype != np.uint8:
            return None
    if found is None and all(name in data for name in ("red", "green", "blue")):
        found = np.stack([np.asarray(data[name]) for name in ("red", "green", "blue")], axis=1)
    return found if found is not None and found.ndim == 2 and found.shape[1] in (3, 4) else None


#: By meshio's names of cells: the corners of a flat cell, without points on its edges, and the faces of a solid cell.
_FLAT = {"triangle": 3, "triangle6": 3, "triangle7": 3, "quad": 4, "quad8": 4, "quad9": 4}
_SOLID: dict[str, list[tuple[int, ...]]] = {
    "tetra": [(0, 2, 1), (0, 1, 3), (1, 2, 3), (0, 3, 2)],
    "hexahedron": [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)],
    "wedge": [(0, 1, 2), (3, 5, 4), (0, 3, 4, 1), (1, 4, 5, 2), (2, 5, 3, 0)],
    "pyramid": [(0, 3, 2, 1), (0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)],
}
_SOLID.update(tetra10=_SOLID["tetra"], hexahedron20=_SOLID["hexahedron"], hexahedron27=_SOLID["hexahedron"],
              wedge15=_SOLID["wedge"], pyramid13=_SOLID["pyramid"])


def _meshio(mesh: Any) -> tuple[Any, ...]:
    """Return the arrays of a `meshio.Mesh`: its flat cells, and the surface of its solid ones.

    Lines and points are left out.
    """
    points = np.asarray(mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    blocks: list[Any] = []
    sides: dict[int, list[_Array]] = {}
    for block in mesh.cells:
        if block.type in _FLAT:
            blocks.append(np.asarray(block.data)[:, :_FLAT[block.type]])
        elif block.type == "polygon":
            blocks.append(block.data)
        elif block.type in _SOLID:
            for side in _outward(points, np.asarray(block.data), _SOLID[block.type]):
                sides.setdefault(side.shape[1], []).append(side)
    for parts in sides.values():
        faces = np.concatenate(parts)
        # A side that two solids share is inside.
        _, first, count = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
        blocks.append(faces[np.sort(first[count == 1])])
    if not blocks and len(mesh.cells):
        kinds = ", ".join(sorted({block.type for block in mesh.cells}))
        raise ValueError(f"a mesh of {kinds}: expected triangles, quads, polygons or solids")
    all_faces: Any = blocks[0] if len(blocks) == 1 else list(itertools.chain.from_iterable(blocks))
    data = mesh.point_data
    normals = _named(data, "Normals", "normals", "Normal")
    if normals is None and all(name in data for name in ("nx", "ny", "nz")):
        normals = np.stack([np.asarray(data[name]) for name in ("nx", "ny", "nz")], axis=1)
    return points, all_faces, normals, _colours_of(data)


def _outward(points: _Array, cells: _Array, sides: list[tuple[int, ...]]) -> Iterator[_Array]:
    """Yield each side of all solids, counter-clockwise seen from outside.

    Libraries do not agree on the order of corners.
    """
    middle = points[cells].mean(axis=1)
    for side in sides:
        faces = cells[:, side]
        a, b, c, d = (points[faces[:, corner]] for corner in (0, 1, 2, -1))
        # This is the cross product of the two diagonals of a quad, or of two edges of a triangle.
        normal = np.cross(c - a, d - b)
        inward = ((points[faces].mean(axis=1) - middle) * normal).sum(axis=1) < 0
        yield np.where(inward[:, None], faces[:, ::-1], faces)


def _pack(name: str, vertices: Any, faces: Any, normals: Any, colours: Any) -> _fastphong.Mesh:
    """Check the arrays of a mesh, and make the crate's mesh from them."""
    vertices = _vectors("vertices", vertices, 3)
    corners, ends = _corners(faces, len(vertices))
    if normals is not None:
        normals = np.asarray(normals)
        if normals.ndim == 3:
            normals = normals.reshape(-1, normals.shape[-1])
        normals = _units(_vectors("normals", normals, 3))
        if len(normals) not in (len(vertices), len(corners)):
            raise ValueError(f"normals: {len(normals)} rows: expected one for each of {len(vertices)} vertices "
                             f"or {len(corners)} corners")
    if colours is not None:
        vertices, corners, normals, colours = _coloured(vertices, corners, ends, normals, colours)
    packed = [None if array is None else array.astype("<f8").tobytes() for array in (normals, colours)]
    return _fastphong.Mesh(name, vertices.astype("<f8").tobytes(), corners.astype("<u4").tobytes(),
                           ends.astype("<u4").tobytes(), *packed)


def _vectors(name: str, array: Any, width: int) -> _Array:
    """Return an array of finite vectors with `width` numbers per row."""
    array = np.asarray(array)
    if array.size == 0 and array.ndim <= 1:
        array = array.reshape(0, width)
    if array.dtype == object or array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: an array of {array.dtype}: expected numbers")
    if array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{name}: an array of shape {array.shape}: expected (n, {width})")
    numbers: _Array = array.astype(np.float64)
    wrong = ~np.isfinite(numbers).all(axis=1)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise ValueError(f"{name}: row {row} is {_row(numbers[row])}: expected finite numbers")
    return numbers


def _row(values: Any) -> str:
    return "(" + ", ".join(f"{value:g}" for value in values) + ")"


def _units(vectors: _Array) -> _Array:
    """Return the vectors scaled to length one. Zero vectors stay zero."""
    largest = np.abs(vectors).max(axis=1, keepdims=True)
    scaled = vectors / np.where(largest > 0, largest, 1)
    lengths = np.linalg.norm(scaled, axis=1, keepdims=True)
    units: _Array = scaled / np.where(lengths > 0, lengths, 1)
    return units


def _corners(faces: Any, count: int) -> tuple[_Array, _Array]:
    """Return the corners of all faces, and for each face the index behind its last corner."""
    if isinstance(faces, np.ndarray) and faces.dtype != object:
        corners, ends = _rectangle(faces)
    else:
        faces = list(faces)
        try:
            lengths = [len(face) for face in faces]
        except TypeError:
            raise TypeError("faces: expected rows of indices") from None
        if len(set(lengths)) == 1:
            corners, ends = _rectangle(np.asarray(faces))
        else:
            corners = _indices(np.asarray(list(itertools.chain.from_iterable(faces))))
            ends = np.cumsum(np.asarray(lengths, np.int64))
            short = np.flatnonzero(np.asarray(lengths) < 3)
            if short.size:
                raise ValueError(f"faces: row {short[0]} has {lengths[short[0]]} corners: expected three or more")
    wrong = (corners < 0) | (corners >= count)
    if wrong.any():
        at = int(np.argmax(wrong))
        row = int(np.searchsorted(ends, at, side="right"))
        expected = f"expected 0 to {count - 1}" if count else "there are no vertices"
        raise IndexError(f"faces: row {row} has the index {corners[at]}: {expected}")
    return corners, ends


def _rectangle(faces: _Array) -> tuple[_Array, _Array]:
    """Return the corners and ends of faces that all have the same number of corners."""
    if faces.size == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    if faces.ndim != 2 or faces.shape[1] < 3:
        raise ValueError(f"faces: an array of shape {faces.shape}: expected (n, 3) or more corners a row")
    rows, width = faces.shape
    return _indices(faces.reshape(-1)), np.arange(1, rows + 1, dtype=np.int64) * width


def _indices(array: _Array) -> _Array:
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"faces: indices of {array.dtype}: expected whole numbers")
    return array.astype(array.dtype.newbyteorder("=")) if array.size else np.zeros(0, np.int64)


def _coloured(
    vertices: _Array, corners: _Array, ends: _Array, normals: _Array | None, colours: Any
) -> tuple[_Array, _Array, _Array | None, _Array]:
    """Return the arrays with a colour for each vertex.

    For colours of faces each corner becomes a vertex. Corners at one position still share their normal.
    """
    colours = np.asarray(colours)
    if colours.ndim != 2 or colours.shape[1] not in (3, 4):
        raise ValueError(f"colours: an array of shape {colours.shape}: expected (n, 3) or (n, 4)")
    scale = 255.0 if colours.dtype.kind in "iu" else 1.0
    colours = _vectors("colours", colours[:, :3], 3) / scale
    wrong = ((colours < 0) | (colours > 1)).any(axis=1)
    if wrong.any():
        row = int(np.argmax(wrong))
        raise ValueError(f"colours: row {row} is {_row(colours[row] * scale)}: expected 0 to {scale:g}")
    if len(colours) == len(vertices):
        return vertices, corners, normals, colours
    if len(colours) != len(ends):
        raise ValueError(f"colours: {len(colours)} rows: expected one for each of {len(vertices)} vertices "
                         f"or {len(ends)} faces")
    if normals is not None and len(normals) == len(vertices):
        normals = normals[corners]
    colours = np.repeat(colours, np.diff(ends, prepend=0), axis=0)
    return vertices[corners], np.arange(len(corners)), normals, colours

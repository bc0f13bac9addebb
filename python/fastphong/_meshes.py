"""Turns meshes of other libraries, and arrays, into the crate's meshes.

This file imports no other library: it recognises an object by its attributes.
"""

from __future__ import annotations

import itertools
import os
import warnings
from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _fastphong
from ._arrays import colours as _linear, plain, polygons, units, vectors

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray

    from ._arrays import Array
    from ._types import Faces, MeshLike


class Mesh:
    """A mesh of polygons, checked once.

    `Mesh(mesh)` accepts whatever `render` accepts except scene files; `Mesh(vertices, faces)` accepts arrays.
    `faces` are rows of indices, (n, k), or a list of rows whose lengths differ. Polygons are never cut into
    triangles. `normals` are (n, 3), one for each vertex or one for each corner of all faces in order.
    `colours` are (n, 3) or (n, 4), one for each vertex or, if there are not as many of both, one for each face. They
    are bytes, or linear floats from 0 to 1; a mesh warns of alpha, which is not drawn. Meshes can be copied and
    pickled.
    """

    _mesh: _fastphong.Mesh

    def __init__(
        self,
        mesh: MeshLike | ArrayLike,
        faces: Faces | None = None,
        normals: ArrayLike | None = None,
        colours: ArrayLike | None = None,
        *,
        _level: int | None = 1,
    ) -> None:
        is_file = isinstance(mesh, (str, bytes, os.PathLike))
        if (is_file or isinstance(mesh, Mesh)) and not (faces is normals is colours is None):
            raise TypeError(f"{'a file' if is_file else 'a Mesh'} has its own faces, normals and colours: expected arrays")
        if isinstance(mesh, Mesh):
            self._mesh = mesh._mesh
            return
        if isinstance(mesh, (str, bytes, os.PathLike)):
            self._mesh = _fastphong.Mesh.load(os.fsdecode(mesh))
        else:
            parts = _parts(mesh) if faces is None else _Parts("mesh", mesh, faces)
            if normals is not None:
                parts.normals, parts.found_normals = normals, {}
            if colours is not None:
                parts.colours, parts.found_colours, parts.found_face_colours = colours, {}, {}
            self._mesh = _packed(parts)
        if _level is not None:
            for text in self._mesh.warnings:
                warnings.warn(text, stacklevel=_level + 1)

    def __reduce__(self) -> Any:
        return _restored, (self._mesh.stored,)

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
        """Warnings about the mesh's file or arrays, a list of sentences."""
        return self._mesh.warnings

    @property
    def _corners(self) -> NDArray[np.uint32]:
        return np.frombuffer(self._mesh.corners, "<u4")

    def __repr__(self) -> str:
        vertices, faces = len(self._mesh.vertices) // 24, len(self._mesh.ends) // 4
        return f"<Mesh: {vertices} vertices, {faces} faces>"


def _restored(stored: Any) -> Mesh:
    """Return the mesh that was pickled."""
    mesh = Mesh.__new__(Mesh)
    mesh._mesh = _fastphong.Mesh.restored(stored)
    return mesh


@dataclass
class _Parts:
    """The arrays of a mesh.

    Normals and colours that were passed must be right. Those that were found in an object, by their names in
    messages, may be something else: then they are not used, and the mesh warns.
    """

    name: str
    vertices: Any
    faces: Any
    normals: Any = None
    colours: Any = None
    found_normals: dict[str, Any] = field(default_factory=dict)
    found_colours: dict[str, Any] = field(default_factory=dict)
    #: Colours of faces, which are used if there are none of vertices.
    found_face_colours: dict[str, Any] = field(default_factory=dict)
    #: Materials, and for each face an index into them, -1 for none.
    materials: tuple[list[_fastphong.Material], Any] | None = None
    warnings: list[str] = field(default_factory=list)

    def warn(self, text: str) -> None:
        """Add a warning, unless it is there."""
        if text not in self.warnings:
            self.warnings.append(text)


#: As the readers of mesh files say it.
_NO_TEXTURES = "textures are not drawn"
_NO_TRANSPARENCY = "transparency is not drawn, all surfaces are opaque"
_NO_EMISSION = "emission is not drawn"
_NO_LINES = "points and lines are not drawn"


def _parts(mesh: Any) -> _Parts:
    """Return the arrays of an object."""
    kind = f"{type(mesh).__module__.split('.')[0]}.{type(mesh).__name__}"
    if isinstance(mesh, (tuple, list)):
        if len(mesh) not in (2, 3):
            raise TypeError(f"a mesh of {len(mesh)} parts: expected (vertices, faces) or (vertices, faces, normals)")
        return _Parts("mesh", *mesh)
    if hasattr(mesh, "geometry") and (hasattr(mesh, "dump") or hasattr(mesh, "to_mesh")):
        return _trimesh(kind, mesh.dump() if hasattr(mesh, "dump") else [mesh.to_mesh()])
    if hasattr(mesh, "vertices") and hasattr(mesh, "faces"):
        return _trimesh(kind, [mesh])
    if hasattr(mesh, "points") and hasattr(mesh, "faces"):
        return _poly_data(kind, mesh)
    if hasattr(mesh, "points") and hasattr(mesh, "extract_surface"):
        with warnings.catch_warnings():
            # pyvista announces a new default, which changes no surface.
            warnings.filterwarnings("ignore", message="The default value of `algorithm`")
            surface = mesh.extract_surface()
        return _poly_data(kind, surface)
    if hasattr(mesh, "points") and isinstance(getattr(mesh, "cells", None), list):
        return _meshio(kind, mesh)
    raise TypeError(
        f"{kind} is no mesh: expected a path, (vertices, faces), trimesh.Trimesh, pyvista.PolyData, meshio.Mesh or Mesh"
    )


def _trimesh(kind: str, meshes: list[Any]) -> _Parts:
    """Return the arrays of `trimesh.Trimesh` objects, one after the other.

    Their normals are left out: they are computed on demand, and do not say if they are the mesh's own.
    """
    parts = _Parts(kind, None, None)
    drawn = [mesh for mesh in meshes if hasattr(mesh, "vertices") and hasattr(mesh, "faces")]
    if len(drawn) < len(meshes):
        parts.warn(_NO_LINES)
    vertices: list[Array] = []
    faces: list[Array] = []
    colours: list[Array | None] = []
    materials: list[_fastphong.Material] = []
    of_faces: list[Array] = []
    count = 0
    for mesh in drawn:
        own, rows = plain("vertices", mesh.vertices), plain("faces", mesh.faces)
        own, rows, coloured = _trimesh_colours(parts, mesh, own, rows)
        own_materials, of_rows = _trimesh_materials(parts, getattr(mesh, "visual", None), len(rows))
        of_faces.append(np.where(of_rows < 0, of_rows, of_rows + len(materials)))
        materials += own_materials
        faces.append(rows + count)
        vertices.append(own)
        count += len(own)
        colours.append(coloured)
    if len(drawn) == 1:
        parts.vertices, parts.faces, parts.colours = vertices[0], faces[0], colours[0]
    else:
        parts.vertices = np.concatenate(vertices) if vertices else []
        parts.faces = np.concatenate(faces) if faces else []
        if any(coloured is not None for coloured in colours):
            # White changes no colour.
            parts.colours = np.concatenate([
                np.ones((len(own), 3)) if coloured is None else coloured for own, coloured in zip(vertices, colours)])
    if materials:
        parts.materials = materials, np.concatenate(of_faces)
    return parts


def _trimesh_colours(parts: _Parts, mesh: Any, vertices: Array, faces: Array) -> tuple[Array, Array, Array | None]:
    """Return the vertices and faces of a mesh with a colour for each vertex, if it has colours."""
    visual: Any = getattr(mesh, "visual", None)
    kind = getattr(visual, "kind", None)
    if kind not in ("vertex", "face"):
        return vertices, faces, None
    colours, is_transparent = _linear(visual.vertex_colors if kind == "vertex" else visual.face_colors)
    if is_transparent:
        parts.warn(_NO_TRANSPARENCY)
    if kind == "face":
        corners = faces.reshape(-1)
        colours = np.repeat(colours, faces.shape[1], axis=0)
        vertices, faces = vertices[corners], np.arange(len(corners)).reshape(faces.shape)
    return vertices, faces, colours


def _trimesh_materials(parts: _Parts, visual: Any, count: int) -> tuple[list[_fastphong.Material], Array]:
    """Return the materials of a mesh of `count` faces, and the index of each face's material, -1 for none."""
    material = getattr(visual, "material", None) if getattr(visual, "kind", None) == "texture" else None
    if material is None:
        return [], np.full(count, -1)
    several = getattr(material, "materials", None)
    of_faces = getattr(visual, "face_materials", None)
    if several is not None and of_faces is not None:
        return [_trimesh_material(parts, one) for one in several], np.asarray(of_faces)
    return [_trimesh_material(parts, material)], np.zeros(count, np.int64)


def _trimesh_material(parts: _Parts, material: Any) -> _fastphong.Material:
    """Return a material of trimesh, as the readers of glTF and MTL files make it."""
    def has(*names: str) -> bool:
        return any(getattr(material, name, None) is not None for name in names)

    def colour(value: Any) -> tuple[float, float, float] | None:
        if value is None:
            return None
        array = plain("colour", value)
        numbers = array.reshape(-1) / (255.0 if array.dtype.kind in "iu" else 1.0)
        if len(numbers) > 3 and numbers[3] < 1:
            parts.warn(_NO_TRANSPARENCY)
        red, green, blue = (float(channel) for channel in np.clip(numbers[:3], 0, 1))
        return red, green, blue

    if has("image", "baseColorTexture", "normalTexture"):
        parts.warn(_NO_TEXTURES)
    if hasattr(material, "baseColorFactor"):
        if getattr(material, "alphaMode", None) not in (None, "OPAQUE"):
            parts.warn(_NO_TRANSPARENCY)
        emission = getattr(material, "emissiveFactor", None)
        if emission is not None and np.any(emission):
            parts.warn(_NO_EMISSION)
        return True, None, colour(material.baseColorFactor) or (1.0, 1.0, 1.0), None, None
    # The values of an MTL file. Without them, trimesh shows its defaults: grey, and a highlight over everything.
    exact = getattr(material, "kwargs", None) or {}

    def own(key: str, name: str) -> Any:
        value = exact.get(key)
        if value is None:
            value = getattr(material, name, None)
            is_default = value is not None and np.array_equal(np.asarray(value).reshape(-1)[:3], (102, 102, 102))
            value = None if is_default and (exact or key != "kd") else value
        return None if value is None else colour(value)

    shininess = exact.get("ns", getattr(material, "glossiness", None))
    shininess = None if shininess is None or ("ns" not in exact and shininess == 1) else float(shininess)
    return False, own("ka", "ambient"), own("kd", "diffuse"), own("ks", "specular"), shininess


def _poly_data(kind: str, mesh: Any) -> _Parts:
    """Return the arrays of a `pyvista.PolyData`: its polygons and strips."""
    faces = _prefixed("faces", mesh.faces)
    # For each face the index of its cell among all cells: first points and lines, then faces, then strips.
    before = int(getattr(mesh, "n_verts", 0)) + int(getattr(mesh, "n_lines", 0))
    cells = before + np.arange(len(faces))
    count = before + len(faces)
    strips = getattr(mesh, "strips", None)
    if strips is not None and len(strips):
        faces, owners = list(faces), [cells]
        for strip in _prefixed("strips", strips):
            rows = np.stack([strip[:-2], strip[1:-1], strip[2:]], axis=1)
            # Every other triangle of a strip is wound the other way.
            rows[1::2] = rows[1::2, ::-1]
            faces.extend(rows)
            owners.append(np.full(len(rows), count))
            count += 1
        cells = np.concatenate(owners)
    parts = _Parts(kind, mesh.points, faces)
    if before and len(cells):
        parts.warn(_NO_LINES)
    points = getattr(mesh, "point_data", {})
    parts.found_normals = _named(points, "Normals")
    parts.found_colours = _colours_in(points, getattr(points, "active_scalars_name", None))
    of_cells = getattr(mesh, "cell_data", {})
    found = _colours_in(of_cells, getattr(of_cells, "active_scalars_name", None))
    parts.found_face_colours = _of_faces(parts, found, cells, count)
    return parts


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


def _named(data: Any, *names: str) -> dict[str, Any]:
    """Return the first array of `data` that has one of these names, by its name."""
    return next(({f"`{name}`": data[name]} for name in names if name in data), {})


def _colours_in(data: Any, active: str | None = None) -> dict[str, Any]:
    """Return an array with a usual name for colours, or bytes that are shown as colours."""
    found = _named(data, "RGBA", "RGB", "rgba", "rgb", "colors", "Colors")
    if not found and active is not None:
        array = np.asarray(data[active])
        found = {f"`{active}`": array} if array.dtype == np.uint8 and array.ndim == 2 else {}
    channels = ("red", "green", "blue")
    if not found and all(name in data for name in channels):
        try:
            return {"`red`, `green` and `blue`": _columns([data[name] for name in channels])}
        except ValueError:
            # Columns of different lengths are no colours.
            return {}
    return found


def _columns(columns: list[Any]) -> Any:
    """Return columns as one array; for a list of columns of blocks, a list of arrays."""
    if isinstance(columns[0], list):
        return [_columns(list(block)) for block in zip(*columns)]
    return np.stack([np.asarray(column) for column in columns], axis=1)


def _of_faces(parts: _Parts, found: dict[str, Any], cells: Array, count: int) -> dict[str, Any]:
    """Return the values of each face in arrays that have a value for each of `count` cells."""
    values = {}
    for name, array in found.items():
        array = np.asarray(array)
        if array.ndim and len(array) == count:
            values[f"{name} of cells"] = array[cells]
        else:
            parts.warn(f"{name} of cells is not used as colours: it has no row for each of {count} cells")
    return values


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


def _meshio(kind: str, mesh: Any) -> _Parts:
    """Return the arrays of a `meshio.Mesh`: its flat cells, and the surface of its solid ones."""
    points = plain("points", mesh.points)
    if points.ndim == 2 and points.shape[1] == 2:
        points = np.pad(points, ((0, 0), (0, 1)))
    # Rows of corners, and for each row the index of its cell among all cells.
    blocks: list[tuple[Any, Array]] = []
    sides: dict[int, list[tuple[Array, Array]]] = {}
    left_out: set[str] = set()
    count = 0
    for block in mesh.cells:
        own = np.arange(count, count + len(block.data))
        count += len(block.data)
        if block.type in _FLAT:
            blocks.append((np.asarray(block.data)[:, :_FLAT[block.type]], own))
        elif block.type == "polygon":
            blocks.append((block.data, own))
        elif block.type in _SOLID:
            cells = np.asarray(block.data)
            if not ((cells >= 0) & (cells < len(points))).all():
                raise IndexError(f"cells of {block.type} have an index without a point: expected 0 to {len(points) - 1}")
            for side in _outward(points, cells, _SOLID[block.type]):
                sides.setdefault(side.shape[1], []).append((side, own))
        else:
            left_out.add(block.type)
    for parts_of_sides in sides.values():
        faces = np.concatenate([rows for rows, _ in parts_of_sides])
        owners = np.concatenate([own for _, own in parts_of_sides])
        # A side that two solids share is inside.
        _, first, times = np.unique(np.sort(faces, axis=1), axis=0, return_index=True, return_counts=True)
        outside = np.sort(first[times == 1])
        blocks.append((faces[outside], owners[outside]))
    kinds = ", ".join(sorted(left_out))
    if not blocks and len(mesh.cells):
        raise ValueError(f"a mesh of {kinds}: expected triangles, quads, polygons or solids")
    all_faces: Any = blocks[0][0] if len(blocks) == 1 else list(itertools.chain.from_iterable(rows for rows, _ in blocks))
    parts = _Parts(kind, points, all_faces)
    if left_out:
        parts.warn(_NO_LINES if left_out <= {"vertex", "line", "line3"} else f"cells of {kinds} are not drawn")
    data = mesh.point_data
    parts.found_normals = _named(data, "Normals", "normals", "Normal")
    if not parts.found_normals and all(name in data for name in ("nx", "ny", "nz")):
        parts.found_normals = {"`nx`, `ny` and `nz`": _columns([data[name] for name in ("nx", "ny", "nz")])}
    parts.found_colours = _colours_in(data)
    found = {
        name: np.concatenate([np.asarray(block) for block in values]) if len(values) else np.zeros((0, 3))
        for name, values in _colours_in(getattr(mesh, "cell_data", {})).items()
    }
    cells = np.concatenate([own for _, own in blocks]) if blocks else np.zeros(0, np.int64)
    parts.found_face_colours = _of_faces(parts, found, cells, count)
    return parts


def _outward(points: Array, cells: Array, sides: list[tuple[int, ...]]) -> Iterator[Array]:
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


def _packed(parts: _Parts) -> _fastphong.Mesh:
    """Check the arrays of a mesh, and make the crate's mesh from them."""
    vertices = vectors("vertices", parts.vertices, 3)
    corners, ends = polygons(parts.faces, len(vertices))
    normals = None if parts.normals is None else _normals(parts.normals, len(vertices), len(corners))
    for name, array in parts.found_normals.items():
        try:
            normals = _normals(array, len(vertices), len(corners))
        except (TypeError, ValueError) as error:
            parts.warn(f"{name} is not used as normals: {_without_name(error)}")
    colours = None if parts.colours is None else _colours(parts, parts.colours, len(vertices), len(ends))
    is_by_face = colours is not None and len(colours) != len(vertices)
    for found in (parts.found_colours, parts.found_face_colours):
        for name, array in found.items():
            is_of_faces = found is parts.found_face_colours
            try:
                if colours is None:
                    colours = _colours(parts, array, len(ends) if is_of_faces else len(vertices))
                    is_by_face = is_of_faces
            except (TypeError, ValueError) as error:
                parts.warn(f"{name} is not used as colours: {_without_name(error)}")
    if colours is not None and is_by_face:
        # Colours of faces: each corner becomes a vertex. Corners at one position still share their normal.
        if normals is not None and len(normals) == len(vertices):
            normals = normals[corners]
        colours = np.repeat(colours, np.diff(ends, prepend=0), axis=0)
        vertices, corners = vertices[corners], np.arange(len(corners))
    materials = None
    if parts.materials is not None:
        materials = parts.materials[0], np.asarray(parts.materials[1]).astype("<u4").tobytes()
    own, lit = (None if array is None else array.astype("<f8").tobytes() for array in (normals, colours))
    return _fastphong.Mesh(
        parts.name, vertices.astype("<f8").tobytes(), corners.astype("<u4").tobytes(), ends.astype("<u4").tobytes(),
        own, lit, materials, parts.warnings)


def _without_name(error: Exception) -> str:
    return str(error).split(": ", 1)[-1]


def _normals(normals: Any, vertices: int, corners: int) -> Array:
    """Return unit normals, one for each vertex or for each corner."""
    array = plain("normals", normals)
    if array.ndim == 3:
        array = array.reshape(-1, array.shape[-1])
    found = units(vectors("normals", array, 3))
    if len(found) not in (vertices, corners):
        raise ValueError(f"normals: {len(found)} rows: expected one for each of {vertices} vertices "
                         f"or {corners} corners")
    return found


def _colours(parts: _Parts, colours: Any, *counts: int) -> Array:
    """Return linear colours: as many as one of `counts`, those of vertices and of faces."""
    found, is_transparent = _linear(colours)
    if len(found) not in counts:
        expected = " or ".join(f"{count} {noun}" for count, noun in zip(counts, ("vertices", "faces")))
        raise ValueError(f"colours: {len(found)} rows: expected one for each of {expected}")
    if is_transparent:
        parts.warn(_NO_TRANSPARENCY)
    return found

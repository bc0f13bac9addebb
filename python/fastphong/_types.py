"""The types of arguments, for type checkers. Nothing here is imported at run time."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal, Protocol, SupportsFloat, SupportsIndex, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from ._meshes import Mesh


class TrimeshLike(Protocol):
    """A `trimesh.Trimesh`."""

    @property
    def vertices(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class PolyDataLike(Protocol):
    """A `pyvista.PolyData`."""

    @property
    def points(self) -> Any: ...
    @property
    def faces(self) -> Any: ...


class MeshioLike(Protocol):
    """A `meshio.Mesh`."""

    @property
    def points(self) -> Any: ...
    @property
    def cells(self) -> Any: ...


class TrimeshSceneLike(Protocol):
    """A `trimesh.Scene`."""

    @property
    def geometry(self) -> Any: ...
    def dump(self) -> Any: ...


class GridLike(Protocol):
    """One of pyvista's other data sets, which has a surface."""

    @property
    def points(self) -> Any: ...
    def extract_surface(self) -> Any: ...


class ArrayObject(Protocol):
    """An object that numpy reads as an array, such as a picture of Pillow."""

    @property
    def __array_interface__(self) -> Any: ...


Faces = Union[ArrayLike, Sequence[Sequence[int]], Sequence[NDArray[Any]], ArrayObject]
PathLike = Union[str, bytes, "os.PathLike[str]", "os.PathLike[bytes]"]
MeshLike = Union[
    PathLike,
    Mesh,
    "tuple[ArrayLike, Faces]",
    "tuple[ArrayLike, Faces, ArrayLike]",
    "list[Any]",
    TrimeshLike,
    TrimeshSceneLike,
    PolyDataLike,
    MeshioLike,
    GridLike,
]
Vector = Union["Sequence[SupportsFloat]", NDArray[Any]]
View = Vector
Light = Union[Vector, Mapping[str, Any], Sequence[Any]]
Look = Literal["shown", "compared"]
Encoding = Literal["linear", "srgb"]
Normals = Union[str, SupportsFloat]
Size = Union["Sequence[SupportsIndex]", NDArray[Any]]
Keys = Mapping[str, Any]
Image = Union[NDArray[np.uint8], ArrayObject, PathLike]

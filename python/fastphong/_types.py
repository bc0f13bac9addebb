"""The types of arguments, for type checkers. Nothing here is imported at run time."""

from __future__ import annotations

import os
from collections.abc import Mapping, Sequence
from typing import Any, Literal, Protocol, Union

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
    """A `meshio.Mesh`, or one of pyvista's grids."""

    @property
    def points(self) -> Any: ...
    @property
    def cells(self) -> Any: ...


class TrimeshSceneLike(Protocol):
    """A `trimesh.Scene`."""

    @property
    def geometry(self) -> Any: ...
    def to_mesh(self) -> Any: ...


Faces = Union[ArrayLike, Sequence[Sequence[int]], Sequence[NDArray[Any]]]
PathLike = Union[str, bytes, os.PathLike[str]]
MeshLike = Union[
    PathLike,
    Mesh,
    "tuple[ArrayLike, Faces]",
    "tuple[ArrayLike, Faces, ArrayLike]",
    TrimeshLike,
    TrimeshSceneLike,
    PolyDataLike,
    MeshioLike,
]
Vector = Union["tuple[float, float, float]", Sequence[float], NDArray[Any]]
View = Union["tuple[float, float]", Vector]
Light = Union[Vector, Mapping[str, Any], Sequence[Any]]
Look = Literal["shown", "compared"]
Normals = Union[str, float]
Size = Union["tuple[int, int]", Sequence[int]]
Keys = Mapping[str, Any]
Image = Union[NDArray[np.uint8], PathLike]

"""Reads arrays of every kind."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

if TYPE_CHECKING:
    from numpy.typing import NDArray

    Array = NDArray[Any]


def plain(name: str, values: Any) -> Array:
    """Return `values` as a plain array: a list, a masked array, a table of pandas, or an object with `__array__`.

    Entries that are masked are an error, because nobody knows what they stand for.
    """
    if isinstance(values, np.ma.MaskedArray):
        masked = np.ma.getmaskarray(values)
        if masked.any():
            row = int(np.argwhere(masked)[0][0]) if masked.ndim else 0
            raise ValueError(f"{name}: row {row} has a masked entry: expected numbers")
    try:
        array = np.asarray(values)
        if array.dtype == object:
            # Tables whose columns have several types, or types that may be missing, hold objects.
            array = np.asarray(array.tolist())
    except (TypeError, ValueError) as error:
        raise ValueError(f"{name}: {error}") from None
    return array


def vectors(name: str, values: Any, width: int) -> Array:
    """Return an array of finite vectors with `width` numbers per row."""
    array = plain(name, values)
    if array.size == 0 and array.ndim <= 1:
        array = array.reshape(0, width)
    if array.dtype.kind not in "fiu":
        raise TypeError(f"{name}: an array of {array.dtype}: expected numbers")
    if array.ndim != 2 or array.shape[1] != width:
        raise ValueError(f"{name}: an array of shape {array.shape}: expected (n, {width})")
    numbers: Array = array.astype(np.float64)
    # The crate computes in single precision.
    wrong = ~(np.abs(numbers) <= np.finfo(np.float32).max).all(axis=1)
    if wrong.any():
        at = int(np.argmax(wrong))
        raise ValueError(f"{name}: row {at} is {row(numbers[at])}: expected finite numbers up to 3.4e38")
    return numbers


def row(values: Any) -> str:
    """Return the numbers of a row as text."""
    return "(" + ", ".join(f"{value:g}" for value in values) + ")"


def units(vectors: Array) -> Array:
    """Return the vectors scaled to length one. Zero vectors stay zero."""
    largest = np.abs(vectors).max(axis=1, keepdims=True)
    scaled = vectors / np.where(largest > 0, largest, 1)
    lengths = np.linalg.norm(scaled, axis=1, keepdims=True)
    found: Array = scaled / np.where(lengths > 0, lengths, 1)
    return found


def polygons(faces: Any, count: int) -> tuple[Array, Array]:
    """Return the corners of all faces, and for each face the index behind its last corner.

    `count` is the count of vertices.
    """
    if hasattr(faces, "__array__") or hasattr(faces, "__array_interface__"):
        # An array of rows whose lengths differ holds objects, and is read as a list.
        array = np.asarray(faces) if not isinstance(faces, np.ma.MaskedArray) else plain("faces", faces)
        is_ragged = array.dtype == object and array.ndim == 1
        faces = list(array) if is_ragged else plain("faces", array)
    if isinstance(faces, np.ndarray):
        corners, ends = _rectangle(faces)
    else:
        try:
            faces = list(faces)
            lengths = [len(face) for face in faces]
        except TypeError:
            raise TypeError("faces: expected rows of indices") from None
        for at, face in enumerate(faces):
            if isinstance(face, np.ma.MaskedArray) and np.ma.is_masked(face):
                raise ValueError(f"faces: row {at} has a masked entry: expected numbers")
        if len(set(lengths)) == 1:
            corners, ends = _rectangle(plain("faces", faces))
        else:
            corners = _indices(plain("faces", [corner for face in faces for corner in face]))
            ends = np.cumsum(np.asarray(lengths, np.int64))
            short = np.flatnonzero(np.asarray(lengths) < 3)
            if short.size:
                raise ValueError(f"faces: row {short[0]} has {lengths[short[0]]} corners: expected three or more")
    wrong = (corners < 0) | (corners >= count)
    if wrong.any():
        at = int(np.argmax(wrong))
        found = int(np.searchsorted(ends, at, side="right"))
        expected = f"expected 0 to {count - 1}" if count else "there are no vertices"
        raise IndexError(f"faces: row {found} has the index {corners[at]}: {expected}")
    return corners, ends


def _rectangle(faces: Array) -> tuple[Array, Array]:
    """Return the corners and ends of faces that all have the same number of corners."""
    if faces.size == 0:
        return np.zeros(0, np.int64), np.zeros(0, np.int64)
    if faces.ndim != 2 or faces.shape[1] < 3:
        raise ValueError(f"faces: an array of shape {faces.shape}: expected (n, 3) or more corners a row")
    rows, width = faces.shape
    return _indices(faces.reshape(-1)), np.arange(1, rows + 1, dtype=np.int64) * width


def _indices(array: Array) -> Array:
    if array.size and array.dtype.kind not in "iu":
        raise TypeError(f"faces: indices of {array.dtype}: expected whole numbers")
    return array.astype(array.dtype.newbyteorder("=")) if array.size else np.zeros(0, np.int64)


def colours(values: Any) -> tuple[Array, bool]:
    """Return linear colours, (n, 3) floats from 0 to 1, and whether some of them are transparent."""
    array = plain("colours", values)
    if array.ndim != 2 or array.shape[1] not in (3, 4):
        raise ValueError(f"colours: an array of shape {array.shape}: expected (n, 3) or (n, 4)")
    scale = 255.0 if array.dtype.kind in "iu" else 1.0
    found = vectors("colours", array, array.shape[1]) / scale
    wrong = ((found < 0) | (found > 1)).any(axis=1)
    if wrong.any():
        at = int(np.argmax(wrong))
        raise ValueError(f"colours: row {at} is {row(found[at] * scale)}: expected 0 to {scale:g}")
    return found[:, :3], bool((found[:, 3:] < 1).any())

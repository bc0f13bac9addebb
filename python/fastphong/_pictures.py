"""Pictures and their differences."""

from __future__ import annotations

import os
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _fastphong

if TYPE_CHECKING:
    from ._types import Image, PathLike

    _Array = np.ndarray[Any, np.dtype[np.uint8]]
else:
    _Array = np.ndarray


class Picture(_Array):
    """A picture: an array of (height, width, 4) bytes, red, green, blue and alpha. Notebooks show it as a picture.

    It is a normal numpy array, and you may write to it. Alpha is the covered share of a pixel, and straight.
    """

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        # A result of numpy that is a picture shows itself as one. A scalar result stays a scalar.
        return array[()] if array.shape == () else _shown(np.asarray(array))

    def __array_function__(self, function: Any, types: Any, arguments: Any, keywords: Any) -> Any:
        return _shown(super().__array_function__(function, types, arguments, keywords))

    def _repr_png_(self) -> bytes | None:
        if not _is_picture(self):
            return None
        return _fastphong.encode_png(self.tobytes(), (self.shape[1], self.shape[0]))

    def save(self, path: PathLike) -> None:
        """Write the picture to a file. The ending of the path names the format: PNG, PPM or PFM."""
        pixels = _pixels("picture", self)
        _fastphong.write_picture(os.fsdecode(path), pixels.tobytes(), (pixels.shape[1], pixels.shape[0]))


def _is_picture(array: _Array) -> bool:
    return array.dtype == np.uint8 and array.ndim == 3 and array.shape[2] == 4 and array.size > 0


def _shown(result: Any) -> Any:
    """Return a result of numpy, as a `Picture` if it has the shape of one."""
    return result.view(Picture) if isinstance(result, np.ndarray) and _is_picture(result) else result


def picture(pixels: bytearray, width: int, height: int) -> Picture:
    """Return the bytes of `pixels` as a picture, without copying them."""
    return np.frombuffer(pixels, np.uint8).reshape(height, width, 4).view(Picture)


def read(path: PathLike) -> Picture:
    """Read a picture file."""
    return picture(*_fastphong.read_picture(os.fsdecode(path)))


def _pixels(name: str, image: Any) -> _Array:
    """Return `image`, an array or the path of a file, as (height, width, 4) bytes."""
    if isinstance(image, (str, bytes, os.PathLike)):
        return read(image)
    pixels: _Array = np.asarray(image)
    if pixels.dtype != np.uint8:
        raise TypeError(f"{name}: an array of {pixels.dtype}: expected uint8, grey levels from 0 to 255")
    if pixels.ndim != 3 or pixels.shape[2] not in (3, 4) or not pixels.size:
        raise ValueError(f"{name}: an array of shape {pixels.shape}: expected (height, width, 4) or (height, width, 3)")
    if pixels.shape[2] == 3:
        pixels = np.concatenate([pixels, np.full_like(pixels[..., :1], 255)], axis=2)
    return pixels


class Difference:
    """The difference of picture `b` from picture `a`, in grey levels of 255."""

    def __init__(self, a: Image, b: Image) -> None:
        self._a, self._b = _pixels("a", a), _pixels("b", b)
        if self._a.shape != self._b.shape:
            (h, w, _), (h2, w2, _) = self._a.shape, self._b.shape
            raise ValueError(f"the pictures are {w}x{h} and {w2}x{h2} pixels: expected the same size")
        self._size = (self._a.shape[1], self._a.shape[0])
        found = _fastphong.difference(self._a.tobytes(), self._b.tobytes(), self._size)
        self.equal = found["equal"]
        self.max = found["max"]
        self.rms = found["rms"]
        self.mean = found["mean"]
        self.p99 = found["p99"]
        self.psnr = found["psnr"]
        self.ssim = found["ssim"]
        self.differing = found["differing"]
        self.compared = found["compared"]
        self.coverage_mismatches = found["coverage_mismatches"]
        self.worst = None if found["worst"] is None else tuple(found["worst"])

    def draw(self, scale: float = 4.0) -> Picture:
        """Return a picture of the difference, from purple to yellow at `scale` grey levels.

        Black pixels are equal, magenta ones are beyond the scale, and white ones are covered by only one picture.
        """
        pixels = _fastphong.difference_map(self._a.tobytes(), self._b.tobytes(), self._size, float(scale))
        return picture(pixels, *self._size)

    @property
    def map(self) -> Picture:
        """A picture of the difference, on a scale of four grey levels."""
        return self.draw()

    def assert_below(self, levels: float) -> None:
        """Raise an `AssertionError` unless every pixel is off by less than `levels` grey levels."""
        if not self.compared and not self.equal:
            raise AssertionError("nothing is compared: neither picture covers a pixel, and their values differ")
        if self.max < levels:
            return
        x, y = self.worst or (0, 0)
        a, b = (tuple(int(c) for c in image[y, x]) for image in (self._a, self._b))
        raise AssertionError(
            f"the pictures are {self.max:g} grey levels apart, expected less than {levels:g}: "
            f"{a} and {b} in column {x}, row {y}; {self!r}"
        )

    def __repr__(self) -> str:
        mismatches = self.coverage_mismatches
        covered = f", {mismatches} of them covered by one picture only" if mismatches else ""
        return (f"<Difference: max {self.max:g}, rms {self.rms:.3g} grey levels, "
                f"{self.differing} of {self.compared} pixels differ{covered}>")

    def _repr_png_(self) -> bytes | None:
        return self.map._repr_png_()

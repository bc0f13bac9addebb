"""Pictures and their differences."""

from __future__ import annotations

import os
import threading
import warnings
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _fastphong
from ._arrays import plain
from ._keys import text

if TYPE_CHECKING:
    from ._types import Encoding, Image, PathLike

    _Array = np.ndarray[Any, np.dtype[np.uint8]]
else:
    _Array = np.ndarray


#: Held while a file is written. A process forks between two files, so that the child can write, too.
_SAVING = threading.RLock()
if hasattr(os, "register_at_fork"):
    os.register_at_fork(before=_SAVING.acquire, after_in_parent=_SAVING.release, after_in_child=_SAVING.release)


class Picture(_Array):
    """A picture: an array of (height, width, 4) bytes, red, green, blue and alpha. Notebooks show it as a picture.

    It is a normal numpy array, and you may write to it. Alpha is the covered share of a pixel, and straight.
    `encoding` is "linear" or "srgb", or None if nobody knows. `background` is the colour, in stored levels, that
    pixels are put over in files without alpha.
    """

    encoding: Encoding | None
    background: tuple[float, float, float] | None

    def __array_finalize__(self, source: Any) -> None:
        self.encoding = getattr(source, "encoding", None)
        self.background = getattr(source, "background", None)

    def __array_wrap__(self, array: Any, context: Any = None, return_scalar: bool = False) -> Any:
        # A result of numpy that is a picture shows itself as one. A scalar result stays a scalar.
        return array[()] if array.shape == () else _shown(np.asarray(array), [self])

    def __array_function__(self, function: Any, types: Any, arguments: Any, keywords: Any) -> Any:
        result = super().__array_function__(function, types, arguments, keywords)
        return _shown(result, list(_pictures_in([*arguments, *keywords.values()])))

    def __reduce__(self) -> Any:
        reduced: Any = super().__reduce__()
        restore, arguments, state = reduced
        return restore, arguments, (state, self.encoding, self.background)

    def __setstate__(self, state: Any) -> None:
        array, self.encoding, self.background = state
        super().__setstate__(array)

    def _repr_png_(self) -> bytes | None:
        return _image("picture", self).png() if _is_picture(self) else None

    def save(self, path: PathLike) -> None:
        """Write the picture to a file. The ending of the path names the format: PNG, PPM or PFM.

        A PNG file states the picture's encoding. PPM and PFM have no alpha: pixels are put over the background. PFM
        holds linear floats.
        """
        with _SAVING:
            _image("picture", self).write(os.fsdecode(path))


def _is_picture(array: _Array) -> bool:
    return array.dtype == np.uint8 and array.ndim == 3 and array.shape[2] == 4 and array.size > 0


def _pictures_in(arguments: Any) -> Iterator[Picture]:
    """Yield the pictures among the arguments of a function, and in lists among them."""
    for argument in arguments:
        if isinstance(argument, Picture):
            yield argument
        elif isinstance(argument, (list, tuple)):
            yield from _pictures_in(argument)


def _shown(result: Any, sources: list[Picture]) -> Any:
    """Return a result of numpy, as a `Picture` if it has the shape of one. It states what all `sources` do."""
    if not (isinstance(result, np.ndarray) and _is_picture(result)):
        return result
    shown = result.view(Picture)
    for name in ("encoding", "background"):
        stated = {getattr(source, name) for source in sources}
        setattr(shown, name, stated.pop() if len(stated) == 1 else None)
    return shown


def picture(pixels: bytearray, width: int, height: int, encoding: Any, background: Any) -> Picture:
    """Return the bytes of `pixels` as a picture, without copying them."""
    shown = np.frombuffer(pixels, np.uint8).reshape(height, width, 4).view(Picture)
    shown.encoding = encoding
    shown.background = None if background is None else tuple(background)
    return shown


def read(path: PathLike, level: int = 1) -> Picture:
    """Read a picture file in 8 bits. `diff` compares files as they are stored, unrounded."""
    image = _fastphong.Image.read(os.fsdecode(path))
    _warn([f"{_name(path)}: {note}" for note in image.notes], level + 1)
    return picture(*image.pixels())


def _name(path: PathLike) -> str:
    """Return a path as text, also if it is not UTF-8."""
    return os.fsencode(path).decode("utf-8", "replace")


def _warn(texts: list[str], level: int) -> None:
    for text in texts:
        warnings.warn(text, stacklevel=level + 1)


def _image(name: str, image: Any, usual: str | None = None) -> _fastphong.Image:
    """Return `image`, an array or the path of a file. An array that states no encoding has the `usual` one."""
    if isinstance(image, (str, bytes, os.PathLike)):
        return _fastphong.Image.read(os.fsdecode(image))
    pixels: Any = plain(name, image)
    if pixels.dtype != np.uint8:
        raise TypeError(f"{name}: an array of {pixels.dtype}: expected uint8, grey levels from 0 to 255")
    if pixels.ndim != 3 or pixels.shape[2] not in (3, 4) or not pixels.size:
        raise ValueError(f"{name}: an array of shape {pixels.shape}: expected (height, width, 4) or (height, width, 3)")
    has_alpha = pixels.shape[2] == 4
    if not has_alpha:
        pixels = np.concatenate([pixels, np.full_like(pixels[..., :1], 255)], axis=2)
    encoding = getattr(image, "encoding", None) or usual
    background = getattr(image, "background", None)
    return _fastphong.Image(pixels.tobytes(), (pixels.shape[1], pixels.shape[0]), encoding, background, has_alpha)


class Difference:
    """The difference of picture `b` from picture `a`, in grey levels of 255.

    Pictures are compared as `fastphong diff` does: as they are stored, in 8 bits, 16 bits or floats. If their
    encodings differ, the linear one is encoded, unrounded. An array that states no encoding has that of the other
    picture.
    """

    def __init__(self, a: Image, b: Image, assume: Encoding | None = None, *, _level: int = 1) -> None:
        names = [_name(image) if isinstance(image, (str, bytes, os.PathLike)) else name
                 for name, image in (("a", a), ("b", b))]
        first = _image("a", a)
        second = _image("b", b, first.encoding)
        is_array = not isinstance(a, (str, bytes, os.PathLike))
        if is_array and first.encoding is None and second.encoding is not None:
            first = _image("a", a, second.encoding)
        (w, h), (w2, h2) = first.size, second.size
        if (w, h) != (w2, h2):
            raise ValueError(f"the pictures are {w}x{h} and {w2}x{h2} pixels: expected the same size")
        self._pair = _fastphong.Comparison(first, second, None if assume is None else text("assume", assume))
        found = self._pair.difference()
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
        self.not_finite = found["not_finite"]
        self.worst = None if found["worst"] is None else tuple(found["worst"])
        self.encoding = found["encoding"]
        notes = [f"{name}: {note}" for name, image in zip(names, (first, second)) for note in image.file_notes]
        _warn(notes + self._pair.notes(names), _level + 1)

    def draw(self, scale: float = 4.0) -> Picture:
        """Return a picture of the difference, from purple to yellow at `scale` grey levels.

        Black pixels are equal, magenta ones are beyond the scale, and white ones are covered by only one picture.
        """
        if not 0 < scale < float("inf"):
            raise ValueError(f"`scale` is {scale!r}: expected grey levels over 0")
        return picture(*self._pair.map(float(scale)))

    @property
    def map(self) -> Picture:
        """A picture of the difference, on a scale of four grey levels."""
        return self.draw()

    def assert_below(self, levels: float) -> None:
        """Raise an `AssertionError` unless every pixel is off by less than `levels` grey levels.

        Pixels that are infinite or not a number in only one picture are beyond all levels. Two pictures that cover
        no pixel are below only if they are the same in all their bytes.
        """
        if levels != levels:
            raise ValueError("`levels` is not a number: expected grey levels")
        if not (self.compared or self.equal):
            raise AssertionError("nothing is compared: the pictures cover no pixel, and are not the same")
        if self.max < levels and not self.not_finite:
            return
        x, y = self.worst or (0, 0)
        a, b = ("(" + ", ".join(f"{level:.5g}" for level in pixel) + ")" for pixel in self._pair.at(x, y))
        raise AssertionError(
            f"the pictures are {self.max:g} grey levels apart, expected less than {levels:g}: "
            f"{a} and {b} in column {x}, row {y}; {self!r}"
        )

    def __repr__(self) -> str:
        mismatches = self.coverage_mismatches
        covered = f", {mismatches} of them covered by one picture only" if mismatches else ""
        lost = f", {self.not_finite} of them infinite or not a number in one of them" if self.not_finite else ""
        return (f"<Difference: max {self.max:g}, rms {self.rms:.3g} grey levels, "
                f"{self.differing} of {self.compared} pixels differ{covered}{lost}>")

    def _repr_png_(self) -> bytes | None:
        return self.map._repr_png_()

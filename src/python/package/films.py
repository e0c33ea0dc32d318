"""Films: images of named channels, which are arrays of numpy."""

from __future__ import annotations

import functools
import json
from typing import Any, Dict, FrozenSet, Iterator, List, Mapping, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _quadrel, arguments

_COLORS = {"RGB": ["R", "G", "B"], "RGBA": ["R", "G", "B", "A"], "YA": ["Y", "A"]}


def _components(name: str, count: int) -> List[str]:
    """The channels of an array whose last axis has `count` elements."""
    known = _COLORS.get(name)
    channels = known if known is not None else _quadrel.expand_channels([name])
    if len(channels) != count:
        raise arguments.wrong(f'film: "{name}"', f"{count} components",
                              f"{len(channels)}: {', '.join(channels)}")
    return channels


_MOST_VALUES = 2**31
_CODES = {np.dtype(np.uint8): 8, np.dtype(np.uint16): 16}


def _is_whole(channel: str) -> bool:
    """Whether a channel of renders has integers."""
    return channel in _whole_channels()


@functools.lru_cache(maxsize=None)
def _whole_channels() -> FrozenSet[str]:
    return frozenset(row["name"] for row in json.loads(_quadrel.list_channels([]))
                     if row["type"] == "uint")


def _planes(arrays: Mapping[str, ArrayLike]) -> Tuple[Dict[str, NDArray[Any]], Dict[str, int]]:
    """Planes by channel, and the bits of those that were codes."""
    codes: Dict[str, int] = {}
    planes: Dict[str, NDArray[Any]] = {}

    def add(channel: str, plane: NDArray[Any]) -> None:
        if channel in planes:
            raise arguments.wrong("film", f'"{channel}" twice', "each channel once")
        bits = _CODES.get(plane.dtype)
        if bits is not None and not _is_whole(channel):
            codes[channel] = bits
            plane = plane.astype(np.float32) / np.float32(2**bits - 1)
        planes[channel] = plane

    count = 0
    for name, values in arguments.mapping("film", arrays, "arrays by channel").items():
        arguments.text("film: the name of a channel", name)
        array = arguments.array(f'film: "{name}"', values)
        if array.dtype.kind not in "fuib":
            raise arguments.wrong(f'film: "{name}"', str(array.dtype), "floats or integers")
        count += array.size
        if count > _MOST_VALUES:
            raise arguments.wrong("film", f"{count} values and more", "at most 2^31")
        if array.ndim == 3:
            for i, channel in enumerate(_components(name, array.shape[2])):
                add(channel, array[:, :, i])
        elif array.ndim == 2:
            add(name, array)
        else:
            raise arguments.wrong(f'film: "{name}"', f"an array of {array.ndim} axes",
                                  "(height, width), or (height, width, components)")
        if array.dtype.kind == "i" and array.size and array.min() < 0:
            raise arguments.wrong(f'film: "{name}"', f"{array.min()}", "integers of 0 and above 0")
        if array.dtype.kind in "ui" and array.size and array.max() > 0xffffffff:
            raise arguments.wrong(f'film: "{name}"', f"{array.max()}", "integers of 32 bits")
    if not planes:
        raise arguments.wrong("film", "no channel", "at least one")
    return planes, codes


class Film(Mapping[str, "NDArray[Any]"]):
    """An image: arrays by channel, (height, width), rows from the top; float32, or uint32 where
    `list_channels` says so. `film["N.X"]` is a view of the film's memory, no copy, and changes the
    film where it is written to.

    Made by `render` and `read`, or of arrays, which are copied: `Film({"hit.U": u, "RGB": image})`.
    An array of three axes is a group ("N", "uv") or RGB, RGBA. Floats become float32. uint8 and uint16
    are codes, code / 255 and code / 65535, as in image files (`compare(..., encode="srgb8")`), but in
    channels of integers, as hit.status; all other integers stay integers. `frame` and `window` are (x0, y0, x1, y1), half-open,
    from the top-left: of the whole image and of the part that the arrays hold; the arrays' size
    unless given.

    Films are equal where they are the same object; `hash` says whether their values are, `compare`
    where not.
    """

    def __init__(self, arrays: Mapping[str, ArrayLike], *,
                 frame: Optional[arguments.Window] = None,
                 window: Optional[arguments.Window] = None,
                 attributes: Optional[Mapping[str, str]] = None) -> None:
        written = arguments.texts("attributes", attributes)
        planes, codes = _planes(arrays)
        height, width = next(iter(planes.values())).shape
        for channel, plane in planes.items():
            if plane.shape != (height, width):
                raise arguments.wrong(f'film: "{channel}"', f"{plane.shape}",
                                      f"{(height, width)}, the shape of all")
        box = arguments.window(window) or (0, 0, width, height)
        whole = arguments.window(frame, "frame") or (0, 0, box[2], box[3])
        if (box[2] - box[0], box[3] - box[1]) != (width, height):
            raise arguments.wrong("window", arguments.shown(box),
                                  f"one of {width} x {height} pixels, as the arrays")
        if not (whole[0] <= box[0] and whole[1] <= box[1] and box[2] <= whole[2]
                and box[3] <= whole[3]):
            raise arguments.wrong("frame", arguments.shown(whole), f"one around the window {box}")
        self._film = _quadrel.film_of_arrays(planes, whole, box, codes)
        self._film.attributes = written

    @classmethod
    def _of(cls, film: _quadrel.Film) -> "Film":
        self = cls.__new__(cls)
        self._film = film
        return self

    # A mapping's would compare arrays.
    __eq__ = object.__eq__
    __hash__ = object.__hash__

    def __getitem__(self, channel: str) -> NDArray[Any]:
        if channel not in self._film.names:
            raise KeyError(channel)
        return self._film.plane(channel)

    def __iter__(self) -> Iterator[str]:
        return iter(self._film.names)

    def __len__(self) -> int:
        return len(self._film.names)

    def stack(self, *channels: str) -> NDArray[Any]:
        """Channels or groups ("N", "uv"; "RGB", "RGBA") as one array (height, width, components), a
        copy."""
        names: List[str] = []
        if not channels:
            raise arguments.wrong("stack", "no channel", "at least one")
        for channel in arguments.names("stack", channels):
            if channel in self:
                names.append(channel)
            else:
                names += _COLORS.get(channel) or _quadrel.expand_channels([channel])
        return np.stack([self[name] for name in names], axis=-1)

    @property
    def frame(self) -> Tuple[int, int, int, int]:
        """(x0, y0, x1, y1) of the whole image, half-open, from the top-left."""
        x0, y0, x1, y1 = self._film.frame
        return x0, y0, x1, y1

    @property
    def window(self) -> Tuple[int, int, int, int]:
        """The part of the frame that the arrays hold."""
        x0, y0, x1, y1 = self._film.window
        return x0, y0, x1, y1

    @property
    def attributes(self) -> Dict[str, str]:
        """What an EXR's header says: the resolved scene, its hash, stages, version (`quadrel:*`)."""
        return dict(self._film.attributes)

    @property
    def hash(self) -> str:
        """SHA-256 (hex) over frame, window and all channels, whatever their order."""
        return self._film.hash()

    def preview(self) -> NDArray[np.uint8]:
        """What `--preview` shows, 8-bit sRGB: (height, width, 3)."""
        return self._film.preview()

    def write(self, file: arguments.Path, *, compression: str = "zip") -> None:
        """Writes an EXR, whole or not at all. Raises OutputError, and UsageError for a name that does
        not end in .exr, or of a file that the film's scene was read from."""
        self._film.write(arguments.path(file, "write"), arguments.text("compression", compression))

    def __repr__(self) -> str:
        x0, y0, x1, y1 = self.window
        return f"<quadrel.Film {x1 - x0}x{y1 - y0}: {' '.join(self)}>"


Image = Union[Film, Mapping[str, ArrayLike], arguments.Path]


def film_of(image: Union[Film, Mapping[str, ArrayLike]]) -> Film:
    """A film as it is, arrays as a film."""
    if isinstance(image, Film):
        return image
    return Film(arguments.mapping("image", image, "a film or arrays by channel"))


def read(file: arguments.Path, *, layer: str = "", part: str = "") -> Film:
    """Reads an EXR: all channels, or those of a layer or part of it. Raises InputError."""
    return Film._of(_quadrel.read_film(arguments.path(file, "read"), arguments.text("layer", layer),
                                       arguments.text("part", part)))


def heatmap(reference: Union[Film, Mapping[str, ArrayLike]],
            test: Union[Film, Mapping[str, ArrayLike]]) -> NDArray[np.uint8]:
    """Where and how much two images differ, as `compare --heatmap` draws it: (height, width, 3)."""
    return _quadrel.heatmap(film_of(reference)._film, film_of(test)._film)

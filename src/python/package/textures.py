"""Textures, samplers, and maps that are derived from heights."""

from __future__ import annotations

import dataclasses
from typing import Any, List, Optional, Sequence, Tuple, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _quadrel, arguments
from .films import Film

_CODES = {np.dtype(np.uint8): ("unorm8", 255), np.dtype(np.uint16): ("unorm16", 65535)}


_MOST_FLOATS = 2**29


def _check_size(shape: Tuple[int, ...], channels: int, mips: str) -> None:
    """Of a texture of so many channels, before anything is copied."""
    height, width = shape[:2]
    count = height * width * channels
    while mips != "none" and max(height, width) > 1:
        height, width = max(height // 2, 1), max(width // 2, 1)
        count += height * width * channels
    if count > _MOST_FLOATS:
        raise arguments.wrong("texture", f"{' x '.join(map(str, shape))} values",
                              "at most 2^29, mip levels included")


def _array(values: ArrayLike) -> NDArray[Any]:
    """(height, width, channels), as it was given."""
    array = arguments.array("texture", values)
    shape = array.shape if array.ndim == 3 else (*array.shape, 1)
    if len(shape) != 3 or not (1 <= shape[0] <= 65536 and 1 <= shape[1] <= 65536
                               and 1 <= shape[2] <= 4):
        raise arguments.wrong("texture", f"an array of shape {array.shape}",
                              "(height, width) or (height, width, 1 to 4), of 1 to 65536 texels a side")
    return array[:, :, np.newaxis] if array.ndim == 2 else array


def _texels(array: NDArray[Any]) -> Tuple[NDArray[np.float32], str]:
    """As floats, and the format that they are of."""
    if array.dtype in _CODES:
        stored, most = _CODES[array.dtype]
        return array.astype(np.float32) / np.float32(most), stored
    if array.dtype.kind != "f":
        raise arguments.wrong("texture", str(array.dtype), "floats, uint8 or uint16")
    return array.astype(np.float32), "half" if array.dtype == np.float16 else "float"


class Texture:
    """A texture with its mip levels, each rounded to a format as a GPU holds it.

    image    an array (height, width) or (height, width, 1 to 4), row 0 at v = 0, or a file. uint8 and
             uint16 are codes, which stand for code / 255 and code / 65535
    srgb     r, g and b are sRGB-encoded
    format   "unorm8", "srgb8", "unorm16", "half" or "float"; the image's own unless given
    mips     "box" (2x2 means), "area" (exact areas), "none"
    swizzle  what each channel takes, as "rgb1", "a", "1-r"
    flip_v   row 0 of the texture is the image's last row
    """

    def __init__(self, image: Union[ArrayLike, arguments.Path], *, srgb: bool = False,
                 format: str = "", mips: str = "box", swizzle: str = "", flip_v: bool = False,
                 layer: str = "", part: str = "") -> None:
        options = _quadrel.TextureOptions(arguments.text("swizzle", swizzle), bool(srgb),
                                          arguments.text("format", format),
                                          arguments.text("mips", mips), bool(flip_v))
        if isinstance(image, (str, bytes)) or hasattr(image, "__fspath__"):
            file = arguments.path(cast(arguments.Path, image))
            self._texture = _quadrel.read_texture(file, options, arguments.text("layer", layer),
                                                  arguments.text("part", part))
        else:
            array = _array(image)
            # What a swizzle takes the library knows.
            held = 1 if swizzle else {3: 4}.get(array.shape[2], array.shape[2])
            _check_size(array.shape, held, mips)
            texels, stored = _texels(array)
            self._texture = _quadrel.texture_of_array(texels, stored, options)

    @classmethod
    def of_levels(cls, levels: Sequence[ArrayLike]) -> "Texture":
        """Of mip levels that someone else has made, the finest first: arrays (height, width, 1, 2 or
        4), taken as they are."""
        arrays = [_array(level) for level in levels]
        if sum(array.size for array in arrays) > _MOST_FLOATS:
            raise arguments.wrong("levels", "more", "at most 2^29 floats")
        return cls._of(_quadrel.texture_of_levels([_texels(array)[0] for array in arrays]))

    @classmethod
    def _of(cls, texture: _quadrel.Texture) -> "Texture":
        self = cls.__new__(cls)
        self._texture = texture
        return self

    @property
    def levels(self) -> List[NDArray[np.float32]]:
        """The mip levels, the finest first: (height, width, channels), of maps of several layers
        (layers, height, width, channels). Views of the texture's memory that cannot be written to."""
        return [self._texture.level(i) for i in range(self._texture.level_count)]

    @property
    def channels(self) -> int:
        return self._texture.channels

    @property
    def layers(self) -> int:
        """1, but of baked maps of several layers."""
        return self._texture.layers

    @property
    def format(self) -> str:
        return self._texture.format

    def __repr__(self) -> str:
        height, width = self._texture.level(0).shape[-3:-1]
        return (f"<quadrel.Texture {width}x{height}, {self.channels} channels of {self.format}, "
                f"{self._texture.level_count} levels>")


@dataclasses.dataclass(frozen=True)
class Sampler:
    """How a texture is sampled.

    wrap      of both axes, or wrap_u and wrap_v: repeat, mirrored-repeat, clamp-to-edge,
              clamp-to-border, mirror-once
    mag, min  nearest or linear, within a level; mip: none, nearest or linear, between levels
    border    r g b a outside with clamp-to-border
    lod_bias, lod_min, lod_max   in levels
    hardware  whose arithmetic: exact, d3d, vulkan-min, llvmpipe, swiftshader, chromium
    """

    wrap: str = "repeat"
    wrap_u: Optional[str] = None
    wrap_v: Optional[str] = None
    mag: str = "linear"
    min: str = "linear"
    mip: str = "linear"
    border: Sequence[float] = (0.0, 0.0, 0.0, 0.0)
    lod_bias: float = 0.0
    lod_min: float = -1000.0
    lod_max: float = 1000.0
    hardware: str = "exact"

    def state(self) -> _quadrel.SamplerState:
        """What the extension module takes. Raises UsageError."""
        border = list(self.border) if np.iterable(self.border) else []
        if len(border) != 4:
            raise arguments.wrong("border", arguments.shown(self.border), "r, g, b and a")
        word, number = arguments.text, arguments.number
        return _quadrel.SamplerState(
            word("wrap_u", self.wrap_u or self.wrap), word("wrap_v", self.wrap_v or self.wrap),
            word("mag", self.mag), word("min", self.min), word("mip", self.mip),
            [number("border", value) for value in border], number("lod_bias", self.lod_bias),
            number("lod_min", self.lod_min), number("lod_max", self.lod_max),
            word("hardware", self.hardware))


@dataclasses.dataclass(frozen=True)
class DepthLayers:
    """Depth layers of a mesh."""

    film: Film  #: R G B A: front, back, second front, second back, from 0 to 1; second.R ... of the
    #: third and fourth solid, third.R ... of the fifth and sixth
    tile: float  #: length of the square of texture space, in the mesh's units
    thickness: float  #: of the relief, depths from 0 to 1, in the mesh's units
    deeper: int  #: texels under which more solids lie than are kept, the nearest ones


def depth_layers(mesh: arguments.Path, *, size: Tuple[int, int] = (256, 256),
                 towards: Sequence[float] = (0.0, 0.0, -1.0),
                 margin: float = 1 / 16, solids: int = 2,
                 progress: arguments.Progress = None) -> DepthLayers:
    """Peels a closed mesh (a file, or cube, icosahedron, sphere, torus) into the depth layers that
    searches behind things read, as `quadrel bake --kind depth-layers`. `towards` is the way of depth
    in the mesh's own axes, `margin` the tiles left free on its longer side, [0, 0.5), `solids`
    how many behind each other are kept, 1 to 6. Ctrl-C ends it, once the mesh is read. Raises InputError for a mesh that is not closed."""
    width, height = arguments.size(size, 16384)
    margin = arguments.number("margin", margin)
    try:
        direction = np.asarray(towards, dtype=np.float64)
    except (TypeError, ValueError):
        direction = np.zeros(0)
    largest = np.abs(direction).max(initial=0)
    if direction.shape != (3,) or not 1e-100 < largest <= 1e100:
        raise arguments.wrong("towards", arguments.shown(towards), "3 numbers, not all 0")
    if not 0 <= margin < 0.5:
        raise arguments.wrong("margin", f"{margin}", "a number in [0, 0.5)")
    with arguments.progress(progress) as told:
        film, tile, thickness, deeper = _quadrel.peel_layers(
            arguments.path(mesh, "mesh"), width, height, list(direction / largest), margin,
            arguments.whole("solids", solids, 1, _quadrel.most_solids), told)
    return DepthLayers(Film._of(film), tile, thickness, deeper)


def bake(heights: Union[Texture, ArrayLike, arguments.Path], kind: str, *, channel: str = "r",
         wrap: str = "repeat", wrap_u: Optional[str] = None, wrap_v: Optional[str] = None,
         border: float = 0.0, format: str = "", flip_v: bool = False, cache: bool = True,
         threads: int = 0, output: Optional[arguments.Path] = None,
         progress: arguments.Progress = None, **parameters: float) -> Texture:
    """Derives a map from a height field, such as cones or a pyramid: `bake(heights, "cone-cell")`.

    `quadrel bake --help` lists the kinds and their `parameters` (`slices=32`). A map holds for one
    pair of wrap modes and one border height. Of an array or a file `channel` (r, g, b, a, or 1-r ...
    for depth) has the heights; of a texture the first of level 0. `cache`: maps are kept in and taken
    from the disk cache; `output` also writes an EXR that scenes can name, never over the heights'
    file. Ctrl-C ends it. Raises InputError, UsageError, OutputError.
    """
    kind = arguments.text("kind", kind)
    if not isinstance(heights, Texture):
        heights = Texture(heights, format=format, mips="none", flip_v=flip_v,
                          swizzle="" if _quadrel.bakes_layers(kind) else channel)
    sampler = Sampler(wrap=wrap, wrap_u=wrap_u, wrap_v=wrap_v, border=(border,) * 4).state()
    file = None if output is None else arguments.path(output, "output")
    with arguments.progress(progress) as told:
        return Texture._of(_quadrel.bake(heights._texture, kind, sampler,
                                         {name: arguments.number(name, value)
                                          for name, value in parameters.items()},
                                         bool(cache), arguments.whole("threads", threads, 0, 1024),
                                         file, told))

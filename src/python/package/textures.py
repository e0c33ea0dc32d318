"""Textures, samplers, and maps that are derived from heights."""

from __future__ import annotations

import dataclasses
from typing import List, Optional, Sequence, Tuple, Union, cast

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _quadrel, arguments
from .films import Film

_CODES = {np.dtype(np.uint8): ("unorm8", 255), np.dtype(np.uint16): ("unorm16", 65535)}


def _texels(values: ArrayLike) -> Tuple[NDArray[np.float32], str]:
    """(height, width, channels), and the format that they are of."""
    array = np.asarray(values)
    if array.ndim == 2:
        array = array[:, :, np.newaxis]
    if array.dtype in _CODES:
        stored, most = _CODES[array.dtype]
        return array.astype(np.float32) / np.float32(most), stored
    if array.dtype.kind != "f":
        raise TypeError(f"texture: found {array.dtype}, expected floats, uint8 or uint16")
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
        options = _quadrel.TextureOptions(swizzle, srgb, format, mips, flip_v)
        if isinstance(image, (str, bytes)) or hasattr(image, "__fspath__"):
            file = arguments.path(cast(arguments.Path, image))
            self._texture = _quadrel.read_texture(file, options, layer, part)
        else:
            texels, stored = _texels(image)
            self._texture = _quadrel.texture_of_array(texels, stored, options)

    @classmethod
    def of_levels(cls, levels: Sequence[ArrayLike]) -> "Texture":
        """Of mip levels that someone else has made, the finest first: arrays (height, width, 1, 2 or
        4), taken as they are."""
        return cls._of(_quadrel.texture_of_levels([_texels(level)[0] for level in levels]))

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
        if len(self.border) != 4:
            raise _quadrel.UsageError("border: expected r, g, b and a")
        return _quadrel.SamplerState(self.wrap_u or self.wrap, self.wrap_v or self.wrap, self.mag,
                                     self.min, self.mip, list(self.border), self.lod_bias,
                                     self.lod_min, self.lod_max, self.hardware)


@dataclasses.dataclass(frozen=True)
class DepthLayers:
    """Depth layers of a mesh."""

    film: Film  #: R G B A: front, back, second front, second back, from 0 to 1
    tile: float  #: length of the square of texture space, in the mesh's units
    thickness: float  #: of the relief, depths from 0 to 1, in the mesh's units
    deeper: int  #: texels under which more than two solids lie; the nearest two are kept


def depth_layers(mesh: arguments.Path, *, size: Tuple[int, int] = (256, 256),
                 towards: Sequence[float] = (0.0, 0.0, -1.0),
                 margin: float = 1 / 16) -> DepthLayers:
    """Peels a closed mesh (a file, or cube, icosahedron, sphere, torus) into the depth layers that
    searches behind things read, as `quadrel bake --kind depth-layers`. `towards` is the way of depth
    in the mesh's own axes, `margin` the tiles left free on its longer side, [0, 0.5). Raises
    InputError for a mesh that is not closed."""
    width, height = (arguments.whole("size", side, 1, 16384) for side in size)
    direction = np.asarray(towards, dtype=np.float64)
    largest = np.abs(direction).max(initial=0)
    if direction.shape != (3,) or not 1e-100 < largest <= 1e100:
        raise _quadrel.UsageError(f"towards: found {towards}, expected 3 numbers, not all 0")
    if not 0 <= margin < 0.5:
        raise _quadrel.UsageError(f"margin: found {margin}, expected a number in [0, 0.5)")
    film, tile, thickness, deeper = _quadrel.peel_layers(
        arguments.path(mesh), width, height, list(direction / largest), margin)
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
    from the disk cache; `output` also writes an EXR that scenes can name. Ctrl-C ends it. Raises
    InputError, UsageError, OutputError.
    """
    if not isinstance(heights, Texture):
        heights = Texture(heights, format=format, mips="none", flip_v=flip_v,
                          swizzle="" if _quadrel.bakes_layers(kind) else channel)
    sampler = Sampler(wrap=wrap, wrap_u=wrap_u, wrap_v=wrap_v, border=(border,) * 4).state()
    file = b"" if output is None else arguments.path(output)
    return Texture._of(_quadrel.bake(heights._texture, kind, sampler,
                                     {name: float(value) for name, value in parameters.items()},
                                     cache, arguments.whole("threads", threads, 0, 1024), file, arguments.progress(progress)))

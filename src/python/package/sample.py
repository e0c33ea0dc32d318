"""Texture look-ups over arrays, as GPUs make them, bit for bit those of the renderer.

A texture is a `Texture`, or what one is made of (an array; its mip levels are made at each call then).
`uv` is (..., 2) in units of the texture, row 0 of the texture at v = 0; values are (..., 4), r g b a,
with 0, 0, 1 for g, b, a that the texture lacks. Look-ups are computed in float32, with number="double"
in float64.

    checks = quadrel.Texture([[0.0, 1.0], [1.0, 0.0]])
    nearest = quadrel.Sampler(wrap="clamp-to-edge", mag="nearest")
    quadrel.sample.texture_lod(checks, (0.75, 0.25), 0, sampler=nearest)     # (1, 0, 0, 1)
"""

from __future__ import annotations

import dataclasses
from typing import Any, Dict, Optional, Tuple, Union

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _quadrel, arguments, quad
from .textures import Sampler, Texture

Source = Union[Texture, ArrayLike, arguments.Path]


@dataclasses.dataclass(frozen=True)
class LevelOfDetail:
    """How a look-up chose its levels; arrays of the look-ups' shape."""

    rho: NDArray[Any]  #: texels of level 0 that a pixel spans; 0 where the level was given
    lambda_: NDArray[Any]  #: log2(rho) plus bias, before any clamp
    level: NDArray[Any]  #: clamped; a whole number where levels are not blended
    frac: NDArray[Any]  #: weight of level + 1
    magnified: NDArray[np.bool_]  #: the magnification filter applies


@dataclasses.dataclass(frozen=True)
class Footprint:
    """The texels of look-ups: arrays (..., 8), of which the first `count` count."""

    count: NDArray[np.int32]  #: (...): 1 to 8
    level: NDArray[np.int32]
    x: NDArray[np.int32]
    y: NDArray[np.int32]
    border: NDArray[np.bool_]  #: outside, with clamp-to-border: the border's colour
    weight: NDArray[np.float64]  #: share in the result; 1 in all
    value: NDArray[np.float32]  #: (..., 8, 4): r g b a
    lod: LevelOfDetail


class _Lanes:
    """Arguments of look-ups, flat, and what comes out in their shape."""

    def __init__(self, kind: str, number: str, y_up: bool) -> None:
        if number not in ("float", "double"):
            raise arguments.wrong("number", arguments.shown(number), "float or double")
        self.kind = kind
        self.y_up = y_up
        self.double = number == "double"
        self.dtype = np.float64 if self.double else np.float32
        self._given: Dict[str, NDArray[Any]] = {}

    def add(self, name: str, values: ArrayLike) -> None:
        try:
            self._given[name] = np.asarray(values, dtype=self.dtype)
        except (TypeError, ValueError):
            raise arguments.wrong(name, arguments.shown(values), "numbers") from None

    def add_whole(self, name: str, values: ArrayLike) -> None:
        given = arguments.array("texel_fetch", values)
        if given.dtype.kind not in "ui":
            raise arguments.wrong("texel_fetch", str(given.dtype), "integers")
        self._given[name] = np.clip(given, -1, 2**31 - 1).astype(np.int32)

    def add_pair(self, names: Tuple[str, str], values: ArrayLike, what: str) -> None:
        pair = arguments.array(what, values)
        if pair.ndim < 1 or pair.shape[-1] != 2:
            raise arguments.wrong(what, f"an array of shape {pair.shape}",
                                  "two components on the last axis")
        add = self.add_whole if what == "xy" else self.add
        add(names[0], pair[..., 0])
        add(names[1], pair[..., 1])

    def arrays(self) -> Dict[str, NDArray[Any]]:
        shapes = [a.shape for a in self._given.values()]
        try:
            self.shape = np.broadcast_shapes(*shapes)
        except ValueError:
            raise arguments.wrong("look-up", f"arrays of the shapes {shapes}",
                                  "ones that broadcast") from None
        return {name: self._flat(np.broadcast_to(a, self.shape))
                for name, a in self._given.items()}

    def _flat(self, values: NDArray[Any]) -> NDArray[Any]:
        if self.kind == "implicit":
            return quad.to_quads(values, self.y_up)
        # Nothing is taken from neighbours: any numbers fill the last quad.
        flat = np.zeros(-(-values.size // 4) * 4, dtype=values.dtype)
        flat[:values.size] = values.reshape(-1)
        return flat

    def shaped(self, lanes: NDArray[Any]) -> NDArray[Any]:
        if self.kind == "implicit":
            return quad.from_quads(lanes, self.shape, self.y_up)
        size = int(np.prod(self.shape, dtype=np.int64))
        return lanes[:size].reshape((*self.shape, *lanes.shape[1:]))


def _request(texture: Source, sampler: Optional[Sampler], lanes: _Lanes, mode: str = "fine",
             component: int = 0) -> _quadrel.LookUp:
    held = texture if isinstance(texture, Texture) else Texture(texture)
    if held.layers > 1:
        raise arguments.wrong("texture", f"a map of {held.layers} layers",
                              "one: Texture.of_levels([level[0] for level in map.levels])")
    chosen = Sampler() if sampler is None else sampler
    if not isinstance(chosen, Sampler):
        raise arguments.wrong("sampler", arguments.shown(chosen), "a Sampler")
    return _quadrel.LookUp(held._texture, chosen.state(), lanes.kind, arguments.text("mode", mode),
                           component, lanes.arrays())


def _values(request: _quadrel.LookUp, lanes: _Lanes) -> NDArray[Any]:
    return lanes.shaped(_quadrel.look_up(request, lanes.double))


def _lanes_of(uv: Optional[ArrayLike], lod: Optional[ArrayLike], duvdx: Optional[ArrayLike],
              duvdy: Optional[ArrayLike], bias: ArrayLike, y_up: bool, number: str) -> _Lanes:
    """Of look-ups whose level is given, or by gradients, or by the differences of uv."""
    if (duvdx is None) != (duvdy is None):
        raise arguments.wrong("duvdx, duvdy", "one of them", "both of them, or neither")
    if lod is not None and duvdx is not None:
        raise arguments.wrong("lod", "it beside duvdx and duvdy", "one of them")
    kind = "level" if lod is not None else "gradients" if duvdx is not None else "implicit"
    lanes = _Lanes(kind, number, y_up)
    if uv is not None:
        lanes.add_pair(("u", "v"), uv, "uv")
    elif kind == "implicit":
        raise arguments.wrong("look-up", "nothing", "uv, lod, or duvdx and duvdy")
    if lod is not None:
        lanes.add("level", lod)
    if duvdx is not None and duvdy is not None:
        lanes.add_pair(("dudx", "dvdx"), duvdx, "duvdx")
        lanes.add_pair(("dudy", "dvdy"), duvdy, "duvdy")
    if kind == "implicit":
        lanes.add("bias", bias)
    return lanes


def texture(texture: Source, uv: ArrayLike, *, sampler: Optional[Sampler] = None,
            bias: ArrayLike = 0, mode: str = "fine", y_up: bool = False,
            number: str = "float") -> NDArray[Any]:
    """A look-up with implicit derivatives: `uv` is an image (..., height, width, 2) of fragments whose
    2x2 quads give the level of detail (`quadrel.quad` has what a quad is, `mode` and `y_up`). `bias`
    in levels."""
    lanes = _lanes_of(uv, None, None, None, bias, y_up, number)
    return _values(_request(texture, sampler, lanes, mode), lanes)


def texture_lod(texture: Source, uv: ArrayLike, lod: ArrayLike, *,
                sampler: Optional[Sampler] = None, number: str = "float") -> NDArray[Any]:
    """The level of detail is given, 0 the finest; the sampler's bias and clamps apply."""
    lanes = _lanes_of(uv, lod, None, None, 0, False, number)
    return _values(_request(texture, sampler, lanes), lanes)


def texture_grad(texture: Source, uv: ArrayLike, duvdx: ArrayLike, duvdy: ArrayLike, *,
                 sampler: Optional[Sampler] = None, number: str = "float") -> NDArray[Any]:
    """The level of detail comes from the gradients of uv, (..., 2) per pixel."""
    lanes = _lanes_of(uv, None, duvdx, duvdy, 0, False, number)
    return _values(_request(texture, sampler, lanes), lanes)


def texture_gather(texture: Source, uv: ArrayLike, component: int = 0, *,
                   sampler: Optional[Sampler] = None, number: str = "float") -> NDArray[Any]:
    """One component (0 to 3) of the four texels of the linear footprint of level 0, in GLSL's order:
    (left, larger v), (right, larger v), (right, smaller v), (left, smaller v)."""
    component = arguments.whole("component", component, 0, 3)
    lanes = _Lanes("gather", number, False)
    lanes.add_pair(("u", "v"), uv, "uv")
    return _values(_request(texture, sampler, lanes, component=component), lanes)


def texel_fetch(texture: Source, xy: ArrayLike, level: ArrayLike = 0) -> NDArray[np.float32]:
    """Single texels by column and row, (..., 2) integers, unfiltered; 0 outside."""
    lanes = _Lanes("fetch", "float", False)
    lanes.add_pair(("x", "y"), xy, "xy")
    lanes.add_whole("z", level)
    return _values(_request(texture, None, lanes), lanes)


def level_of_detail(texture: Source, uv: Optional[ArrayLike] = None, *,
                    lod: Optional[ArrayLike] = None, duvdx: Optional[ArrayLike] = None,
                    duvdy: Optional[ArrayLike] = None, sampler: Optional[Sampler] = None,
                    bias: ArrayLike = 0, mode: str = "fine", y_up: bool = False,
                    number: str = "float") -> LevelOfDetail:
    """Which levels a look-up reads: of a given `lod`, by gradients, or by the quads of `uv`."""
    lanes = _lanes_of(uv, lod, duvdx, duvdy, bias, y_up, number)
    return _level_of_detail(_request(texture, sampler, lanes, mode), lanes)


def _level_of_detail(request: _quadrel.LookUp, lanes: _Lanes) -> LevelOfDetail:
    records = lanes.shaped(_quadrel.levels_of_detail(request, lanes.double))
    rho, lambda_, level, frac, magnified = (records[..., i] for i in range(5))
    return LevelOfDetail(rho, lambda_, level, frac, magnified != 0)


def footprint(texture: Source, uv: ArrayLike, *, lod: Optional[ArrayLike] = None,
              duvdx: Optional[ArrayLike] = None, duvdy: Optional[ArrayLike] = None,
              sampler: Optional[Sampler] = None, bias: ArrayLike = 0, mode: str = "fine",
              y_up: bool = False, number: str = "float") -> Footprint:
    """Which texels a look-up reads and with which weights, as `level_of_detail` takes it: the finer
    level first, then by row, then by column."""
    lanes = _lanes_of(uv, lod, duvdx, duvdy, bias, y_up, number)
    request = _request(texture, sampler, lanes, mode)
    count, level, x, y, border, weight, value = (
        lanes.shaped(array) for array in _quadrel.footprints(request, lanes.double))
    return Footprint(count, level, x, y, border, weight, value, _level_of_detail(request, lanes))

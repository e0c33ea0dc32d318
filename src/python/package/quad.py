"""Derivatives over 2x2 quads, as GPUs take them.

Arrays are images, rows and columns of fragments on the last two axes unless `axes` says otherwise,
both even. A quad is two columns of two rows, from row 0 and column 0 on: window coordinates that are
even, then odd. Where rows run down and window y runs up (images of `conventions: gl`, as a film has
them), `y_up=True`. `mode` is "fine", each row (column) its own difference, or "coarse", one for the
quad. float64 is computed in float64, all else in float32.

    dudx = quadrel.quad.dFdx(film["uv.U"])
    dudy = quadrel.quad.dFdy(film["uv.U"], y_up=True)

Fragments of one quad must belong to one triangle, or the difference is between two surfaces; a film
has no helper lanes.
"""

from __future__ import annotations

from typing import Any, Tuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from . import _quadrel, arguments

Axes = Tuple[int, int]


def _odd(image: NDArray[Any]) -> _quadrel.UsageError:
    return arguments.wrong("quads", f"an array of shape {image.shape}",
                           "rows and columns, an even number of each")


def to_quads(image: NDArray[Any], y_up: bool) -> NDArray[Any]:
    """(..., height, width) as one flat array, quad by quad: (even x, even y), (odd, even),
    (even, odd), (odd, odd)."""
    if image.ndim < 2 or image.shape[-2] % 2 or image.shape[-1] % 2:
        raise _odd(image)
    rows = image[..., ::-1, :] if y_up else image
    height, width = image.shape[-2:]
    split = rows.reshape(*image.shape[:-2], height // 2, 2, width // 2, 2)
    return np.ascontiguousarray(split.swapaxes(-3, -2)).reshape(-1)


def from_quads(lanes: NDArray[Any], shape: Tuple[int, ...], y_up: bool) -> NDArray[Any]:
    """The inverse, of lanes with any axes behind: (..., height, width) and those."""
    height, width = shape[-2:]
    behind = lanes.shape[1:]
    count = int(np.prod(shape[:-2], dtype=np.int64))
    split = lanes.reshape(count, height // 2, width // 2, 2, 2, *behind)
    image = split.swapaxes(2, 3).reshape(*shape, *behind)
    return np.flip(image, axis=len(shape) - 2) if y_up else image


def _differences(which: str, values: ArrayLike, mode: str, y_up: bool, axes: Axes) -> NDArray[Any]:
    given = arguments.array("quads", values)
    if given.ndim < 2:
        raise _odd(given)
    exact = given.dtype == np.float64
    if given.dtype.kind not in "fuib":
        raise arguments.wrong("quads", str(given.dtype), "numbers")
    numbers = given.astype(np.float64 if exact else np.float32, copy=False)
    try:
        image = np.moveaxis(numbers, axes, (-2, -1))
    except (TypeError, ValueError):
        raise arguments.wrong("axes", arguments.shown(axes),
                              f"two of the array's {given.ndim}") from None
    lanes = _quadrel.differences(which, arguments.text("mode", mode), to_quads(image, y_up), exact)
    return np.moveaxis(from_quads(lanes, image.shape, y_up), (-2, -1), axes)


def dFdx(values: ArrayLike, *, mode: str = "fine", y_up: bool = False,
         axes: Axes = (-2, -1)) -> NDArray[Any]:
    """Right minus left in each quad, of the array's shape."""
    return _differences("x", values, mode, y_up, axes)


def dFdy(values: ArrayLike, *, mode: str = "fine", y_up: bool = False,
         axes: Axes = (-2, -1)) -> NDArray[Any]:
    """Larger window y minus smaller in each quad, of the array's shape."""
    return _differences("y", values, mode, y_up, axes)


def fwidth(values: ArrayLike, *, mode: str = "fine", y_up: bool = False,
           axes: Axes = (-2, -1)) -> NDArray[Any]:
    """|dFdx| + |dFdy|, of the array's shape."""
    return _differences("width", values, mode, y_up, axes)

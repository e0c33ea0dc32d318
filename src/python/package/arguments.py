"""Arguments as the extension module takes them."""

from __future__ import annotations

import os
from typing import Any, Callable, Optional, Protocol, Sequence, Tuple, Union, cast

Path = Union[str, "os.PathLike[str]"]
Window = Sequence[int]


class Bar(Protocol):
    """A progress bar of tqdm's kind."""

    n: float
    total: Optional[float]

    def update(self, n: float) -> Any: ...


Progress = Union[Callable[[float], Any], Bar, None]


def path(file: Path) -> bytes:
    """A file's name, whatever its bytes."""
    return os.fsencode(file)


def window(box: Optional[Window]) -> Optional[Tuple[int, ...]]:
    return None if box is None else tuple(int(side) for side in box)


def progress(told: Progress) -> Optional[Callable[[float], Any]]:
    """What is called with 0 to 1: a function, or one that moves a bar."""
    if told is None:
        return None
    if not hasattr(told, "update"):
        if not callable(told):
            raise TypeError("progress: expected a function of a float, or a bar as tqdm's")
        return told
    bar = cast(Bar, told)
    total = bar.total = 1.0 if bar.total is None else bar.total

    def move(share: float) -> None:
        bar.update(share * total - bar.n)

    return move

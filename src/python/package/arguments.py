"""Arguments as the extension module takes them."""

from __future__ import annotations

import operator
import os
from typing import Any, Callable, List, Optional, Protocol, Sequence, Tuple, Union, cast

from . import _quadrel

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


def whole(what: str, number: int, least: int, most: int) -> int:
    """A whole number that is not beyond what is permitted."""
    index = operator.index(number)
    if not least <= index <= most:
        raise _quadrel.UsageError(f"{what}: found {index}, expected {least} to {most}")
    return index


def window(box: Optional[Window]) -> Optional[Tuple[int, ...]]:
    if box is None:
        return None
    if isinstance(box, str) or len(box) != 4:
        raise _quadrel.UsageError(f"window: found {box!r}, expected (x0, y0, x1, y1)")
    return tuple(whole("window", side, 0, 65536) for side in box)


def running(number: str, isa: str, threads: int) -> _quadrel.Running:
    return _quadrel.Running(number, isa, whole("threads", threads, 0, 1024))


def names(what: str, given: Union[str, Sequence[str]]) -> List[str]:
    """One name, or several."""
    several = [given] if isinstance(given, str) else list(given)
    for name in several:
        if not isinstance(name, str):
            raise TypeError(f"{what}: found {name!r}, expected names")
    return several


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

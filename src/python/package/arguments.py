"""Arguments as the extension module takes them."""

from __future__ import annotations

import operator
import os
from typing import (Any, Callable, Dict, List, Mapping, Optional, Protocol, Sequence, Tuple, Union,
                    cast)

import numpy as np
from numpy.typing import NDArray

from . import _quadrel

Path = Union[str, "os.PathLike[str]"]
Window = Sequence[int]


class Bar(Protocol):
    """A progress bar of tqdm's kind."""

    n: float
    total: Optional[float]

    def update(self, n: float) -> Any: ...


Progress = Union[Callable[[float], Any], Bar, None]


def shown(value: Any) -> str:
    """What was found, on one line and short."""
    most = 60
    line = " ".join(repr(value).split())
    return line if len(line) <= most else f"{line[:most]}..."


def path(file: Path, what: str = "file") -> bytes:
    """A file's name, whatever its bytes."""
    try:
        return os.fsencode(file)
    except (TypeError, UnicodeEncodeError):
        raise _quadrel.UsageError(
            f"{what}: found {shown(file)}, expected the name of a file") from None


def text(what: str, given: str) -> str:
    """A text that UTF-8 can say."""
    if isinstance(given, str):
        try:
            given.encode()
            return given
        except UnicodeEncodeError:
            pass
    raise _quadrel.UsageError(f"{what}: found {shown(given)}, expected a text")


def texts(what: str, given: Optional[Mapping[str, str]]) -> Dict[str, str]:
    """Texts by name."""
    return {text(what, name): text(what, value)
            for name, value in mapping(what, given, "texts by name").items()}


def mapping(what: str, given: Optional[Mapping[str, Any]], expected: str) -> Mapping[str, Any]:
    """A mapping; None is an empty one."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise _quadrel.UsageError(f"{what}: found {shown(given)}, expected {expected}")
    return given


def array(what: str, values: Any) -> NDArray[Any]:
    """What numpy makes an array of."""
    try:
        return np.asarray(values)
    except (TypeError, ValueError):
        raise _quadrel.UsageError(
            f"{what}: found {shown(values)}, expected an array") from None


def index(what: str, number: int) -> int:
    """A whole number, of any size."""
    try:
        if isinstance(number, (bool, np.bool_)):
            raise TypeError
        return operator.index(number)
    except TypeError:
        raise _quadrel.UsageError(
            f"{what}: found {shown(number)}, expected a whole number") from None


def whole(what: str, number: int, least: int, most: int) -> int:
    """A whole number that is not beyond what is permitted."""
    given = index(what, number)
    if not least <= given <= most:
        raise _quadrel.UsageError(f"{what}: found {given}, expected {least} to {most}")
    return given


def number(what: str, given: float) -> float:
    """A number as Python or numpy has it."""
    try:
        if isinstance(given, (str, bytes)):
            raise TypeError
        return float(given)
    except (TypeError, ValueError, OverflowError):
        raise _quadrel.UsageError(
            f"{what}: found {shown(given)}, expected a number") from None


def wholes(what: str, given: Sequence[int], names: str, least: int, most: int) -> Tuple[int, ...]:
    """So many whole numbers as there are names."""
    count = len(names.split(", "))
    values = list(given) if np.iterable(given) and not isinstance(given, (str, bytes)) else []
    if len(values) != count or isinstance(given, (Mapping, set, frozenset)):
        raise _quadrel.UsageError(f"{what}: found {shown(given)}, expected ({names})")
    return tuple(whole(what, value, least, most) for value in values)


def window(box: Optional[Window]) -> Optional[Tuple[int, ...]]:
    return None if box is None else wholes("window", box, "x0, y0, x1, y1", 0, 65536)


def size(given: Sequence[int], most: int) -> Tuple[int, ...]:
    return wholes("size", given, "width, height", 1, most)


def running(number: str, isa: str, threads: int) -> _quadrel.Running:
    return _quadrel.Running(text("number", number), text("isa", isa),
                            whole("threads", threads, 0, 1024))


def names(what: str, given: Union[str, Sequence[str]]) -> List[str]:
    """One name, or several."""
    if isinstance(given, str):
        return [text(what, given)]
    if not np.iterable(given):
        raise _quadrel.UsageError(f"{what}: found {shown(given)}, expected names")
    return [text(what, name) for name in given]


def progress(told: Progress) -> Optional[Callable[[float], Any]]:
    """What is called with 0 to 1: a function, or one that moves a bar."""
    if told is None:
        return None
    if not hasattr(told, "update"):
        if not callable(told):
            raise _quadrel.UsageError(f"progress: found {shown(told)}, expected a function of a "
                                      "float, or a bar as tqdm's")
        return told
    bar = cast(Bar, told)
    total = bar.total = 1.0 if bar.total is None else bar.total

    def move(share: float) -> None:
        bar.update(share * total - bar.n)

    return move

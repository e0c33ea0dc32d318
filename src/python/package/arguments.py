"""Arguments as the extension module takes them."""

from __future__ import annotations

import contextlib
import operator
import os
from typing import (Any, Callable, Dict, Iterator, List, Mapping, Optional, Protocol, Sequence, Tuple,
                    Union, cast)

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


def wrong(key: str, found: str, expected: str) -> _quadrel.UsageError:
    """The error of an argument that is not as expected, by its parts."""
    error = _quadrel.UsageError(f"{key}: found {found}, expected {expected}")
    error.key, error.found, error.expected = key, found, expected
    return error


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
        raise wrong(what, shown(file), "the name of a file") from None


def text(what: str, given: str) -> str:
    """A text that UTF-8 can say."""
    if isinstance(given, str):
        try:
            given.encode()
            return given
        except UnicodeEncodeError:
            pass
    raise wrong(what, shown(given), "a text")


def texts(what: str, given: Optional[Mapping[str, str]]) -> Dict[str, str]:
    """Texts by name."""
    return {text(what, name): text(what, value)
            for name, value in mapping(what, given, "texts by name").items()}


def mapping(what: str, given: Optional[Mapping[str, Any]], expected: str) -> Mapping[str, Any]:
    """A mapping; None is an empty one."""
    if given is None:
        return {}
    if not isinstance(given, Mapping):
        raise wrong(what, shown(given), expected)
    return given


def array(what: str, values: Any) -> NDArray[Any]:
    """What numpy makes an array of."""
    try:
        return np.asarray(values)
    except (TypeError, ValueError):
        raise wrong(what, shown(values), "an array") from None


def index(what: str, number: int) -> int:
    """An integer of Python's or numpy's, of any size: neither a bool nor a float, though it be whole."""
    try:
        if isinstance(number, (bool, np.bool_)):
            raise TypeError
        return operator.index(number)
    except TypeError:
        raise wrong(what, f"{shown(number)} ({type(number).__name__})", "an integer") from None


def whole(what: str, number: int, least: int, most: int) -> int:
    """An integer that is not beyond what is permitted."""
    given = index(what, number)
    if not least <= given <= most:
        raise wrong(what, str(given), f"{least} to {most}")
    return given


def number(what: str, given: float) -> float:
    """A number as Python or numpy has it."""
    try:
        if isinstance(given, (str, bytes, bool, np.bool_)):
            raise TypeError
        return float(given)
    except (TypeError, ValueError, OverflowError):
        raise wrong(what, f"{shown(given)} ({type(given).__name__})", "a number") from None


def wholes(what: str, given: Sequence[int], names: str, least: int, most: int) -> Tuple[int, ...]:
    """So many integers as there are names."""
    count = len(names.split(", "))
    values = list(given) if np.iterable(given) and not isinstance(given, (str, bytes)) else []
    if len(values) != count or isinstance(given, (Mapping, set, frozenset)):
        raise wrong(what, shown(given), f"({names})")
    return tuple(whole(what, value, least, most) for value in values)


def window(box: Optional[Window], what: str = "window") -> Optional[Tuple[int, ...]]:
    """(x0, y0, x1, y1) with pixels in it."""
    if box is None:
        return None
    x0, y0, x1, y1 = wholes(what, box, "x0, y0, x1, y1", 0, 65536)
    if x0 >= x1 or y0 >= y1:
        raise wrong(what, shown((x0, y0, x1, y1)), "(x0, y0, x1, y1) with x0 < x1 and y0 < y1")
    return x0, y0, x1, y1


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
        raise wrong(what, shown(given), "names")
    return [text(what, name) for name in given]


@contextlib.contextmanager
def progress(told: Progress) -> Iterator[Optional[Callable[[float], Any]]]:
    """What is called with 0 to 1: a function, or one that moves a bar. A class makes a bar of its own,
    which is closed in the end."""
    if told is None:
        yield None
    elif isinstance(told, type) and hasattr(told, "update"):
        own = told(total=1.0)
        try:
            yield _mover(cast(Bar, own))
        finally:
            if hasattr(own, "close"):
                own.close()
    elif hasattr(told, "update"):
        yield _mover(cast(Bar, told))
    elif callable(told):
        yield told
    else:
        raise wrong("progress", shown(told), "a function of a float, or a bar as tqdm's")


def _mover(bar: Bar) -> Callable[[float], Any]:
    total = bar.total = 1.0 if bar.total is None else bar.total

    def move(share: float) -> None:
        bar.update(share * total - bar.n)
        if share == 1 and hasattr(bar, "refresh"):
            bar.refresh()  # bars show only now and then how far they are

    return move

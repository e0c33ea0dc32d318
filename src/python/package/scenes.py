"""Scenes, and what there is to choose from."""

from __future__ import annotations

import json
import os
import re
import warnings
from typing import Any, Dict, List, Mapping, Optional, Tuple, Union, overload

from . import _quadrel, arguments


def _plain(value: Any) -> Any:
    """numpy's numbers and arrays as JSON has them."""
    if hasattr(value, "tolist"):
        return value.tolist()
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    raise TypeError(f"a scene has no values of type {type(value).__name__}")


#: As the library reads it. What stands behind "=" would be the value, and "//" begins a comment.
_KEY = re.compile(r"[^.\[\]=]+(\[[0-9]+\])*(\.[^.\[\]=]+(\[[0-9]+\])*)*")


def _assignment(key: str, value: Any) -> str:
    if not isinstance(key, str) or not _KEY.fullmatch(key) or "//" in key:
        raise arguments.wrong("set", arguments.shown(key),
                              "a key as in camera.eye or objects[0].mesh")
    try:
        written = json.dumps(value, default=_plain, allow_nan=False)
    except (TypeError, ValueError, RecursionError) as error:
        raise arguments.wrong(f"set: {key}", f"{arguments.shown(value)} ({error})",
                              "what JSON can say") from None
    return f"{arguments.text('set', key)}={written}"


class Scene:
    """A scene that was read, with the values that were set in it. Made by `load`."""

    def __init__(self, file_or_name: arguments.Path, values: Mapping[str, Any]) -> None:
        self._name = file_or_name
        self._values: Dict[str, Any] = dict(arguments.mapping("values", values, "values by key"))
        self._scene = self._read(self._values, None)

    def _read(self, values: Mapping[str, Any],
              before: Optional[_quadrel.Scene]) -> _quadrel.Scene:
        assignments = [_assignment(key, value) for key, value in values.items()]
        scene = _quadrel.load_scene(arguments.path(self._name, "load"), assignments, before)
        for note in scene.notes:
            warnings.warn(note, stacklevel=4)
        return scene

    @overload
    def set(self, key: str, value: Any, /) -> None: ...
    @overload
    def set(self, values: Mapping[str, Any], /) -> None: ...
    def set(self, key: Union[str, Mapping[str, Any]], value: Any = None, /) -> None:
        """Sets values, as `-D KEY=VALUE` does: `set("material.relief.steps", 64)`, or several at
        once, `set({"size": [64, 64], "camera.fov": 30})`. The value is what JSON can say, or an
        array; None removes the key.

        The scene is read again, and is as it was where that fails. What its renders have loaded is
        kept. Keys, the types and ranges of values, stages' names and their parameters are checked at
        once: who changes a search and what it takes sets them together. Raises InputError, which names
        the key, UsageError for what is no key.
        """
        changes = dict(key) if isinstance(key, Mapping) else {key: value}
        # One that is set again is set last: later values may lie within it.
        values = {k: v for k, v in self._values.items() if k not in changes}
        values.update(changes)
        self._scene = self._read(values, self._scene)
        self._values = values

    @property
    def size(self) -> Tuple[int, int]:
        """Width and height of the frame in pixels."""
        return self._scene.width, self._scene.height

    @property
    def file(self) -> str:
        """The file that it was read from."""
        return os.fsdecode(self._scene.file)

    @property
    def values(self) -> Dict[str, Any]:
        """The values that were set, by key."""
        return dict(self._values)

    @property
    def resolved(self) -> Dict[str, Any]:
        """The whole scene with all values, files by the hashes of their contents."""
        resolved: Dict[str, Any] = json.loads(self._scene.canonical)
        return resolved

    @property
    def hash(self) -> str:
        """SHA-256 (hex) of `resolved`: what renders of equal scenes share."""
        return self._scene.hash

    @property
    def notes(self) -> List[str]:
        """What is no error but should be known, such as what a mesh's file holds and is ignored."""
        return list(self._scene.notes)

    def __repr__(self) -> str:
        width, height = self.size
        return f"<quadrel.Scene {os.fspath(self._name)!r} {width}x{height}>"


def load(file_or_name: arguments.Path, values: Optional[Mapping[str, Any]] = None, *,
         size: Optional[Tuple[int, int]] = None) -> Scene:
    """Reads a scene file, or an installed scene by its name ("bricks-45"; see `list_scenes`).

    `values` are set in it as `Scene.set` has it, `size` is (width, height) in pixels. Raises
    InputError with `file`, `line`, `key`, `found` and `expected` for anything that is wrong in it.
    What should be known is a warning. Stages of a plugin are known once it is loaded (`load_plugin`).
    """
    given = dict(arguments.mapping("values", values, "values by key"))
    if size is not None:
        given["size"] = list(arguments.size(size, 2**31 - 1))
    return Scene(file_or_name, given)


def load_plugin(file: arguments.Path) -> None:
    """Loads stages that were built by `quadrel_add_stages`; scenes name them by id."""
    _quadrel.load_plugin(arguments.path(file, "load_plugin"))


def _rows(found: str) -> List[Dict[str, Any]]:
    rows: List[Dict[str, Any]] = json.loads(found)
    return rows


def list_algorithms(*words: str) -> List[Dict[str, Any]]:
    """Every stage that has all of the words in its texts: `id`, `kind`, `summary`, `source`,
    `parameters` with their ranges, `inputs`, `outputs`, `number_types`."""
    return _rows(_quadrel.list_algorithms(arguments.names("list_algorithms", words)))


def list_channels(*words: str) -> List[Dict[str, Any]]:
    """Everything that a film can hold: `name`, `type`, `unit`, `meaning`."""
    return _rows(_quadrel.list_channels(arguments.names("list_channels", words)))


def list_presets(*words: str) -> List[Dict[str, Any]]:
    """What engines ship, as choices of stages."""
    return _rows(_quadrel.list_presets(arguments.names("list_presets", words)))


def list_scenes(*words: str) -> List[Dict[str, Any]]:
    """The installed scenes: `name` and `description`."""
    return _rows(_quadrel.list_scenes(arguments.names("list_scenes", words)))

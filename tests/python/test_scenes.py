"""Scenes, their values, what is wrong with them, and lists."""

import numpy as np
import pytest

import quadrel


def test_values_are_set_by_path_and_from_a_dict(bricks):
    before = bricks.hash
    bricks.set("material.relief.steps", 16)
    once = bricks.hash
    assert once != before
    bricks.set({"material.relief.steps": 32})
    assert bricks.hash == before
    assert quadrel.load("bricks-45", {"material.relief.steps": 16, "size": [48, 48]}).hash == once


def test_values_are_what_json_or_numpy_have(bricks):
    bricks.set({"size": np.array([24, 12]), "material.relief.steps": np.int64(8)})
    assert bricks.size == (24, 12)
    with pytest.raises(quadrel.UsageError):
        bricks.set("material.relief.depth", float("nan"))
    with pytest.raises(quadrel.UsageError, match="no values of type"):
        bricks.set("material.relief.depth", object())


def test_none_removes_a_key(bricks):
    with_key = bricks.hash
    bricks.set("material.relief.steps", None)
    assert bricks.hash != with_key


def test_what_is_wrong_is_said_by_parts(bricks):
    before = bricks.hash
    with pytest.raises(quadrel.InputError) as caught:
        bricks.set("material.releif", 3)
    error = caught.value
    assert error.file.endswith("bricks-45.json")
    assert error.key.endswith("releif")
    assert "unknown" in error.found and "relief" in error.expected
    for part in (error.file, error.key, error.found, error.expected):
        assert part in str(error)
    assert isinstance(error, quadrel.Error) and isinstance(error, ValueError)
    assert bricks.hash == before and "material.releif" not in bricks.values


def test_errors_have_lines(tmp_path):
    file = tmp_path / "broken.json"
    file.write_text('{\n  "quadrel": 1,\n  "size": [8, ]\n}\n')
    with pytest.raises(quadrel.InputError) as caught:
        quadrel.load(file)
    assert caught.value.line == 3 and caught.value.file == str(file)
    with pytest.raises(quadrel.InputError) as caught:
        quadrel.load("no-such-scene")
    assert caught.value.line is None


def test_names_of_files_may_be_no_text(tmp_path, bricks):
    film = quadrel.render(bricks, ["R"], window=(0, 0, 2, 2))
    file = tmp_path / b"\xff.exr".decode("utf8", "surrogateescape")
    film.write(file)
    assert quadrel.read(file).hash == film.hash
    with pytest.raises(quadrel.InputError) as caught:
        quadrel.read(str(file) + "x")
    assert "xff" in caught.value.file or "\udcff" in caught.value.file


def test_lists_have_what_there_is():
    algorithms = quadrel.list_algorithms()
    ids = [row["id"] for row in algorithms]
    assert "linear" in ids and len(ids) == len(set(ids)) > 50
    linear = algorithms[ids.index("linear")]
    steps = next(p for p in linear["parameters"] if p["name"] == "steps")
    assert steps["minimum"] <= steps["default"] <= steps["maximum"]
    some = quadrel.list_algorithms("CONE", "dummer")
    assert 0 < len(some) < len(algorithms)
    assert all(row in algorithms for row in some)
    assert "hit.U" in [row["name"] for row in quadrel.list_channels()]
    assert "bricks-45" in [row["name"] for row in quadrel.list_scenes("bricks")]
    assert quadrel.list_presets("godot")


def test_resolved_scenes_have_all_values(bricks):
    assert bricks.resolved["size"] == [48, 48]

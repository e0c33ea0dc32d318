"""What is written: no input, nothing of another kind."""

import json

import numpy as np
import pytest

import quadrel


@pytest.fixture
def heights(tmp_path):
    file = tmp_path / "h.exr"
    values = np.random.default_rng(3).random((8, 8), dtype=np.float32)
    quadrel.Film({"R": values}).write(file)
    return file


@pytest.fixture
def scene_file(tmp_path, heights):
    """Its heights are a file of its own."""
    file = tmp_path / "s.json"
    file.write_text(json.dumps({
        "quadrel": 1, "size": [16, 16],
        "camera": {"type": "perspective", "fov_y": 40, "eye": [0, -1.5, 1.5], "target": [0, 0, 0]},
        "textures": {"h": {"file": "h.exr", "swizzle": "r"}},
        "materials": {"m": {"height": "h", "relief": {
            "frame": "frame-gram", "trace": "linear", "surface": "h2n-thesis", "depth": 0.07,
            "steps": 16}}},
        "objects": [{"mesh": {"shape": "quad", "size": 2}, "material": "m"}],
        "lights": [{"type": "point", "space": "eye", "position": [10, 10, 10]}]}))
    return file


def refuses(call, file, message):
    """The file stays as it is."""
    before = file.read_bytes()
    with pytest.raises(quadrel.UsageError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)
    assert file.read_bytes() == before


def test_films_are_not_written_over_what_their_scene_read(scene_file, heights, tmp_path):
    scene = quadrel.load(scene_file)
    film = quadrel.render(scene, ["R"])
    refuses(lambda: film.write(scene_file), scene_file, "is the input")
    refuses(lambda: film.write(heights), heights, "write: .*h.exr is the input .*h.exr")
    link = tmp_path / "link.exr"
    link.symlink_to(heights)
    refuses(lambda: film.write(link), heights, "is the input")
    scene.set("material.relief.steps", 8)
    again = quadrel.render(scene, ["R"])
    refuses(lambda: again.write(heights), heights, "is the input")
    refuses(lambda: quadrel.errors(scene, window=(6, 6, 10, 10)).film.write(heights), heights,
            "is the input")
    film.write(tmp_path / "out.exr")
    again.write(tmp_path / "out.exr")


def test_inputs_are_known_in_another_folder_and_changed(scene_file, heights, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    film = quadrel.render("s.json", ["R"])
    heights.write_bytes(heights.read_bytes())
    moved = tmp_path / "moved"
    moved.write_bytes(heights.read_bytes())
    moved.rename(heights)
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    refuses(lambda: film.write("../h.exr"), heights, "is the input")
    film.write("h.exr")


def test_films_are_not_written_over_what_was_injected(bricks, tmp_path):
    file = tmp_path / "in.exr"
    quadrel.render(bricks, ["hit.U"]).write(file)
    film = quadrel.render(bricks, ["R"], inject={"hit.U": file})
    refuses(lambda: film.write(file), file, "is the input")
    quadrel.read(file).write(file)  # its own


def test_maps_are_not_baked_over_their_heights(heights, tmp_path):
    for source in (heights, quadrel.Texture(heights, mips="none")):
        refuses(lambda: quadrel.bake(source, "max-mip", output=heights), heights,
                "output: .*h.exr is the input .*h.exr")
    quadrel.bake(heights, "max-mip", output=tmp_path / "map.exr")
    assert (tmp_path / "map.exr").exists()


def test_sweeps_are_not_written_over_their_plan(tmp_path):
    plan = tmp_path / "results.json"
    plan.write_text(json.dumps({
        "sweep": 1, "title": "one", "scenes": [{"name": "bricks", "scene": "bricks-45"}],
        "views": [45], "algorithms": [{"trace": "linear"}], "size": [16, 16], "repeats": 1}))
    refuses(lambda: quadrel.sweep(plan, tmp_path), plan, "is the input")


@pytest.mark.parametrize("name, message", [
    ("x.png", "expected a name that ends in .exr"),
    ("x", "expected a name that ends in .exr"),
    ("", "expected the name of a file"),
    (3, "expected the name of a file"),
])
def test_names_say_what_is_written(heights, tmp_path, monkeypatch, name, message):
    monkeypatch.chdir(tmp_path)
    before = sorted(tmp_path.iterdir())
    with pytest.raises(quadrel.UsageError, match=message):
        quadrel.read(heights).write(name)
    with pytest.raises(quadrel.UsageError, match=message):
        quadrel.bake(heights, "max-mip", output=name, cache=False)
    assert sorted(tmp_path.iterdir()) == before


def test_names_that_say_nothing_are_taken(heights, tmp_path):
    film = quadrel.read(heights)
    film.write(tmp_path / "UPPER.EXR")
    film.write("/dev/null")
    with pytest.raises(quadrel.OutputError):
        film.write(tmp_path)

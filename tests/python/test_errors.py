"""Errors by their parts: file, key, found, expected, in one line."""

import os
import signal
import textwrap
import threading
import time

import numpy as np
import pytest

import quadrel
from quadrel import sample


def parts_of(error):
    """What is wrong with an error's parts, if anything."""
    parts = {name: getattr(error, name) for name in ("file", "key", "found", "expected")}
    if not all(isinstance(part, str) for part in parts.values()):
        return f"parts that are no texts: {parts}"
    missing = [name for name, part in parts.items() if part not in str(error)]
    if missing:
        return f"not said: {missing} in {error}"
    if "\n" in str(error):
        return "several lines"
    wanted = ("file", "found", "expected") if isinstance(error, quadrel.InputError) else \
        ("key", "found", "expected")
    empty = [name for name in wanted if not parts[name]]
    return f"empty: {empty} of {error!r}" if empty else None


def test_what_an_error_lacks_is_seen():
    assert parts_of(quadrel.UsageError("isa: found 3")) is not None
    error = quadrel.UsageError("isa: found 3, expected a text")
    assert parts_of(error) is not None  # nobody has set its parts
    error.key, error.found, error.expected = "isa", "3", "a text"
    assert parts_of(error) is None
    error.expected = "a number"
    assert parts_of(error) is not None


@pytest.mark.parametrize("key, value, found", [
    ("size", "large", "large"),
    ("size", [64.5, 64], "64.5"),
    ("size", [64, -1], "-1"),
    ("size", [True, 64], "true"),
    ("camera.fov_y", "wide", "wide"),
    ("camera.fov_y", 400, "400"),
    ("camera.eye", [0, 1], "2"),
    ("camera.oye", [0, 1, 2], "unknown"),
    ("conventions", "vulkann", "vulkann"),
    ("textures.bricks-height.swizzle", "xyzzy", "xyzzy"),
    ("textures.bricks-height.file", "nowhere.exr", "no such file"),
    ("material.height", "bricks-hight", "bricks-hight"),
    ("material.relief", 3, "3"),
    ("material.relief.depth", "deep", "deep"),
    ("material.relief.depth", -1, "-1"),
    ("material.relief.trace", "linaer", "linaer"),
    ("material.relief.trace", 3, "3"),
    ("material.relief.trace", "lambert", "lambert"),
    ("material.relief.surface", "h2n-thesys", "h2n-thesys"),
    ("material.relief.steps", -3, "-3"),
    ("material.relief.steps", 3.5, "3.5"),
    ("material.relief.steps", True, "true"),
    ("material.relief.steps", "many", "many"),
    ("material.relief.steps", 1e30, "1e"),
    ("material.relief.steppes", 3, "unknown"),
    ("material.shade", "shade-thesys", "shade-thesys"),
    ("objects[0].mesh", "nowhere.obj", "nowhere.obj"),
    ("objects[0].material", "stone", "stone"),
    ("objects[3].material", "bricks", "index 3"),
    ("lights[0].type", "spott", "spott"),
    ("lights[0].position", "here", "here"),
    ("objects", 3, "3"),
])
def test_values_are_checked_as_soon_as_they_are_set(bricks, key, value, found):
    before, values = bricks.hash, bricks.values
    with pytest.raises((quadrel.InputError, quadrel.UsageError)) as caught:
        bricks.set(key, value)
    error = caught.value
    if isinstance(error, quadrel.InputError):
        assert parts_of(error) is None
        assert error.file.endswith("bricks-45.json") or "nowhere" in error.file
        assert found in error.found
        place = key.split("[3]")[0].split(".")[-1].split("[")[0]
        assert place in error.key or "nowhere" in error.file, error.key
    assert "\n" not in str(error)
    assert bricks.hash == before and bricks.values == values
    quadrel.render(bricks, window=(0, 0, 2, 2))
    with pytest.raises(type(error)):
        quadrel.load("bricks-45", {key: value})


def test_what_belongs_together_is_set_together(bricks):
    with pytest.raises(quadrel.InputError, match="steps"):
        bricks.set("material.relief.trace", "max-mip")  # which the fixture's steps are not for
    bricks.set({"material.relief.trace": "max-mip", "material.relief.steps": None})
    quadrel.render(bricks, window=(0, 0, 2, 2))


@pytest.fixture
def bad(tmp_path):
    """A folder of files that are wrong."""
    (tmp_path / "text.exr").write_text("no image")
    (tmp_path / "text.png").write_text("no image")
    (tmp_path / "text.json").write_text("{")
    (tmp_path / "array.json").write_text("[]")
    (tmp_path / "plan.json").write_text('{"sweep": 1, "title": "t", "scenes": []}')
    (tmp_path / "plans.json").write_text('{"sweep": 1, "titel": "t"}')
    (tmp_path / "open.obj").write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
    (tmp_path / "text.obj").write_text("f 1 2 3\n")
    (tmp_path / "plugin.so").write_text("no plugin")
    (tmp_path / "folder.exr").mkdir()
    holes = np.zeros((4, 4), np.float32)
    holes[2, 1] = np.nan
    quadrel.Film({"R": holes}).write(tmp_path / "holes.exr")
    return tmp_path


@pytest.mark.parametrize("call", [
    lambda d, s: quadrel.load("no-such-scene"),
    lambda d, s: quadrel.load(d / "none.json"),
    lambda d, s: quadrel.load(d / "text.json"),
    lambda d, s: quadrel.load(d / "array.json"),
    lambda d, s: quadrel.load(d / "text.exr"),
    lambda d, s: quadrel.load(d),
    lambda d, s: quadrel.render(d / "none.json"),
    lambda d, s: quadrel.probe(d / "none.json", 0, 0),
    lambda d, s: quadrel.errors(d / "none.json"),
    lambda d, s: quadrel.read(d / "none.exr"),
    lambda d, s: quadrel.read(d / "text.exr"),
    lambda d, s: quadrel.read(d / "text.png"),
    lambda d, s: quadrel.read(d / "folder.exr"),
    lambda d, s: quadrel.read(d / "holes.exr", layer="diffuse"),
    lambda d, s: quadrel.read(d / "holes.exr", part="left"),
    lambda d, s: quadrel.compare(d / "holes.exr", d / "none.exr"),
    lambda d, s: quadrel.compare(d / "text.png", d / "holes.exr"),
    lambda d, s: quadrel.render(s, inject={"hit.U": d / "text.exr"}),
    lambda d, s: quadrel.Texture(d / "none.png"),
    lambda d, s: quadrel.Texture(d / "text.png"),
    lambda d, s: quadrel.Texture(d / "holes.exr"),
    lambda d, s: quadrel.bake(d / "text.png", "max-mip"),
    lambda d, s: quadrel.bake(d / "holes.exr", "max-mip", cache=False),
    lambda d, s: quadrel.depth_layers(d / "open.obj"),
    lambda d, s: quadrel.depth_layers(d / "text.obj"),
    lambda d, s: quadrel.depth_layers(d / "none.obj"),
    lambda d, s: quadrel.sweep(d / "none.json", d / "out"),
    lambda d, s: quadrel.sweep(d / "text.json", d / "out"),
    lambda d, s: quadrel.sweep(d / "plan.json", d / "out"),
    lambda d, s: quadrel.sweep(d / "plans.json", d / "out"),
    lambda d, s: quadrel.load_plugin(d / "plugin.so"),
    lambda d, s: quadrel.load_plugin(d / "none.so"),
])
def test_bad_files_are_input_errors(bad, bricks, call):
    before = sorted(bad.iterdir())
    with pytest.raises(quadrel.InputError) as caught:
        call(bad, bricks)
    assert parts_of(caught.value) is None
    assert sorted(bad.iterdir()) == before


@pytest.mark.parametrize("call, key", [
    (lambda s, f: quadrel.render(s, ["N.Q"]), "channels"),
    (lambda s, f: quadrel.render(s, isa="mmx"), "isa"),
    (lambda s, f: quadrel.render(s, number="half"), "number"),
    (lambda s, f: quadrel.render(s, number="double", isa="avx2"), "isa"),
    (lambda s, f: quadrel.render(s, threads=-1), "threads"),
    (lambda s, f: quadrel.render(s, limits="glide"), "limits"),
    (lambda s, f: quadrel.render(s, limits="gl,plane=2"), "limits"),
    (lambda s, f: quadrel.render(s, integrate=40), "integrate"),
    (lambda s, f: quadrel.render(s, integrate=16, integrate_error=-1), "integrate_error"),
    (lambda s, f: quadrel.render(s, window=(4, 4, 4, 8)), "window"),
    (lambda s, f: quadrel.render(s, inject={"": f}), "inject"),
    (lambda s, f: quadrel.probe(s, 48, 0), "pixel"),
    (lambda s, f: quadrel.compare(f, f, abs=-1), "abs"),
    (lambda s, f: quadrel.compare(f, f, rel=float("nan")), "rel"),
    (lambda s, f: quadrel.compare(f, f, ulp=1.5), "ulp"),
    (lambda s, f: quadrel.compare(f, f, fraction=1.5), "fraction"),
    (lambda s, f: quadrel.compare(f, f, encode="srgb9"), "encode"),
    (lambda s, f: quadrel.compare(f, f, legal=True, abs=1), "legal"),
    (lambda s, f: quadrel.errors(s, worst=-1), "worst"),
    (lambda s, f: quadrel.bake(np.zeros((4, 4)), "cones"), "kind"),
    (lambda s, f: quadrel.bake(np.zeros((4, 4)), "horizon", azimuths=2.5), "azimuths"),
    (lambda s, f: quadrel.bake(np.zeros((4, 4)), "horizon", slopes=2), "slopes"),
    (lambda s, f: quadrel.bake(np.zeros((4, 4)), "max-mip", wrap="repaet"), "wrap_u"),
    (lambda s, f: quadrel.Texture(np.zeros((4, 4)), format="unorm7"), "format"),
    (lambda s, f: quadrel.Texture(np.zeros((4, 4)), mips="boxes"), "mips"),
    (lambda s, f: quadrel.Sampler(mag="liniar").state(), "mag"),
    (lambda s, f: quadrel.Film({"R": np.zeros((2, 2)), "G": np.zeros((3, 2))}), 'film: "G"'),
    (lambda s, f: quadrel.Film({"R": np.zeros((2, 2))}, window=(0, 0, 3, 3)), "window"),
    (lambda s, f: quadrel.Film({"R": np.zeros((2, 2))}, frame=(0, 0, 1, 1)), "frame"),
    (lambda s, f: f.write("x.png"), "write"),
    (lambda s, f: f.write("x.exr", compression="zap"), "compression"),
    (lambda s, f: f.stack("M"), "channels"),
    (lambda s, f: quadrel.sweep("plan.json", "out", task=(3, 2)), "task"),
    (lambda s, f: sample.texture_lod([[0.0]], (0, 0), 0, number="half"), "number"),
])
def test_wrong_arguments_have_parts(bricks, tmp_path, monkeypatch, call, key):
    monkeypatch.chdir(tmp_path)
    film = quadrel.Film({"R": np.zeros((48, 48), np.float32)})
    before = sorted(tmp_path.iterdir())
    with pytest.raises(quadrel.UsageError) as caught:
        call(bricks, film)
    assert parts_of(caught.value) is None
    assert caught.value.key == key
    assert sorted(tmp_path.iterdir()) == before


#: Arguments that are integers, one each.
INTEGERS = {
    "threads": lambda s, n: quadrel.render(s, window=(0, 0, 2, 2), threads=n),
    "integrate": lambda s, n: quadrel.render(s, window=(0, 0, 2, 2), integrate=n),
    "window": lambda s, n: quadrel.render(s, window=(0, 0, n, 16)),
    "size": lambda s, n: quadrel.load("bricks-45", size=(n, 8)),
    "pixel": lambda s, n: quadrel.probe(s, n, 2),
    "worst": lambda s, n: quadrel.errors(s, window=(0, 0, 2, 2), worst=n),
    "component": lambda s, n: sample.texture_gather(np.zeros((2, 2)), (.1, .1), n),
}


@pytest.mark.parametrize("argument", INTEGERS)
def test_integers_are_pythons_or_numpys(bricks, argument):
    call = INTEGERS[argument]
    number = 2 if argument == "component" else 16
    for given in (number, np.int64(number), np.uint8(number), np.array(number)):
        call(bricks, given)
    for given in (True, np.bool_(True), float(number), np.float32(number), str(number), None,
                  np.array([number, number]), complex(number)):
        if argument == "integrate" and given is None:
            continue
        with pytest.raises(quadrel.UsageError) as caught:
            call(bricks, given)
        assert parts_of(caught.value) is None
        assert caught.value.key == argument and caught.value.expected == "an integer"
        assert type(given).__name__ in caught.value.found


def test_outputs_have_parts(bricks, tmp_path):
    film = quadrel.render(bricks, ["R"], window=(0, 0, 2, 2))
    with pytest.raises(quadrel.OutputError) as caught:
        film.write(tmp_path / "none" / "x.exr")
    assert caught.value.file.endswith("x.exr") and caught.value.found == caught.value.reason
    assert caught.value.found in str(caught.value)


def stopped_after(seconds, call):
    """How long a call goes on once a signal has come."""
    sent = []

    def send():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    killer = threading.Timer(seconds, send)
    killer.start()
    try:
        with pytest.raises(KeyboardInterrupt):
            call()
        return time.monotonic() - sent[0]
    finally:
        killer.cancel()
        killer.join()


def test_ctrl_c_stops_depth_layers():
    """Of a map that takes sixteen times as long as a smaller one."""
    began = time.monotonic()
    quadrel.depth_layers("torus", size=(1024, 1024))
    small = time.monotonic() - began
    stopped = stopped_after(small / 2, lambda: quadrel.depth_layers("torus", size=(4096, 4096)))
    assert stopped < 4 * small + 1


def test_depth_layers_tell_how_far_they_are():
    shares = []
    quadrel.depth_layers("sphere", size=(256, 256), progress=shares.append)
    assert shares == sorted(shares) and shares[-1] == 1

    class Enough(Exception):
        pass

    def progress(share):
        raise Enough

    with pytest.raises(Enough):
        quadrel.depth_layers("torus", size=(2048, 2048), progress=progress)


def test_ctrl_c_stops_a_sweep_within_a_run(tmp_path):
    """A run of a million rays by a slow search: nothing of it is kept."""
    plan = tmp_path / "plan.json"
    plan.write_text(textwrap.dedent("""
        {"sweep": 1, "title": "slow", "scenes": [{"name": "bricks", "scene": "bricks-45"}],
         "views": [80], "algorithms": [{"trace": "linear", "parameters": {"steps": 8192}}], "size": [1024, 1024],
         "repeats": 100, "isa": ["scalar"]}"""))
    assert stopped_after(2, lambda: quadrel.sweep(plan, tmp_path / "out")) < 5
    assert [file.name for file in (tmp_path / "out").rglob("*.json")] in ([], ["part.json"])

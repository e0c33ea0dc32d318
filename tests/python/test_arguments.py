"""Arguments that make no sense are a UsageError of one line, before anything is done."""

import resource
import subprocess
import sys
import textwrap
import time

import numpy as np
import pytest

import quadrel
from quadrel import sample


def refuses(call, message):
    with pytest.raises(quadrel.UsageError, match=message) as caught:
        call()
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("key", [
    "size=[8,8]//", "material.relief.steps=4 //", "size//", "", ".", "size.", "objects[x].mesh",
    "objects[0", "\udc80", 3, None])
def test_what_is_no_key_is_refused(bricks, key):
    before = bricks.hash
    refuses(lambda: bricks.set(key, 3), "set: found .*expected a" if key != "\udc80" else "text")
    refuses(lambda: quadrel.load("bricks-45", {key: 3}), "set: found")
    assert bricks.hash == before and bricks.size == (48, 48)


@pytest.mark.parametrize("size", [
    (4.9, 5.9), (8, 9, 10), "89", (True, 5), 64, (8,), (8, None), {8: 1, 9: 1}, (0, 8), (-1, 8),
    np.array([4.0, 4.0]), np.zeros((2, 2), int)])
def test_sizes_are_two_whole_numbers(size):
    refuses(lambda: quadrel.load("bricks-45", size=size), "size: found")
    refuses(lambda: quadrel.depth_layers("cube", size=size), "size: found")


def test_sizes_may_be_numpys():
    assert quadrel.load("bricks-45", size=np.array([24, 12])).size == (24, 12)


@pytest.mark.parametrize("call, message", [
    (lambda s, f: s.set("material.relief.depth", float("nan")), "material.relief.depth"),
    (lambda s, f: s.set("material.relief.depth", [1, float("inf")]), "material.relief.depth"),
    (lambda s, f: s.set("material.relief.depth", object()), "no values of type object"),
    (lambda s, f: quadrel.load("bricks-45", 3), "values"),
    (lambda s, f: quadrel.load(3), "load"),
    (lambda s, f: quadrel.render(s, stats=[]), r"stats: found \[\]"),
    (lambda s, f: quadrel.render(s, inject=3), "inject: found 3"),
    (lambda s, f: quadrel.render(s, inject={"hit.U": 3}), "found 3"),
    (lambda s, f: quadrel.render(s, inject={3: f}), "inject: found 3"),
    (lambda s, f: quadrel.render(s, channels=3), "channels: found 3"),
    (lambda s, f: quadrel.render(s, channels=["R", 3]), "channels: found 3"),
    (lambda s, f: quadrel.render(s, window=3), "window: found 3"),
    (lambda s, f: quadrel.render(s, window=(0, 0, 4.5, 4)), "window: found 4.5"),
    (lambda s, f: quadrel.render(s, threads=1.5), "threads: found 1.5"),
    (lambda s, f: quadrel.render(s, number=3), "number: found 3"),
    (lambda s, f: quadrel.render(s, isa=None), "isa: found None"),
    (lambda s, f: quadrel.render(s, limits=3), "limits: found 3"),
    (lambda s, f: quadrel.render(s, integrate="many"), "integrate: found 'many'"),
    (lambda s, f: quadrel.render(s, progress=3), "progress: found 3"),
    (lambda s, f: quadrel.probe(s, 1.5, 2), "pixel: found 1.5"),
    (lambda s, f: quadrel.heatmap(f, "x.png"), "image: found 'x.png'"),
    (lambda s, f: quadrel.errors(s, "x.png"), "image: found 'x.png'"),
    (lambda s, f: quadrel.compare(f, 3), "found 3"),
    (lambda s, f: quadrel.compare(f, f, abs="much"), "abs: found 'much'"),
    (lambda s, f: quadrel.compare(f, f, map=3), "map: found 3"),
    (lambda s, f: quadrel.compare(f, f, encode=3), "encode: found 3"),
    (lambda s, f: quadrel.Film(3), "film: found 3"),
    (lambda s, f: quadrel.Film({"R": np.zeros((2, 2))}, attributes={"a": 3}), "attributes: found 3"),
    (lambda s, f: quadrel.Film({"R": np.zeros((2, 2))}, attributes=3), "attributes: found 3"),
    (lambda s, f: quadrel.Film({"\udc80": np.zeros((2, 2))}), "name of a channel"),
    (lambda s, f: quadrel.Film({3: np.zeros((2, 2))}), "name of a channel"),
    (lambda s, f: quadrel.Film({"R": [[1], [2, 3]]}), "R"),
    (lambda s, f: quadrel.Film({"R": np.array([["a"]])}), "expected floats"),
    (lambda s, f: f.write("x.exr", compression=3), "compression: found 3"),
    (lambda s, f: quadrel.read(3), "read: found 3"),
    (lambda s, f: quadrel.list_algorithms(3), "list_algorithms: found 3"),
    (lambda s, f: quadrel.sweep("plan.json", "out", task=3), "task: found 3"),
    (lambda s, f: quadrel.Texture(np.zeros((2, 2), int)), "expected floats"),
    (lambda s, f: quadrel.Texture(np.zeros((2, 2)), mips=3), "mips: found 3"),
    (lambda s, f: sample.texture_lod(np.zeros((2, 2)), (.1, .1), 0, sampler="repeat"), "sampler"),
    (lambda s, f: sample.texture_lod(np.zeros((2, 2)), (.1, .1), "fine"), "level: found 'fine'"),
    (lambda s, f: sample.texture_lod(np.zeros((2, 2)), np.zeros((3, 2)), [0, 1]), "broadcast"),
    (lambda s, f: sample.texture_lod(np.zeros((2, 2)), (.1, .1), 0,
                                     sampler=quadrel.Sampler(lod_bias="x")), "lod_bias"),
    (lambda s, f: sample.texture_gather(np.zeros((2, 2)), (.1, .1), 4), "component: found 4"),
    (lambda s, f: sample.texel_fetch(np.zeros((2, 2)), (.1, .1)), "expected integers"),
    (lambda s, f: f.stack(3), "stack: found 3"),
    (lambda s, f: quadrel.quad.dFdx(f["R"], mode=3), "mode: found 3"),
    (lambda s, f: quadrel.quad.dFdx(f["R"], axes=(0, 7)), "axes: found"),
    (lambda s, f: quadrel.quad.dFdx([["a", "b"], ["c", "d"]]), "expected numbers"),
    (lambda s, f: quadrel.compare(f, f, legal=True, widest="x"), "widest: found 'x'"),
    (lambda s, f: quadrel.bake(np.zeros((4, 4)), 3), "kind: found 3"),
    (lambda s, f: quadrel.bake(np.zeros((4, 4)), "cone-cell", slices="x"), "slices: found 'x'"),
    (lambda s, f: quadrel.depth_layers("cube", towards="up"), "towards: found 'up'"),
    (lambda s, f: quadrel.depth_layers("cube", margin="wide"), "margin: found 'wide'"),
    (lambda s, f: quadrel.depth_layers("cube", solids=7), "solids: found 7"),
])
def test_wrong_arguments_are_usage_errors(bricks, call, message):
    film = quadrel.Film({"R": np.zeros((48, 48), np.float32)})
    before = bricks.hash
    refuses(lambda: call(bricks, film), message)
    assert bricks.hash == before


def test_films_are_equal_to_themselves_alone():
    values = {"R": np.zeros((2, 2), np.float32)}
    film, other = quadrel.Film(values), quadrel.Film(values)
    assert film == film and film != other and film != values
    assert film in [other, film] and film not in [other]
    assert 3 not in film and "\udc80" not in film and "R" in film
    assert len({film, other, film}) == 2 and film.hash == other.hash


def test_a_single_look_up_has_a_footprint():
    texture = quadrel.Texture(np.arange(16, dtype=np.float32).reshape(4, 4))
    single = sample.footprint(texture, (.1, .1), lod=0)
    several = sample.footprint(texture, [(.1, .1)], lod=0)
    assert single.count == several.count[0] and single.value.shape == (8, 4)
    assert np.array_equal(single.weight, several.weight[0])
    assert single.weight.sum() == pytest.approx(1)
    assert sample.level_of_detail(texture, lod=0).level == 0


def peak():
    return resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024


@pytest.mark.parametrize("call", [
    lambda one: quadrel.Texture(np.broadcast_to(one, (24000, 24000))),
    lambda one: quadrel.Texture(np.broadcast_to(one, (21000, 21000))),
    lambda one: quadrel.Texture(np.broadcast_to(one, (12000, 12000, 3)), mips="none"),
    lambda one: quadrel.Texture(np.broadcast_to(one, (20000, 20000, 5))),
    lambda one: quadrel.Texture.of_levels([np.broadcast_to(one, (24000, 24000))]),
    lambda one: quadrel.Film({"R": np.broadcast_to(one, (50000, 50000))}),
    lambda one: quadrel.Film({"RGB": np.broadcast_to(one, (30000, 30000, 3))}),
], ids=["texture", "mips", "rgb", "channels", "levels", "film", "group"])
def test_sizes_are_checked_before_memory_is_taken(call):
    before = peak()
    with pytest.raises(quadrel.UsageError, match="texture|levels|film"):
        call(np.zeros((), np.float32))
    assert peak() < before + 2**28


@pytest.mark.parametrize("work", [
    "quadrel.render(scene, isa='scalar', number='double')",
    "[quadrel.compare(film, film) for _ in range(10**6)]",
    "quadrel.depth_layers('torus', size=(2048, 2048))",
], ids=["render", "compare", "layers"])
def test_the_interpreter_ends_while_other_threads_work(work):
    program = textwrap.dedent(f"""
        import threading, time
        import quadrel
        scene = quadrel.load("bricks-45", {{"material.relief.steps": 4096}}, size=(1024, 1024))
        film = quadrel.Film({{"R": [[0.0] * 512] * 512}})
        threading.Thread(target=lambda: {work}, daemon=True).start()
        time.sleep(0.3)
    """)
    began = time.monotonic()
    ran = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert (ran.returncode, ran.stderr) == (0, "")
    assert time.monotonic() - began < 60

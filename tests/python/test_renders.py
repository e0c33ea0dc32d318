"""Renders: arrays without copies, progress, Ctrl-C, other threads."""

import io
import os
import signal
import threading
import time

import numpy as np
import pytest

import quadrel


def test_arrays_are_views_of_the_film(bricks, tmp_path):
    film = quadrel.render(bricks, ["R", "hit.status"])
    assert film["R"].dtype == np.float32 and film["hit.status"].dtype == np.uint32
    assert film["R"].shape == (48, 48)
    assert np.shares_memory(film["R"], film["R"]) and not film["R"].flags.owndata
    film["R"][3, 5] = 0.25
    film.write(tmp_path / "changed.exr")
    assert quadrel.read(tmp_path / "changed.exr")["R"][3, 5] == 0.25


def test_arrays_outlive_their_film(bricks):
    film = quadrel.render(bricks, ["R"])
    kept, copy = film["R"], film["R"].copy()
    del film
    quadrel.render(bricks, ["G"])
    assert np.array_equal(kept, copy)


def test_films_are_those_of_the_command_line(bricks, tmp_path):
    film = quadrel.render(bricks, ["R", "hit", "N"])
    assert film.attributes["quadrel:sceneHash"] == bricks.hash
    for isa in ("auto", "scalar"):
        assert quadrel.render(bricks, ["R", "hit", "N"], isa=isa, threads=2).hash == film.hash
    part = quadrel.render(bricks, ["R"], window=(4, 6, 20, 30))
    assert part.window == (4, 6, 20, 30) and part.frame == (0, 0, 48, 48)
    assert np.array_equal(part["R"], film["R"][6:30, 4:20])
    assert film.stack("N").shape == (48, 48, 3)
    assert np.array_equal(film.stack("N")[..., 2], film["N.Z"])
    assert "N.X" in film and "N" not in film and list(film)[0] == "R"
    with pytest.raises(KeyError):
        film["N"]


def test_films_of_arrays_come_back(tmp_path):
    values = np.random.default_rng(1).random((4, 6, 3), dtype=np.float32)
    status = np.arange(24).reshape(4, 6)
    film = quadrel.Film({"RGB": values, "hit.status": status}, frame=(0, 0, 10, 10),
                        window=(2, 3, 8, 7))
    film.write(tmp_path / "made.exr", compression="none")
    read = quadrel.read(tmp_path / "made.exr")
    assert read.hash == film.hash and read.window == (2, 3, 8, 7)
    assert np.array_equal(read.stack("RGB"), values) and np.array_equal(read["hit.status"], status)
    assert read["hit.status"].dtype == np.uint32


@pytest.mark.parametrize("arrays, message", [
    ({}, "at least one"),
    ({"N": np.zeros((2, 2, 2))}, "expected 3: N.X"),
    ({"R": np.zeros(4)}, "axes"),
    ({"R": np.zeros((2, 2)), "RGB": np.zeros((2, 2, 3))}, "twice"),
    ({"R": np.zeros((2, 2)), "G": np.zeros((2, 3))}, "shape of all"),
    ({"hit.status": np.full((2, 2), -1)}, "found -1"),
    ({"hit.status": np.full((2, 2), 2**33)}, "32 bits"),
])
def test_what_is_no_film_is_refused(arrays, message):
    with pytest.raises(quadrel.UsageError, match=message):
        quadrel.Film(arrays)


def test_progress_goes_from_nothing_to_all(bricks):
    bricks.set("size", [256, 256])
    shares, threads = [], set()

    def progress(share):
        shares.append(share)
        threads.add(threading.get_ident())

    quadrel.render(bricks, progress=progress)
    assert shares == sorted(shares) and shares[-1] == 1 and min(shares) > 0
    assert threads == {threading.get_ident()}


class Bar:
    """What tqdm promises."""

    def __init__(self, total=None):
        self.n, self.total = 0, total

    def update(self, n):
        self.n += n


@pytest.mark.parametrize("total", [None, 50])
def test_bars_are_moved_to_their_end(bricks, total):
    bar = Bar(total)
    quadrel.render(bricks, progress=bar)
    assert bar.n == pytest.approx(bar.total) and bar.total == (total or 1)


class OwnBar(Bar):
    """What the class promises: a bar of its own, which shows what it was told last."""

    made = []

    def __init__(self, total=None):
        super().__init__(total)
        self.shown, self.closed = 0, False
        self.made.append(self)

    def refresh(self):
        assert not self.closed
        self.shown = self.n

    def close(self):
        self.closed = True


def test_a_bars_class_makes_one_that_is_closed(bricks):
    OwnBar.made.clear()
    quadrel.render(bricks, progress=OwnBar)
    with pytest.raises(quadrel.UsageError):
        quadrel.render(bricks, ["N.Q"], progress=OwnBar)
    done, failed = OwnBar.made
    assert done.closed and failed.closed and failed.n == 0
    assert done.shown == pytest.approx(1) and done.total == 1


@pytest.mark.parametrize("total", [None, 1, 250])
def test_tqdm_is_such_a_bar(bricks, total):
    tqdm = pytest.importorskip("tqdm")
    shown = io.StringIO()
    with tqdm.tqdm(total=total, disable=False, file=shown) as bar:
        quadrel.render(bricks, progress=bar)
        assert bar.n == pytest.approx(total or 1)
        assert "100%" in shown.getvalue()


def test_tqdms_class_is_one_too(bricks, capfd):
    tqdm = pytest.importorskip("tqdm")
    quadrel.render(bricks, progress=tqdm.tqdm)
    assert "100%" in capfd.readouterr().err


def slow_scene():
    """Some seconds of one thread, and more on doubles."""
    return quadrel.load("bricks-45", {"material.relief.steps": 4096}, size=(1024, 1024))


def test_what_progress_raises_ends_the_render():
    class Enough(Exception):
        pass

    def progress(share):
        raise Enough

    began = time.monotonic()
    with pytest.raises(Enough):
        quadrel.render(slow_scene(), isa="scalar", progress=progress)
    assert time.monotonic() - began < 5


@pytest.mark.parametrize("options", [
    {"isa": "scalar", "number": "double"},
    {"integrate": 8192, "window": (0, 0, 64, 64)},
    {"limits": "gl", "channels": ["N"], "window": (0, 0, 64, 64)},
], ids=["plain", "integrals", "ranges"])
def test_ctrl_c_stops_a_render(options):
    """Within some tiles: as a whole each of these takes a minute and more."""
    killer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
    killer.start()
    began = time.monotonic()
    with pytest.raises(KeyboardInterrupt):
        quadrel.render(slow_scene(), **options)
    assert time.monotonic() - began < 30
    killer.join()


def test_other_threads_run_meanwhile():
    counted, done = [], threading.Event()

    def count():
        while not done.is_set():
            counted.append(time.monotonic())
            time.sleep(0.005)

    thread = threading.Thread(target=count)
    thread.start()
    began = time.monotonic()
    quadrel.render(slow_scene(), ["R"], isa="scalar", window=(0, 0, 128, 128))
    ended = time.monotonic()
    done.set()
    thread.join()
    within = [t for t in counted if began < t < ended]
    assert len(within) > (ended - began) / 0.005 / 20


def test_renders_run_in_several_threads_at_once(bricks):
    alone = quadrel.render(bricks).hash
    hashes = []
    threads = [threading.Thread(target=lambda: hashes.append(quadrel.render(bricks).hash))
               for _ in range(4)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert hashes == [alone] * 4


def test_values_are_injected(bricks):
    film = quadrel.render(bricks, ["hit.U", "N"])
    same = quadrel.render(bricks, ["N"], inject={"hit.U": film})
    assert np.array_equal(same["N.X"], film["N.X"])
    moved = quadrel.render(bricks, ["N"], inject={"hit.U": {"hit.U": film["hit.U"] + 0.1}})
    assert not np.array_equal(moved["N.X"], film["N.X"])


def test_stats_are_counted(bricks):
    stats = {}
    quadrel.render(bricks, stats=stats)
    assert stats["pixels"] == 48 * 48 and stats["fetches"]["look_ups"] > 0


@pytest.mark.parametrize("options, message", [
    ({"channels": ["N.Q"]}, "N.Q"),
    ({"window": (0, 0, 49, 4)}, "48x48"),
    ({"window": (0, 0, 4)}, "x0, y0, x1, y1"),
    ({"window": (-1, 0, 4, 4)}, "found -1"),
    ({"threads": 2000}, "0 to 1024"),
    ({"number": "half"}, "half"),
    ({"isa": "mmx"}, "mmx"),
    ({"limits": "glide"}, "glide"),
    ({"integrate": 7}, "16"),
])
def test_what_makes_no_sense_is_refused(bricks, options, message):
    with pytest.raises(quadrel.UsageError, match=message):
        quadrel.render(bricks, **options)


def test_pixels_are_integrals(bricks):
    film = quadrel.render(bricks, window=(8, 8, 12, 12), integrate=16)
    assert "integral.error.R" in film and (film["integral.samples"] == 16).all()


def test_outputs_that_cannot_be_written_are_errors(bricks, tmp_path):
    film = quadrel.render(bricks, ["R"], window=(0, 0, 2, 2))
    with pytest.raises(quadrel.OutputError) as caught:
        film.write(tmp_path / "nowhere" / "x.exr")
    assert caught.value.file.endswith("x.exr") and caught.value.reason
    assert isinstance(caught.value, OSError)
    with pytest.raises(quadrel.UsageError, match="zip"):
        film.write(tmp_path / "x.exr", compression="zipp")


def test_a_preview_is_a_picture(bricks):
    picture = quadrel.render(bricks).preview()
    assert picture.shape == (48, 48, 3) and picture.dtype == np.uint8 and picture.std() > 5

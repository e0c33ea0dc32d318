"""What the annotations promise: checked by mypy, where it is installed."""

import os
import pathlib
import subprocess
import sys

import pytest

import quadrel

PACKAGE = pathlib.Path(quadrel.__file__).parent

RIGHT = """
import numpy as np
import quadrel
from typing import Any, Dict, List

stats: Dict[str, Any] = {}
scene = quadrel.load("bricks-45", {"material.relief.steps": 8}, size=(16, 16))
scene.set("material.relief.depth", 0.1)
scene.set({"size": [8, 8]})
film = quadrel.render(scene, ["R"], window=(0, 0, 4, 4), stats=stats, progress=lambda share: None)
red: np.ndarray[Any, Any] = film["R"]
report = quadrel.compare(film, {"R": red}, abs={"R": 1e-3}, blame=scene)
passes: bool = bool(report.passes)
levels: List[Any] = quadrel.bake(np.eye(4), "horizon", azimuths=8).levels
quadrel.sample.texture_lod([[0.0, 1.0]], (0.5, 0.5), 0, sampler=quadrel.Sampler(mag="nearest"))
try:
    quadrel.read("none.exr", layer="a")
except quadrel.InputError as error:
    where: str = error.file + error.key + error.found + error.expected
    line: int = error.line or 0
"""

#: Each line is an error.
WRONG = """
quadrel.load("bricks-45", size="64x64")
quadrel.load("bricks-45").set()
quadrel.render("bricks-45", threads="all")
quadrel.render("bricks-45", progress=3)
quadrel.compare("a.exr")
quadrel.Film({"R": 3}, windov=(0, 0, 1, 1))
quadrel.bake("h.png")
quadrel.Sampler(mag=3)
quadrel.InputError("x").reason
"""


def mypy(*arguments, cwd):
    return subprocess.run([sys.executable, "-m", "mypy", "--cache-dir", os.devnull, *arguments],
                          capture_output=True, text=True, cwd=cwd)


@pytest.fixture(scope="module", autouse=True)
def installed(tmp_path_factory):
    if mypy("--version", cwd=tmp_path_factory.mktemp("mypy")).returncode != 0:
        pytest.skip("mypy is not installed")


def test_the_package_is_typed_strictly_and_users_are_told(tmp_path):
    """Its own files, a program that is right and one that is wrong in every line, in one run."""
    (tmp_path / "right.py").write_text(RIGHT)
    (tmp_path / "wrong.py").write_text("import quadrel" + WRONG)
    ran = mypy("--strict", PACKAGE, "right.py", "wrong.py", cwd=tmp_path)
    lines = {int(line.split(":")[1]) for line in ran.stdout.splitlines()
             if line.startswith("wrong.py") and ": error:" in line}
    rest = [line for line in ran.stdout.splitlines()
            if ": error:" in line and not line.startswith("wrong.py")]
    assert not rest, ran.stdout
    assert lines == set(range(2, 2 + len(WRONG.splitlines()) - 1)), ran.stdout

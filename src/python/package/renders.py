"""Renders and sweeps."""

from __future__ import annotations

import json
import math
import os
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from . import _quadrel, arguments
from .films import Film, film_of, read
from .scenes import Scene, load

Injected = Mapping[str, Union[Film, Mapping[str, ArrayLike], arguments.Path]]


def scene_of(scene: Union[Scene, arguments.Path]) -> Scene:
    return scene if isinstance(scene, Scene) else load(scene)


def injections(injected: Optional[Injected]) -> List[Tuple[str, _quadrel.Film, str]]:
    all_of_them = []
    given = arguments.mapping("inject", injected, "images by what they are injected as")
    for values, image in given.items():
        arguments.text("inject", values)
        if isinstance(image, Mapping):
            all_of_them.append((values, film_of(image)._film, "an array"))
        else:
            all_of_them.append((values, read(image)._film, os.fsdecode(image)))
    return all_of_them


def render(scene: Union[Scene, arguments.Path], channels: Union[str, Sequence[str]] = (), *,
           window: Optional[arguments.Window] = None, number: str = "float", isa: str = "auto",
           threads: int = 0, limits: str = "", integrate: Optional[int] = None,
           integrate_error: Optional[float] = None, inject: Optional[Injected] = None,
           stats: Optional[Dict[str, Any]] = None, touched: bool = False,
           progress: arguments.Progress = None) -> Film:
    """Renders a scene to a film of named channels. Equal input gives equal bits.

    scene           as `load` gives it, or what `load` takes
    channels        names or groups ("hit", "N"; see `list_channels`); none: R G B A Z
    window          (x0, y0, x1, y1) in pixels from the top-left, half-open: this part alone
    number, isa     "float" or "double"; "auto", "scalar", "sse4", "avx2", "avx512" (the same bits)
    threads         0: as many as there are processors
    limits          "vulkan", "d3d", "gl" or "webgpu": also what a GPU may give, gpu.lo.X and so on
    integrate       each pixel the mean of so many samples of its area (a multiple of 16), and
    integrate_error no more of them once the means' standard errors are at most this
    inject          {"hit.uv": film}: values of an image in the place of what a stage stores
    stats           a dict that receives what the render did and took; with `touched` also which
                    texels look-ups touched, which takes several times as long
    progress        called with 0 to 1 in the calling thread; or a bar as tqdm's, or its class

    Other threads of Python run meanwhile. Ctrl-C, and what `progress` raises, end it at the next
    tile. Raises InputError for a scene that cannot be drawn, UsageError.
    """
    if stats is not None and not isinstance(stats, dict):
        raise arguments.wrong("stats", arguments.shown(stats), "a dict")
    samples = None if integrate is None else arguments.whole("integrate", integrate, 16, 65536)
    if samples is not None and samples % 16:
        raise arguments.wrong("integrate", str(samples), "a multiple of 16")
    error = None if integrate_error is None else arguments.number("integrate_error", integrate_error)
    if error is not None and not 0 <= error < math.inf:
        raise arguments.wrong("integrate_error", str(error), "a finite number of 0 or more")
    extras = _quadrel.Extras(arguments.text("limits", limits), samples, error, stats is not None,
                             bool(touched))
    with arguments.progress(progress) as told:
        film, counted = _quadrel.render(scene_of(scene)._scene, arguments.names("channels", channels),
                                        arguments.window(window),
                                        arguments.running(number, isa, threads), extras,
                                        injections(inject), told)
    if stats is not None and counted is not None:
        stats.clear()
        stats.update(json.loads(counted))
    return Film._of(film)


def sweep(plan: arguments.Path, output: arguments.Path, *, task: Tuple[int, int] = (1, 1),
          progress: arguments.Progress = None) -> List[Dict[str, Any]]:
    """Measures run time against error over a plan (bench/README.md has the format) into a folder:
    page.html, results.csv, results.json, plots. Runs that the folder has are not measured again.

    Returns the runs, a dict each, as results.json has them; of task=(I, N) every N-th, from the I-th
    on. Ctrl-C ends it within the run that is being measured, of which nothing stays; finished runs do.
    """
    number, of = arguments.wholes("task", task, "I, N", 1, 2**31 - 1)
    if number > of:
        raise arguments.wrong("task", f"({number}, {of})", "(I, N) with 1 <= I <= N, as (3, 8)")
    with arguments.progress(progress) as told:
        results = _quadrel.sweep(arguments.path(plan, "plan"), arguments.path(output, "output"), number,
                                 of, told)
    runs: List[Dict[str, Any]] = json.loads(results)["runs"]
    return runs

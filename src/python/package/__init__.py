"""Quadrel: a CPU reference rasterizer for relief mapping.

    import quadrel

    scene = quadrel.load("bricks-45", {"material.relief.steps": 256})
    film = quadrel.render(scene, channels=["R", "G", "B", "hit", "N"])
    film["hit.U"]                                    # a float32 array, a view of the film's memory

    report = quadrel.compare(film, {"hit.U": u, "hit.V": v}, abs=1e-4, blame=scene)
    print(report)                                    # a dict as well: report["channels"]

Images are given as a `Film`, as arrays by channel, or as a file of any format. What goes wrong is an
`Error`: an `InputError` says the file, the key, what was found and what was expected.

`quadrel.sample` looks up textures as GPUs do, `quadrel.quad` takes derivatives over 2x2 quads.
"""

from . import quad, sample
from ._quadrel import Error, InputError, OutputError, UsageError, version as __version__
from .films import Film, heatmap, read
from .judges import Report, compare, errors, probe
from .renders import render, sweep
from .scenes import (Scene, list_algorithms, list_channels, list_presets, list_scenes, load,
                     load_plugin)
from .textures import DepthLayers, Sampler, Texture, bake, depth_layers

__all__ = [
    "DepthLayers", "Error", "Film", "InputError", "OutputError", "Report", "Sampler", "Scene",
    "Texture", "UsageError", "bake", "compare", "depth_layers", "errors", "heatmap",
    "list_algorithms", "list_channels", "list_presets", "list_scenes", "load", "load_plugin",
    "probe", "quad", "read", "render", "sample", "sweep",
]

"""Finds the first wrong value of a GPU's image, given as arrays.

    PYTHONPATH=build/release/python python3 src/python/first_wrong_value.py [gpu.npz]

The file has an array for each channel that the port wrote, `numpy.savez("gpu.npz", **{"uv": ...,
"K": ..., "hit.U": ...})`: read back from its float targets. Without one a port is played that gets a
derivative wrong.
"""

import sys

import numpy as np

import quadrel

CHANNELS = ["A", "uv", "dUVdx", "dUVdy", "K", "hit.U", "hit.V", "hit.status", "N"]


def played_port(scene):
    """What a port gives whose dFdy runs down the image instead of up the window: Quadrel computes every
    later value from the wrong one."""
    right = quadrel.render(scene, ["dUVdy"])
    wrong = {name: -values for name, values in right.items()}
    return dict(quadrel.render(scene, CHANNELS, inject={"dUVdy": wrong}))


def main(arguments):
    scene = quadrel.load("bricks-45", size=(256, 256))
    port = dict(np.load(arguments[0])) if arguments else played_port(scene)
    reference = quadrel.render(scene, CHANNELS)

    report = quadrel.compare(reference, port, channels=CHANNELS, abs=1e-4, blame=scene)
    for channel in report["channels"]:
        print(f"{channel['name']:<12}{channel['differing']} of {channel['pixels']} pixels differ")
    if report.passes:
        return 0

    blame = report["blame"]
    x, y, first = blame["x"], blame["y"], blame["first"]
    print(f"\nThe first wrong value at {x},{y} is {first}. Four lanes of the reference there:")
    probe = quadrel.probe(scene, x, y)
    for stage in probe["fragments"][0]["stages"]:
        if first in stage["outputs"]:
            print(f"  {stage['id']}: {stage['outputs'][first]['lanes']}, "
                  f"of which the pixel is number {probe['lane']}")

    # Judged for itself: what does the reference make of the port's own earlier values?
    later = ["K", "hit.U", "hit.V", "hit.status", "N"]
    given = quadrel.render(scene, ["A", *later], inject={"uv,dUVdx,dUVdy": port})
    behind = quadrel.compare(given, port, channels=later, abs=1e-4)
    print("Behind it, given the port's own derivatives:",
          "all is right" if behind.passes else f"more is wrong\n{behind}")
    return 1


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))

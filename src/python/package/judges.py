"""Images against a reference, against the ranges of one, or against the truth."""

from __future__ import annotations

import json
from typing import Any, Dict, List, Mapping, Optional, Sequence, Tuple, Union

from numpy.typing import ArrayLike

from . import _quadrel, arguments
from .films import Film, Image, film_of
from .renders import Injected, injections, scene_of
from .scenes import Scene

ByChannel = Union[float, Mapping[str, float], None]


class Report(Dict[str, Any]):
    """What was found, as the command line's --json has it. `text`, and `str`, are what it prints."""

    #: For people, several lines.
    text: str
    #: Whether there is nothing to complain of; None of what does not judge.
    passes: Optional[bool]
    #: Of `errors`: the channels `err.*` that were summed up.
    film: Optional[Film]

    def __init__(self, found: str, text: str, passes: Optional[bool] = None,
                 film: Optional[Film] = None) -> None:
        super().__init__(json.loads(found))
        self.text = text
        self.passes = passes
        self.film = film

    def __str__(self) -> str:
        return self.text

    def __repr__(self) -> str:
        says = {None: "", True: " passes", False: " does not pass"}[self.passes]
        return f"<quadrel.Report{says}: {', '.join(self)}>"


def _tolerances(**allowed: ByChannel) -> List[Tuple[str, str, float]]:
    rules = []
    for kind, value in allowed.items():
        if value is None:
            continue
        by_channel = value if isinstance(value, Mapping) else {"": value}
        rules += [(kind, arguments.text(kind, channel), _tolerance(kind, number))
                  for channel, number in by_channel.items()]
    return rules


def _tolerance(kind: str, given: float) -> float:
    value = arguments.number(kind, given)
    most = {"ulp": 2.0**32 - 1, "fraction": 1.0}.get(kind, 1e300)
    if not 0 <= value <= most or (kind == "ulp" and value != int(value)):
        expected = {"ulp": "a whole number of 0 to 2^32 - 1", "fraction": "0 to 1"}
        raise arguments.wrong(kind, arguments.shown(given), expected.get(kind, "0 or more"))
    return value


def _source(image: Image) -> Union[_quadrel.Film, bytes]:
    return film_of(image)._film if isinstance(image, Mapping) else arguments.path(image)


def compare(reference: Image, test: Image, *, abs: ByChannel = None, rel: ByChannel = None,
            ulp: ByChannel = None, fraction: ByChannel = None, channels: Union[str, Sequence[str]] = (),
            window: Optional[arguments.Window] = None, overlap: bool = False,
            map: Optional[Mapping[str, str]] = None, flip_y: bool = False, encode: str = "none",
            ignore_flags: Union[str, Sequence[str]] = (), blame: Union[Scene, arguments.Path, None] = None,
            legal: bool = False, widest: float = 0.1, most_ambiguous: float = 0.05,
            most_unconstrained: float = 0.01) -> Report:
    """Compares two images value by value: films, arrays by channel, or files of any format.

    A channel differs where its bits differ and no tolerance allows that; a NaN on one side, a missing
    channel, another size or window always do. `report.passes` says whether nothing does.

    abs, rel, ulp, fraction  tolerances: a number, or one by channel or group, {"N": 1e-3}
    channels        these alone; so a test image may lack the others
    window          (x0, y0, x1, y1): these pixels alone; overlap: those that both have
    map             {"N": "gbuffer.normal"}: the test image's channel or group for a reference's
    flip_y          the test image's first row is its bottom
    encode          "srgb8", "unorm8" or "half": both rounded to what that can hold; arrays of uint8
                    and files of 8 bits are taken as encoded so
    ignore_flags    leaves out pixels whose reference has one of these hit.flags ("nan-look-up")
    blame           the scene: report["blame"] is the first wrong value in data flow at the worst pixel,
                    if any (`probe` shows how the reference came to its own)

    legal=True judges by the ranges that the reference holds (`render(limits="gl")`) instead: a value
    passes, is ambiguous, unconstrained (its range wider than `widest` of the channel's extent), or
    fails; most_ambiguous and most_unconstrained are the shares of pixels that may be so. Pixels that
    one side alone covers are ambiguous where the reference's channel undecided says that this may be,
    and fail elsewhere; without it, or without A on a side, their values are judged.
    """
    how = _quadrel.Comparison()
    how.tolerances = _tolerances(abs=abs, rel=rel, ulp=ulp, fraction=fraction)
    how.channels = arguments.names("channels", channels)
    how.ignored_flags = arguments.names("ignore_flags", ignore_flags)
    how.mappings = list(arguments.texts("map", map).items())
    how.window = arguments.window(window)
    how.overlap = bool(overlap)
    how.flip_y = bool(flip_y)
    how.encode = arguments.text("encode", encode)
    if encode not in ("none", "srgb8", "unorm8", "half"):
        raise arguments.wrong("encode", f'"{encode}"', "srgb8, unorm8, half or none")
    if legal:
        if how.tolerances or blame is not None:
            raise arguments.wrong("legal", "tolerances or blame beside True",
                                  "none: the reference says what is permitted")
        return Report(*_quadrel.judge(_source(reference), _source(test), how,
                                      arguments.number("widest", widest),
                                      arguments.number("most_ambiguous", most_ambiguous),
                                      arguments.number("most_unconstrained", most_unconstrained)))
    scene = None if blame is None else scene_of(blame)._scene
    return Report(*_quadrel.compare(_source(reference), _source(test), how, scene))


def probe(scene: Union[Scene, arguments.Path], x: int, y: int, *, number: str = "float",
          isa: str = "scalar", inject: Optional[Injected] = None) -> Report:
    """Runs the quad of a pixel (x, y from the top-left) once more and tells all that it goes through:
    values, steps, look-ups, texels and weights, derivatives fine, coarse and exact, of four lanes,
    with the bits of the render. Steps and look-ups are told by "float" on "scalar" alone."""
    probed = scene_of(scene)
    x, y = (arguments.index("pixel", side) for side in (x, y))
    width, height = probed.size
    if not (0 <= x < width and 0 <= y < height):
        raise arguments.wrong("pixel", f"{x},{y}", f"one within the {width}x{height} image")
    return Report(*_quadrel.probe(probed._scene, x, y, arguments.text("number", number),
                                  arguments.text("isa", isa), injections(inject)))


def errors(scene: Union[Scene, arguments.Path],
           image: Union[Film, Mapping[str, ArrayLike], None] = None, *,
           window: Optional[arguments.Window] = None, number: str = "float", isa: str = "auto",
           threads: int = 0, worst: int = 3, progress: arguments.Progress = None) -> Report:
    """How far what a scene draws is from the truth, the proven first hit of each ray: kinds of hits
    (late, early, missed, ...), percentiles of the errors in texels, degrees and colour, the `worst`
    pixels. `report.film` has the channels err.*.

    With an image, which must be of the scene's size, that is judged instead, by what it holds of
    hit.U, hit.V, hit.s, hit.status, N, shadow.visibility, R, G, B and A. Raises InputError where there
    is nothing to judge.
    """
    judged = None if image is None else film_of(image)._film
    with arguments.progress(progress) as told:
        found, text, film = _quadrel.errors(scene_of(scene)._scene, judged, arguments.window(window),
                                            arguments.running(number, isa, threads),
                                            arguments.whole("worst", worst, 0, 1000), told)
    return Report(found, text, film=Film._of(film))

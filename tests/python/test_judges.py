"""Comparisons, ranges, errors, probes."""

import numpy as np
import pytest

import quadrel


def channels_of(report):
    return {row["name"]: row for row in report["channels"]}


def test_equal_images_pass_and_others_do_not(bricks):
    film = quadrel.render(bricks, ["R", "hit.U", "hit.status"])
    assert quadrel.compare(film, film).passes
    test = {name: values.copy() for name, values in film.items()}
    assert quadrel.compare(film, test).passes
    test["hit.U"][7, 9] += 1e-3
    report = quadrel.compare(film, test)
    assert not report.passes
    row = channels_of(report)["hit.U"]
    assert row["differing"] == 1 and (row["worst"][0]["x"], row["worst"][0]["y"]) == (9, 7)
    assert "hit.U" in str(report)


def test_tolerances_are_for_all_or_by_channel_and_group(bricks):
    film = quadrel.render(bricks, ["R", "N"])
    test = {name: values + np.float32(1e-3) for name, values in film.items()}
    assert not quadrel.compare(film, test, abs=1e-4).passes
    assert quadrel.compare(film, test, abs=2e-3).passes
    assert not quadrel.compare(film, test, abs={"N": 2e-3}).passes
    assert quadrel.compare(film, test, abs={"N": 2e-3, "R": 2e-3}).passes
    assert quadrel.compare(film, test, channels=["N"], abs={"N": 2e-3}).passes
    assert quadrel.compare(film, test, fraction=1).passes
    with pytest.raises(quadrel.UsageError, match="did you mean"):
        quadrel.compare(film, test, abs={"N.XX": 1})
    with pytest.raises(quadrel.UsageError, match="fraction"):
        quadrel.compare(film, test, fraction=2)
    with pytest.raises(quadrel.UsageError, match="ulp"):
        quadrel.compare(film, test, ulp=0.5)


def test_nan_on_one_side_is_a_difference(bricks):
    film = quadrel.render(bricks, ["R"])
    test = {"R": film["R"].copy()}
    test["R"][0, 0] = np.nan
    assert not quadrel.compare(film, test, abs=1e9).passes
    film["R"][0, 0] = -np.nan  # any NaN is as good
    assert quadrel.compare(film, test).passes


def test_images_are_made_comparable(bricks):
    film = quadrel.render(bricks, ["R", "N"])
    port = {"gbuffer.normal." + c: film["N." + c][::-1] for c in "XYZ"}
    assert quadrel.compare(film, port, channels="N", map={"N": "gbuffer.normal"},
                           flip_y=True).passes
    assert not quadrel.compare(film, port, channels="N", map={"N": "gbuffer.normal"}).passes
    half = {"R": film["R"].astype(np.float16)}
    assert quadrel.compare(film, half, channels="R", encode="half").passes
    assert not quadrel.compare(film, half, channels="R").passes
    part = quadrel.render(bricks, ["R"], window=(2, 2, 8, 8))
    assert not quadrel.compare(film, part, channels="R").passes
    assert quadrel.compare(film, part, channels="R", overlap=True).passes
    assert quadrel.compare(film, part, channels="R", window=(3, 3, 5, 5)).passes
    with pytest.raises(quadrel.UsageError, match="window"):
        quadrel.compare(film, part, channels="R", window=(0, 0, 5, 5))


def srgb_codes(linear):
    """IEC 61966-2-1, to the nearest code."""
    clipped = np.clip(linear.astype(np.float64), 0, 1)
    encoded = np.where(clipped <= 0.0031308, 12.92 * clipped, 1.055 * clipped ** (1 / 2.4) - 0.055)
    return np.floor(encoded * 255 + 0.5).astype(np.uint8)


def test_screenshots_are_judged_by_codes(bricks):
    film = quadrel.render(bricks, ["R", "G", "B"])
    shot = srgb_codes(film.stack("RGB"))
    assert quadrel.compare(film, {"RGB": shot}, encode="srgb8").passes
    assert not quadrel.compare(film, {"RGB": shot}).passes
    assert not quadrel.compare(film, {"RGB": shot}, encode="unorm8").passes
    shot[4, 5, 1] += 2
    report = quadrel.compare(film, {"RGB": shot}, encode="srgb8")
    assert channels_of(report)["G"]["differing"] == 1
    assert quadrel.compare(film, {"RGB": shot}, encode="srgb8", ulp=2).passes
    assert report["preparation"]["test_storage"] == "unorm8"


def test_small_integers_of_integer_channels_are_no_codes(bricks):
    film = quadrel.render(bricks, ["hit.status", "hit.steps"])
    assert film["hit.steps"].max() < 256
    port = {name: values.astype(np.uint8) for name, values in film.items()}
    assert quadrel.compare(film, port).passes
    port["hit.status"] = film["hit.status"].astype(np.float32)
    assert quadrel.compare(film, port).passes
    port["hit.status"][3, 4] += 1
    assert not quadrel.compare(film, port).passes


def test_files_are_images(bricks, tmp_path):
    film = quadrel.render(bricks, ["R"])
    film.write(tmp_path / "a.exr")
    assert quadrel.compare(tmp_path / "a.exr", film).passes
    with pytest.raises(quadrel.InputError):
        quadrel.compare(tmp_path / "b.exr", film)


def test_the_first_wrong_value_is_blamed(bricks):
    """A wrong derivative makes all that follows wrong; the blame is its own."""
    wanted = ["A", "uv", "dUVdy", "K", "hit.U", "N"]
    film = quadrel.render(bricks, wanted)
    wrong = {name: -film[name] for name in ("dUVdy.U", "dUVdy.V")}
    port = dict(quadrel.render(bricks, wanted, inject={"dUVdy": wrong}))
    report = quadrel.compare(film, port, abs=1e-5, blame=bricks)
    blame = report["blame"]
    assert blame["first"] in wrong and blame["same_scene"]
    assert any(channel.startswith("uv") for channel in blame["upstream"])
    assert "quadrel probe" in blame["command"]
    probe = quadrel.probe(bricks, blame["x"], blame["y"])
    values = [value for stage in probe["fragments"][0]["stages"]
              for name, value in stage["outputs"].items() if name == blame["first"]]
    assert np.float32(values[0]["lanes"][probe["lane"]]) == film[blame["first"]][blame["y"], blame["x"]]
    assert "blame" not in quadrel.compare(film, film, blame=bricks)


def test_ranges_judge_what_is_legal(bricks):
    reference = quadrel.render(bricks, ["uv"], window=(8, 8, 16, 16), limits="gl")
    port = {"uv.U": reference["gpu.hi.uv.U"].copy(), "uv.V": reference["gpu.lo.uv.V"].copy()}
    port = quadrel.Film(port, frame=reference.frame, window=reference.window)
    assert quadrel.compare(reference, port, legal=True).passes
    port["uv.U"][0, 0] += 1
    report = quadrel.compare(reference, port, legal=True, channels=["uv"])
    assert not report.passes
    assert not quadrel.compare(reference, port, legal=True, channels="uv.U").passes
    assert quadrel.compare(reference, port, legal=True, channels="uv.V").passes
    with pytest.raises(quadrel.UsageError, match="beside True"):
        quadrel.compare(reference, port, legal=True, abs=1)
    with pytest.raises(quadrel.UsageError, match="no range"):
        quadrel.compare(reference, port, legal=True, channels=["R"])


def test_ranges_are_rounded_with_the_codes_that_they_judge(bricks):
    reference = quadrel.render(bricks, ["bary"], window=(8, 8, 16, 16), limits="gl")
    codes = (reference["bary.0"].astype(np.float64) * 255 + 0.5).astype(np.uint8)
    how = {"legal": True, "channels": "bary.0", "widest": 1}

    def port(values):
        return quadrel.Film({"bary.0": values}, frame=reference.frame, window=reference.window)

    assert quadrel.compare(reference, port(codes), encode="unorm8", **how).passes
    assert not quadrel.compare(reference, port(codes + np.uint8(2)), encode="unorm8", **how).passes
    assert not quadrel.compare(reference, port(codes), **how).passes


def test_errors_are_those_of_the_truth(bricks):
    report = quadrel.errors(bricks, window=(8, 8, 24, 24), worst=1)
    assert report["judged"] == 256
    assert report.film["err.uv"].shape == (16, 16)
    assert np.isfinite(report.film["err.uv"]).all() and report.film["err.uv"].max() > 0
    bricks.set({"material.relief.trace": "max-mip", "material.relief.steps": None})
    exact = quadrel.errors(bricks, window=(8, 8, 24, 24))
    assert exact.film["err.search.uv"].max() < report.film["err.search.uv"].max()


def test_an_image_is_judged_by_the_truth(bricks):
    film = quadrel.render(bricks, ["hit.U", "hit.V", "A"])
    good = quadrel.errors(bricks, film)
    film["hit.U"][:] += 0.01
    bad = quadrel.errors(bricks, film)
    assert bad.film["err.uv"].mean() > good.film["err.uv"].mean() + 1


def test_scenes_without_heights_have_nothing_to_judge():
    with pytest.raises(quadrel.InputError, match="nothing to judge"):
        quadrel.errors(quadrel.load("bricks-45", {"material.relief": None, "material.height": None}, size=(8, 8)))


def test_probes_have_the_bits_of_the_render(bricks):
    film = quadrel.render(bricks, ["hit.s"])
    report = quadrel.probe(bricks, 20, 30)
    lane = report["lane"]
    outputs = [v for stage in report["fragments"][0]["stages"]
               for name, v in stage["outputs"].items() if name == "hit.s"]
    assert int(outputs[-1]["bits"][lane], 16) == film["hit.s"].view(np.uint32)[30, 20]
    assert "hit.s" in str(report)
    for x in (-1, 48, 2**40):
        with pytest.raises(quadrel.UsageError, match="within"):
            quadrel.probe(bricks, x, 0)


def test_heat_maps_show_where(bricks):
    film = quadrel.render(bricks, ["R"])
    test = {"R": film["R"].copy()}
    assert quadrel.heatmap(film, film).shape[2] == 3
    test["R"][10:20, 10:20] += 1
    assert not np.array_equal(quadrel.heatmap(film, film), quadrel.heatmap(film, test))

"""Textures, samplers, derivatives, baked maps."""

import numpy as np
import pytest

import quadrel
from quadrel import quad, sample


@pytest.fixture
def noise():
    return np.random.default_rng(7).random((16, 32, 4), dtype=np.float32)


def image_of_uv(height, width, scale):
    """uv of fragments that see `scale` textures across, (height, width, 2)."""
    y, x = np.mgrid[0:height, 0:width] + 0.5
    return np.stack([x / width * scale, y / height * scale], axis=-1).astype(np.float32)


def test_levels_are_means_without_copies(noise):
    texture = quadrel.Texture(noise)
    levels = texture.levels
    assert [level.shape for level in levels] == [(16 >> i or 1, 32 >> i, 4) for i in range(6)]
    assert np.array_equal(levels[0], noise)
    means = noise.reshape(8, 2, 16, 2, 4).mean(axis=(1, 3), dtype=np.float64)
    assert np.allclose(levels[1], means, atol=1e-6)
    assert not levels[0].flags.owndata and not levels[0].flags.writeable
    assert np.shares_memory(levels[1], texture.levels[1])
    assert len(quadrel.Texture(noise, mips="none").levels) == 1


def test_codes_become_fractions():
    codes = np.arange(256, dtype=np.uint8).reshape(16, 16)
    texture = quadrel.Texture(codes)
    assert texture.format == "unorm8"
    assert np.array_equal(texture.levels[0][..., 0], codes / np.float32(255))
    linear = quadrel.Texture(np.dstack([codes] * 3), srgb=True)
    assert linear.format == "srgb8" and linear.channels == 4
    assert linear.levels[0][8, 0, 0] == pytest.approx(0.2158605, abs=1e-6)


def test_bad_textures_are_refused(tmp_path):
    with pytest.raises(quadrel.UsageError, match="1 to 4"):
        quadrel.Texture(np.zeros((2, 2, 5), np.float32))
    with pytest.raises(quadrel.UsageError, match="expected floats"):
        quadrel.Texture(np.zeros((2, 2), np.int64))
    with pytest.raises(quadrel.UsageError, match="one of none, box, area"):
        quadrel.Texture(np.zeros((2, 2)), mips="boks")
    with pytest.raises(quadrel.UsageError, match="each level"):
        quadrel.Texture.of_levels([np.zeros((4, 4)), np.zeros((3, 2))])
    with pytest.raises(quadrel.InputError):
        quadrel.Texture(tmp_path / "none.png")


def test_nearest_look_ups_are_texels(noise):
    nearest = quadrel.Sampler(mag="nearest", min="nearest", mip="none")
    y, x = np.mgrid[0:16, 0:32]
    uv = np.stack([(x + 0.5) / 32, (y + 0.5) / 16], axis=-1)
    assert np.array_equal(sample.texture_lod(noise, uv, 0, sampler=nearest), noise)
    assert np.array_equal(sample.texture_lod(noise, uv + [3, -2], 0, sampler=nearest), noise)
    assert np.array_equal(sample.texel_fetch(noise, np.stack([x, y], axis=-1)), noise)
    assert not sample.texel_fetch(noise, [[32, 0], [0, -1], [0, 16]]).any()


def test_linear_look_ups_are_lerps(noise):
    """In the order that the README states, in doubles."""
    rng = np.random.default_rng(3)
    uv = rng.random((50, 2))
    values = sample.texture_lod(noise, uv, 0, number="double")
    texel = uv * [32, 16] - 0.5
    base, weight = np.floor(texel).astype(int), texel - np.floor(texel)
    a, b = weight[:, :1], weight[:, 1:]

    def at(dx, dy):
        return noise[(base[:, 1] + dy) % 16, (base[:, 0] + dx) % 32].astype(np.float64)

    top = at(0, 0) + a * (at(1, 0) - at(0, 0))
    bottom = at(0, 1) + a * (at(1, 1) - at(0, 1))
    assert np.allclose(values, top + b * (bottom - top), atol=1e-12)
    assert values.dtype == np.float64
    assert sample.texture_lod(noise, uv, 0).dtype == np.float32


def test_look_ups_keep_shapes_and_broadcast(noise):
    assert sample.texture_lod(noise, (0.5, 0.5), 1).shape == (4,)
    assert sample.texture_lod(noise, np.zeros((3, 5, 2)), np.zeros((7, 1, 1))).shape == (7, 3, 5, 4)
    assert sample.texture_lod(noise, np.zeros((0, 2)), 0).shape == (0, 4)
    each = [sample.texture_lod(noise, (u, 0.3), 0.5) for u in (0.1, 0.2, 0.7)]
    assert np.array_equal(sample.texture_lod(noise, [(0.1, 0.3), (0.2, 0.3), (0.7, 0.3)], 0.5), each)
    assert np.array_equal(sample.texture_lod(noise[..., 0], (0.4, 0.4), 0)[1:], (0, 0, 1))


def test_implicit_look_ups_are_those_of_the_quads_gradients(noise):
    texture = quadrel.Texture(noise)
    uv = image_of_uv(12, 20, 2.5)
    uv[..., 0] += 0.1 * uv[..., 1] ** 2
    for mode in ("fine", "coarse"):
        for y_up in (False, True):
            dx = quad.dFdx(uv, mode=mode, y_up=y_up, axes=(0, 1))
            dy = quad.dFdy(uv, mode=mode, y_up=y_up, axes=(0, 1))
            implicit = sample.texture(texture, uv, mode=mode, y_up=y_up)
            assert np.array_equal(implicit, sample.texture_grad(texture, uv, dx, dy))
    biased = sample.texture(texture, uv, bias=1.5)
    assert np.array_equal(biased, sample.texture(texture, uv, sampler=quadrel.Sampler(lod_bias=1.5)))
    assert not np.array_equal(biased, sample.texture(texture, uv))


def test_levels_follow_the_gradients(noise):
    texture = quadrel.Texture(noise)
    size = np.array([0.25, 1, 2, 4, 1000]) / 32
    lod = sample.level_of_detail(texture, duvdx=np.stack([size, 0 * size], -1),
                                 duvdy=np.zeros((5, 2)))
    assert np.allclose(lod.rho, [0.25, 1, 2, 4, 1000])
    assert np.allclose(lod.lambda_[:4], [-2, 0, 1, 2])
    assert np.allclose(lod.level, [0, 0, 1, 2, 5])
    assert lod.magnified.tolist() == [True, True, False, False, False]
    given = sample.level_of_detail(texture, lod=[0, 1.25])
    assert given.level.tolist() == [0, 1.25] and given.frac.tolist() == [0, 0.25]
    nearest = sample.level_of_detail(texture, lod=[0.75], sampler=quadrel.Sampler(mip="nearest"))
    assert nearest.level.tolist() == [1]


@pytest.mark.parametrize("wrap", ["repeat", "mirrored-repeat", "clamp-to-edge", "clamp-to-border"])
def test_footprints_make_the_value(noise, wrap):
    sampler = quadrel.Sampler(wrap=wrap, border=(1, 2, 3, 4))
    uv = np.random.default_rng(5).random((40, 2)) * 3 - 1
    lod = np.linspace(0, 4.5, 40)
    taps = sample.footprint(noise, uv, lod=lod, sampler=sampler)
    assert np.allclose(taps.weight.sum(-1), 1, atol=1e-6)
    values = (taps.weight[..., np.newaxis] * taps.value).sum(-2)
    assert np.allclose(values, sample.texture_lod(noise, uv, lod, sampler=sampler), atol=1e-5)
    levels = quadrel.Texture(noise).levels
    for i in range(40):
        for k in range(taps.count[i]):
            expected = (1, 2, 3, 4) if taps.border[i, k] else \
                levels[taps.level[i, k]][taps.y[i, k], taps.x[i, k]]
            assert np.array_equal(taps.value[i, k], expected)
    assert taps.border.any() == (wrap == "clamp-to-border")
    assert set(np.unique(taps.count)) <= {4, 8}


def test_gather_has_glsls_order(noise):
    uv = ((5 + 1) / 32, (3 + 1) / 16)  # where texels (5, 3) to (6, 4) meet
    assert sample.texture_gather(noise, uv, 2).tolist() == \
        noise[[4, 4, 3, 3], [5, 6, 6, 5], 2].tolist()


def test_hardware_rounds_weights(noise):
    uv = np.random.default_rng(5).random((64, 2))
    exact = sample.texture_lod(noise, uv, 0)
    rounded = sample.texture_lod(noise, uv, 0, sampler=quadrel.Sampler(hardware="d3d"))
    assert 0 < np.abs(rounded - exact).max() < 1 / 256


def test_levels_of_others_are_taken_as_they_are():
    levels = [np.full((4, 8), 1.0), np.full((2, 4), 5.0), np.full((1, 2), 7.0)]
    texture = quadrel.Texture.of_levels(levels)
    assert [sample.texture_lod(texture, (0.5, 0.5), l)[0] for l in (0, 1, 1.5, 2, 9)] == \
        [1, 5, 6, 7, 7]


@pytest.mark.parametrize("call, message", [
    (lambda: sample.texture([[0.0]], np.zeros((3, 4, 2))), "even number"),
    (lambda: sample.texture_lod([[0.0]], np.zeros((3, 3)), 0), "two components"),
    (lambda: sample.texture_lod([[0.0]], (0, 0), 0, number="half"), "float or double"),
    (lambda: sample.texture_gather([[0.0]], (0, 0), 4), "0 to 3"),
    (lambda: sample.footprint([[0.0]], (0, 0), duvdx=(0, 0)), "both of"),
    (lambda: sample.level_of_detail([[0.0]]), "expected uv, lod"),
    (lambda: sample.texture_lod([[0.0]], (0, 0), 0, sampler=quadrel.Sampler(wrap="repaet")),
     '"repeat"'),
    (lambda: sample.texture_lod([[0.0]], (0, 0), 0, sampler=quadrel.Sampler(border=(1, 2))),
     "r, g, b and a"),
    (lambda: quad.dFdx(np.zeros(4)), "even number"),
    (lambda: quad.dFdx(np.zeros((2, 2)), mode="rough"), "fine"),
])
def test_senseless_look_ups_are_refused(call, message):
    with pytest.raises(quadrel.UsageError, match=message):
        call()


def test_differences_are_each_quads_own():
    values = np.array([[1, 4, 0, 0], [10, 15, 0, 8]], np.float32)
    assert quad.dFdx(values).tolist() == [[3, 3, 0, 0], [5, 5, 8, 8]]
    assert quad.dFdx(values, mode="coarse").tolist() == [[3, 3, 0, 0], [3, 3, 0, 0]]
    assert quad.dFdy(values).tolist() == [[9, 11, 0, 8], [9, 11, 0, 8]]
    assert quad.dFdy(values, y_up=True).tolist() == [[-9, -11, 0, -8], [-9, -11, 0, -8]]
    assert quad.dFdx(values, mode="coarse", y_up=True).tolist() == [[5, 5, 8, 8], [5, 5, 8, 8]]
    assert quad.fwidth(values).tolist() == [[12, 14, 0, 8], [14, 16, 8, 16]]
    stacked = np.stack([values, 2 * values])
    assert np.array_equal(quad.dFdy(stacked), [quad.dFdy(values), 2 * quad.dFdy(values)])
    last = np.moveaxis(stacked, 0, -1)
    assert np.array_equal(quad.dFdy(last, axes=(0, 1))[..., 1], 2 * quad.dFdy(values))
    assert quad.dFdx(values.astype(np.float64)).dtype == np.float64
    assert quad.dFdx(np.zeros((0, 4))).shape == (0, 4)


def test_differences_are_those_of_the_renderer(bricks):
    """But where an edge goes through a quad, whose helper lanes a film has not."""
    film = quadrel.render(bricks, ["uv", "dUVdx", "dUVdy", "id.primitive", "A"])
    assert film["A"].all()
    triangle = film["id.primitive"].astype(np.float64)
    whole = (quad.fwidth(triangle) == 0) & (quad.dFdx(triangle, mode="coarse", y_up=True) == 0)
    whole &= quad.fwidth(quad.dFdx(triangle)) == 0
    assert whole.mean() > 0.8
    for c in "UV":
        assert np.array_equal(quad.dFdx(film["uv." + c])[whole], film["dUVdx." + c][whole])
        down = quad.dFdy(film["uv." + c], y_up=True)
        assert np.array_equal(down[whole], film["dUVdy." + c][whole])
        assert not np.array_equal(quad.dFdy(film["uv." + c])[whole], film["dUVdy." + c][whole])


def test_maps_are_baked(tmp_path):
    heights = np.random.default_rng(2).random((16, 16), dtype=np.float32)
    shares = []
    pyramid = quadrel.bake(heights, "texel-max", progress=shares.append)
    assert [level.shape for level in pyramid.levels] == [(16 >> i, 16 >> i, 1) for i in range(5)]
    assert np.array_equal(pyramid.levels[0][..., 0], heights)
    assert np.array_equal(pyramid.levels[1][..., 0],
                          heights.reshape(8, 2, 8, 2).max(axis=(1, 3)))
    assert pyramid.levels[4].max() == heights.max() and shares[-1] == 1
    depth = quadrel.bake(1 - heights, "texel-max", channel="1-r")
    assert np.allclose(depth.levels[0], pyramid.levels[0], atol=1e-7)
    horizon = quadrel.bake(heights, "horizon", azimuths=8, output=tmp_path / "h.exr")
    assert horizon.layers == 8 and horizon.levels[0].shape == (8, 16, 16, 1)
    assert np.array_equal(quadrel.read(tmp_path / "h.exr")["000.Y"], horizon.levels[0][0, :, :, 0])


def test_meshes_are_peeled(tmp_path):
    layers = quadrel.depth_layers("sphere", size=(32, 32), margin=0.25)
    front, back = layers.film["R"], layers.film["G"]
    assert front[16, 16] < 0.01 and back[16, 16] > 0.99  # the whole diameter in the middle
    assert (front <= back).all() and front.min() >= 0 and back.max() <= 1
    inside = back > front
    assert inside.mean() == pytest.approx(np.pi / 4 * 0.25, abs=0.02)
    assert layers.tile == pytest.approx(2 * layers.thickness, rel=1e-3) and layers.deeper == 0
    layers.film.write(tmp_path / "layers.exr")
    assert quadrel.read(tmp_path / "layers.exr").attributes["quadrel:bake.kind"] == "depth-layers"
    edge_on = [quadrel.depth_layers("torus", size=(32, 32), towards=(1, 0, 0), solids=solids)
               for solids in (1, 2, 3)]
    assert [len(of.film) for of in edge_on] == [4, 4, 8] and edge_on[0].deeper > 0
    assert all(of.deeper == 0 for of in edge_on[1:])
    assert np.array_equal(edge_on[2].film["A"], edge_on[1].film["A"])
    with pytest.raises(quadrel.UsageError, match="towards"):
        quadrel.depth_layers("sphere", towards=(0, 0, 0))
    with pytest.raises(quadrel.UsageError, match="margin"):
        quadrel.depth_layers("sphere", margin=0.5)
    with pytest.raises(quadrel.InputError):
        quadrel.depth_layers(tmp_path / "none.obj")


@pytest.mark.parametrize("call, message", [
    (lambda h: quadrel.bake(h, "cones"), "cone"),
    (lambda h: quadrel.bake(h, "horizon", azimuth=8), "azimuths"),
    (lambda h: quadrel.bake(h, "cone", wrap="repeet"), "repeat"),
    (lambda h: sample.texture_lod(quadrel.bake(h, "horizon", azimuths=8), (0, 0), 0), "8 layers"),
])
def test_senseless_bakes_are_refused(call, message):
    with pytest.raises(quadrel.UsageError, match=message):
        call(np.zeros((8, 8), np.float32))


def test_what_progress_raises_ends_a_bake():
    class Enough(Exception):
        pass

    def progress(share):
        raise Enough

    heights = np.random.default_rng(2).random((512, 512), dtype=np.float32)
    with pytest.raises(Enough):
        quadrel.bake(heights, "relaxed-cone", cache=False, progress=progress)

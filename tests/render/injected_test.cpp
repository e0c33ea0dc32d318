// Values that are taken from an image in the place of what a stage stores.
#include <set>

#include "built_isas.hpp"
#include "quadrel/error.hpp"
#include "quadrel/probe.hpp"
#include "quadrel/raster/coverage.hpp"
#include "quadrel/scene/load.hpp"
#include "render/films.hpp"
#include "render/plan/channel_source.hpp"
#include "render/plan/plan.hpp"
#include "render/scenes.hpp"

namespace quadrel::render_tests {
namespace {

using Names = std::vector<std::string>;

Injection injection(const std::string& values, const Film& image) {
    return {values, std::make_shared<const Film>(image), "gpu.exr"};
}

/// A render with the values of these channels taken from `image`.
Film with_values(const Scene& scene, const Names& values, const Film& image,
                 RenderOptions options = {}) {
    if (options.channels.empty()) options.channels = channels_without_counts(scene);
    for (const std::string& name : values) options.injected.push_back(injection(name, image));
    return render(scene, options);
}

Film own_film(const Scene& scene) { return take(render, scene, channels_without_counts(scene)); }

/// Channels that hold what a stage stores.
Names stored_channels(const Scene& scene) {
    Names names;
    for (const std::string& name : channels_without_counts(scene)) {
        const ChannelSource source = channel_source(name);
        const bool again = name.starts_with("shadow.visibility");  // light 0's
        if (source.kind == ChannelSource::Kind::value && !again) names.push_back(name);
    }
    return names;
}

TEST(Injected, OwnValuesChangeNoBit) {
    const Scene scene = varied_scene();
    const Film own = own_film(scene);
    EXPECT_TRUE(same_bits(own, with_values(scene, stored_channels(scene), own)));
    for (const std::string& name : stored_channels(scene))
        EXPECT_TRUE(same_bits(own, with_values(scene, {name}, own))) << name;
    for (const char* name : {"hit.uv", "J", "hit", "light", "uv,K,hit.uv,N"})
        EXPECT_TRUE(same_bits(own, with_values(scene, {name}, own))) << name;
}

/// Values that a material's stages make, among others, of `changed`; itself included.
ValueSet made_of(const Scene& scene, Value changed, int light) {
    ValueSet all;
    for (const Material& material : scene.materials) {
        ValueSet reached;
        bool stored = false;
        for (const PlannedStage& stage : material_stages(scene, material)) {
            const auto reads = [&](Value v) { return reached[static_cast<std::size_t>(v)]; };
            if (stored && std::ranges::any_of(stage.info->inputs, reads))
                for (const Value v : stage.info->outputs) reached.set(static_cast<std::size_t>(v));
            if (!stores(stage, changed) || (stage.light >= 0 && stage.light != light)) continue;
            stored = true;
            reached.set(static_cast<std::size_t>(changed));
        }
        all |= reached;
    }
    return all;
}

/// The film with another value of a channel at each pixel that is covered.
Film moved(Film film, const std::string& channel) {
    Plane& plane = *film.find(channel);
    const bool whole = plane.type == ChannelType::uint32;
    for (std::size_t i = 0; i < plane.bits.size(); ++i)
        if (film.find("A")->as_float(i) > 0)
            plane.bits[i] = whole ? plane.bits[i] ^ 1u
                                  : std::bit_cast<std::uint32_t>(plane.as_float(i) * 0.75f + 0.01f);
    return film;
}

/// A frame that the search turns is stored twice; channels have it as the search leaves it, which
/// is not what the search starts from.
TEST(Injected, WhatIsStoredTwiceIsReplacedInTheEnd) {
    const Scene scene = load_scene("rows/curved-quadric", {"size=[40,40]"});
    const Film own = own_film(scene);
    const Names turned{"T", "B.X", "B.Y", "B.Z", "J", "frame_normal"};
    EXPECT_TRUE(same_bits(own, with_values(scene, turned, own)));
    const Film film = with_values(scene, {"frame_normal"}, moved(own, "frame_normal.X"));
    EXPECT_EQ(film.find("hit.s")->bits, own.find("hit.s")->bits);
    EXPECT_NE(film.find("N.X")->bits, own.find("N.X")->bits);
}

/// Whether a change of a channel moves what stages make of it, and nothing else; the channel is the
/// image's.
testing::AssertionResult moves_what_follows(const Scene& scene, const Film& own,
                                            const std::string& channel, const Film& found) {
    const ChannelSource changed = channel_source(channel);
    const ValueSet reached = made_of(scene, changed.value, changed.light);
    int later = 0;
    const Film image = moved(own, channel);
    for (const Plane& plane : own.planes) {
        const ChannelSource source = channel_source(plane.name);
        const bool is_value = source.kind == ChannelSource::Kind::value;
        const bool is_changed = is_value && source.slot() == changed.slot();
        if (is_changed && plane.name != channel) continue;  // shadow.visibility is light 0's
        const bool is_z = source.kind == ChannelSource::Kind::z;
        const auto v = static_cast<std::size_t>(is_z ? Value::hit_P : source.value);
        const bool same = found.find(plane.name)->bits == plane.bits;
        if (is_changed && found.find(plane.name)->bits != image.find(plane.name)->bits)
            return testing::AssertionFailure() << plane.name << " is not the image's";
        const bool may_move = (is_value || is_z) && reached[v] && !is_changed;
        later += may_move && !same;
        const bool component = is_value && source.value == changed.value && !is_changed;
        if (!same && !is_changed && (!may_move || component))
            return testing::AssertionFailure() << plane.name << " has moved";
    }
    if (later == 0) return testing::AssertionFailure() << "nothing has moved";
    return testing::AssertionSuccess();
}

TEST(Injected, AChangeMovesWhatFollowsAndNothingElse) {
    const Scene scene = varied_scene();
    const Film own = own_film(scene);
    for (const char* name : {"uv.U", "dUVdx.V", "dPdy.Y", "K.U", "hit.U", "hit.s", "N.Y",
                             "shadow.0.visibility", "shadow.1.visibility"}) {
        const Film found = with_values(scene, {name}, moved(own, name));
        EXPECT_TRUE(moves_what_follows(scene, own, name, found)) << name;
        // Planted: not injected at all, and injected into the stage before.
        EXPECT_FALSE(moves_what_follows(scene, own, name, own)) << name;
        EXPECT_FALSE(
            moves_what_follows(scene, own, name, with_values(scene, {"P.X"}, moved(own, "P.X"))))
            << name;
    }
}

TEST(Injected, BitsAreTheSameOnEveryInstructionSetTileAndWindow) {
    const Scene scene = varied_scene();
    const Film image = moved(own_film(scene), "hit.U");
    const Names names{"hit.uv", "K"};
    const Film expected = with_values(scene, names, image);
    RenderOptions options;
    for (const std::string& isa : built_isas()) {
        options.isa = isa;
        EXPECT_TRUE(same_bits(expected, with_values(scene, names, image, options))) << isa;
    }
    options.tile = 6;
    options.threads = 3;
    options.skip = false;
    EXPECT_TRUE(same_bits(expected, with_values(scene, names, image, options)));
    Film part = expected;
    crop(part, {5, 3, 20, 16});
    options.window = Window{5, 3, 20, 16};
    EXPECT_TRUE(same_bits(part, with_values(scene, names, image, options)));
    // The image may be no larger than what is rendered; then lanes beyond it are the stages' own.
    Film small = image;
    crop(small, {5, 3, 20, 16});
    EXPECT_EQ(with_values(scene, names, small, options).find("hit.U")->bits,
              part.find("hit.U")->bits);
}

/// Doubles get the image's floats, and go on in double.
TEST(Injected, DoublesGetTheImagesFloats) {
    const Scene scene = varied_scene();
    const Film image = moved(own_film(scene), "hit.U");
    RenderOptions options;
    options.number = "double";
    const Film found = with_values(scene, {"hit.uv"}, image, options);
    options.channels = channels_without_counts(scene);
    const Film own = render(scene, options);
    for (const char* name : {"hit.U", "hit.V"})
        EXPECT_EQ(found.find(name)->bits, image.find(name)->bits) << name;
    EXPECT_EQ(found.find("K.U")->bits, own.find("K.U")->bits);
    EXPECT_NE(found.find("N.X")->bits, own.find("N.X")->bits);
    EXPECT_NE(found.find("N.X")->bits, with_values(scene, {"hit.uv"}, image).find("N.X")->bits);
}

/// Where the image has no fragment the stage's value stays; NaN is a value like any other. What
/// the image holds where nothing is seen does not matter, helper lanes being the stages' own.
TEST(Injected, OnlyFragmentsOfBothAreReplaced) {
    const Scene scene = varied_scene();
    const Film own = own_film(scene);
    Film image = own;
    for (std::size_t i = 0; i < own.window.area(); ++i)
        if (!(own.find("A")->as_float(i) > 0))
            for (const char* name : {"dUVdx.U", "K.U", "hit.U", "hit.V"})
                image.find(name)->bits[i] = canonical_nan;
    Film without_coverage = image;
    std::erase_if(without_coverage.planes, [](const Plane& plane) { return plane.name == "A"; });
    for (const Film& film : {image, without_coverage})
        EXPECT_TRUE(same_bits(own, with_values(scene, {"hit.uv", "K", "dUVdx"}, film)));
    Film some = moved(own, "hit.U");
    const Where kept = [](int x, int y) { return (x + 2 * y) % 3 == 0; };
    for (int y = 0; y < scene.height; ++y)
        for (int x = 0; x < scene.width; ++x)
            if (kept(x, y)) some.find("A")->bits[some.index(x, y)] = 0;
    const Film mixed = with_values(scene, {"hit.uv"}, some);
    EXPECT_TRUE(same_bits(with_planes(own, {"hit.U"}), mixed, kept));
    EXPECT_FALSE(same_bits(with_planes(own, {"hit.U"}), mixed));
    Film nan = own;
    std::ranges::fill(nan.find("hit.U")->bits, canonical_nan);
    const Film poisoned = with_values(scene, {"hit.uv"}, nan);
    EXPECT_TRUE(everywhere(poisoned, covered(own), [&](int x, int y) {
        return bits(poisoned, "hit.U", x, y) == canonical_nan ? "" : "not NaN";
    }));
}

/// What is decided before it is known what is seen is the reference's own: holes stay where they
/// are.
TEST(Injected, CoverageStaysTheReferences) {
    const Scene scene = varied_scene();
    const Film own = own_film(scene);
    const Film found = with_values(scene, {"uv", "hit.uv"}, moved(moved(own, "uv.U"), "hit.U"));
    EXPECT_TRUE(
        same_bits(with_planes(own, {"A", "id.object", "id.primitive", "quad.coverage"}), found));
}

/// A probe goes through the values of the render.
TEST(Injected, AProbeSeesThem) {
    const Scene scene = varied_scene();
    const Film image = moved(own_film(scene), "hit.U");
    const Film film = with_values(scene, {"hit.uv"}, image);
    int compared = 0;
    for (const auto& [x, y] : {std::pair(12, 13), std::pair(20, 8), std::pair(25, 14)}) {
        const ProbeReport report =
            probe(scene, x, y, "float", "scalar", {injection("hit.uv", image)});
        for (const ProbeFragment& fragment : report.fragments) {
            const auto lane = static_cast<std::size_t>(report.lane);
            if (fragment.visible[lane] == 0) continue;
            for (const ProbeStage& stage : fragment.stages)
                for (const ProbeValue& value : stage.outputs)
                    if (value.name == "hit.U" || value.name == "N.X" || value.name == "R") {
                        EXPECT_EQ(canonical_bits(std::bit_cast<std::uint32_t>(value.real[lane])),
                                  bits(film, value.name, x, y));
                        ++compared;
                    }
        }
    }
    EXPECT_GE(compared, 3);
}

/// Ranges of what follows are ranges around what was injected; of that itself they are points.
TEST(Injected, RangesBeginThere) {
    Scene scene = empty_scene(16, 16);
    set_perspective_camera(scene, {0.9, -1.2, 1.5}, {.near = 0.5, .far = 50});
    scene.materials = {relief_material("relief", false)};
    scene.lights = {directional_light({0.8f, 0.3f, 1})};
    add_object(scene, make_quad(2), 0);
    RenderOptions options;
    options.channels = {"A", "hit.U", "hit.V", "N", "K"};
    options.limits = "gl";
    const Film own = render(scene, options);
    const Film image = moved(own, "hit.U");
    const Film found = with_values(scene, {"hit.uv"}, image, options);
    const auto wide = [&](const Film& film, const std::string& channel, int x, int y) {
        return value(film, "gpu.hi." + channel, x, y) - value(film, "gpu.lo." + channel, x, y);
    };
    int narrower = 0;
    EXPECT_TRUE(everywhere(found, covered(own), [&](int x, int y) -> std::string {
        narrower += wide(found, "N.X", x, y) < 0.5f * wide(own, "N.X", x, y);
        if (value(found, "gpu.lo.hit.U", x, y) > value(image, "hit.U", x, y) ||
            value(found, "gpu.hi.hit.U", x, y) < value(image, "hit.U", x, y) ||
            wide(found, "hit.U", x, y) > 1e-6f)
            return "hit.U is no point";
        const float n = value(found, "N.X", x, y);
        if (!(value(found, "gpu.lo.N.X", x, y) <= n && n <= value(found, "gpu.hi.N.X", x, y)))
            return "N.X is outside of its range";
        return wide(found, "K.U", x, y) == wide(own, "K.U", x, y) ? "" : "K has another range";
    }));
    EXPECT_GT(narrower, 20);
}

template <class Error>
std::string refusal(const Scene& scene, const Names& values, const Film& image,
                    RenderOptions options = {}) {
    try {
        with_values(scene, values, image, options);
    } catch (const Error& error) {
        return error.what();
    }
    return "";
}

testing::AssertionResult says(const std::string& message, const Names& parts) {
    for (const std::string& part : parts)
        if (message.find(part) == std::string::npos)
            return testing::AssertionFailure() << "no \"" << part << "\" in \"" << message << "\"";
    return testing::AssertionSuccess();
}

TEST(Injected, WhatDoesNotFitIsRefused) {
    const Scene scene = varied_scene();
    const Film own = own_film(scene);
    const auto of_input = [&](const Names& values, const Film& image) {
        return refusal<InputError>(scene, values, image);
    };
    EXPECT_TRUE(says(of_input({"hit.uv"}, own_film(varied_scene(1, Conventions::gl, 36, 27))),
                     {"gpu.exr", "36x27", "37x27"}));
    Film part = own;
    crop(part, {0, 0, 20, 20});
    EXPECT_TRUE(says(of_input({"hit.uv"}, part), {"gpu.exr", "0,0,20,20", "0,0,37,27"}));
    EXPECT_TRUE(
        says(of_input({"hit.uv"}, with_planes(own, {"hit.U"})), {"hit.V", "no such channel"}));
    EXPECT_TRUE(says(of_input({"hit"}, with_planes(own, {"N.X"})), {"hit", "no channel"}));
    Film types = own;
    types.find("hit.U")->type = ChannelType::uint32;
    types.find("hit.status")->type = ChannelType::float32;
    EXPECT_TRUE(says(of_input({"hit.U"}, types), {"hit.U", "integers", "floats"}));
    EXPECT_TRUE(says(of_input({"hit.status"}, types), {"hit.status", "floats", "integers"}));
    Film codes = own;
    codes.find("hit.status")->bits[codes.index(4, 3)] = 8;
    EXPECT_TRUE(says(of_input({"hit.status"}, codes), {"hit.status", "8 at 4,3", "0 to 7"}));
}

TEST(Injected, WhatMakesNoSenseIsRefused) {
    Scene scene = varied_scene();
    const Film own = own_film(scene);
    const auto of_usage = [&](const Names& values, RenderOptions options = {}) {
        return refusal<UsageError>(scene, values, own, options);
    };
    EXPECT_TRUE(says(of_usage({"Z"}), {"--inject", "Z"}));
    EXPECT_TRUE(says(of_usage({"exact.dUVdx"}), {"--inject", "exact.dUVdx.U"}));
    EXPECT_TRUE(says(of_usage({"hit.uw"}), {"hit.uw"}));
    EXPECT_TRUE(says(of_usage({"hit.uv", "hit.V"}), {"hit.V", "twice"}));
    RenderOptions options;
    options.channels = {"uv"};
    EXPECT_TRUE(says(of_usage({"hit.uv"}, options), {"hit.uv", "nothing that is rendered reads"}));
    options.channels = {"R", "derr.dNdx.X"};
    EXPECT_TRUE(says(of_usage({"hit.uv"}, options), {"derr.dNdx.X"}));
    scene.samples = 4;
    EXPECT_TRUE(says(of_usage({"hit.uv"}), {"4 samples"}));
    scene.samples = 1;
    options.channels.clear();
    options.integral = IntegralOptions{16};
    EXPECT_TRUE(says(of_usage({"hit.uv"}, options), {"integral"}));
}

/// The header says what was injected, by its hash.
TEST(Injected, TheHeaderSaysWhat) {
    const Scene scene = varied_scene();
    const Film own = own_film(scene);
    RenderOptions options;
    const auto attribute = [&] {
        for (const auto& [name, text] : render_attributes(scene, options))
            if (name == "quadrel:injected") return text;
        return std::string();
    };
    EXPECT_EQ(attribute(), "");
    options.injected = {injection("hit.uv", own)};
    const std::string first = attribute();
    EXPECT_TRUE(says(first, {"hit.uv=" + film_hash(own)}));
    options.injected = {injection("hit.uv", moved(own, "hit.U"))};
    EXPECT_NE(attribute(), first);
}

}  // namespace
}  // namespace quadrel::render_tests

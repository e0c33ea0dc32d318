// What holds for every kind: threads, position, progress, identity, refusals.
#include "quadrel/bake/bake.hpp"

#include <set>

#include "bake/files.hpp"
#include "quadrel/error.hpp"

namespace quadrel::test {
namespace {

using BakeWith = std::function<Texels(const Texture&, BakeKind, const BakeOptions&)>;

Texels bake_repeating(const Texture& field, BakeKind kind, const BakeOptions& options) {
    return bake(field, kind, repeat(), options);
}

testing::AssertionResult ignores_threads(const BakeWith& bake_with) {
    const Texels field = random_field(33, 20, 71);
    for (const BakeKindInfo& info : bake_kinds()) {
        BakeOptions one, many;
        one.threads = 1;
        many.threads = 4;
        if (!same_texels(*bake_with(*field, info.kind, one), *bake_with(*field, info.kind, many)))
            return testing::AssertionFailure() << info.name;
    }
    return testing::AssertionSuccess();
}

TEST(Bake, GivesTheSameOnAnyNumberOfThreads) {
    EXPECT_TRUE(ignores_threads(bake_repeating));
    EXPECT_FALSE(ignores_threads([](const Texture& field, BakeKind kind, const BakeOptions& o) {
        return with_values(*bake_repeating(field, kind, o), [&](float v, int, int, int, int, int) {
            return v + static_cast<float>(o.threads);
        });
    })) << static_cast<int>(Planted::threads_in_values);
}

/// Pyramids are aligned to the texture's first texel, and so are quick cones.
bool moves_with_the_field(const BakeKindInfo& info) {
    return info.kind != BakeKind::cone_quick && info.kind != BakeKind::relaxed_cone;
}

/// Under repeat a field that is moved by whole texels gives the same map, moved. The published
/// relaxed cones round coordinates and move up to that.
testing::AssertionResult moves(const BakeWith& bake_with) {
    const int width = 12, height = 7, by_x = 5, by_y = 3;
    const Texels field = random_field(width, height, 72);
    const Texels moved = make_field(width, height, [&](int i, int j) {
        return height_at(*field, repeat(), i + by_x, j + by_y);
    });
    for (const BakeKindInfo& info : bake_kinds()) {
        if (!moves_with_the_field(info)) continue;
        const Texels a = bake_with(*field, info.kind, {}), b = bake_with(*moved, info.kind, {});
        for (int k = 0; k < width * height * a->view().faces * a->view().channels; ++k) {
            const int c = k % a->view().channels, layer = k / a->view().channels % a->view().faces;
            const int texel = k / a->view().channels / a->view().faces;
            const int i = texel % width, j = texel / width;
            if (texel_of(*b, 0, layer, i, j, c) !=
                texel_of(*a, 0, layer, (i + by_x) % width, (j + by_y) % height, c))
                return testing::AssertionFailure() << info.name << " layer " << layer;
        }
    }
    return testing::AssertionSuccess();
}

TEST(Bake, MovesWithTheFieldUnderRepeat) {
    EXPECT_TRUE(moves(bake_repeating));
    EXPECT_FALSE(moves([](const Texture& field, BakeKind kind, const BakeOptions& options) {
        return bake(field, kind, sampler_with(Wrap::clamp_to_edge, Wrap::repeat), options);
    })) << static_cast<int>(Planted::wrap_forgotten);
    EXPECT_FALSE(moves([](const Texture& field, BakeKind kind, const BakeOptions& options) {
        return with_value(*bake_repeating(field, kind, options), 0, 0, 1, 1, 0,
                          [](float v) { return v + 0.125f; });
    })) << static_cast<int>(Planted::position_in_values);
}

testing::AssertionResult tells_progress(const BakeWith& bake_with) {
    const Texels field = random_field(16, 16, 73);
    for (const BakeKindInfo& info : bake_kinds()) {
        std::vector<double> told;
        BakeOptions options;
        options.progress = [&](double done) { told.push_back(done); };
        bake_with(*field, info.kind, options);
        if (told.size() < 2 || told.back() != 1 || told.front() <= 0 ||
            !std::is_sorted(told.begin(), told.end()))
            return testing::AssertionFailure() << info.name << " told " << told.size() << " times";
        // Half of the calls before half of the work, roughly: no jump to the end.
        if (told[told.size() - 2] < 0.5)
            return testing::AssertionFailure()
                   << info.name << " jumps from " << told[told.size() - 2];
    }
    return testing::AssertionSuccess();
}

TEST(Bake, TellsProgress) {
    EXPECT_TRUE(tells_progress(bake_repeating));
    EXPECT_FALSE(tells_progress([](const Texture& field, BakeKind kind, const BakeOptions& o) {
        const Texels map = bake_repeating(field, kind, o);
        o.progress(0.5);
        return map;
    })) << static_cast<int>(Planted::progress_falls);
}

/// Everything that decides about values is in the identity, and nothing else.
TEST(Bake, IdentityHoldsWhatDecidesAboutValues) {
    const Texels field = random_field(4, 4, 74), other = random_field(4, 4, 75);
    std::set<std::string> ids;
    for (const BakeKindInfo& info : bake_kinds()) ids.insert(baked_id(*field, info.kind, repeat()));
    ids.insert(baked_id(*other, BakeKind::cone, repeat()));
    for (const SamplerState& sampler : all_samplers())
        ids.insert(baked_id(*field, BakeKind::cone, sampler));
    ids.insert(
        baked_id(*field, BakeKind::cone, sampler_with(Wrap::clamp_to_border, Wrap::repeat, 0.5f)));
    BakeOptions wide;
    wide.parameters["c_max"] = 2;
    ids.insert(baked_id(*field, BakeKind::cone, repeat(), wide));
    EXPECT_EQ(ids.size(), bake_kinds().size() + 1 + 24 + 1 + 1);

    SamplerState filtered = repeat();
    filtered.border[0] = 0.3f;  // which no look-up reaches
    filtered.mag = Filter::nearest;
    BakeOptions same;
    same.parameters["c_max"] = 1;
    same.threads = 3;
    EXPECT_EQ(baked_id(*field, BakeKind::cone, filtered, same),
              baked_id(*field, BakeKind::cone, repeat()));
    EXPECT_EQ(bake(*field, BakeKind::cone, repeat())->id(),
              baked_id(*field, BakeKind::cone, repeat()));
}

/// The same heights in another channel, with mip levels: the same map, hence the same identity.
TEST(Bake, IdentityIsOfHeightsAndNotOfFiles) {
    const Texels field = random_field(5, 3, 77);
    Image image;
    image.width = 5;
    image.height = 3;
    image.channels = 4;
    for (int k = 0; k < 15; ++k)
        for (const float v : {0.5f, 0.0f, 0.25f, 1 - texel_of(*field, 0, 0, k % 5, k / 5)})
            image.values.push_back(v);
    TextureOptions options;
    options.swizzle = "1-ar";
    const Texels packed = make_texture(image, options);
    EXPECT_EQ(height_id(*packed), height_id(*field));
    EXPECT_TRUE(same_texels(*bake(*packed, BakeKind::cone_cell, repeat()),
                            *bake(*field, BakeKind::cone_cell, repeat())));
    EXPECT_NE(height_id(*make_field(3, 5,
                                    [&](int i, int j) {
                                        return texel_of(*field, 0, 0, (j * 3 + i) % 5,
                                                        (j * 3 + i) / 5);
                                    })),
              height_id(*field));
}

TEST(Bake, NamesAndKindsAgree) {
    int next = 0;
    for (const BakeKindInfo& info : bake_kinds()) {
        EXPECT_EQ(static_cast<int>(info.kind), next++);
        EXPECT_EQ(bake_kind_from_name(info.name), info.kind);
        EXPECT_EQ(&bake_kind_info(info.kind), &bake_kind_info(info.kind));
        EXPECT_GT(bake_seconds_estimate(info.kind, 64, 64), 0) << info.name;
        EXPECT_LE(bake_seconds_estimate(info.kind, 128, 128), 20) << info.name;
    }
    EXPECT_THROW(bake_kind_from_name("cone-robot"), UsageError);
}

TEST(Bake, RefusesWhatMakesNoSense) {
    const Texels field = random_field(4, 4, 76);
    const auto with = [&](const char* name, double value) {
        BakeOptions options;
        options.parameters[name] = value;
        return bake(*field, BakeKind::distance, repeat(), options);
    };
    EXPECT_NO_THROW(with("slices", 4));
    EXPECT_THROW(with("slice", 4), UsageError);
    EXPECT_THROW(with("slices", 4.5), UsageError);
    EXPECT_THROW(with("slices", 1e9), UsageError);
    EXPECT_THROW(with("slices", std::nan("")), UsageError);
    const Texels broken = make_field(4, 4, [](int i, int j) { return i == j ? NAN : 0.5f; });
    for (const BakeKindInfo& info : bake_kinds()) {
        const bool bounds = info.kind == BakeKind::max_mip || info.kind == BakeKind::min_max ||
                            info.kind == BakeKind::texel_max || info.kind == BakeKind::rmq ||
                            info.kind == BakeKind::layer_bounds;
        if (bounds) {
            EXPECT_NO_THROW(bake(*broken, info.kind, repeat())) << info.name;
        } else {
            EXPECT_THROW(bake(*broken, info.kind, repeat()), InputError) << info.name;
        }
    }
}

TEST(Bake, RefusesMapsThatAreTooLarge) {
    // 100 layers of 2^24 cells are more than 2^29 floats.
    const Texels wide = make_field(4096, 4096, [](int, int) { return 0.5; });
    EXPECT_THROW(bake(*wide, BakeKind::rmq, repeat()), InputError);
    BakeOptions deep;
    deep.parameters["slices"] = 256;
    EXPECT_THROW(bake(*wide, BakeKind::distance_exact, repeat(), deep), InputError);
}

}  // namespace
}  // namespace quadrel::test

// Traces that are named after a listing give its bits.
#include "effort.hpp"
#include "relief/listing_runs.hpp"

namespace quadrel::test {
namespace {

Listing welsh(bool limited) {
    const auto run = [limited](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::welsh(b.vector2(Value::uv, lane), vertex_eye(b, lane), 0.04f, -0.02f,
                                   limited, undisplaced_level(b, lane));
        });
    };
    return limited ? Listing{"offset-limit@published", run, {}, "offset-limit"}
                   : Listing{"parallax-bias@published", run, {}, "parallax-bias"};
}

Listing unity() {
    const auto run = [](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::unity(b.vector2(Value::uv, lane), tangent_eye(b, lane), 0.02f,
                                   undisplaced_level(b, lane));
        });
    };
    return {"offset-limit-042@published", run, {}, "offset-limit-042"};
}

Listing mcguire(bool constant_xy) {
    const auto run = [constant_xy](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& sampler) {
            const int lane = 4 * quad + i;
            // The listing's y axis runs against v.
            const Vec3 eye = vertex_eye(b, lane) * Vec3(1.0f, -1.0f, 1.0f);
            return listings::mcguire(b.vector2(Value::uv, lane), eye, 5, 0.05f, constant_xy,
                                     sampler);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    return constant_xy ? Listing{"steep-constant-xy@published", run, {}, "steep-constant-xy"}
                       : Listing{"steep@published", run, {}, "steep"};
}

Listing flightgear(float hresolution) {
    const auto run = [hresolution](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& sampler) {
            const int lane = 4 * quad + i;
            return listings::flightgear(b.vector2(Value::uv, lane), -vertex_eye(b, lane), 0.1f,
                                        hresolution, 50, sampler);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    return {"height-outward@published", run, {{"hresolution", hresolution}}, "height-outward"};
}

/// The mip level of the listing, from the four coordinates of the quad.
float dx_sdk_level(Batch<float>& b, int quad, int i) {
    const auto [size, dx, dy] = TexelDerivatives(b, 4 * quad + i);
    const float larger = max(dx.x * dx.x + dy.x * dy.x, dx.y * dx.y + dy.y * dy.y);
    return max(0.5f * log2(larger), 0.0f);
}

Listing dx_sdk() {
    return {"pom-dxsdk",
            [](Batch<float>& b, int quad) {
                return each_fragment(quad, [&](int lane) {
                    const float level = dx_sdk_level(b, quad, lane - 4 * quad);
                    End end = listings::dx_sdk(b.vector2(Value::uv, lane),
                                               -b.vector2(Value::K, lane), b.real(Value::r, lane),
                                               50, 8, level, 3, own_level(b, lane, false));
                    // Without an offset the listing has no depth: the stage says the polygon's.
                    if (!(level <= 3)) end.s = 1 - b.material.seat;
                    return end;
                });
            },
            {},
            "pom"};
}

Listing rabbid(bool relief, float least, float most) {
    const auto run = [=](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& inside, const Sampler& behind) {
            const int lane = 4 * quad + i;
            const Vec3 V = Vec3(0.0f) - b.vector3(Value::P, lane);
            const float frontFace = dot(b.vector3(Value::Ng, lane), V) < 0 ? -1.0f : 1.0f;
            const Vec2 K = b.vector2(Value::K, lane);
            return listings::rabbid(normalize(Vec3(K.x, K.y, -frontFace)),
                                    b.vector2(Value::uv, lane), Vec2(least, most), frontFace,
                                    relief, inside, behind);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    const Parameters quality = {{"quality_normal", least}, {"quality_grazing", most}};
    return relief ? Listing{"rabbid-relief", run, quality, "relief-binary"}
                  : Listing{"rabbid-pom", run, quality, "pom"};
}

Listing rabbid_offset() {
    const auto run = [](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& sampler) {
            const int lane = 4 * quad + i;
            const Vec2 uv = b.vector2(Value::uv, lane);
            listings::ParallaxMain listing;
            listing.u_displacement_scale = b.material.depth;
            listing.main({b.vector3(Value::P, lane), b.vector3(Value::dPdx, lane),
                          b.vector3(Value::dPdy, lane), b.vector3(Value::vertex_normal, lane), uv,
                          b.vector2(Value::dUVdx, lane), b.vector2(Value::dUVdy, lane)});
            return listings::rabbid_offset(listing.texDir3D, uv, sampler);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    return {"offset-limit-rabbid@published", run, {}, "offset-limit"};
}

Listing gpu_gems_3() {
    const auto run = [](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            const Sampler height = own_level(b, lane, true);
            const auto depth = [&](const Vec2& uv) { return 1.0f - height(uv); };
            const Vec2 uv = b.vector2(Value::uv, lane), K = b.vector2(Value::K, lane);
            return listings::gpu_gems_3(uv, Vec3(K.x, K.y, 1.0f), 15, 6, depth);
        });
    };
    return {"relief-gg3", run, {}, "relief-binary", true};
}

/// Level 0 by one filter.
Sampler filtered(Batch<float>& batch, Filter filter) {
    SampledTexture map = *batch.bound(TextureSlot::height);
    map.sampler.mag = map.sampler.min = filter;
    map.sampler.mip = MipFilter::none;
    return [map](const Vec2& uv) {
        return texture_lod(map, SampleContext<Fetch>(), vec2<Fetch>(Fetch(uv.x), Fetch(uv.y)),
                           Fetch(0))
            .x.lane[0];
    };
}

Listing thesis_by_texels() {
    const auto run = [](Batch<float>& b, int quad) {
        const TextureView& view = b.bound(TextureSlot::height)->view;
        return each_fragment(quad, [&](int lane) {
            const Vec2 uv = b.vector2(Value::uv, lane), K = b.vector2(Value::K, lane);
            const float polygon = 1 - b.material.seat;
            const float texels = max(std::fabs(K.x) * static_cast<float>(view.width[0]),
                                     std::fabs(K.y) * static_cast<float>(view.height[0]));
            return listings::thesis_by_texels(
                [&](float s) { return uv + K * (s - polygon); },
                static_cast<int>(clamp(std::ceil(texels), 1.0f, 1024.0f)), 7,
                filtered(b, Filter::nearest), filtered(b, Filter::linear));
        });
    };
    return {"thesis-linear-binary@published", run, {}, "thesis-linear-binary"};
}

std::vector<Listing> all_listings() {
    return {unity(),
            welsh(false),
            welsh(true),
            mcguire(false),
            mcguire(true),
            flightgear(1),
            flightgear(0.7f),
            dx_sdk(),
            rabbid(false, 0.5, 1),
            rabbid(false, 0.05f, 0.3f),
            gpu_gems_3(),
            rabbid_offset(),
            thesis_by_texels(),
            rabbid(true, 2, 1),
            rabbid(true, 0.05f, 0.6f)};
}

TEST(TraceListings, AreReproducedBitForBit) {
    for (const Listing& listing : all_listings()) {
        EXPECT_TRUE(equals_listing(listing, {listing.id}, rounds(40)));
    }
}

TEST(TraceListings, ErrorsAreCaught) {
    for (const Listing& listing : all_listings()) {
        EXPECT_FALSE(equals_listing(listing, {listing.corrected}, 5)) << listing.id;
        for (const Planted planted : {Planted::one_sample_early, Planted::steps_counted_once}) {
            EXPECT_FALSE(equals_listing(listing, flawed(listing.id, planted), 1)) << listing.id;
        }
        EXPECT_TRUE(notices_the_ray(listing));
    }
}

/// Rabbid76's at level 0, in place of texture().
Listing rabbid_at_level_0(bool relief) {
    Listing listing = rabbid(relief, 0.5, 1);
    listing.run = [relief](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            const Vec3 V = Vec3(0.0f) - b.vector3(Value::P, lane);
            const float frontFace = dot(b.vector3(Value::Ng, lane), V) < 0 ? -1.0f : 1.0f;
            const Vec2 K = b.vector2(Value::K, lane);
            const Sampler level_0 = own_level(b, lane, true);
            return listings::rabbid(normalize(Vec3(K.x, K.y, -frontFace)),
                                    b.vector2(Value::uv, lane), Vec2(0.5, 1), frontFace, relief,
                                    level_0, level_0);
        });
    };
    return listing;
}

TEST(TraceListings, RabbidsLookUpsTakeImplicitDerivatives) {
    for (const bool relief : {false, true})
        EXPECT_FALSE(equals_listing(rabbid_at_level_0(relief), {rabbid(relief, 0.5, 1).id}, 10))
            << static_cast<int>(Planted::level_0_look_ups);
}

/// How often fragments of the inputs end early, late, and from behind.
TEST(TraceListings, InputsReachEveryBranch) {
    for (const Listing& listing : all_listings()) {
        std::set<int> statuses, fetches;
        for (int i = 0; i < 20; ++i) {
            Inputs inputs(i);
            inputs.batch.run(listing.id, listing.parameters);
            for (int lane = 0; lane < inputs.batch.lanes; ++lane) {
                statuses.insert(inputs.batch.integer(Value::hit_status, lane));
                fetches.insert(inputs.batch.integer(Value::hit_fetches, lane));
            }
        }
        EXPECT_TRUE(statuses.contains(static_cast<int>(Status::hit))) << listing.id;
        const bool offset = listing.id.starts_with("offset") || listing.id.starts_with("parallax");
        const bool leaves_early = !offset && listing.id != "relief-gg3";
        EXPECT_EQ(fetches.size() > 5, leaves_early) << listing.id;
    }
}

}  // namespace
}  // namespace quadrel::test

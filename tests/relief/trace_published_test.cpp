// Traces that are named after a listing give its bits.
#include <set>

#include "relief/surface_rays.hpp"
#include "relief/trace_listings.hpp"

namespace quadrel::test {
namespace {

using listings::End;
using listings::Sampler;
using Vec2 = listings::Vec2;
using Vec3 = listings::Vec3;

// ---- What a listing's fragment reads ------------------------------------------------------------

/// One fragment's look-ups at a level that its neighbours have no say in.
Sampler own_level(Batch<float>& batch, int lane, bool level_0) {
    const SampledTexture& map = *batch.bound(TextureSlot::height);
    const auto spread = [](const Vec2& v) { return vec2<Fetch>(Fetch(v.x), Fetch(v.y)); };
    const LodRecord<Fetch> lod = level_0
                                     ? lod_from_level(map, Fetch(0))
                                     : compute_lod(map, spread(batch.vector2(Value::dUVdx, lane)),
                                                   spread(batch.vector2(Value::dUVdy, lane)));
    const GeneralHeight<Fetch> height(map, lod);
    return [=](const Vec2& uv) { return height({}, spread(uv)).lane[0]; };
}

/// Four fragments in lockstep, as a quad of a GPU runs them: the n-th look-up of each takes its
/// gradients from the n-th of all four, and a fragment that makes no more keeps its last
/// coordinate. Fragments are plain functions; they are started anew for every look-up of the quad,
/// with the results so far, and stopped at the next.
class Lockstep {
  public:
    using Fragment = std::function<End(int lane, const Sampler&)>;

    Lockstep(const SampledTexture& map, Fragment fragment) : map_(map), fragment_(fragment) {}

    std::array<End, 4> run() {
        while (!advance()) {
        }
        return ends_;
    }

  private:
    struct NextLookUp {};

    /// Runs all four up to the first look-up without a result, and makes it; true if none is left.
    bool advance() {
        bool finished = true;
        for (int lane = 0; lane < 4; ++lane) finished = finishes(lane) && finished;
        if (finished) return true;
        vec2<Fetch> at;
        for (int c = 0; c < 2; ++c)
            for (int lane = 0; lane < 4; ++lane) at[c].lane[lane] = at_[lane][c];
        results_.push_back(texture(map_, SampleContext<Fetch>(), at).x);
        return false;
    }
    bool finishes(int lane) {
        std::size_t made = 0;
        try {
            ends_[lane] = fragment_(lane, [&](const Vec2& uv) {
                at_[lane] = uv;
                if (made == results_.size()) throw NextLookUp();
                return results_[made++].lane[lane];
            });
            return true;
        } catch (const NextLookUp&) {
            return false;
        }
    }

    const SampledTexture& map_;
    Fragment fragment_;
    std::vector<Fetch> results_;
    std::array<Vec2, 4> at_;
    std::array<End, 4> ends_;
};

Vec3 tangent_eye(Batch<float>& batch, int lane) {
    const Vec3 eye = Vec3(0.0f) - batch.vector3(Value::P, lane);
    return {dot(eye, batch.vector3(Value::T, lane)), dot(eye, batch.vector3(Value::B, lane)),
            dot(eye, batch.vector3(Value::frame_normal, lane))};
}

// ---- The listings over a batch ------------------------------------------------------------------

/// A listing: its stage, and its four ends for a quad of the batch.
struct Listing {
    std::string id;
    std::function<std::array<End, 4>(Batch<float>&, int quad)> run;
    Parameters parameters{};
    std::string corrected{};  ///< a stage that this one must not be taken for
};

std::array<End, 4> each_fragment(int quad, const std::function<End(int lane)>& fragment) {
    std::array<End, 4> ends;
    for (int i = 0; i < 4; ++i) ends[i] = fragment(4 * quad + i);
    return ends;
}

Listing welsh(bool limited) {
    const auto run = [limited](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::welsh(b.vector2(Value::uv, lane), tangent_eye(b, lane), 0.04f, -0.02f,
                                   limited, own_level(b, lane, false));
        });
    };
    return limited ? Listing{"offset-limit@published", run, {}, "offset-limit"}
                   : Listing{"parallax-bias@published", run, {}, "parallax-bias"};
}

Listing unity() {
    const auto run = [](Batch<float>& b, int quad) {
        return each_fragment(quad, [&](int lane) {
            return listings::unity(b.vector2(Value::uv, lane), tangent_eye(b, lane), 0.02f,
                                   own_level(b, lane, false));
        });
    };
    return {"offset-limit-042@published", run, {}, "offset-limit-042"};
}

Listing mcguire(bool constant_xy) {
    const auto run = [constant_xy](Batch<float>& b, int quad) {
        const auto fragment = [&](int i, const Sampler& sampler) {
            const int lane = 4 * quad + i;
            // The listing's y axis runs against v.
            const Vec3 eye = tangent_eye(b, lane) * Vec3(1.0f, -1.0f, 1.0f);
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
            return listings::flightgear(b.vector2(Value::uv, lane), -tangent_eye(b, lane), 0.1f,
                                        hresolution, 50, sampler);
        };
        return Lockstep(*b.bound(TextureSlot::height), fragment).run();
    };
    return {"height-outward@published", run, {{"hresolution", hresolution}}, "height-outward"};
}

/// The mip level of the listing, from the four coordinates of the quad.
float dx_sdk_level(Batch<float>& b, int quad, int i) {
    const TextureView& view = b.bound(TextureSlot::height)->view;
    const auto texels = [&](int k) {
        const Vec2 uv = b.vector2(Value::uv, 4 * quad + k);
        return Vec2(uv.x * static_cast<float>(view.width[0]),
                    uv.y * static_cast<float>(view.height[0]));
    };
    const Vec2 dx = texels(i | 1) - texels(i & 2), dy = texels(i | 2) - texels(i & 1);
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
        return each_fragment(quad, [&](int lane) {
            const Vec3 V = Vec3(0.0f) - b.vector3(Value::P, lane);
            const float frontFace = dot(b.vector3(Value::Ng, lane), V) < 0 ? -1.0f : 1.0f;
            const Vec2 K = b.vector2(Value::K, lane);
            return listings::rabbid(normalize(Vec3(K.x, K.y, -frontFace)),
                                    b.vector2(Value::uv, lane), Vec2(least, most), frontFace,
                                    relief, own_level(b, lane, true));
        });
    };
    const Parameters quality = {{"quality_normal", least}, {"quality_grazing", most}};
    return relief ? Listing{"rabbid-relief", run, quality, "relief-binary"}
                  : Listing{"rabbid-pom", run, quality, "pom"};
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
    return {"relief-gg3", run, {}, "relief-binary"};
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
            thesis_by_texels(),
            rabbid(true, 2, 1),
            rabbid(true, 0.05f, 0.6f)};
}

// ---- The check ----------------------------------------------------------------------------------

bool same(float a, float b) {
    return a != a ? b != b : std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

testing::AssertionResult lane_equals(const Listing& listing, Batch<float>& b, int lane,
                                     const End& end) {
    const Vec2 uv = b.vector2(Value::hit_uv, lane);
    const bool equal = same(uv.x, end.uv.x) && same(uv.y, end.uv.y) &&
                       same(b.real(Value::hit_s, lane), end.s) &&
                       b.integer(Value::hit_fetches, lane) == end.fetches &&
                       b.integer(Value::hit_steps, lane) == end.fetches;
    const float map = end.map, h = b.real(Value::hit_h, lane);
    // The map of relief-gg3 holds 1 - h.
    const bool same_map = listing.id == "relief-gg3" ? same(map, 1.0f - h) : same(map, h);
    if (equal && (end.fetches == 0 || same_map)) {
        return testing::AssertionSuccess();
    }
    return testing::AssertionFailure()
           << listing.id << ", lane " << lane << ": uv " << uv.x << " " << uv.y << " for "
           << end.uv.x << " " << end.uv.y << ", s " << b.real(Value::hit_s, lane) << " for "
           << end.s << ", fetches " << b.integer(Value::hit_fetches, lane) << " for " << end.fetches
           << ", h " << h << " for " << map;
}

/// Any map and sampler, footprints from a part of a texel to many, angles up to 84 degrees.
struct Inputs {
    Random random;
    Map map;
    Batch<float> batch;

    explicit Inputs(int seed)
        : random(static_cast<std::uint64_t>(seed)), map(random_map(random, 1)), batch(64) {
        fill_surface(batch, random, {0.1, random.uniform(0.01, 0.4), 1, 0.0005, 0.4, true});
        batch.material.seat = random.chance(0.5) ? 1.0f : static_cast<float>(random.uniform(0, 1));
        batch.bind(TextureSlot::height, map.sampled);
    }
};

testing::AssertionResult equals_listing(const Listing& listing, const StageUnderTest<float>& stage,
                                        int batches) {
    for (int i = 0; i < batches; ++i) {
        Inputs inputs(i);
        Batch<float>& batch = inputs.batch;
        stage.run(batch, stage.id == listing.id ? listing.parameters : Parameters());
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            const std::array<End, 4> ends = listing.run(batch, quad);
            for (int k = 0; k < 4; ++k) {
                const auto result = lane_equals(listing, batch, 4 * quad + k, ends[k]);
                if (!result) return testing::AssertionFailure() << result.message() << ", " << i;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(TraceListings, AreReproducedBitForBit) {
    for (const Listing& listing : all_listings()) {
        EXPECT_TRUE(equals_listing(listing, {listing.id}, 40));
    }
}

/// The stage with an error: before it, the ray a ten-thousandth off in one quad; behind it, the
/// result of one lane.
StageUnderTest<float> flawed(const std::string& id, Planted planted) {
    const auto before = [planted](Batch<float>& b) {
        if (planted != Planted::ray_nudged) return;
        for (int lane = 8; lane < 12; ++lane) {
            for (const Value v : {Value::K, Value::T, Value::B}) {
                for (int c = 0; c < 2; ++c) b.real(v, lane, c) *= 1.0001f;
            }
        }
    };
    const auto after = [planted](Batch<float>& b) {
        if (planted == Planted::one_sample_early) b.real(Value::hit_s, 21) -= 1.0f / 128;
        if (planted == Planted::steps_counted_once) b.integer(Value::hit_steps, 5) += 1;
    };
    return {id, before, after};
}

/// The same stage over inputs that the listing did not get.
testing::AssertionResult notices_the_ray(const Listing& listing) {
    for (int i = 0; i < 10; ++i) {
        Inputs inputs(i);
        Batch<float> moved = inputs.batch;
        flawed(listing.id, Planted::ray_nudged).run(moved, listing.parameters);
        for (int k = 0; k < 4; ++k) {
            const End end = listing.run(inputs.batch, 2)[k];
            if (!lane_equals(listing, moved, 8 + k, end)) return testing::AssertionSuccess();
        }
    }
    return testing::AssertionFailure() << listing.id;
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

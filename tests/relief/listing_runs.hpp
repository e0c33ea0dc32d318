// Published listings over batches: what a fragment of a listing reads, and the check that a stage
// gives its bits.
#pragma once

#include <set>

#include "quadrel/raster/interpolation.hpp"
#include "relief/frame/frame_listings.hpp"
#include "relief/surface_rays.hpp"
#include "relief/trace/trace_listings.hpp"

namespace quadrel::test {

using listings::End;
using listings::Sampler;
using Vec2 = listings::Vec2;
using Vec3 = listings::Vec3;

// ---- What a listing's fragment reads ------------------------------------------------------------

/// One fragment's look-ups at a level that its neighbours have no say in.
inline Sampler own_level(Batch<float>& batch, int lane, bool level_0) {
    const SampledTexture& map = *batch.bound(TextureSlot::height);
    const auto spread = [](const Vec2& v) { return vec2<Fetch>(Fetch(v.x), Fetch(v.y)); };
    const LodRecord<Fetch> lod = level_0
                                     ? lod_from_level(map, Fetch(0))
                                     : compute_lod(map, spread(batch.vector2(Value::dUVdx, lane)),
                                                   spread(batch.vector2(Value::dUVdy, lane)));
    const GeneralHeight<Fetch> height(map, lod);
    return [=](const Vec2& uv) { return height({}, spread(uv)).lane[0]; };
}

/// Look-ups of the level that a quad's undisplaced coordinates have by their fine differences:
/// texture() there, or what is handed ddx_fine and ddy_fine of them.
inline Sampler undisplaced_level(Batch<float>& batch, int lane) {
    const SampledTexture& map = *batch.bound(TextureSlot::height);
    const int first = lane / 4 * 4, i = lane % 4;
    const auto difference = [&](int to, int from) {
        const Vec2 d =
            batch.vector2(Value::uv, first + to) - batch.vector2(Value::uv, first + from);
        return vec2<Fetch>(Fetch(d.x), Fetch(d.y));
    };
    const GeneralHeight<Fetch> height(
        map, compute_lod(map, difference(i | 1, i & 2), difference(i | 2, i & 1)));
    return
        [=](const Vec2& uv) { return height({}, vec2<Fetch>(Fetch(uv.x), Fetch(uv.y))).lane[0]; };
}

/// Look-ups of a level of detail.
inline Sampler of_level(Batch<float>& batch, float level) {
    const SampledTexture& map = *batch.bound(TextureSlot::height);
    const GeneralHeight<Fetch> height(map, lod_from_level(map, Fetch(level)));
    return
        [=](const Vec2& uv) { return height({}, vec2<Fetch>(Fetch(uv.x), Fetch(uv.y))).lane[0]; };
}

/// Derivatives of the coordinate in texels of level 0: differences to the neighbours in the quad.
struct TexelDerivatives {
    Vec2 size, dx, dy;

    TexelDerivatives(Batch<float>& b, int lane) {
        const TextureView& view = b.bound(TextureSlot::height)->view;
        size = {static_cast<float>(view.width[0]), static_cast<float>(view.height[0])};
        const int first = lane / 4 * 4, i = lane % 4;
        const auto texels = [&](int k) { return b.vector2(Value::uv, first + k) * size; };
        dx = texels(i | 1) - texels(i & 2);
        dy = texels(i | 2) - texels(i & 1);
    }
};

/// Four fragments in lockstep, as a quad of a GPU runs them: the n-th look-up of each takes its
/// gradients from the n-th of all four, and a fragment that makes no more keeps its last
/// coordinate. Fragments are plain functions; they are started anew for every look-up of the quad,
/// with the results so far, and stopped at the next.
class Lockstep {
  public:
    using Fragment = std::function<End(int lane, const Sampler&)>;
    /// With a loop, and look-ups behind it: those wait until all four have left the loop.
    using Loop = std::function<End(int lane, const Sampler& inside, const Sampler& behind)>;

    Lockstep(const SampledTexture& map, Loop fragment) : map_(map), fragment_(fragment) {}
    Lockstep(const SampledTexture& map, Fragment fragment)
        : Lockstep(map, Loop([fragment](int lane, const Sampler& all, const Sampler&) {
                       return fragment(lane, all);
                   })) {}

    std::array<End, 4> run() {
        while (!advance()) {
        }
        return ends_;
    }

  private:
    struct NextLookUp {
        int part;
    };
    /// The look-ups of the loop, and those behind it.
    struct Part {
        std::vector<Fetch> results;
        std::array<Vec2, 4> at;
    };
    static constexpr int finished = 2;

    /// Runs all four up to the first look-up without a result, and makes it; true if none is left.
    bool advance() {
        int part = finished;
        for (int lane = 0; lane < 4; ++lane) part = std::min(run_on(lane), part);
        if (part == finished) return true;
        vec2<Fetch> at;
        for (int c = 0; c < 2; ++c)
            for (int lane = 0; lane < 4; ++lane) at[c].lane[lane] = parts_[part].at[lane][c];
        parts_[part].results.push_back(texture(map_, SampleContext<Fetch>(), at).x);
        return false;
    }
    /// The part of the fragment's next look-up, or `finished`.
    int run_on(int lane) {
        std::array<std::size_t, 2> made{};
        const auto sampler = [&](int part) {
            return [this, &made, lane, part](const Vec2& uv) {
                Part& of = parts_[part];
                of.at[lane] = uv;
                if (made[part] == of.results.size()) throw NextLookUp{part};
                return of.results[made[part]++].lane[lane];
            };
        };
        try {
            ends_[lane] = fragment_(lane, sampler(0), sampler(1));
            return finished;
        } catch (const NextLookUp& next) {
            return next.part;
        }
    }

    const SampledTexture& map_;
    Loop fragment_;
    std::array<Part, 2> parts_;
    std::array<End, 4> ends_;
};

/// The output of a vertex program, interpolated to a lane.
inline Vec3 interpolated(const Batch<float>& batch, int lane,
                         const std::function<Vec3(const PrimitiveVertices&, int vertex)>& program) {
    const auto primitive = static_cast<std::size_t>(batch.primitive[lane]);
    const PrimitiveVertices& row = batch.vertices[primitive];
    const auto& w = batch.primitives[primitive].w;
    const auto edge = [&](int i) { return batch.edges[i][lane]; };
    const auto b = perspective_barycentrics(EdgeValues<float>{edge(0), edge(1), edge(2)},
                                            PerVertex<float>{w[0], w[1], w[2]});
    return interpolate(b, PerVertex<Vec3>{program(row, 0), program(row, 1), program(row, 2)});
}

inline Vec3 as_vector(const float (&v)[3]) { return {v[0], v[1], v[2]}; }

/// fragment.texcoord[3] of Welsh, _tsE of McGuire but for the sign of y.
inline Vec3 vertex_eye(const Batch<float>& batch, int lane) {
    return interpolated(batch, lane, [](const PrimitiveVertices& row, int v) {
        listings::WelshVertex vertex;
        vertex.eye = {0, 0, 0};
        vertex.tangent = as_vector(row.tangent[v]);
        vertex.binormal = as_vector(row.binormal[v]);
        vertex.normal = as_vector(row.normal[v]);
        vertex.position = as_vector(row.position[v]);
        vertex.main();
        return vertex.texcoord3;
    });
}

inline Vec3 tangent_eye(Batch<float>& batch, int lane) {
    const Vec3 eye = Vec3(0.0f) - batch.vector3(Value::P, lane);
    return {dot(eye, batch.vector3(Value::T, lane)), dot(eye, batch.vector3(Value::B, lane)),
            dot(eye, batch.vector3(Value::frame_normal, lane))};
}

/// The unit vector to the viewer in tangent space.
inline Vec3 tangent_view(Batch<float>& batch, int lane) {
    const Vec3 view = normalize(Vec3(0.0f) - batch.vector3(Value::P, lane));
    return {dot(view, batch.vector3(Value::T, lane)), dot(view, batch.vector3(Value::B, lane)),
            dot(view, batch.vector3(Value::frame_normal, lane))};
}

// ---- The listings over a batch ------------------------------------------------------------------

/// A listing: its stage, and its four ends for a quad of the batch.
struct Listing {
    std::string id;
    std::function<std::array<End, 4>(Batch<float>&, int quad)> run;
    Parameters parameters{};
    std::string corrected{};  ///< a stage that this one must not be taken for
    bool maps_depth = false;  ///< its map holds 1 - h
};

inline std::array<End, 4> each_fragment(int quad, const std::function<End(int lane)>& fragment) {
    std::array<End, 4> ends;
    for (int i = 0; i < 4; ++i) ends[i] = fragment(4 * quad + i);
    return ends;
}

// ---- The check ----------------------------------------------------------------------------------

inline bool same(float a, float b) {
    return a != a ? b != b : std::bit_cast<std::uint32_t>(a) == std::bit_cast<std::uint32_t>(b);
}

inline testing::AssertionResult lane_equals(const Listing& listing, Batch<float>& b, int lane,
                                            const End& end) {
    const Vec2 uv = b.vector2(Value::hit_uv, lane);
    const bool equal = same(uv.x, end.uv.x) && same(uv.y, end.uv.y) &&
                       same(b.real(Value::hit_s, lane), end.s) &&
                       b.integer(Value::hit_fetches, lane) == end.fetches &&
                       b.integer(Value::hit_steps, lane) == end.fetches;
    const float map = end.map, h = b.real(Value::hit_h, lane);
    const bool same_map = listing.maps_depth ? same(map, 1.0f - h) : same(map, h);
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
        Random bends(static_cast<std::uint64_t>(seed) + 1000);
        bend_vertices(batch, bends);
    }
};

inline testing::AssertionResult equals_listing(const Listing& listing,
                                               const StageUnderTest<float>& stage, int batches) {
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

/// The stage with an error: before it, the ray a ten-thousandth off in one quad; behind it, the
/// result of one lane.
inline StageUnderTest<float> flawed(const std::string& id, Planted planted) {
    const auto before = [planted](Batch<float>& b) {
        if (planted != Planted::ray_nudged) return;
        for (int lane = 8; lane < 12; ++lane) {
            for (const Value v : {Value::K, Value::T, Value::B, Value::J, Value::dPdx}) {
                for (int c = 0; c < 2; ++c) b.real(v, lane, c) *= 1.0001f;
            }
        }
        for (auto& tangent : b.vertices[2].tangent)
            for (float& x : tangent) x *= 1.0001f;
        for (auto& position : b.vertices[2].position)
            for (int c = 0; c < 2; ++c) position[c] *= 1.0001f;
    };
    const auto after = [planted](Batch<float>& b) {
        if (planted == Planted::one_sample_early) b.real(Value::hit_s, 21) -= 1.0f / 128;
        if (planted == Planted::steps_counted_once) b.integer(Value::hit_steps, 5) += 1;
    };
    return {id, before, after};
}

/// The same stage over inputs that the listing did not get.
inline testing::AssertionResult notices_the_ray(const Listing& listing) {
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

}  // namespace quadrel::test

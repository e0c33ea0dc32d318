// What true-impostor@published stores is what the program on the disc of GPU Gems 3 computes.
#include "quadrel/num/quad.hpp"
#include "quadrel/relief/trace/layer/true_impostor_published.hpp"
#include "relief/layer/impostor_views.hpp"
#include "relief/tangent_listings.hpp"

namespace quadrel::test::impostor {
namespace {

using tangent::Float;
using tangent::Vec2;
using tangent::Vec3;
using tangent::Vec4;

/// What the program takes for granted, where a frame's vectors are else.
struct TellsProgram : StageDefaults {
    static constexpr StageText text{"tells-program", "trace", "what the program is given", "none"};
    static constexpr auto inputs = impostor_ray_inputs;
    static constexpr auto outputs = values(Value::T, Value::B, Value::r, Value::uv_rate, Value::K);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const ImpostorRay<F> ray = impostor_ray(io);
        const ImpostorProgram<F> program = impostor_program(io, ray);
        io.template store<Value::T>(program.view_origin);
        io.template store<Value::B>(program.view);
        io.template store<Value::r>(program.hscale);
        io.template store<Value::uv_rate>(vec2<F>(ray.part.from, ray.volume.tile));
        io.template store<Value::K>(vec2<F>(select(ray.active, F(1), F(0)), F(0)));
    }
};

/// Errors planted in the listing.
struct ListingFlaws {
    bool one_step_more = false, other_way = false, not_centred = false, halved_late = false;
};

/// Its two loops. Above each line of code stands the line that it transcribes.
struct Disc {
    const SampledTexture& heightSampler;
    Vec3 viewOrigin, viewVec;
    Float hscale;
    int linear_search_steps;
    Float depth_step;
    ListingFlaws flaws{};
    Float dis = Float(0.0f);
    Mask<Float> collided = Mask<Float>(false);
    int fetches = 0;

    Float product() {
        // depth = input.viewOrigin.z + dis*viewVec.z;
        const Float depth = viewOrigin.z + dis * viewVec.z;
        // tex_coords = (dis)*float2(-viewVec.x, -viewVec.y);
        Vec2 tex_coords(dis * -viewVec.x, dis * -viewVec.y);
        if (flaws.other_way) tex_coords = -tex_coords;
        // tex_coords += float2(viewOrigin.x, viewOrigin.y);
        tex_coords = tex_coords + Vec2(viewOrigin.x, viewOrigin.y);
        // pixelColor = tex2D(heightSampler, tex_coords)*hscale+(1 - hscale)/2.0f-0.5;
        Vec4 pixelColor = quadrel::texture(heightSampler, SampleContext<Float>(), tex_coords);
        ++fetches;
        const Float middle = flaws.not_centred ? Float(0.0f) : Float(1.0f) - hscale;
        for (int c = 0; c < 4; ++c)
            pixelColor[c] = pixelColor[c] * hscale + middle / Float(2.0f) - Float(0.5f);
        // pixelColor.rgba = (depth) - (pixelColor.rgba);
        for (int c = 0; c < 4; ++c) pixelColor[c] = depth - pixelColor[c];
        // (pixelColor.r*pixelColor.g*pixelColor.b*pixelColor.a)
        return pixelColor[0] * pixelColor[1] * pixelColor[2] * pixelColor[3];
    }
    Mask<Float> is_free() {
        // if(... > 0) //no collision
        const Mask<Float> free = product() > Float(0.0f);
        collided = collided | !free;
        return free;
    }

    void run() {
        // for(int i=1; i<linear_search_steps; i++ )
        for (int i = flaws.one_step_more ? 0 : 1; i < linear_search_steps; i++) {
            // dis+=depth_step;
            dis = select(is_free(), dis + depth_step, dis);
        }
        // for(int i = 1; (i < 8); i++)
        for (int i = 1; i < 8; i++) {
            const Mask<Float> free = is_free();
            // depth_step*=0.5f;
            const Float whole = depth_step;
            depth_step = depth_step * Float(0.5f);
            // dis+=depth_step; } else { dis-=depth_step; }
            const Float by = flaws.halved_late ? whole : depth_step;
            dis = select(free, dis + by, dis - by);
        }
    }
};

/// Smooth solids with mip levels: look-ups are by the differences of coordinates.
const Map& smooth_layers() {
    static const Map map = [] {
        SamplerState sampler = plain_sampler();
        sampler.mip = MipFilter::linear;
        return make_map(
            64, 64, 4,
            [](int i, int j, int c) {
                const auto wave = [](int k) { return std::abs(static_cast<float>(k - 32)) / 32; };
                return 0.1f + 0.2f * static_cast<float>(c) + 0.1f * wave(i) - 0.08f * wave(j);
            },
            sampler);
    }();
    return map;
}

/// Way, status and look-ups of every fragment are the listing's.
testing::AssertionResult equals_the_listing(const Map& layers, int steps, float step,
                                            const ListingFlaws& flaws = {},
                                            const char* id = "true-impostor@published") {
    Random random(77);
    int hits = 0, misses = 0;
    for (int n = 0; n < 8; ++n) {
        const View view(random);
        Batch<float> batch(64);
        batch.own_depth = true;
        batch.bind(TextureSlot::layers, layers.sampled);
        for (int lane = 0; lane < batch.lanes; ++lane) fill_lane(batch, lane, view, random);
        batch.run("frame-impostor");
        Batch<float> told = batch;
        const NoParams none;
        told.run(&run_stage<TellsProgram, Float>, &none);
        Parameters parameters{{"steps", steps}};
        if (std::string(id) == "true-impostor@published") parameters["step"] = step;
        batch.run(id, parameters);
        for (int quad = 0; quad < batch.lanes / 4; ++quad) {
            Disc disc{layers.sampled,
                      tangent::lanes3(told, Value::T, quad),
                      tangent::lanes3(told, Value::B, quad),
                      tangent::lanes(told, Value::r, quad),
                      steps,
                      Float(step),
                      flaws};
            disc.run();
            const Float from = tangent::lanes(told, Value::uv_rate, quad, 0);
            const Float tile_length = tangent::lanes(told, Value::uv_rate, quad, 1);
            const Float way = select(disc.collided, from + disc.dis * tile_length, Float(0.0f));
            const Float met = select(disc.collided, Float(1.0f), Float(0.0f));
            for (std::size_t i = 0; i < 4; ++i) {
                const int lane = 4 * quad + static_cast<int>(i);
                if (told.real(Value::K, lane) == 0) continue;
                const bool hit = met.lane[i] == 1;
                ++(hit ? hits : misses);
                const Status status = hit ? Status::hit : Status::clip;
                if (std::bit_cast<std::uint32_t>(batch.real(Value::hit_depth, lane)) !=
                        std::bit_cast<std::uint32_t>(way.lane[i]) ||
                    batch.integer(Value::hit_status, lane) != static_cast<int>(status) ||
                    batch.integer(Value::hit_fetches, lane) != disc.fetches)
                    return testing::AssertionFailure()
                           << id << ", view " << n << ", lane " << lane << ": "
                           << batch.real(Value::hit_depth, lane) << " for " << way.lane[i];
            }
        }
    }
    if (hits < 40 || misses < 20)
        return testing::AssertionFailure() << hits << " hits, " << misses << " misses";
    return testing::AssertionSuccess();
}

TEST(ImpostorPublished, TheSearchIsTheListing) {
    const Map& balls_of_both = maps().both;
    EXPECT_TRUE(equals_the_listing(balls_of_both, 128, 0.015625f));
    EXPECT_TRUE(equals_the_listing(balls_of_both, 40, 0.07f));
    EXPECT_TRUE(equals_the_listing(smooth_layers(), 24, 0.02f));
    EXPECT_FALSE(equals_the_listing(balls_of_both, 128, 0.015625f, {}, "true-impostor"));
    EXPECT_FALSE(equals_the_listing(balls_of_both, 40, 0.07f, {.one_step_more = true}));
    EXPECT_FALSE(equals_the_listing(balls_of_both, 40, 0.07f, {.other_way = true}));
    EXPECT_FALSE(equals_the_listing(balls_of_both, 40, 0.07f, {.not_centred = true}));
    EXPECT_FALSE(equals_the_listing(balls_of_both, 40, 0.07f, {.halved_late = true}));
}

}  // namespace
}  // namespace quadrel::test::impostor

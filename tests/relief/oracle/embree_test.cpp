// The surface of two triangles a cell against Embree, which traces the same triangles in float.
#include <embree3/rtcore.h>

#include <optional>

#include "relief/oracle/judged.hpp"
#include "relief/planted.hpp"

namespace quadrel::test {
namespace {

using judge::Surface;

constexpr int side = 512;

/// Triangles between texel centres of a map that ends at its edges; positions are dual cells.
class EmbreeField {
  public:
    explicit EmbreeField(const oracle::Field& field)
        : device_(rtcNewDevice("threads=1")), scene_(rtcNewScene(device_)) {
        RTCGeometry geometry = rtcNewGeometry(device_, RTC_GEOMETRY_TYPE_TRIANGLE);
        auto* vertex = static_cast<float*>(
            rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                    3 * sizeof(float), std::size_t(side) * side));
        for (int y = 0; y < side; ++y)
            for (int x = 0; x < side; ++x)
                for (const oracle::Real c : {oracle::Real(x), oracle::Real(y), field.texel(x, y)})
                    *vertex++ = static_cast<float>(c);
        auto* index = static_cast<unsigned*>(rtcSetNewGeometryBuffer(
            geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(unsigned),
            std::size_t(2) * (side - 1) * (side - 1)));
        for (unsigned y = 0; y + 1 < side; ++y)
            for (unsigned x = 0; x + 1 < side; ++x) {
                const unsigned a = y * side + x, b = a + 1, c = a + side, d = c + 1;
                for (const unsigned i : {a, b, d, a, d, c}) *index++ = i;
            }
        rtcCommitGeometry(geometry);
        rtcAttachGeometry(scene_, geometry);
        rtcReleaseGeometry(geometry);
        rtcSetSceneFlags(scene_, RTC_SCENE_FLAG_ROBUST);
        rtcCommitScene(scene_);
    }
    ~EmbreeField() {
        rtcReleaseScene(scene_);
        rtcReleaseDevice(device_);
    }
    EmbreeField(const EmbreeField&) = delete;

    struct Met {
        double s;
        long cell_x, cell_y;
        bool lower;  ///< the triangle below the edge, with corner (1, 0)
    };
    /// The ray from (x, y, 1) along (dx, dy, -1).
    std::optional<Met> trace(float x, float y, float dx, float dy) const {
        RTCRayHit ray{};
        ray.ray.org_x = x;
        ray.ray.org_y = y;
        ray.ray.org_z = 1;
        ray.ray.dir_x = dx;
        ray.ray.dir_y = dy;
        ray.ray.dir_z = -1;
        ray.ray.tfar = 1;
        ray.ray.mask = ~0u;
        ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
        RTCIntersectContext context;
        rtcInitIntersectContext(&context);
        rtcIntersect1(scene_, &context, &ray);
        if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
        const long cell = ray.hit.primID / 2;
        return Met{ray.ray.tfar, cell % (side - 1), cell / (side - 1), ray.hit.primID % 2 == 0};
    }

  private:
    RTCDevice device_;
    RTCScene scene_;
};

/// What is made of the rays.
struct Tally {
    int same = 0;       ///< the same triangle
    int near = 0;       ///< another one, its s as near as float can tell
    int explained = 0;  ///< a hit of the field moved by what float rounds
    int wrong = 0;
};

/// `late`: an error planted in the judge's s.
Tally compare_with_embree(int rays, double late, bool beside = false) {
    Random random(17);
    const JudgedMap map(height_map(
        side, side,
        [&](int x, int y) { return fractal_height(x, y, side) * 0.9f + 0.1f * random.below(2); },
        Wrap::clamp_to_edge));
    const oracle::Field field(map.height.sampled);
    const EmbreeField embree(field);
    Tally tally;
    for (int k = 0; k < rays; ++k) {
        const double theta = random.uniform(0, 89) * 0.017453292519943295;
        const double shift = std::min(0.05 * side * tan(theta), 0.45 * side);
        const double azimuth = random.uniform(0, 6.283185307179586);
        const auto dx = static_cast<float>(shift * cos(azimuth));
        const auto dy = static_cast<float>(shift * sin(azimuth));
        const auto x = static_cast<float>(random.uniform(0.46, 0.54) * side);
        const auto y = static_cast<float>(random.uniform(0.46, 0.54) * side);
        const judge::Ray ray{(double(x) + 0.5) / side, (double(y) + 0.5) / side, double(dx) / side,
                             double(dy) / side, 0};
        const judge::Hit hit = judge::first_hit(map.field(Surface::tri_main), ray);
        const auto met = embree.trace(x, y, dx, dy);
        const double s = hit.s + late, other = met ? met->s : 1;
        const bool lower = hit.place_y <= hit.place_x;
        const double cell_x = hit.cell_x + beside;
        // Positions are rounded to float: of coordinates up to `side`, and so are heights in
        // proportion to the slope, at most 1 per cell, and s by the condition.
        const double error = 0x1p-22 * side;
        if (met && std::fabs(s - other) <= error * (1 + hit.condition) &&
            met->cell_x == long(cell_x) && met->cell_y == long(hit.cell_y) && met->lower == lower) {
            ++tally.same;
        } else if (std::fabs(s - other) <= error * (1 + hit.condition)) {
            ++tally.near;
        } else {
            const auto meet = [&](double lift) {
                return oracle::meet_triangles(field, long_ray(ray), oracle::Diagonal::main, lift).s;
            };
            const bool between = other >= meet(error) - error && other <= meet(-error) + error &&
                                 s >= meet(error) - error && s <= meet(-error) + error;
            ++(between ? tally.explained : tally.wrong);
        }
    }
    return tally;
}

int rays_to_trace() {
    const char* const rays = std::getenv("QUADREL_EMBREE_RAYS");
    return rays ? std::atoi(rays) : 4000;
}

TEST(Embree, MeetsTheSameTriangles) {
    const int rays = rays_to_trace();
    const Tally tally = compare_with_embree(rays, 0);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_LE(tally.explained, rays / 200);
    EXPECT_GE(tally.same, rays * 99 / 100) << tally.near << " near, " << tally.explained;
    RecordProperty("same", tally.same);
    RecordProperty("near", tally.near);
    RecordProperty("explained", tally.explained);
}

TEST(Embree, ErrorsAreNoticed) {
    EXPECT_GT(compare_with_embree(400, 0.01).wrong, 100);
    EXPECT_LT(compare_with_embree(400, 0, true).same, 10) << static_cast<int>(Planted::cell_beside);
}

}  // namespace
}  // namespace quadrel::test

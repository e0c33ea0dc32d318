#include "embree/geometry.hpp"

#include <fmt/format.h>

#include <cmath>
#include <glm/common.hpp>
#include <stdexcept>

#include "measure.hpp"

namespace quadrel::peers {
namespace {

/// Vertices of the part: columns and rows of texels, from `first` on.
struct Lattice {
    glm::ivec2 first, count;
};

Lattice lattice_of(const Part& part, int side) {
    const glm::ivec2 low(floor(part.low * double(side) - 0.5)),
        high(ceil(part.high * double(side) - 0.5));
    return {low - 1, high - low + 3};
}

int wrapped(int i, int side) { return ((i % side) + side) % side; }

void fill_vertices(RTCGeometry geometry, const Texture& heights, const Lattice& lattice,
                   double depth) {
    const int side = heights.view().width[0];
    const auto count =
        static_cast<std::size_t>(lattice.count.x) * static_cast<std::size_t>(lattice.count.y);
    auto* vertex = static_cast<float*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), count));
    const float* const texels = heights.level_texels(0, 0);
    for (int y = 0; y < lattice.count.y; ++y)
        for (int x = 0; x < lattice.count.x; ++x) {
            const glm::ivec2 at = lattice.first + glm::ivec2(x, y);
            const float h = texels[wrapped(at.y, side) * side + wrapped(at.x, side)];
            *vertex++ = static_cast<float>((at.x + 0.5) / side);
            *vertex++ = static_cast<float>((at.y + 0.5) / side);
            *vertex++ = static_cast<float>((double(h) - 1) * depth);
        }
}

void fill_grid(RTCGeometry geometry, const Lattice& lattice) {
    auto* const grid = static_cast<RTCGrid*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_GRID, 0, RTC_FORMAT_GRID, sizeof(RTCGrid), 1));
    *grid = {0, static_cast<unsigned>(lattice.count.x),
             static_cast<unsigned short>(lattice.count.x),
             static_cast<unsigned short>(lattice.count.y)};
}

void fill_triangles(RTCGeometry geometry, const Lattice& lattice) {
    const auto columns = static_cast<unsigned>(lattice.count.x);
    const auto rows = static_cast<unsigned>(lattice.count.y);
    auto* index = static_cast<unsigned*>(
        rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                3 * sizeof(unsigned), std::size_t(2) * (columns - 1) * (rows - 1)));
    for (unsigned y = 0; y + 1 < rows; ++y)
        for (unsigned x = 0; x + 1 < columns; ++x) {
            const unsigned a = y * columns + x, b = a + 1, c = a + columns, d = c + 1;
            for (const unsigned i : {a, b, c, b, d, c}) *index++ = i;
        }
}

void require(RTCDevice device) {
    const RTCError error = rtcGetDeviceError(device);
    if (error != RTC_ERROR_NONE)
        throw std::runtime_error(fmt::format("Embree: error {}", static_cast<int>(error)));
}

}  // namespace

EmbreeScene::EmbreeScene(const Texture& heights, const Part& part, double depth, GeometryKind kind,
                         int threads)
    : device_(rtcNewDevice(fmt::format("threads={}", threads).c_str())) {
    require(device_);
    rtcSetDeviceMemoryMonitorFunction(device_, count_bytes, this);
    scene_ = rtcNewScene(device_);
    const Lattice lattice = lattice_of(part, heights.view().width[0]);
    const bool grid = kind == GeometryKind::grid;
    RTCGeometry geometry =
        rtcNewGeometry(device_, grid ? RTC_GEOMETRY_TYPE_GRID : RTC_GEOMETRY_TYPE_TRIANGLE);
    fill_vertices(geometry, heights, lattice, depth);
    grid ? fill_grid(geometry, lattice) : fill_triangles(geometry, lattice);
    rtcAttachGeometry(scene_, geometry);
    build_ = time_of([&] {
        rtcCommitGeometry(geometry);
        rtcCommitScene(scene_);
    });
    rtcReleaseGeometry(geometry);
    require(device_);
}

EmbreeScene::~EmbreeScene() {
    rtcReleaseScene(scene_);
    rtcReleaseDevice(device_);
}

bool EmbreeScene::count_bytes(void* self, ssize_t bytes, bool) {
    static_cast<EmbreeScene*>(self)->bytes_ += bytes;
    return true;
}

double EmbreeScene::memory_mib() const { return static_cast<double>(bytes_.load()) / (1 << 20); }

int EmbreeScene::widest_packet() const {
    if (rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY16_SUPPORTED) != 0) return 16;
    return rtcGetDeviceProperty(device_, RTC_DEVICE_PROPERTY_NATIVE_RAY8_SUPPORTED) != 0 ? 8 : 4;
}

}  // namespace quadrel::peers

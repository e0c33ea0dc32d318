#include "rules/probes/samples.hpp"

#include "quadrel/raster/samples.hpp"
#include "quadrel/raster/triangle_quads.hpp"
#include "rules/probes/inputs.hpp"

namespace quadrel::rules {

std::vector<Triangle> moving_edges(bool along_y) {
    const int width = along_y ? 1 : sample_steps, height = along_y ? sample_steps : 1;
    const auto at = [&](double x, double y) {
        return along_y ? corner(y, x, width, height) : corner(x, y, width, height);
    };
    std::vector<Triangle> triangles;
    for (int k = 0; k < sample_steps; ++k) {
        const Corner low = at(k + k / 16.0, 0), high = at(k + (k + 1) / 16.0, 1);
        const Corner low_end = at(k + 1, 0), high_end = at(k + 1, 1);
        triangles.push_back({low, low_end, high_end});
        triangles.push_back({low, high_end, high});
    }
    return triangles;
}

namespace {

Values drawn_positions(const HardwareModel& hardware) {
    Values positions(2 * sample_count);
    for (const bool along_y : {false, true}) {
        const RasterState state =
            raster_state({along_y ? 1 : sample_steps, along_y ? sample_steps : 1}, hardware);
        for (const Triangle& triangle : moving_edges(along_y)) {
            std::array<glm::vec4, 3> clip;
            for (std::size_t i = 0; i < 3; ++i) {
                const auto& p = triangle[i].position;
                clip[i] = glm::vec4(p[0], p[1], p[2], p[3]);
            }
            std::vector<AssembledTriangle> pieces;
            PrimitiveCounts counts;
            assemble_triangle(clip, state, pieces, counts);
            for (const AssembledTriangle& piece : pieces)
                for (int y = 0; y < state.viewport.height; ++y)
                    for (int x = 0; x < state.viewport.width; ++x) {
                        const int mask = coverage_mask(piece.screen, x, y, sample_count);
                        for (int sample = 0; sample < sample_count; ++sample)
                            positions[static_cast<std::size_t>(2 * sample + along_y)] +=
                                static_cast<float>((mask >> sample) & 1);
                    }
        }
    }
    return positions;
}

}  // namespace

Probe sample_positions_probe() {
    Probe probe{"samples", "where the samples of a pixel lie, of 4, in 1/16 pixel, by coverage",
                "anywhere (OpenGL 4.6, 14.3.1); Vulkan's standard positions: 6,2 14,6 2,10 10,14"};
    probe.by_samples = true;
    probe.model = drawn_positions;
    probe.words = [](const Values& values) {
        std::string text;
        for (std::size_t i = 0; i + 1 < values.size(); i += 2)
            text += fmt::format("{}{:.0f},{:.0f}", i == 0 ? "" : " ", values[i], values[i + 1]);
        return text;
    };
    return probe;
}

}  // namespace quadrel::rules

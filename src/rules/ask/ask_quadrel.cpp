// Quadrel's side: its own set-up, coverage, interpolation and numbers.
#include <bit>

#include "quadrel/raster/interpolation.hpp"
#include "quadrel/raster/planes.hpp"
#include "quadrel/raster/quad_points.hpp"
#include "quadrel/raster/triangle_quads.hpp"
#include "rules/ask/question.hpp"
#include "rules/ask/sampled.hpp"

namespace quadrel::rules {
namespace {

/// The varying in a quad: exactly, or by the planes of the hardware.
class Varying {
  public:
    Varying(const AssembledTriangle& piece, const Triangle& triangle, Interpolation form)
        : screen_(piece.screen), form_(form) {
        for (std::size_t v = 0; v < 3; ++v)
            for (std::size_t c = 0; c < 4; ++c) {
                double sum = 0;
                for (std::size_t i = 0; i < 3; ++i)
                    sum += piece.weights[v].perspective[i] * double(triangle[i].varying[c]);
                corner_[c][v] = static_cast<float>(sum);
                is_asked_ = is_asked_ || sum != 0;
            }
        if (form != Interpolation::exact)
            plane_ = std::bit_cast<std::array<float, 16>>(plane_setup(form, screen_, 1));
    }

    vec4<QuadF> at(const QuadCoverage& quad) const {
        vec4<QuadF> value(QuadF(0));
        for (std::size_t c = 0; c < 4 && is_asked_; ++c) {
            const PerVertex<QuadF> corners{QuadF(corner_[c][0]), QuadF(corner_[c][1]),
                                           QuadF(corner_[c][2])};
            value[static_cast<int>(c)] =
                form_ == Interpolation::exact ? exact(quad, corners) : by_planes(quad, corners);
        }
        return value;
    }

  private:
    QuadF exact(const QuadCoverage& quad, const PerVertex<QuadF>& corners) const {
        double e[3][4];
        attribute_edges(screen_, quad_centres(quad.x, quad.y), e[0], e[1], e[2]);
        const EdgeValues<QuadF> edges{load_wide<QuadF>(e[0]), load_wide<QuadF>(e[1]),
                                      load_wide<QuadF>(e[2])};
        const PerVertex<QuadF> w{QuadF(screen_.vertex[0].w), QuadF(screen_.vertex[1].w),
                                 QuadF(screen_.vertex[2].w)};
        return interpolate(perspective_barycentrics(edges, w), corners);
    }
    QuadF by_planes(const QuadCoverage& quad, const PerVertex<QuadF>& corners) const {
        QuadF x, y;
        for (int lane = 0; lane < 4; ++lane) {
            x.lane[lane] = static_cast<float>(lane_x(quad, lane)) + 0.5f;
            y.lane[lane] = static_cast<float>(lane_y(quad, lane)) + 0.5f;
        }
        const auto at = [&](int i) { return QuadF(plane_[static_cast<std::size_t>(i)]); };
        if (form_ == Interpolation::llvmpipe) return llvmpipe_value(corners, x, y, at);
        return swiftshader_value(corners, x, y, QuadF(0, 1, 0, 1), QuadF(0, 0, 1, 1), at);
    }

    const ScreenTriangle& screen_;
    Interpolation form_;
    bool is_asked_ = false;  ///< null everywhere: needs no work
    std::array<std::array<float, 3>, 4> corner_{};
    std::array<float, 16> plane_{};
};

std::array<glm::vec4, 3> positions_of(const Triangle& triangle) {
    std::array<glm::vec4, 3> clip;
    for (std::size_t i = 0; i < 3; ++i) {
        const auto& p = triangle[i].position;
        clip[i] = glm::vec4(p[0], p[1], p[2], p[3]);
    }
    return clip;
}

/// One quad's lanes as the shader gets them. Lanes outside of the frame ask for 0.
QuadInput input_of(const Question& question, const QuadCoverage& quad, DerivativeMode derivatives,
                   const std::vector<SampledTexture>& maps) {
    QuadInput input{vec4<QuadF>(QuadF(0)), {}, {}, derivatives, maps};
    for (int lane = 0; lane < 4; ++lane) {
        const int x = lane_x(quad, lane), y = lane_y(quad, lane);
        input.pixel.x.lane[lane] = static_cast<float>(x);
        input.pixel.y.lane[lane] = static_cast<float>(y);
        const auto i = static_cast<std::size_t>(y * question.width + x);
        if (x >= question.width || i >= question.asked.size()) continue;
        for (int c = 0; c < 4; ++c)
            input.asked[c].lane[lane] = question.asked[i][static_cast<std::size_t>(c)];
    }
    return input;
}

void store(const Question& question, const QuadCoverage& quad, const vec4<QuadF>& answer,
           float* picture) {
    for (int lane = 0; lane < 4; ++lane) {
        if (quad.samples[static_cast<std::size_t>(lane)] == 0) continue;
        const int pixel = lane_y(quad, lane) * question.width + lane_x(quad, lane);
        for (int c = 0; c < 4; ++c) picture[4 * pixel + c] = answer[c].lane[lane];
    }
}

}  // namespace

Triangle whole_frame() {
    return {Corner{{-1, -1, 0, 1}}, Corner{{3, -1, 0, 1}}, Corner{{-1, 3, 0, 1}}};
}

Values ask_quadrel(const Question& question, const HardwareModel& hardware) {
    const std::vector<Triangle> triangles =
        question.triangles.empty() ? std::vector{whole_frame()} : question.triangles;
    const SampledMaps maps(question.maps, hardware);
    const RasterState state = raster_state({question.width, question.height}, hardware);
    const auto size = static_cast<std::size_t>(4 * question.width * question.height);
    Values values(question.apart ? triangles.size() * size : size);
    for (std::size_t i = 0; i < triangles.size(); ++i)
        for (const TriangleQuads& part : triangle_quads(positions_of(triangles[i]), state)) {
            const Varying varying(part.piece, triangles[i], hardware.interpolation);
            for (const QuadCoverage& quad : part.quads) {
                QuadInput input = input_of(question, quad, hardware.derivatives, maps.all());
                input.interpolated = varying.at(quad);
                store(question, quad, question.text(input),
                      values.data() + (question.apart ? i * size : 0));
            }
        }
    return values;
}

}  // namespace quadrel::rules

// Any pixel, re-run alone, with everything that its quad went through.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "quadrel/quad/value.hpp"
#include "quadrel/raster/viewport.hpp"
#include "quadrel/render.hpp"
#include "quadrel/scene/scene.hpp"
#include "quadrel/texture/footprint.hpp"

namespace quadrel {

/// Four lanes of one number: floats, or integers where `integer`.
struct ProbeValue {
    std::string name;  ///< channel-like: "P.X", "hit.steps", "dUVdx.U coarse"
    bool integer = false;
    std::array<float, 4> real{};
    std::array<std::int32_t, 4> whole{};
};

/// One texture look-up.
struct ProbeFetch {
    std::string texture;  ///< the slot: height, color, ...
    std::array<bool, 4> active{};
    std::array<float, 4> u{}, v{};
    std::array<std::array<float, 4>, 4> value{};  ///< [lane][r g b a]
    std::array<LaneFootprint, 4> footprint;       ///< no taps for cube maps
};

/// One step of a search: the ray against the map.
struct ProbeStep {
    std::array<bool, 4> active{};
    std::array<float, 4> s{}, u{}, v{}, ray_height{}, map_height{};
    std::size_t fetches_end = 0;  ///< look-ups of the stage made up to the end of this step
};

struct ProbeStage {
    std::string id;
    int light = -1;
    std::vector<ProbeStep> steps;
    std::vector<ProbeFetch> fetches;
    std::vector<ProbeValue> outputs;
};

/// One triangle in the pixel's quad.
struct ProbeFragment {
    std::uint32_t object = 0, primitive = 0;
    std::string object_name, material;
    std::array<std::uint16_t, 4>
        visible{};  ///< samples of each lane that it owns after the depth test
    std::array<std::uint16_t, 4> covered{};              ///< samples of each lane that it covers
    std::array<std::array<std::int64_t, 4>, 3> edges{};  ///< [edge][lane]
    std::array<float, 4> depth{};                        ///< window depth at the pixel centres
    std::vector<ProbeStage> stages;                      ///< in the order of the data flow
    std::vector<ProbeValue> derivatives;                 ///< of P and uv: fine, coarse and exact
};

struct ProbeReport {
    int image_x = 0, image_y = 0;  ///< from the top-left
    int window_x = 0, window_y = 0;
    int quad_x = 0, quad_y = 0;  ///< lane 0, window coordinates
    int lane = 0;
    int samples = 1;
    std::string conventions;
    std::string number, isa;               ///< the kernels that computed the values
    std::vector<ProbeFragment> fragments;  ///< by ascending submission order; empty: background
};

/// Re-runs the quad of image pixel (x, y). The values are those of the render with that `number`
/// and `isa` (named as in RenderOptions), bit for bit; doubles are rounded to float, as channels
/// are. Steps and look-ups are reported by float on scalar alone. Throws UsageError for a pixel
/// outside and for kernels that are not there, InputError as `render` does.
/// `injected`: as RenderOptions has it.
ProbeReport probe(const Scene& scene, int x, int y, const std::string& number = "float",
                  const std::string& isa = "scalar", const std::vector<Injection>& injected = {});

/// For people: decimal and hex float.
std::string to_text(const ProbeReport& report);
/// For tools: JSON. Floats are numbers (null for NaN and infinities) beside their bits as hex text.
std::string to_json(const ProbeReport& report);

}  // namespace quadrel

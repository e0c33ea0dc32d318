// One question to an implementation and to Quadrel: triangles, textures, numbers to work on, and a
// fragment shader in GLSL beside the same text over Quadrel's numbers.
#pragma once

#include <array>
#include <functional>
#include <string>
#include <vector>

#include "quadrel/num/math.hpp"
#include "quadrel/scene/settings.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel::rules {

using QuadF = Quad<float>;

/// Texels as both sides get them: floats that every format holds exactly.
struct ProbeTexture {
    TexelFormat format = TexelFormat::float32;
    int channels = 1;  ///< 1 or 4; srgb8 needs 4
    bool cube = false;
    int width = 1, height = 1;               ///< of level 0
    std::vector<std::vector<float>> levels;  ///< row by row; of cubes face after face
    SamplerState sampler;
};

/// A vertex: clip position, and a varying.
struct Corner {
    std::array<float, 4> position, varying{};
};
using Triangle = std::array<Corner, 3>;

/// What Quadrel's side of a shader is given: a quad.
struct QuadInput {
    vec4<QuadF> asked;         ///< the pixel's number
    vec4<QuadF> interpolated;  ///< the triangle's varying
    vec2<QuadF> pixel;         ///< window coordinates, whole
    DerivativeMode derivatives;
    const std::vector<SampledTexture>& maps;
};

struct Question {
    int width = 1, height = 1;
    /// The body of a function of the vec4 `asked`, the vec4 `interpolated` and the vec2
    /// `pixel` that returns the vec4 of answers; with maps map0, map1, ...
    std::string glsl{};
    std::string uniforms{};  ///< declared in front of it, for textures that are bound already
    std::function<vec4<QuadF>(const QuadInput&)> text{};
    std::vector<std::array<float, 4>> asked{};  ///< one per pixel, row 0 first; none: zeros
    std::vector<ProbeTexture> maps{};
    std::vector<Triangle> triangles{};  ///< none: one that holds the whole frame
    int version = 33;    ///< of OpenGL, that it needs: 33, 40, or 45 for derivatives' qualifiers
    bool apart = false;  ///< a picture of each triangle alone, one after the other
};

/// Four floats per pixel, row 0 (the lowest) first; 0 where nothing is drawn.
using Values = std::vector<float>;

/// What Quadrel answers as this hardware.
Values ask_quadrel(const Question& question, const HardwareModel& hardware);

/// A triangle over any frame, whose vertices lie far outside.
Triangle whole_frame();

}  // namespace quadrel::rules

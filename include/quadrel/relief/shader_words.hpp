// The words of searches on Shader, and what reads maps by addresses of its own. To be included
// before the rows.
#pragma once

#include "quadrel/num/shader/loop.hpp"
#include "quadrel/num/shader/named.hpp"
#include "quadrel/num/shader/neighbours.hpp"
#include "quadrel/quad/shader_io.hpp"
#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/direction_table.hpp"
#include "quadrel/relief/trace/cone/cone_map.hpp"
#include "quadrel/relief/trace/search/course.hpp"
#include "quadrel/relief/trace/search/near_surface.hpp"

namespace quadrel {

/// Every step is made.
template <Number F, class Height>
requires std::same_as<F, Shader> ShaderSteps steps_near_surface(const Height&,
                                                                const LatticeRays<F>&,
                                                                const ShaderMask&, int first,
                                                                int last,
                                                                Before = Before::not_needed) {
    return {first, last};
}
template <Number F, class Height>
requires std::same_as<F, Shader> ShaderSteps steps_near_surface(const Height&, const SearchRay<F>&,
                                                                const ShaderMask&, F, int last,
                                                                Before = Before::not_needed) {
    return {0, last};
}
template <Before before, class Along, class Position, class Heights>
class StepsOnCourse<Shader, before, Along, Position, Heights> : public ShaderSteps {
  public:
    StepsOnCourse(const Along&, Position&, const Heights&, const ShaderMask&, int first, int last,
                  const Shader&)
        : ShaderSteps(first, last) {}
};

/// Sizes are asked of the texture.
template <>
struct TexelSize<Shader> {
    vec2<Shader> texels, step;

    explicit TexelSize(const SampledTexture& map) {
        using namespace recorded;
        const auto side = [&](int axis) {
            return to_float<Shader>(size_of_level(map.view, axis, literal(Type::integer, 0)));
        };
        texels = named("texels", vec2<Shader>(side(0), side(1)));
        step = named("texel", vec2<Shader>(Shader(1)) / texels);
    }
};

/// A baked map is looked up as every texture, at level 0.
template <TextureSlot slot, int channels, class Stage, Interpolated what>
class BakedLookUp<slot, channels, StageIo<Stage, Shader>, what> {
  public:
    explicit BakedLookUp(const StageIo<Stage, Shader>& io) : map_(*io.template texture<slot>()) {}

    Texel<channels, Shader> operator()(const ShaderMask&, const vec2<Shader>& uv) const {
        using namespace recorded;
        if constexpr (what == Interpolated::roots) return interpolated_roots(uv);
        return texel(look_up("textureLod", map_, {pack<2>(uv), literal(Type::real, 0)}));
    }
    Texel<channels, Shader> operator()(const ShaderMask&, const vec2<Shader>& uv,
                                       const ShaderInt& layer) const {
        using namespace recorded;
        return texel(look_up("textureLayer", map_,
                             {pack<2>(uv), layer.node(), literal(Type::real, 0)},
                             "sampler2DArray"));
    }
    vec2<Shader> size() const { return TexelSize<Shader>(map_).texels; }

  private:
    /// What no sampler does: texel by texel.
    Texel<channels, Shader> interpolated_roots(const vec2<Shader>& uv) const {
        const auto level = level_geometry<Shader>(map_.view, 0);
        const Footprint<Shader> at = address(map_, level, uv, Filter::linear);
        FourTaps<channels, Shader> taps;
        for (int tap = 0; tap < 4; ++tap) {
            const ShaderInt x = tap % 2 == 0 ? at.x.first : at.x.second;
            const ShaderInt y = tap / 2 == 0 ? at.y.first : at.y.second;
            taps.tap[tap] = texel(recorded::texel(map_.view, x, y, nullptr));
            taps.tap[tap].channel[1] = sqrt(taps.tap[tap].channel[1]);
        }
        Texel<channels, Shader> result = blend(taps, at.x.weight, at.y.weight);
        result.channel[1] = result.channel[1] * result.channel[1];
        return result;
    }
    static Texel<channels, Shader> texel(recorded::Node* value) {
        Texel<channels, Shader> result;
        for (int i = 0; i < channels; ++i)
            result.channel[i] = Shader(recorded::component(value, i));
        return result;
    }

    const SampledTexture& map_;
};

template <>
inline Shader first_channel<Shader>(const TextureView& view, ShaderInt x, ShaderInt y,
                                    ShaderInt level) {
    return Shader(recorded::component(recorded::texel(view, x, y, level.node()), 0));
}
template <>
inline Shader first_channel<Shader>(const TextureView& view, ShaderInt x, ShaderInt y) {
    return Shader(recorded::component(recorded::texel(view, x, y, nullptr), 0));
}
template <>
inline vec2<Shader> both_channels<Shader>(const TextureView& view, ShaderInt x, ShaderInt y) {
    recorded::Node* const texel = recorded::texel(view, x, y, nullptr);
    return {Shader(recorded::component(texel, 0)), Shader(recorded::component(texel, 1))};
}

template <>
inline vec4<Shader> all_channels<Shader>(const TextureView& view, ShaderInt x, ShaderInt y,
                                         ShaderInt level) {
    return recorded::unpack<4>(recorded::texel(view, x, y, level.node()));
}

/// A table is an array of its slices, whose texels are fetched, and uniforms for the two numbers
/// that are said of it as a whole.
template <>
class DirectionTable<Shader> {
  public:
    explicit DirectionTable(const TextureView& view) : view_(view) {}

    std::int32_t columns() const { return view_.width[1]; }
    std::int32_t rows() const { return view_.height[1]; }
    std::int32_t slices() const { return view_.faces; }
    std::int32_t directions() const { return view_.width[0] / view_.width[1]; }
    Shader depth() const {
        return number_of_map("_depth", "depth of the relief that it was baked for, in tiles");
    }
    Shader curvature() const {
        return number_of_map(
            "_curvature",
            "the greatest of bases that it was baked for, in 1/tile; 0: planes alone");
    }

    Shader at(ShaderInt i, ShaderInt j, ShaderInt k, ShaderInt a, ShaderInt b) const {
        const ShaderInt x = named("table_x", a * ShaderInt(columns()) + i);
        const ShaderInt y = named("table_y", b * ShaderInt(rows()) + j);
        return Shader(recorded::component(recorded::texel_of_layer(view_, x, y, k), 0));
    }
    ShaderInt slice(Shader z) const {
        const Shader count(static_cast<float>(slices()));
        return to_int(clamp(ceil(z * count) - Shader(1), Shader(0), count - Shader(1)));
    }

  private:
    Shader number_of_map(const char* what, const char* comment) const {
        using namespace recorded;
        const std::string name = ShaderTextures::current().entry_of(view_).name + what;
        return Shader(Recorder::current().uniform(Type::real, {name, "float", 0, comment}));
    }

    const TextureView& view_;
};

/// Statuses have names.
template <>
inline ShaderInt status_packet<Shader>(Status status) {
    static constexpr const char* names[] = {"STATUS_NONE", "STATUS_HIT",    "STATUS_FLOOR",
                                            "STATUS_CAP",  "STATUS_CLIP",   "STATUS_NO_FRAME",
                                            "STATUS_NAN",  "STATUS_OUTSIDE"};
    return ShaderInt(recorded::Recorder::current().symbol(recorded::Type::integer,
                                                          names[static_cast<int>(status)]));
}

}  // namespace quadrel

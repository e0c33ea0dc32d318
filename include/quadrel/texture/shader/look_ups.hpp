// Look-ups of Shader: better matches than the texts of sampler.hpp, lod.hpp and cube.hpp, which
// leave the shading language's own. What a sampler's state says is the sampler's affair there.
#pragma once

#include "quadrel/texture/cube.hpp"
#include "quadrel/texture/height_sampler.hpp"
#include "quadrel/texture/shader/textures.hpp"

namespace quadrel {

/// A level of detail is what it was asked for by: gradients, or a level.
template <>
struct LodRecord<Shader> {
    Shader rho, lambda, level, frac;
    ShaderMask magnified;
    vec2<Shader> dx, dy;
    Shader given;
};

inline LodRecord<Shader> compute_lod(const SampledTexture&, const vec2<Shader>& dx,
                                     const vec2<Shader>& dy) {
    LodRecord<Shader> record;
    record.dx = dx;
    record.dy = dy;
    return record;
}
inline LodRecord<Shader> lod_for(LodUse, const SampledTexture& texture, const vec2<Shader>& dx,
                                 const vec2<Shader>& dy) {
    return compute_lod(texture, dx, dy);
}
inline LodRecord<Shader> lod_from_level(const SampledTexture&, const Shader& level) {
    LodRecord<Shader> record;
    record.given = level;
    return record;
}
template <>
inline LodRecord<Shader> finest_lod<Shader>() {
    LodRecord<Shader> record;
    record.given = Shader(0);
    return record;
}
inline LodRecord<Shader> implicit_lod(const SampledTexture& texture, const vec2<Shader>& uv,
                                      DerivativeMode = DerivativeMode::fine) {
    return compute_lod(texture, {dFdx(uv.x), dFdx(uv.y)}, {dFdy(uv.x), dFdy(uv.y)});
}
inline LodRecord<Shader> implicit_lod(const SampledTexture& texture, const vec2<Shader>& uv,
                                      DerivativeMode mode, const Shader& bias, LodUse) {
    if (bias.node()->kind != recorded::Node::Kind::literal || bias.node()->value != 0)
        throw recorded::RecordingError("a biased level of detail for a whole march");
    return implicit_lod(texture, uv, mode);
}

/// The sampler's affair: no model of one level applies.
inline MipLevels<Shader> mip_levels(const SampledTexture&, const LodRecord<Shader>&) {
    MipLevels<Shader> levels;
    levels.blends = true;
    return levels;
}

inline vec4<Shader> sample_expanded(const SampledTexture& texture, const SampleContext<Shader>&,
                                    const vec2<Shader>& uv, const LodRecord<Shader>& lod) {
    using namespace recorded;
    if (lod.given.node() != nullptr)
        return unpack<4>(look_up("textureLod", texture, {pack<2>(uv), lod.given.node()}));
    return unpack<4>(
        look_up("textureGrad", texture, {pack<2>(uv), pack<2>(lod.dx), pack<2>(lod.dy)}));
}
inline vec4<Shader> sample_expanded(const SampledTexture& texture,
                                    const SampleContext<Shader>& context, const vec2<Shader>& uv,
                                    const LodRecord<Shader>& lod, const MipLevels<Shader>&) {
    return sample_expanded(texture, context, uv, lod);
}
inline vec4<Shader> texture(const SampledTexture& from, const SampleContext<Shader>&,
                            const vec2<Shader>& uv, DerivativeMode = DerivativeMode::fine) {
    return recorded::unpack<4>(recorded::look_up("texture", from, {recorded::pack<2>(uv)}));
}
inline vec4<Shader> texture_bias(const SampledTexture& from, const SampleContext<Shader>&,
                                 const vec2<Shader>& uv, const Shader& bias,
                                 DerivativeMode = DerivativeMode::fine) {
    return recorded::unpack<4>(
        recorded::look_up("texture", from, {recorded::pack<2>(uv), bias.node()}));
}
inline vec4<Shader> texture_gather(const SampledTexture& texture, const SampleContext<Shader>&,
                                   const vec2<Shader>& uv, int component = 0) {
    using namespace recorded;
    return unpack<4>(
        look_up("textureGather", texture, {pack<2>(uv), literal(Type::integer, component)}));
}

inline vec4<Shader> texture_cube(const SampledTexture& from, const SampleContext<Shader>&,
                                 const vec3<Shader>& direction,
                                 DerivativeMode = DerivativeMode::fine) {
    using namespace recorded;
    return unpack<4>(look_up("texture", from, {pack<3>(direction)}, "samplerCube"));
}
inline vec4<Shader> texture_cube_lod(const SampledTexture& from, const SampleContext<Shader>&,
                                     const vec3<Shader>& direction, const Shader& level) {
    using namespace recorded;
    return unpack<4>(
        look_up("textureLod", from, {pack<3>(direction), level.node()}, "samplerCube"));
}

// ---- Texels -------------------------------------------------------------------------------------

namespace recorded {
/// texelFetch; `level` is 0 where it is null.
inline Node* texel(const TextureView& view, const ShaderInt& x, const ShaderInt& y, Node* level) {
    return look_up("texelFetch", view,
                   {x.node(), y.node(), level != nullptr ? level : literal(Type::integer, 0)});
}
/// The same of level 0 of an array's layer.
inline Node* texel_of_layer(const TextureView& view, const ShaderInt& x, const ShaderInt& y,
                            const ShaderInt& layer) {
    return look_up("texelLayer", view,
                   {x.node(), y.node(), layer.node(), literal(Type::integer, 0)}, "sampler2DArray");
}
/// Width (axis 0) or height of a level in texels.
inline ShaderInt size_of_level(const TextureView& view, int axis, Node* level) {
    return integer("textureSize",
                   {sampler(view, "sampler2D"), level, literal(Type::integer, axis)});
}
}  // namespace recorded

template <Number F>
requires std::same_as<F, Shader> vec4<F> texel_fetch(const SampledTexture& texture,
                                                     const SampleContext<F>&, ShaderInt x,
                                                     ShaderInt y, ShaderInt level) {
    return recorded::unpack<4>(recorded::texel(texture.view, x, y, level.node()));
}

/// Tables of sizes by level are the texture's; other tables a shader does not have.
template <>
inline ShaderInt gather_int<Shader>(const std::int32_t* base, ShaderInt index) {
    int axis = 0;
    const TextureView* const view = ShaderTextures::current().view_of_sizes(base, axis);
    if (view == nullptr) throw recorded::RecordingError("reads a table of its own");
    return recorded::size_of_level(*view, axis, index.node());
}
template <>
inline Shader gather<Shader>(const float*, ShaderInt) {
    throw recorded::RecordingError("reads texels by addresses of its own");
}
template <>
inline void gather2<Shader>(const float*, ShaderInt, Shader[2]) {
    throw recorded::RecordingError("reads texels by addresses of its own");
}
template <>
inline ShaderInt look_up16<Shader>(const std::int32_t*, ShaderInt) {
    throw recorded::RecordingError("reads a table of its own");
}

/// For those who count lanes to choose between ways that give the same.
inline int count(const ShaderMask&) { return 0; }

}  // namespace quadrel

// The named values that flow between stages: one enumeration, one table. A batch keeps each
// component of each value in an array of its own, lane after lane, in quad order.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace quadrel {

/// Everything a stage may read or write, in the order of the data flow. Positions and vectors are
/// in eye space (right-handed, looking down -z), lengths in world units.
enum class Value : std::int32_t {
    P,               ///< interpolated surface point
    vertex_normal,   ///< interpolated vertex normal, not normalised; the face normal of flat meshes
    Ng,              ///< unit face normal, counter-clockwise side of the triangle
    uv,              ///< interpolated texture coordinates
    bary,            ///< perspective-correct barycentrics of the (clipped) triangle
    vertex_tangent,  ///< interpolated vertex tangent, not normalised (what it is: the frame's)
    tangent_sign,    ///< interpolated handedness of the vertex tangents
    vertex_bitangent,  ///< interpolated vertex bitangent, not normalised
    quadric,           ///< interpolated quadric of the vertices (quadric_of_lane), 1 / world unit
    face_J,            ///< J of the triangle itself, from its vertices, in its plane
    object_x,          ///< the normal matrix' columns: eye-space directions of the object's axes
    object_y,
    object_z,
    dPdx,  ///< window-space differences over the quad
    dPdy,
    dUVdx,
    dUVdy,
    relief_depth,  ///< D: relief thickness in world units, after fading
    T,             ///< unit tangent of the frame
    B,             ///< unit bitangent of the frame
    frame_normal,  ///< unit normal of the frame: the axis of relief depth
    J,             ///< d(u, v) / dP: U.X U.Y U.Z V.X V.Y V.Z, per world unit
    r,             ///< depth rate of the view ray: world depth a unit of its length
    uv_rate,       ///< UV shift per world unit of depth along the view ray
    K,             ///< UV shift while the ray falls through the whole relief: depth * uv_rate
    frame_status,  ///< HIT or NOFRAME
    frame_flags,
    oracle_s,          ///< where the ray first meets the height field, as hit_s
    oracle_uv,         ///< there, as hit_uv
    oracle_cell,       ///< column and row of the cell that is met, whole numbers
    oracle_place,      ///< where in the cell, [0, 1]
    oracle_gradient,   ///< d height / d(u, v) there
    oracle_condition,  ///< |ds / d height|: how far s moves with the heights
    oracle_bound,      ///< how far oracle_s may be from the exact one
    oracle_status,     ///< as hit_status
    certified,         ///< Certificate
    certified_reason,  ///< Uncertified
    lod_rho,
    lod_lambda,
    lod_level,
    lod_frac,
    hit_uv,
    hit_s,      ///< ray parameter: depth below the top plane, in units of the relief's depth
    hit_h,      ///< height that ended the search, in [0, 1]
    hit_depth,  ///< world depth of the hit below the polygon's plane, along the frame's normal
    hit_P,      ///< displaced point
    hit_status,
    hit_flags,
    hit_steps,
    hit_fetches,
    frag_depth,         ///< window depth of the hit
    N,                  ///< unit shading normal (the published thesis leaves it unnormalised)
    shadow_visibility,  ///< a light: 1 lit, 0 dark
    shadow_steps,       ///< a light
    occlusion,          ///< ambient visibility at the hit: 1 open, 0 closed
    occlusion_error,    ///< standard error of occlusion, where that is an estimate
    light_ambient,
    light_diffuse,
    light_specular,
    light_emissive,
    light_reflection,
    light_refraction,
    color,    ///< linear RGB
    opacity,  ///< of the base colour; what `discard_below` tests
    count,
};

enum class ValueKind : std::int32_t { real, integer };

/// Lights that one render may have; values per light get as many arrays.
inline constexpr int max_lights = 8;

struct ValueInfo {
    std::string_view name;
    std::int32_t components;
    ValueKind kind = ValueKind::real;
    bool per_light = false;
};

inline constexpr std::array<ValueInfo, static_cast<std::size_t>(Value::count)> value_table{{
    {"P", 3},
    {"vertex_normal", 3},
    {"Ng", 3},
    {"uv", 2},
    {"bary", 3},
    {"vertex_tangent", 3},
    {"tangent_sign", 1},
    {"vertex_bitangent", 3},
    {"quadric", 2},
    {"face_J", 6},
    {"object_x", 3},
    {"object_y", 3},
    {"object_z", 3},
    {"dPdx", 3},
    {"dPdy", 3},
    {"dUVdx", 2},
    {"dUVdy", 2},
    {"relief.depth", 1},
    {"T", 3},
    {"B", 3},
    {"frame_normal", 3},
    {"J", 6},
    {"r", 1},
    {"uv_rate", 2},
    {"K", 2},
    {"frame_status", 1, ValueKind::integer},
    {"frame_flags", 1, ValueKind::integer},
    {"oracle.s", 1},
    {"oracle.uv", 2},
    {"oracle.cell", 2},
    {"oracle.place", 2},
    {"oracle.gradient", 2},
    {"oracle.condition", 1},
    {"oracle.bound", 1},
    {"oracle.status", 1, ValueKind::integer},
    {"certified", 1, ValueKind::integer},
    {"certified.reason", 1, ValueKind::integer},
    {"lod.rho", 1},
    {"lod.lambda", 1},
    {"lod.level", 1},
    {"lod.frac", 1},
    {"hit.uv", 2},
    {"hit.s", 1},
    {"hit.h", 1},
    {"hit.depth", 1},
    {"hit.P", 3},
    {"hit.status", 1, ValueKind::integer},
    {"hit.flags", 1, ValueKind::integer},
    {"hit.steps", 1, ValueKind::integer},
    {"hit.fetches", 1, ValueKind::integer},
    {"frag.depth", 1},
    {"N", 3},
    {"shadow.visibility", 1, ValueKind::real, true},
    {"shadow.steps", 1, ValueKind::integer, true},
    {"occlusion", 1},
    {"occlusion.error", 1},
    {"light.ambient", 3},
    {"light.diffuse", 3},
    {"light.specular", 3},
    {"light.emissive", 3},
    {"light.reflection", 3},
    {"light.refraction", 3},
    {"color", 3},
    {"opacity", 1},
}};

constexpr const ValueInfo& info(Value v) { return value_table[static_cast<std::size_t>(v)]; }

/// Arrays that a value takes.
constexpr int arrays_of(Value v) {
    return info(v).components * (info(v).per_light ? max_lights : 1);
}

/// First arrays of the values, and their number at the end. Sums made here once: a loop at every
/// look-up shows in a render's profile.
inline constexpr auto first_slots = [] {
    std::array<int, static_cast<std::size_t>(Value::count) + 1> slots{};
    for (std::size_t i = 0; i + 1 < slots.size(); ++i)
        slots[i + 1] = slots[i] + arrays_of(static_cast<Value>(i));
    return slots;
}();

/// Index of the first array of a value; component c of light l is slot + l * components + c.
constexpr int slot_of(Value v) { return first_slots[static_cast<std::size_t>(v)]; }

inline constexpr int slot_count = slot_of(Value::count);

/// hit.status. The codes are part of the file format.
enum class Status : std::int32_t {
    none = 0,  ///< uncovered
    hit = 1,
    floor = 2,     ///< no crossing found: the bottom plane
    cap = 3,       ///< iteration cap reached above the surface
    clip = 4,      ///< uv left the domain
    no_frame = 5,  ///< singular or back-facing frame
    nan = 6,
    outside = 7,
};

/// certified: how the first hit was proven. Part of the file format.
enum class Certificate : std::int32_t {
    none = 0,
    bounds = 1,  ///< by bounds on the rounding errors of double
    exact = 2,   ///< by rational arithmetic, where those bounds did not settle it
};

/// certified.reason: why it was not. Part of the file format.
enum class Uncertified : std::int32_t {
    proven = 0,
    no_ray = 1,         ///< the fragment has no frame
    not_finite = 2,     ///< the ray is not: NaN, or infinite
    not_a_number = 3,   ///< a height on the way is NaN or infinite
    too_long = 4,       ///< more cells on the way than are searched
    not_exact = 5,      ///< the bounds did not settle it, and this build has no rational arithmetic
    no_height_map = 6,  ///< heights are noise, or there are none
};

/// hit.flags, a set of bits. Part of the file format. (16 is kept for hits outside of a chart.)
struct HitFlag {
    static constexpr std::int32_t uv_degenerate = 1, ambiguous = 2, start_below = 4, wrapped = 8,
                                  nan_look_up = 32;
    static constexpr std::int32_t end = 64;
};

/// A bit of hit.flags as users name it.
struct HitFlagName {
    std::string_view name;
    std::int32_t bit;
};
inline constexpr std::array<HitFlagName, 5> hit_flag_names{{
    {"degenerate-uv", HitFlag::uv_degenerate},
    {"ambiguous", HitFlag::ambiguous},
    {"start-below", HitFlag::start_below},
    {"wrapped", HitFlag::wrapped},
    {"nan-look-up", HitFlag::nan_look_up},
}};

}  // namespace quadrel

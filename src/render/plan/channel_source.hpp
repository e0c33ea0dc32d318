// Where a channel's bits come from: a value of the stages, or something only the renderer knows.
#pragma once

#include <string>

#include "quadrel/film/film.hpp"
#include "quadrel/quad/value.hpp"

namespace quadrel {

/// What an err.* channel measures (film/channels.hpp lists them for people).
enum class ErrorMeasure : std::int32_t {
    s,
    uv,
    cell,
    kind,
    normal,
    shadow,
    color,
    K,          ///< of the frame alone
    certified,  ///< how the truth was proven, as channel `certified`
};

/// What is judged: all that is drawn, its search on the exact frame, or its frame under the judge's
/// search.
enum class ErrorPart : std::int32_t { whole, search, frame };

/// Under which errors ranges are taken.
enum class RangeSet {
    none,   ///< no range
    exact,  ///< bound.*: exact arithmetic on float32 inputs
    gpu,    ///< gpu.*: what a specification permits
};

/// What stages differentiate beside values that they store (render/exact/observed.hpp).
enum class Observed {
    none,
    height,    ///< of the map at the hit
    mirrored,  ///< the viewer's direction, mirrored by the shading normal: unit, eye space
};

struct ChannelSource {
    enum class Kind {
        value,      ///< component of a stage value
        coverage,   ///< A
        z,          ///< -hit.P.z
        depth,      ///< window depth of the sample
        object,     ///< id.object
        primitive,  ///< id.primitive
        lane,       ///< quad.lane
        quad_coverage,
        exact,        ///< exact derivative of a component of a stage value
        exact_error,  ///< the drawn finite difference minus it
        error,        ///< what a row has minus what the judge has: `measure` of `part`
        range_low,    ///< of a value or Z, the least that it may be
        range_high,
        gap_low,  ///< where the widest gap between such ranges begins
        gap_high,
        range_paths,       ///< how many ranges the ways of open decisions leave
        undecided,         ///< what decisions were open
        pixel_certified,   ///< certified.pixel, of K by exact arithmetic
        pixel_reason,      ///< certified.pixel.reason
        integral_error,    ///< standard error of a component of the colour
        integral_samples,  ///< integral.samples
    };
    std::string name;
    ChannelType type = ChannelType::float32;
    Kind kind = Kind::value;
    Value value = Value::P;
    int component = 0, light = 0;
    int axis = 0;  ///< of a derivative: 0 window x, 1 window y
    ErrorMeasure measure = ErrorMeasure::s;
    ErrorPart part = ErrorPart::whole;
    RangeSet range_set = RangeSet::none;
    bool negated = false;                ///< of a range: Z is the opposite of its value
    Observed observed = Observed::none;  ///< of a derivative: of this instead of `value`

    /// Index of the value's array (quad/value.hpp).
    int slot() const { return slot_of(value) + light * info(value).components + component; }
    /// Resolved over the samples of a pixel; every other channel is one fragment's.
    bool resolved() const;
};

/// Whether the channel says what is proven of a pixel, whose ray is known to be in a range.
inline bool certifies_pixels(const ChannelSource& channel) {
    return channel.kind == ChannelSource::Kind::pixel_certified ||
           channel.kind == ChannelSource::Kind::pixel_reason;
}

/// The source of a full channel name (film/channels.hpp has checked that it exists).
ChannelSource channel_source(const std::string& name);

}  // namespace quadrel

// A stage: a pure function from named inputs to named outputs over a batch of packets.
//
// It is a struct template of static members and one call operator:
//   text        id, room, one-line summary, source
//   inputs, outputs   the values that it may load and must store
//   textures    the texture slots that it reads
//   Params, parameters   plain struct, and its description (name, unit, range, default)
//   operator()(Io& io, const Params&)   templated on StageIo<Stage, F>, F the number type
// Loading a value that is not declared does not compile.
#pragma once

#include <algorithm>
#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "quadrel/num/functions.hpp"
#include "quadrel/quad/parameter.hpp"
#include "quadrel/quad/uniforms.hpp"
#include "quadrel/quad/value.hpp"
#include "quadrel/raster/planes.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel {

/// Fragments of one batch: 64 quads, 256 lanes.
inline constexpr int batch_quads = 64;
inline constexpr int batch_lanes = 4 * batch_quads;

/// One step of a search, as a probe sees it.
struct MarchStep {
    QuadMask active;
    Quad<float> s;  ///< ray parameter: depth below the top plane
    vec2<Quad<float>> uv;
    Quad<float> ray_height, map_height;
};

/// Receives what a probed quad goes through, look-ups included.
class StageLog : public FetchLog {
  public:
    virtual void march_step(const MarchStep& step) = 0;
};

struct SharedScales;  // shared_scales.hpp

/// What a stage function is called with. Only plain data: this crosses module borders.
struct StageCall {
    void* const* values;          ///< array per slot (value.hpp); null where not planned
    const std::uint32_t* active;  ///< a lane: not 0 in every lane of a real quad, helpers included
    std::int32_t lanes;           ///< multiple of 16, padded with inactive quads
    const void* parameters;       ///< the stage's Params
    const MaterialUniforms* material;
    const FrameUniforms* frame;
    const SampledTexture* textures[texture_slot_count];  ///< null where the material has none
    std::int32_t light;                                  ///< which light a per-light stage serves
    FetchCounters* counters;                             ///< an array, one a texture slot; or null
    StageLog* log;                                       ///< null but in a probe
    SharedScales* scales;  ///< of this batch; null where every stage is to compute its own
    // What the interpolation reads instead of values.
    const double* edges[3];         ///< edge functions at the evaluation point, per lane
    const float* window[2];         ///< the evaluation point in pixels; null where `planes` is
    const std::int32_t* primitive;  ///< index into `primitives`, per lane
    const PrimitiveData* primitives;
    const PrimitiveFrame* frames;       ///< parallel to `primitives`; null where no stage asks
    const PrimitiveVertices* vertices;  ///< likewise, for stages with a vertex program
    const PlaneSetup* planes;           ///< likewise; null if the frame's interpolation is exact
    const EdgeSlopes* edge_slopes;      ///< per quad; read by number types with derivatives alone
};

using StageFunction = void (*)(const StageCall*);

struct StageText {
    const char* id;  ///< `name` or `name@published`
    /// quad, depth, frame, oracle, trace, clip, hit, frag-depth, surface, shadow, occlusion or
    /// shade. A scene chooses one stage of each room but quad, depth, oracle and hit, whose stages
    /// run whenever something asks for what they store.
    const char* room;
    const char* summary;
    const char* source;
};

inline constexpr std::array<TextureSlot, 0> no_textures{};

/// What a stage has that declares nothing else: no textures, no parameters, no leaving out, no
/// vertex program, all of its textures read.
struct StageDefaults {
    static constexpr auto textures = no_textures;
    /// Whether the stage leaves out steps by the bounds of the height map's heights
    /// (MaterialUniforms), with the same bits but for counts of steps and fetches.
    static constexpr bool uses_height_bounds = false;
    /// Whether the stage reads of the height map the texels of level 0, or the patches between
    /// them, and nothing else; then a render need not make the coarser levels.
    static constexpr bool reads_finest_heights_only = false;
    /// Whether it reads of the gloss map the first channel and nothing else.
    static constexpr bool reads_first_gloss_only = false;
    /// Whether the stage has a vertex program (vertex_program.hpp).
    static constexpr bool reads_vertices = false;
    /// Whether the stage's text, on Quad<Dual> (num/dual.hpp), gives the exact window-space
    /// derivatives of what it computes: for each function its own, for texels a constant, for the
    /// steps of a lattice 0, for an exact hit the implicit derivative.
    static constexpr bool runs_on_duals = false;
    using Params = NoParams;
    static constexpr auto parameters = no_parameters;
};

namespace detail {
/// Where a member function of the same name hides `store`.
template <class Element, class Packet>
void store_packet(Element* to, const Packet& packet) {
    store(to, packet);
}
}  // namespace detail

template <class... V>
constexpr std::array<Value, sizeof...(V)> values(V... v) {
    return {v...};
}
template <class... S>
constexpr std::array<TextureSlot, sizeof...(S)> slots(S... s) {
    return {s...};
}

template <std::size_t n>
constexpr bool contains(const std::array<Value, n>& list, Value v) {
    return std::find(list.begin(), list.end(), v) != list.end();
}

/// One packet's view of a StageCall, but for values.
template <class Stage, class F>
class PacketIo {
  public:
    using Number = F;
    static constexpr bool reads_vertices = Stage::reads_vertices;

    PacketIo(const StageCall& call, int first_lane) : call_(call), lane_(first_lane) {}

    Mask<F> active() const { return load_mask<F>(call_.active + lane_); }
    /// For look-ups in the texture of that slot.
    template <TextureSlot slot>
    SampleContext<F> context(Mask<F> mask) const {
        FetchCounters* const all = call_.counters;
        return {mask, all ? all + static_cast<int>(slot) : nullptr, call_.log};
    }
    template <TextureSlot slot>
    SampleContext<F> context() const {
        return context<slot>(active());
    }

    /// The bound texture of a declared slot, or null.
    template <TextureSlot slot>
    const SampledTexture* texture() const {
        static_assert(std::find(Stage::textures.begin(), Stage::textures.end(), slot) !=
                          Stage::textures.end(),
                      "not among the stage's textures");
        return call_.textures[static_cast<int>(slot)];
    }

    /// Every search calls this once a step, after its fetch. Costs nothing outside of a probe.
    void march_step(Mask<F> mask, F s, const vec2<F>& uv, F ray_height, F map_height) const {
        if constexpr (std::same_as<F, Quad<float>>) {
            if (call_.log) call_.log->march_step({mask, s, uv, ray_height, map_height});
        }
    }

    const MaterialUniforms& material() const { return *call_.material; }
    const FrameUniforms& frame() const { return *call_.frame; }
    const StageCall& call() const { return call_; }
    int first_lane() const { return lane_; }

  protected:
    const StageCall& call_;
    int lane_;
};

namespace detail {
/// Component after component of a value: F, vec2, vec3 or six as two vec3, as `real(i)` gives them.
template <int components, class Real>
auto assemble(const Real& real) {
    using F = decltype(real(0));
    if constexpr (components == 1) {
        return real(0);
    } else if constexpr (components == 2) {
        return vec2<F>(real(0), real(1));
    } else if constexpr (components == 3) {
        return vec3<F>(real(0), real(1), real(2));
    } else {
        return std::array<vec3<F>, 2>{vec3<F>(real(0), real(1), real(2)),
                                      vec3<F>(real(3), real(4), real(5))};
    }
}
/// The other way: put(i, component i).
template <int components, class X, class Put>
void take_apart(const X& x, const Put& put) {
    if constexpr (components == 1) {
        put(0, x);
    } else if constexpr (components == 6) {
        for (int i = 0; i < 6; ++i) put(i, x[std::size_t(i / 3)][i % 3]);
    } else {
        for (int i = 0; i < components; ++i) put(i, x[i]);
    }
}
}  // namespace detail

/// One packet's view of a StageCall: values are in the arrays of a batch.
template <class Stage, class F>
class StageIo : public PacketIo<Stage, F> {
  public:
    using PacketIo<Stage, F>::PacketIo;

    /// The declared input `v`: F, vec2, vec3 or an integer packet by the value's table entry.
    template <Value v>
    auto load(int light = 0) const {
        static_assert(contains(Stage::inputs, v), "not among the stage's inputs");
        constexpr int n = info(v).components;
        const int slot = slot_of(v) + light * n;
        if constexpr (info(v).kind == ValueKind::integer) {
            return load_int<F>(array<std::int32_t>(slot));
        } else {
            return detail::assemble<n>(
                [&](int i) { return quadrel::load<F>(array<MemoryElement<F>>(slot + i)); });
        }
    }

    /// Stores the declared output `v`; nothing happens when no one asked for it.
    template <Value v, class X>
    void store(const X& x, int light = 0) const {
        static_assert(contains(Stage::outputs, v), "not among the stage's outputs");
        constexpr int n = info(v).components;
        const int slot = slot_of(v) + light * n;
        if (!this->call_.values[slot]) return;
        if constexpr (info(v).kind == ValueKind::integer) {
            detail::store_packet(array<std::int32_t>(slot), x);
        } else {
            detail::take_apart<n>(
                x, [&](int i, F c) { detail::store_packet(array<MemoryElement<F>>(slot + i), c); });
        }
    }

    /// Whether anyone asked for the declared output `v`.
    template <Value v>
    bool wanted() const {
        static_assert(contains(Stage::outputs, v), "not among the stage's outputs");
        return this->call_.values[slot_of(v)] != nullptr;
    }

    int light() const { return this->call_.light; }

  private:
    template <class Element>
    Element* array(int slot) const {
        return static_cast<Element*>(this->call_.values[slot]) + this->lane_;
    }
};

/// Runs a stage over a batch.
template <class Stage, class F>
void run_stage(const StageCall* call) {
    const auto& params = *static_cast<const typename Stage::Params*>(call->parameters);
    for (int lane = 0; lane < call->lanes; lane += lanes_of<F>) {
        StageIo<Stage, F> io(*call, lane);
        Stage()(io, params);
    }
    leave<F>();
}

/// Three floats of a uniform as a vector in every lane.
template <Number F>
vec3<F> uniform3(const float (&v)[3]) {
    return {F(v[0]), F(v[1]), F(v[2])};
}

}  // namespace quadrel

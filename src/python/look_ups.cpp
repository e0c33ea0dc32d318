#include "python/look_ups.hpp"

#include "quadrel/num/quad.hpp"
#include "quadrel/texture/footprint.hpp"
#include "quadrel/texture/sampler.hpp"

namespace quadrel::python {
namespace {

template <class T>
Quad<T> load_quad(const T* values, std::size_t lane) {
    return values == nullptr
               ? Quad<T>(T(0))
               : Quad<T>(values[lane], values[lane + 1], values[lane + 2], values[lane + 3]);
}

QuadInt load_quad(const std::int32_t* values, std::size_t lane) {
    QuadInt quad;
    for (std::size_t i = 0; i < 4; ++i) quad.lane[i] = values[lane + i];
    return quad;
}

template <class T>
vec2<Quad<T>> load_pair(const T* first, const T* second, std::size_t lane) {
    return {load_quad(first, lane), load_quad(second, lane)};
}

/// The record of one quad's look-ups.
template <class T>
LodRecord<Quad<T>> record_of(const SampledTexture& texture, LookUp kind,
                             const LookUpArguments<T>& a, std::size_t lane) {
    if (kind == LookUp::level) return lod_from_level(texture, load_quad(a.level, lane));
    if (kind == LookUp::gradients)
        return compute_lod(texture, load_pair(a.dudx, a.dvdx, lane),
                           load_pair(a.dudy, a.dvdy, lane));
    return implicit_lod(texture, load_pair(a.u, a.v, lane), a.mode, load_quad(a.bias, lane));
}

template <class T>
vec4<Quad<T>> values_of(const SampledTexture& texture, LookUp kind, const LookUpArguments<T>& a,
                        std::size_t lane) {
    using F = Quad<T>;
    const SampleContext<F> context{};
    if (kind == LookUp::fetch)
        return texel_fetch<F>(texture, context, load_quad(a.x, lane), load_quad(a.y, lane),
                              load_quad(a.z, lane));
    const vec2<F> uv = load_pair(a.u, a.v, lane);
    if (kind == LookUp::gather) return texture_gather(texture, context, uv, a.component);
    return sample_expanded(texture, context, uv, record_of(texture, kind, a, lane));
}

}  // namespace

template <class T>
void look_up(const SampledTexture& texture, LookUp kind, const LookUpArguments<T>& arguments,
             T* values) {
    for (std::size_t lane = 0; lane < arguments.lanes; lane += 4) {
        const vec4<Quad<T>> result = values_of(texture, kind, arguments, lane);
        for (std::size_t i = 0; i < 4; ++i)
            for (int c = 0; c < 4; ++c)
                values[4 * (lane + i) + static_cast<std::size_t>(c)] = result[c].lane[i];
    }
}

template <class T>
void levels_of_detail(const SampledTexture& texture, LookUp kind,
                      const LookUpArguments<T>& arguments, T* records) {
    for (std::size_t lane = 0; lane < arguments.lanes; lane += 4) {
        const auto lod = record_of(texture, kind, arguments, lane);
        for (std::size_t i = 0; i < 4; ++i) {
            const T record[] = {lod.rho.lane[i], lod.lambda.lane[i], lod.level.lane[i],
                                lod.frac.lane[i], lod.magnified.lane[i] ? T(1) : T(0)};
            std::copy(std::begin(record), std::end(record), records + 5 * (lane + i));
        }
    }
}

template <class T>
void footprints(const SampledTexture& texture, LookUp kind, const LookUpArguments<T>& arguments,
                const TapArrays& taps) {
    for (std::size_t lane = 0; lane < arguments.lanes; lane += 4) {
        const auto uv = load_pair(arguments.u, arguments.v, lane);
        const auto lod = record_of(texture, kind, arguments, lane);
        for (std::size_t i = 0; i < 4; ++i) {
            const LaneFootprint footprint =
                lane_footprint<T>(texture, uv, lod, static_cast<int>(i));
            taps.count[lane + i] = static_cast<std::int32_t>(footprint.taps.size());
            std::size_t at = most_taps * (lane + i);
            for (const TexelTap& tap : footprint.taps) {
                taps.level[at] = tap.level;
                taps.x[at] = tap.x;
                taps.y[at] = tap.y;
                taps.border[at] = tap.border;
                taps.weight[at] = tap.weight;
                std::copy(std::begin(tap.value), std::end(tap.value), taps.value + 4 * at);
                ++at;
            }
        }
    }
}

template <class T>
void differences(Difference which, DerivativeMode mode, std::size_t lanes, const T* values,
                 T* results) {
    for (std::size_t lane = 0; lane < lanes; lane += 4) {
        const Quad<T> v = load_quad(values, lane);
        const Quad<T> result = which == Difference::x   ? dFdx(v, mode)
                               : which == Difference::y ? dFdy(v, mode)
                                                        : fwidth(v, mode);
        std::copy(std::begin(result.lane), std::end(result.lane), results + lane);
    }
}

template void look_up(const SampledTexture&, LookUp, const LookUpArguments<float>&, float*);
template void look_up(const SampledTexture&, LookUp, const LookUpArguments<double>&, double*);
template void levels_of_detail(const SampledTexture&, LookUp, const LookUpArguments<float>&,
                               float*);
template void levels_of_detail(const SampledTexture&, LookUp, const LookUpArguments<double>&,
                               double*);
template void footprints(const SampledTexture&, LookUp, const LookUpArguments<float>&,
                         const TapArrays&);
template void footprints(const SampledTexture&, LookUp, const LookUpArguments<double>&,
                         const TapArrays&);
template void differences(Difference, DerivativeMode, std::size_t, const float*, float*);
template void differences(Difference, DerivativeMode, std::size_t, const double*, double*);

}  // namespace quadrel::python

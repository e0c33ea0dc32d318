// Loads of neighbouring elements into lanes, and texels blended as they are stored: the end of
// lanes.hpp.
#pragma once

#include "quadrel/num/lanes.hpp"

namespace quadrel {

namespace simd {

/// Indices in memory, from where each is loaded by itself. The compiler must not see that they come
/// from a register: it would take it apart lane by lane, two instructions on the one port that the
/// inserts behind each load need, too.
struct Addresses {
    explicit Addresses(LanesInt index) {
        hn::Store(index.v, IntTag(), lane);
        asm("" : "+m"(lane));
    }
    alignas(64) std::int32_t lane[lanes];
};

/// A 4x4 transpose within each quad.
inline void transpose(const FloatVector rows[4], Lanes out[4]) {
    const FloatTag tag;
    const hn::RepartitionToWide<FloatTag> wide;
    const auto low01 = hn::BitCast(wide, hn::InterleaveLower(tag, rows[0], rows[1]));
    const auto low23 = hn::BitCast(wide, hn::InterleaveLower(tag, rows[2], rows[3]));
    const auto high01 = hn::BitCast(wide, hn::InterleaveUpper(tag, rows[0], rows[1]));
    const auto high23 = hn::BitCast(wide, hn::InterleaveUpper(tag, rows[2], rows[3]));
    out[0] = Lanes(hn::BitCast(tag, hn::InterleaveLower(wide, low01, low23)));
    out[1] = Lanes(hn::BitCast(tag, hn::InterleaveUpper(wide, low01, low23)));
    out[2] = Lanes(hn::BitCast(tag, hn::InterleaveLower(wide, high01, high23)));
    out[3] = Lanes(hn::BitCast(tag, hn::InterleaveUpper(wide, high01, high23)));
}

/// base[index] and base[index + 1] of half of the lanes, side by side.
template <class Half>
FloatVector gather_pairs(const float* base, Half index) {
    const hn::RepartitionToWide<IntTag> wide;
    const auto bytes = hn::ShiftLeft<2>(hn::PromoteTo(wide, index));
    return hn::BitCast(FloatTag(),
                       hn::GatherOffset(wide, reinterpret_cast<const std::int64_t*>(base), bytes));
}

/// Two elements from base[at[0]], base[at[1]], base[at[4]], base[at[5]], ... side by side.
template <int n = lanes>
hn::Vec<hn::FixedTag<double, n / 2>> load_pairs(const float* base, const std::int32_t* at) {
    if constexpr (n == 4) {
        alignas(16) double pair[2];
        __builtin_memcpy(&pair[0], base + at[0], sizeof(double));
        __builtin_memcpy(&pair[1], base + at[1], sizeof(double));
        return hn::Load(hn::FixedTag<double, 2>(), pair);
    } else {
        return hn::Combine(hn::FixedTag<double, n / 2>(), load_pairs<n / 2>(base, at + n / 2),
                           load_pairs<n / 2>(base, at));
    }
}

/// Four elements from base[at[0]], base[at[4]], ... side by side.
template <int n = lanes>
hn::Vec<hn::FixedTag<float, n>> load_quads(const float* base, const std::int32_t* at) {
    if constexpr (n == 4) {
        return hn::LoadU(hn::FixedTag<float, 4>(), base + at[0]);
    } else {
        return hn::Combine(hn::FixedTag<float, n>(), load_quads<n / 2>(base, at + n / 2),
                           load_quads<n / 2>(base, at));
    }
}

/// Asks the memory for what the next packet reads if it lies beside this one. Touches nothing.
inline void fetch_ahead(const float* base, const Addresses& first, const Addresses& below) {
    if constexpr (lanes >= 8) {
        const std::int32_t* const at = first.lane;
        const std::int64_t ahead = 2 * std::int64_t(at[lanes - 4]) - at[0] - at[lanes - 8];
        const auto fetch = [&](std::int64_t index) {
            __builtin_prefetch(reinterpret_cast<const void*>(reinterpret_cast<std::intptr_t>(base) +
                                                             4 * (index + ahead)));
        };
        for (int i = 0; i < lanes; i += 2) fetch(at[i]);
        for (int i = 2; i < lanes; i += 4) fetch(below.lane[i]);
    }
}

inline FloatVector mix(FloatVector a, FloatVector b, FloatVector t) {
    return hn::Add(a, hn::Mul(t, hn::Sub(b, a)));
}

/// The four taps blended with the weights, as stored: row k has the elements of lane k of each
/// quad.
inline void bilinear_rows(const float* base, const LanesInt index[4], Lanes x, Lanes y,
                          FloatVector rows[4]) {
    const Addresses at[4] = {Addresses(index[0]), Addresses(index[1]), Addresses(index[2]),
                             Addresses(index[3])};
    fetch_ahead(base, at[0], at[2]);
    const auto row = [&](int k, FloatVector weight_x, FloatVector weight_y) {
        const auto tap = [&](int i) { return load_quads(base, at[i].lane + k); };
        return mix(mix(tap(0), tap(1), weight_x), mix(tap(2), tap(3), weight_x), weight_y);
    };
    rows[0] = row(0, hn::Broadcast<0>(x.v), hn::Broadcast<0>(y.v));
    rows[1] = row(1, hn::Broadcast<1>(x.v), hn::Broadcast<1>(y.v));
    rows[2] = row(2, hn::Broadcast<2>(x.v), hn::Broadcast<2>(y.v));
    rows[3] = row(3, hn::Broadcast<3>(x.v), hn::Broadcast<3>(y.v));
}

/// fine where t is 0, else blended.
inline FloatVector mix_levels(FloatVector fine, FloatVector coarse, FloatVector t) {
    const FloatTag tag;
    return hn::IfThenElse(hn::Gt(t, hn::Zero(tag)), mix(fine, coarse, t), fine);
}

}  // namespace simd

/// Pairs by 64-bit gathers where a register holds 16 lanes; else by 64-bit loads, then a transpose
/// within each quad: either is cheaper than two gathers.
inline void PacketOps<Lanes>::gather2(const float* base, LanesInt index, Lanes out[2]) {
    const simd::FloatTag tag;
    if constexpr (simd::lanes == 16) {
        const hn::Half<simd::IntTag> half;
        const auto low = simd::gather_pairs(base, hn::LowerHalf(half, index.v));
        const auto high = simd::gather_pairs(base, hn::UpperHalf(half, index.v));
        out[0] = Lanes(hn::ConcatEven(tag, high, low));
        out[1] = Lanes(hn::ConcatOdd(tag, high, low));
    } else {
        const simd::Addresses at(index);
        const auto pair01 = hn::BitCast(tag, simd::load_pairs(base, at.lane));
        const auto pair23 = hn::BitCast(tag, simd::load_pairs(base, at.lane + 2));
        const auto even = hn::InterleaveLower(tag, pair01, pair23);
        const auto odd = hn::InterleaveUpper(tag, pair01, pair23);
        out[0] = Lanes(hn::InterleaveLower(tag, even, odd));
        out[1] = Lanes(hn::InterleaveUpper(tag, even, odd));
    }
}

/// Row k: the four elements of lane k of every quad; then a 4x4 transpose within each quad.
inline void PacketOps<Lanes>::gather4(const float* base, LanesInt index, Lanes out[4]) {
    const simd::Addresses at(index);
    simd::FloatVector rows[4];
    for (int k = 0; k < 4; ++k) rows[k] = simd::load_quads(base, at.lane + k);
    simd::transpose(rows, out);
}

/// Blended as they are stored, so that one transpose does for the four texels.
inline void PacketOps<Lanes>::bilinear4(const float* base, const LanesInt index[4], Lanes weight_x,
                                        Lanes weight_y, Lanes out[4]) {
    simd::FloatVector rows[4];
    simd::bilinear_rows(base, index, weight_x, weight_y, rows);
    simd::transpose(rows, out);
}

/// The same of two levels.
inline void PacketOps<Lanes>::trilinear4(const float* base, const LanesInt fine[4], Lanes fine_x,
                                         Lanes fine_y, const LanesInt coarse[4], Lanes coarse_x,
                                         Lanes coarse_y, Lanes weight, Lanes out[4]) {
    simd::FloatVector rows[4], coarse_rows[4];
    simd::bilinear_rows(base, fine, fine_x, fine_y, rows);
    simd::bilinear_rows(base, coarse, coarse_x, coarse_y, coarse_rows);
    rows[0] = simd::mix_levels(rows[0], coarse_rows[0], hn::Broadcast<0>(weight.v));
    rows[1] = simd::mix_levels(rows[1], coarse_rows[1], hn::Broadcast<1>(weight.v));
    rows[2] = simd::mix_levels(rows[2], coarse_rows[2], hn::Broadcast<2>(weight.v));
    rows[3] = simd::mix_levels(rows[3], coarse_rows[3], hn::Broadcast<3>(weight.v));
    simd::transpose(rows, out);
}

}  // namespace quadrel

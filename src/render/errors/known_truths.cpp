#include "render/errors/known_truths.hpp"

#include <algorithm>

#include "quadrel/raster/tile_buffer.hpp"
#include "render/draw/batch.hpp"

namespace quadrel {
namespace {

/// Those that the batch has.
std::vector<int> arrays_in(const Batch& batch) {
    std::vector<int> slots;
    for (int slot = 0; slot < slot_count; ++slot)
        if (batch.has(slot)) slots.push_back(slot);
    return slots;
}

/// Calls of(q, lane) for what is covered, until it returns false, and returns whether none did.
template <class Of>
bool each_covered(const QuadCoverage* quads, int count, const Of& of) {
    for (int q = 0; q < count; ++q)
        for (int lane = 0; lane < 4; ++lane)
            if (quads[q].samples[static_cast<std::size_t>(lane)] != 0 && !of(q, lane)) return false;
    return true;
}

}  // namespace

KnownTruths::KnownTruths(int width, int height)
    : width_(width),
      triangles_(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), no_triangle) {}

bool KnownTruths::fits(const Batch& truth) const { return arrays_in(truth) == slots_; }

bool KnownTruths::load(const QuadCoverage* quads, int count, Batch& truth) const {
    const bool known = each_covered(quads, count, [&](int q, int lane) {
        return triangles_[pixel(quads[q], lane)] == quads[q].triangle;
    });
    if (!known || !fits(truth)) return false;
    return each_covered(quads, count, [&](int q, int lane) {
        const std::size_t at = pixel(quads[q], lane);
        for (std::size_t s = 0; s < slots_.size(); ++s)
            truth.set_element(slots_[s], 4 * q + lane, values_[s][at]);
        return true;
    });
}

void KnownTruths::store(const QuadCoverage* quads, int count, const Batch& truth) {
    std::call_once(settled_, [&] {
        slots_ = arrays_in(truth);
        values_.assign(slots_.size(), std::vector<std::uint64_t>(triangles_.size()));
    });
    if (!fits(truth)) return;
    each_covered(quads, count, [&](int q, int lane) {
        const std::size_t at = pixel(quads[q], lane);
        triangles_[at] = quads[q].triangle;
        for (std::size_t s = 0; s < slots_.size(); ++s)
            values_[s][at] = truth.element(slots_[s], 4 * q + lane);
        return true;
    });
}

}  // namespace quadrel

// A StageCall with memory of its own, to run one stage by itself.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "quadrel/quad/stage.hpp"

namespace quadrel::quad_tests {

/// Arrays of 16 lanes (four quads) of T, float or double.
template <class T>
class StageBench {
  public:
    static constexpr int lanes = 16;

    StageBench() : arrays_(static_cast<std::size_t>(slot_count)), values_(slot_count, nullptr) {
        active_.fill(0xffffffffu);
        call_.values = values_.data();
        call_.active = active_.data();
        call_.lanes = lanes;
        call_.parameters = &parameters_;
        call_.material = &material;
        call_.frame = &frame;
        call_.counters = counters_.data();
        for (std::size_t i = 0; i < 3; ++i) call_.edges[i] = edges[i].data();
        call_.primitive = primitive.data();
    }
    StageBench(const StageBench&) = delete;

    /// Makes the arrays of a value; stages store only what has arrays.
    void want(Value v) {
        for (int slot = slot_of(v); slot < slot_of(v) + arrays_of(v); ++slot) {
            auto& array = arrays_[static_cast<std::size_t>(slot)];
            array = std::make_unique<Array>();
            values_[static_cast<std::size_t>(slot)] = array->data();
        }
    }
    T& at(Value v, int component, int lane) {
        return (*arrays_[static_cast<std::size_t>(slot_of(v) + component)])[std::size_t(lane)];
    }
    StageCall& call() { return call_; }

    MaterialUniforms material{};
    FrameUniforms frame{};
    std::array<std::array<double, lanes>, 3> edges{};
    std::array<std::int32_t, lanes> primitive{};

  private:
    struct alignas(64) Array : std::array<T, lanes> {};
    std::vector<std::unique_ptr<Array>> arrays_;
    std::vector<void*> values_;
    std::array<std::uint32_t, lanes> active_{};
    NoParams parameters_;
    std::array<FetchCounters, texture_slot_count> counters_{};
    StageCall call_{};
};

}  // namespace quadrel::quad_tests

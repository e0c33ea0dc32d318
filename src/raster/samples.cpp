#include "quadrel/raster/samples.hpp"

#include <array>

#include "quadrel/check.hpp"

namespace quadrel {
namespace {

constexpr std::array<SamplePosition, 1> one{{{8, 8}}};
constexpr std::array<SamplePosition, 2> two{{{12, 12}, {4, 4}}};
constexpr std::array<SamplePosition, 4> four{{{6, 2}, {14, 6}, {2, 10}, {10, 14}}};
constexpr std::array<SamplePosition, 8> eight{
    {{9, 5}, {7, 11}, {13, 9}, {5, 3}, {3, 13}, {1, 7}, {11, 15}, {15, 1}}};
constexpr std::array<SamplePosition, 16> sixteen{{{9, 9},
                                                  {7, 5},
                                                  {5, 10},
                                                  {12, 7},
                                                  {3, 6},
                                                  {10, 13},
                                                  {13, 11},
                                                  {11, 3},
                                                  {6, 14},
                                                  {8, 1},
                                                  {4, 2},
                                                  {2, 12},
                                                  {0, 8},
                                                  {15, 4},
                                                  {14, 15},
                                                  {1, 0}}};

}  // namespace

bool is_sample_count(int samples) {
    return samples == 1 || samples == 2 || samples == 4 || samples == 8 || samples == 16;
}

std::span<const SamplePosition> sample_positions(int samples) {
    switch (samples) {
        case 1:
            return one;
        case 2:
            return two;
        case 4:
            return four;
        case 8:
            return eight;
        case 16:
            return sixteen;
    }
    QUADREL_CHECK(is_sample_count(samples), samples);
    return {};
}

}  // namespace quadrel

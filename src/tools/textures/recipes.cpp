#include "recipes.hpp"

#include <array>

namespace quadrel::textures {

std::span<const Recipe> recipes() {
    static constexpr std::array<Recipe, 11> all{{{"bricks", write_bricks},
                                                 {"calibration", write_calibration},
                                                 {"city", write_city},
                                                 {"dunes", write_dunes},
                                                 {"layers", write_layers},
                                                 {"mip-levels", write_mip_levels},
                                                 {"obstacles", write_obstacles},
                                                 {"sky", write_sky},
                                                 {"spikes", write_spikes},
                                                 {"stones", write_stones},
                                                 {"text", write_text}}};
    return all;
}

}  // namespace quadrel::textures

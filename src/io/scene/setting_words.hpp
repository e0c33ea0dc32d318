// Settings as scene files, attributes and messages spell them.
#pragma once

#include <string_view>
#include <utility>

#include "quadrel/scene/settings.hpp"

namespace quadrel {

inline constexpr std::pair<std::string_view, Conventions> conventions_words[] = {
    {"gl", Conventions::gl}, {"vulkan", Conventions::vulkan}, {"d3d", Conventions::d3d}};

inline constexpr std::pair<std::string_view, Hardware> hardware_words[] = {
    {"exact", Hardware::exact},
    {"d3d", Hardware::d3d},
    {"vulkan-min", Hardware::vulkan_min},
    {"llvmpipe", Hardware::llvmpipe},
    {"swiftshader", Hardware::swiftshader},
    {"chromium", Hardware::chromium}};

}  // namespace quadrel

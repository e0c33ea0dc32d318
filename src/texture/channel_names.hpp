// The names of an image's channels, where a file of another format gets them.
#pragma once

#include <string>
#include <vector>

namespace quadrel {

/// R G B A, or Y A where the first stands for R, G and B; as many of these as there are.
inline std::vector<std::string> channel_names(bool luminance, int channels) {
    const std::vector<std::string> gray = {"Y", "A"}, colours = {"R", "G", "B", "A"};
    const std::vector<std::string>& names = luminance ? gray : colours;
    return {names.begin(), names.begin() + channels};
}

}  // namespace quadrel

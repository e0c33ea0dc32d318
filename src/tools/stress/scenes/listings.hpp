// Which stages give what a published text gives, bit for bit, whatever that is.
#pragma once

#include <algorithm>
#include <iterator>
#include <string>
#include <string_view>

namespace quadrel::stress {

/// Whether a stage transcribes a listing or an engine's shader: its NaNs and its hits beyond the
/// bottom are those of the source.
inline bool is_listing(const std::string& id) {
    constexpr std::string_view all[] = {"frame-thesis",
                                        "linear-thesis",
                                        "pom-dxsdk",
                                        "relief-gg3",
                                        "cone-gg3",
                                        "cone-rabbid",
                                        "cone-rabbid-float",
                                        "cone-dummer-exact",
                                        "rabbid-pom",
                                        "rabbid-relief",
                                        "offset-limit-rabbid",
                                        "shade-gg3",
                                        "babylon",
                                        "bevy",
                                        "godot",
                                        "jmonkey",
                                        "learnopengl",
                                        "o3de",
                                        "playcanvas",
                                        "three-parallax",
                                        "three-parallax-uv",
                                        "unity-pom",
                                        "unreal-bump-offset"};
    return id.find('@') != std::string::npos ||
           std::find(std::begin(all), std::end(all), id) != std::end(all);
}

/// Whether a trace shifts the texture by what one height says, without a search: then hit.s is what
/// the shift comes to, above the top where heights or a bias are.
inline bool is_offset(const std::string& id) {
    return id.starts_with("parallax") || id.starts_with("offset-limit") || id == "trace-none";
}

}  // namespace quadrel::stress

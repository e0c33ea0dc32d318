// What all probes found.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "gl/probe/ask_gl.hpp"

namespace quadrel::gl {

/// The first pixel of a question (of its pictures, row by row) at which answers differ.
struct Difference {
    std::size_t pixel;
    std::array<float, 4> asked, seen, expected;
};

/// One preset's answers beside those of the implementation.
struct PresetResult {
    std::string preset, words;
    std::size_t differing = 0;  ///< answers; 0: agrees
    std::optional<Difference> first{};
};

struct ProbeResult {
    Probe probe;
    std::string missing;  ///< why it could not be asked, or empty
    std::string seen;     ///< answers in few words
    std::size_t answers = 0;
    std::optional<bool> permitted;
    std::vector<PresetResult> presets;  ///< in the order of preset_names
};

/// "exact", "d3d", "vulkan-min", "llvmpipe", "swiftshader".
std::vector<std::string> preset_names();

struct Results {
    std::string renderer, version;
    std::vector<ProbeResult> probes;
};

/// Asks the current context. `only`: the ids to be asked, all where empty.
Results run_probes(const std::vector<std::string>& only);

/// The probes that the preset models and in which it does not agree.
std::vector<const ProbeResult*> disagreements(const Results& results, const std::string& preset);

/// For a terminal: what is seen, and which presets do the same; or, wide, what they do instead.
std::string to_text(const Results& results, bool wide);
std::string to_markdown(const Results& results);
nlohmann::ordered_json to_json(const Results& results);

}  // namespace quadrel::gl

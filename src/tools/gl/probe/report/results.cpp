#include "gl/probe/report/results.hpp"

#include <epoxy/gl.h>
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "gl/context/context.hpp"
#include "io/scene/setting_words.hpp"

namespace quadrel::gl {
namespace {

std::array<float, 4> four(const Values& values, std::size_t pixel) {
    std::array<float, 4> some{};
    for (std::size_t i = 0; i < 4 && 4 * pixel + i < values.size(); ++i)
        some[i] = values[4 * pixel + i];
    return some;
}

std::optional<Difference> first_difference(const Probe& probe, const Values& seen,
                                           const Values& expected) {
    for (std::size_t pixel = 0; 4 * pixel < seen.size(); ++pixel) {
        const auto a = four(seen, pixel), b = four(expected, pixel);
        if (rules::differing(probe, {a.begin(), a.end()}, {b.begin(), b.end()}) == 0) continue;
        const auto& asked = probe.question.asked;
        return Difference{pixel, pixel < asked.size() ? asked[pixel] : std::array<float, 4>{}, a,
                          b};
    }
    return {};
}

PresetResult run_preset(const Probe& probe, std::string_view name, Hardware hardware,
                        const Values* seen) {
    const Values own = rules::answers_of_quadrel(probe, hardware_model(hardware));
    PresetResult result{std::string(name), probe.words(own)};
    if (seen == nullptr) return result;
    result.differing = rules::differing(probe, *seen, own);
    if (result.differing != 0) result.first = first_difference(probe, *seen, own);
    return result;
}

ProbeResult run_probe(const Probe& probe) {
    ProbeResult result{probe, {}, {}, 0, {}, {}};
    Values seen;
    const int version = epoxy_gl_version();
    if (version < probe.question.version) {
        result.missing = fmt::format("needs OpenGL {}.{}", probe.question.version / 10,
                                     probe.question.version % 10);
    } else {
        try {
            seen = answers_of_gl(probe);
            result.seen = probe.words(seen);
            if (probe.legal) result.permitted = probe.legal(seen);
        } catch (const std::runtime_error& error) {
            result.missing = error.what();
        }
    }
    result.answers = seen.size();
    for (const auto& [name, hardware] : hardware_words)
        result.presets.push_back(
            run_preset(probe, name, hardware, result.missing.empty() ? &seen : nullptr));
    return result;
}

}  // namespace

std::vector<std::string> preset_names() {
    std::vector<std::string> names;
    for (const auto& [name, hardware] : hardware_words) names.emplace_back(name);
    return names;
}

Results run_probes(const std::vector<std::string>& only) {
    Results results{gl_string(GL_RENDERER), gl_string(GL_VERSION), {}};
    for (const Probe& probe : rules::all_probes())
        if (only.empty() || std::find(only.begin(), only.end(), probe.id) != only.end())
            results.probes.push_back(run_probe(probe));
    return results;
}

std::vector<const ProbeResult*> disagreements(const Results& results, const std::string& preset) {
    std::vector<const ProbeResult*> found;
    for (const ProbeResult& result : results.probes) {
        if (!result.probe.not_modelled.empty() || !result.missing.empty()) continue;
        for (const PresetResult& one : result.presets)
            if (one.preset == preset && one.differing != 0) found.push_back(&result);
    }
    return found;
}

}  // namespace quadrel::gl

#include "gl/probe/planted.hpp"

#include <epoxy/gl.h>

#include "gl/probe/ask_gl.hpp"
#include "io/scene/setting_words.hpp"

namespace quadrel::gl {
namespace {

struct Term {
    const char* name;
    void (*change)(HardwareModel&);
};

constexpr Term terms[] = {
    {"sub-pixel bits", [](HardwareModel& m) { m.subpixel_bits = m.subpixel_bits == 4 ? 8 : 4; }},
    {"rounding of vertices", [](HardwareModel& m) { m.snap_rounding = SnapRounding::half_away; }},
    {"interpolation", [](HardwareModel& m) { m.interpolation = Interpolation::exact; }},
    {"derivatives",
     [](HardwareModel& m) {
         m.derivatives =
             m.derivatives == DerivativeMode::fine ? DerivativeMode::coarse : DerivativeMode::fine;
     }},
    {"level of detail", [](HardwareModel& m) { m.lod_form = LodForm::sqrt_max; }},
    {"bits of weights", [](HardwareModel& m) { m.weight_bits = 8; }},
    {"bits of levels", [](HardwareModel& m) { m.lod_bits = 8; }},
    {"scaling before wrapping", [](HardwareModel& m) { m.scale_first = !m.scale_first; }},
    {"one level a quad",
     [](HardwareModel& m) {
         m.quad_lod = false;
         m.derivatives = DerivativeMode::fine;  // coarse ones are the quad's anyway
     }},
    {"rounding of levels", [](HardwareModel& m) { m.level_rounding = LevelRounding::finer; }}};

}  // namespace

int term_count() { return static_cast<int>(std::size(terms)); }

std::string unnoticed_terms(const std::string& preset) {
    HardwareModel as_is;
    for (const auto& [name, hardware] : hardware_words)
        if (name == preset) as_is = hardware_model(hardware);
    std::vector<bool> noticed(std::size(terms));
    for (const Probe& probe : rules::all_probes()) {
        if (!probe.not_modelled.empty() || probe.question.version > epoxy_gl_version()) continue;
        const Values seen = answers_of_gl(probe);
        if (rules::differing(probe, seen, rules::answers_of_quadrel(probe, as_is)) != 0) continue;
        for (std::size_t i = 0; i < noticed.size(); ++i) {
            if (noticed[i]) continue;
            HardwareModel changed = as_is;
            terms[i].change(changed);
            noticed[i] =
                rules::differing(probe, seen, rules::answers_of_quadrel(probe, changed)) != 0;
        }
    }
    std::string text;
    for (std::size_t i = 0; i < noticed.size(); ++i)
        if (!noticed[i]) text += (text.empty() ? "" : ", ") + std::string(terms[i].name);
    return text;
}

}  // namespace quadrel::gl

#include "rules/page.hpp"

#include <algorithm>
#include <bit>
#include <map>

#include "bake/wrap_names.hpp"
#include "io/document/json.hpp"
#include "io/scene/setting_words.hpp"
#include "page/bits.hpp"
#include "rules/ask/shader_text.hpp"
#include "rules/probe.hpp"
#include "texture/texel_format.hpp"

namespace quadrel::rules {
namespace {

constexpr const char* head =
    "#version 300 es\n"
    "precision highp float;\nprecision highp int;\n"
    "precision highp sampler2D;\nprecision highp samplerCube;\nprecision highp usampler2D;\n";

using Words = std::vector<std::uint32_t>;

/// Lists of bits one after the other, equal ones once.
class Numbers {
  public:
    /// The list's number.
    std::size_t add(const Words& words) {
        const auto [at, is_new] = known_.emplace(words, lengths_.size());
        if (is_new) {
            all_.insert(all_.end(), words.begin(), words.end());
            lengths_.push_back(words.size());
        }
        return at->second;
    }
    /// Every `parts`-th number from each of the first ones on.
    Json add_parts(const Words& words, std::size_t parts) {
        Json lists = Json::array();
        for (std::size_t part = 0; part < parts; ++part) {
            Words list;
            for (std::size_t i = part; i < words.size(); i += parts) list.push_back(words[i]);
            lists.push_back(add(list));
        }
        return lists;
    }
    const Words& all() const { return all_; }
    const std::vector<std::size_t>& lengths() const { return lengths_; }

  private:
    Words all_;
    std::vector<std::size_t> lengths_;
    std::map<Words, std::size_t> known_;
};

template <class Floats>
void append_bits(const Floats& floats, Words& words) {
    for (const float value : floats) words.push_back(std::bit_cast<std::uint32_t>(value));
}

Json sampler_json(const SamplerState& state) {
    const auto filter = [](Filter of) { return of == Filter::nearest ? "nearest" : "linear"; };
    const char* const mips[] = {"none", "nearest", "linear"};
    return {{"wrap", {wrap_name(state.wrap_u), wrap_name(state.wrap_v)}},
            {"mag", filter(state.mag)},
            {"min", filter(state.min)},
            {"mip", mips[static_cast<int>(state.mip)]},
            {"lod_min", state.lod_min},
            {"lod_max", state.lod_max}};
}

Json map_json(const ProbeTexture& map, Numbers& numbers) {
    Json levels = Json::array();
    for (const std::vector<float>& level : map.levels) {
        Words words;
        append_bits(level, words);
        levels.push_back(numbers.add(words));
    }
    return {{"format", format_name(map.format)},
            {"channels", map.channels},
            {"cube", map.cube},
            {"size", {map.width, map.height}},
            {"levels", levels},
            {"sampler", sampler_json(map.sampler)}};
}

Words words_of(const std::vector<Triangle>& triangles) {
    Words words;
    for (const Triangle& triangle : triangles)
        for (const Corner& corner : triangle) {
            append_bits(corner.position, words);
            append_bits(corner.varying, words);
        }
    return words;
}

Json question_json(const Question& question, Numbers& numbers) {
    Json json{{"size", {question.width, question.height}},
              {"fragment", fragment_text(question, head)},
              {"apart", question.apart},
              {"maps", Json::array()}};
    for (const ProbeTexture& map : question.maps) json["maps"].push_back(map_json(map, numbers));
    Words asked;
    for (const auto& number : question.asked) append_bits(number, asked);
    asked.resize(static_cast<std::size_t>(4 * question.width * question.height));
    json["asked"] = numbers.add_parts(asked, 4);
    const std::vector<Triangle>& triangles = question.triangles;
    json["triangles"] =
        numbers.add_parts(words_of(triangles.empty() ? std::vector{whole_frame()} : triangles), 8);
    return json;
}

/// Why WebGL 2 cannot be asked; empty: it can.
std::string missing_in_browsers(const Probe& probe) {
    if (probe.by_samples) return "WebGL 2 reads no samples of a pixel one by one";
    if (probe.question.version <= 33) return "";
    for (const char* function : {"dFdxCoarse", "textureQueryLod", "textureGather", "fma"})
        if (probe.question.glsl.find(std::string(function) + "(") != std::string::npos)
            return std::string("GLSL ES 3.0 has no ") + function;
    return "needs a newer version of OpenGL";
}

Json answers_json(const Probe& probe, Numbers& numbers) {
    Json answers = Json::array();
    Words first;
    for (const auto& [name, hardware] : hardware_words) {
        Words words;
        append_bits(answers_of_quadrel(probe, hardware_model(hardware)), words);
        if (first.empty())
            first = words;
        else  // presets agree in most, which takes no room then
            for (std::size_t i = 0; i < words.size(); ++i) words[i] ^= first[i];
        answers.push_back(numbers.add_parts(words, 4));
    }
    return answers;
}

}  // namespace

std::string probes_for_page() {
    Numbers numbers;
    Json presets = Json::array(), probes = Json::array();
    for (const auto& [name, hardware] : hardware_words) presets.push_back(name);
    for (const Probe& probe : all_probes()) {
        const std::string missing = missing_in_browsers(probe);
        probes.push_back({{"id", probe.id},
                          {"asks", probe.asks},
                          {"permits", probe.permits},
                          {"not_modelled", probe.not_modelled},
                          {"tolerance", probe.tolerance},
                          {"missing", missing},
                          {"question", question_json(probe.question, numbers)},
                          {"answers", answers_json(probe, numbers)}});
        if (!missing.empty()) probes.back()["question"].erase("fragment");
    }
    const Words& all = numbers.all();
    const Json described{{"vertex", vertex_text(head)},
                         {"presets", presets},
                         {"probes", probes},
                         {"lengths", numbers.lengths()},
                         {"numbers", page::packed_bits(all)}};
    return page::packed_text(described.dump());
}

}  // namespace quadrel::rules

// The rules for loops of stage texts (src/README.md, "Loops"), as far as a text tells.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>

#include "sources/code_blocks.hpp"

namespace quadrel::source_tests {

/// What breaks a rule, in words; empty: nothing.
using Finding = std::string;

/// Loops and branches of the host in headers that texts include: none is over lanes, or it chooses
/// a texture's levels, which shaders have of their own.
inline bool is_the_hosts(std::string_view statement) {
    static constexpr std::array<std::string_view, 7> known = {
        "while (k > 0 && below(k - 1))",
        "while (k <= n && !below(k))",
        "for (int side = width > height ? width : height; side > 1; side /= 2)",
        "for (int c = 0; c < view.channels; ++c)",
        "for (std::size_t i = 0; i + 1 < slots.size(); ++i)",
        "for (int lane = 0; lane < call->lanes; lane += lanes_of<F>)",
        "if (texture.sampler.mip == MipFilter::nearest || none(lod.frac > F(0)))"};
    return std::ranges::find(known, statement) != known.end();
}

/// Whether a count is known to the compiler: a literal, a constant or a template's parameter of the
/// same file, the lanes of a packet; or the number of lights, by which values are named.
inline bool is_fixed_count(const std::string& code, const std::string& count) {
    static const std::regex known(R"(\d+|lanes_of<F>|io\.frame\(\)\.light_count)");
    if (std::regex_match(count, known)) return true;
    const std::string name = count.substr(count.rfind('.') + 1);
    if (!std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) || c == '_'; }))
        return false;
    const std::regex declared("constexpr [A-Za-z_:0-9]+ " + name + "\\b" +
                              "|template <[^>]*\\b(int|length_t|size_t) " + name + "\\b");
    return std::regex_search(code, declared);
}

/// A loop that is written out: for (int c = 0; c < channels; ++c).
inline bool is_written_out(const std::string& code, const std::string& head) {
    static const std::regex counted(
        R"([a-z_:0-9]+ (\w+) = \d+; (\w+) < ([^;]+); (\+\+\w+|\w+ \+= \d+))");
    std::smatch match;
    return std::regex_match(head, match, counted) && match[1] == match[2] &&
           is_fixed_count(code, match[3]);
}

/// The name of the step in the head of a loop by words; empty for other loops.
inline std::string step_name(const std::string& head) {
    static const std::regex words(
        R"(const auto (\w+) :\s+((quadrel::)?(steps|rounds|steps_near_surface|steps_on_course)<\w+(, Before::needed)?>|ray\.steps)\([^;]*\))");
    std::smatch match;
    return std::regex_match(head, match, words) ? match[1].str() : "";
}

inline std::ptrdiff_t count_of(const std::string& code, const std::regex& what) {
    return std::distance(std::sregex_iterator(code.begin(), code.end(), what),
                         std::sregex_iterator());
}

/// Every way out of a loop is `if (none(...)) break;`.
inline Finding ways_out(const std::string& body) {
    const std::string own = without_lambdas(body);
    static const std::regex returned("\\breturn\\b");
    if (std::regex_search(own, returned)) return "returns out of a loop";
    static const std::regex leave("\\bbreak;"), none("\\bif \\(none\\(");
    return count_of(own, leave) == count_of(own, none) ? ""
                                                       : "leaves a loop by other words than none";
}

/// A step's number is asked for by number<F>(k): nothing is chosen by it, and no array indexed.
inline Finding uses_of_step(const std::string& body, const std::string& k) {
    const std::string named = "\\b" + k + "\\b";
    if (std::regex_search(body, std::regex("\\[[^\\[\\]]*" + named + "[^\\[\\]]*\\]")))
        return "indexes by a step";
    if (std::regex_search(body, std::regex("(" + named + "[^;{}]*\\?|\\?[^;{}]*" + named + ")")))
        return "chooses by a step";
    for (const char* keyword : {"if", "for", "while", "switch"})
        for (const Block& block : blocks_of(body, keyword))
            if (std::regex_search(block.head, std::regex(named))) return "branches by a step";
    return "";
}

/// What a loop assigns has a value before it. `before`: of the loop's function.
inline Finding empty_before(const std::string& before, const std::string& body) {
    static const std::regex assigned(R"((^|[;{}])\s*(\w+)[.\w]* = )");
    for (std::sregex_iterator i(body.begin(), body.end(), assigned), end; i != end; ++i) {
        const std::string name = (*i)[2];
        const std::regex empty("\\b(F|(Int|Mask|vec[234])<F>) ([^;(){}]*, )?" + name +
                               "(, [^;]*)?;");
        if (std::regex_search(before, empty)) return name + " has no value before its loop";
    }
    return "";
}

inline Finding loop_finding(const std::string& code) {
    static const std::regex loop("\\b(for|while) \\(|\\bdo \\{");
    if (!mentions(code, {"for (", "while (", "do {"})) return "";
    for (std::sregex_iterator i(code.begin(), code.end(), loop), end; i != end; ++i) {
        const std::string keyword = (*i)[1];
        if (keyword.empty()) return "has a do loop";
        const auto [head, body] = block_at(code, std::size_t(i->position() + i->length() - 1));
        const std::string statement = fmt::format("{} ({})", keyword, head);
        if (is_the_hosts(statement)) continue;
        const std::string k = step_name(head);
        if (k.empty()) {
            const bool over_words = std::regex_search(head, std::regex("steps|rounds"));
            const bool over_container =
                keyword == "for" && head.find(';') == std::string::npos && !over_words;
            if (over_container || is_written_out(code, head)) continue;
            return fmt::format("has {}", statement);
        }
        for (const Finding& found :
             {ways_out(body), uses_of_step(body, k),
              empty_before(function_before(code, std::size_t(i->position())), body)})
            if (!found.empty()) return fmt::format("{}: {}", statement, found);
    }
    return "";
}

/// `if (word(mask))` and no more in its head.
inline bool asks_alone(const Block& block, const std::string& word) {
    return block.head.starts_with(word + "(") &&
           after_bracket(block.head, word.size()) == block.head.size();
}

/// Lanes are asked by `if (none(...)) break;` and `if (when(...))`, which is left at its end.
inline Finding branch_finding(const std::string& code) {
    static const std::regex any("\\bany\\("), asked("\\b(none|when)\\(");
    static const std::regex left("\\b(return|break)\\b"), returned("\\breturn\\b");
    if (!mentions(code, {"any(", "none(", "when("})) return "";
    if (std::regex_search(code, any)) return "asks any";
    std::ptrdiff_t in_heads = 0;
    for (const Block& block : blocks_of(code, "if")) {
        const std::ptrdiff_t here = count_of(block.head, asked);
        in_heads += here;
        if (here == 0 || is_the_hosts(fmt::format("if ({})", block.head))) continue;
        if (asks_alone(block, "none") && block.body == "break;") continue;
        const bool has_loop = block.body.find("for (") != std::string::npos;
        const bool leaves =
            std::regex_search(without_lambdas(block.body), has_loop ? returned : left);
        if (!asks_alone(block, "when") || leaves)
            return fmt::format("has if ({}) {}", block.head, block.body);
    }
    return count_of(code, asked) == in_heads ? "" : "asks none or when without if";
}

/// Texels and uniforms are reached by words too.
inline Finding access_finding(const std::string& path, const std::string& code) {
    static const std::regex rooms("/(relief|shade)/"), uniforms("\\b(Frame|Light)Uniforms\\b");
    static const std::regex texels("\\bgather2?<F>\\(\\s*[a-z_.]*texels\\b|texels \\+");
    if (!mentions(code, {"Uniforms", "texels"}) || !std::regex_search(path, rooms)) return "";
    if (std::regex_search(code, uniforms)) return "names a type of uniforms";
    if (!path.ends_with("relief/cells.hpp") && std::regex_search(code, texels))
        return "reads texels by a pointer";
    return "";
}

}  // namespace quadrel::source_tests

#include "rows.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace quadrel::peers {
namespace {

std::string search(const std::string& trace, const std::string& more = "") {
    return R"(material.relief={"frame":"frame-gram","surface":"none","shadow":"none","depth":0.05,)"
           R"("trace":")" +
           trace + "\"" + more + "}";
}

/// A search under matte light; `parameters` as they follow in JSON.
Row searching(const std::string& name, const std::string& title, const std::string& trace,
              const std::string& parameters, const std::string& shader,
              const std::vector<std::string>& defines) {
    return {name,
            title,
            {search(trace, parameters)},
            {"surface", shader, "shadow_none", "relief"},
            defines};
}

Row linear(int steps) {
    return searching(fmt::format("linear-{}", steps), fmt::format("linear {}", steps), "linear",
                     fmt::format(",\"steps\":{}", steps), "trace_linear",
                     {fmt::format("STEPS {}", steps)});
}

/// Heights with levels, two of them blended: what maps have unless a scene says otherwise.
Row with_levels(Row row) {
    row.name += "-levels";
    row.title += ", heights with mip levels";
    row.overrides.insert(row.overrides.end(),
                         {"textures.height.mip=box", "textures.height.min=linear-mipmap-linear"});
    return row;
}

constexpr const char* no_relief =
    R"(material.relief={"frame":"none","trace":"none","surface":"none","shadow":"none"})";

Row unlit() {
    return {"unlit",
            "trilinear texture, unlit",
            {no_relief, "material.shade=shade-texture"},
            {"surface", "unlit"},
            {}};
}

Row plain() {
    return {"plain", "trilinear texture, one light", {no_relief}, {"surface", "plain"}, {}};
}

Row steep() {
    Row row = searching("steep-30", "steep 30, shadow-march-mcguire", "steep", ",\"steps\":30",
                        "trace_steep", {"STEPS 30"});
    row.overrides.emplace_back("material.relief.shadow=shadow-march-mcguire");
    row.shaders[2] = "shadow_mcguire";
    return row;
}

/// Steps are long: a pixel that meets another one, by the last bit of a coordinate, lies elsewhere.
Row thesis(const std::string& depth) {
    return {"thesis-" + depth,
            "the thesis' whole shader, depth " + depth,
            {R"(material.relief={"frame":"frame-thesis","trace":"linear-thesis",)"
             R"("surface":"h2n-thesis@published","shadow":"shadow-march-thesis@published",)"
             R"("depth":)" +
                 depth + "}",
             "material.shade=shade-thesis@published", "material.gloss=gloss"},
            {"thesis"},
            {},
            {},
            2e-3};
}

Row max_mip() {
    Row row = searching("max-mip", "max-mip (exact); llvmpipe: QDM, capped", "max-mip", "",
                        "trace_qdm", {"NODES 1024"});
    row.shader_draws = {search("qdm")};
    return row;
}

}  // namespace

std::vector<std::string> Row::judged_overrides() const {
    std::vector<std::string> all = shader_draws.empty() ? overrides : shader_draws;
    all.emplace_back("hardware=llvmpipe");
    return all;
}

const std::vector<Row>& drawn_rows() {
    static const std::vector<Row> rows{
        unlit(),
        plain(),
        searching("offset-limit", "offset-limit", "offset-limit", "", "trace_offset_limit", {}),
        linear(256),
        linear(1024),
        with_levels(linear(256)),
        searching("relief-binary", "relief-binary 256 + 7", "relief-binary",
                  ",\"steps\":256,\"binary_steps\":7", "trace_relief_binary",
                  {"STEPS 256", "BINARY_STEPS 7"}),
        steep(),
        searching("rabbid-pom", "rabbid-pom", "rabbid-pom", "", "trace_rabbid_pom", {}),
        thesis("0.05"),
        thesis("1.0"),
        max_mip()};
    return rows;
}

const Row& row_of(const std::string& name) {
    const auto& rows = drawn_rows();
    return *std::find_if(rows.begin(), rows.end(),
                         [&](const Row& row) { return row.name == name; });
}

std::vector<std::string> row_names() {
    std::vector<std::string> names;
    for (const Row& row : drawn_rows()) names.push_back(row.name);
    return names;
}

std::string joined(const std::vector<std::string>& words) {
    return fmt::format("{}", fmt::join(words, ", "));
}

}  // namespace quadrel::peers

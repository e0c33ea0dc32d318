#include "export/export.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include <sstream>

#include "file/module_path.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

const ExportTable& load_table() {
    const auto path = find_module("quadrel-shaders");
    if (!path) throw UsageError("export: the module quadrel-shaders is not installed");
    void* const module = dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
    if (module == nullptr) throw UsageError(fmt::format("export: {}", dlerror()));
    using TableFunction = const ExportTable* (*)();
    const auto function = reinterpret_cast<TableFunction>(dlsym(module, export_symbol));
    const ExportTable* const table = function != nullptr ? function() : nullptr;
    if (table == nullptr || table->magic != export_magic ||
        table->abi_version != export_abi_version)
        throw UsageError(
            fmt::format("export: {} is not of this version of Quadrel", path->string()));
    return *table;
}

}  // namespace

const ExportTable& export_table() {
    static const ExportTable& table = load_table();
    return table;
}

std::vector<ExportRow> export_rows() {
    std::vector<ExportRow> rows;
    export_table().stages(
        [](void* to, const ExportedStage* stage) {
            static_cast<std::vector<ExportRow>*>(to)->push_back(
                {stage->id, stage->room, stage->refusal != nullptr ? stage->refusal : ""});
        },
        &rows);
    return rows;
}

namespace {

/// What cannot be written stands in the list, with the reason.
[[noreturn]] void refuse(const std::string& reason) {
    throw UsageError("export: " + reason + " (see `quadrel export --list`)");
}

}  // namespace

std::string export_stages(std::span<const StageUse> stages, const ExportOptions& options) {
    std::string text;
    const ExportRequest request{
        options.language.c_str(),
        stages.data(),
        static_cast<std::int32_t>(stages.size()),
        options.side,
        options.lights,
        options.wrap_u,
        options.wrap_v,
        options.seat,
        options.uniforms ? 1 : 0,
        [](void* to, const char* part) { *static_cast<std::string*>(to) += part; },
        &text};
    if (!export_table().write(&request)) refuse(text);
    return text;
}

namespace {

/// "TYPE NAME" or "TYPE NAME NUMBER".
ProgramName program_name(const std::string& text) {
    ProgramName of;
    std::istringstream(text) >> of.type >> of.name >> of.number;
    return of;
}

struct ProgramParts {
    Program program;
    std::string refusal;

    void put(const std::string& part, const std::string& text) {
        if (part == "vertex") program.vertex = text;
        if (part == "fragment") program.fragment = text;
        if (part == "attribute") program.attributes.push_back(program_name(text));
        if (part == "uniform") program.uniforms.push_back(program_name(text));
        if (part == "sampler") program.samplers.push_back(program_name(text));
        if (part == "refusal") refusal = text;
    }
};

}  // namespace

Program export_program(ProgramRequest request) {
    ProgramParts parts;
    request.put = [](void* to, const char* part, const char* text) {
        static_cast<ProgramParts*>(to)->put(part, text);
    };
    request.to = &parts;
    if (!export_table().write_program(&request)) refuse(parts.refusal);
    return parts.program;
}

NamedFloats vertex_program_values(ProgramRequest request, const VertexList& vertices,
                                  const NamedFloats& uniforms) {
    std::string refusal;
    request.put = [](void* to, const char*, const char* text) {
        *static_cast<std::string*>(to) = text;
    };
    request.to = &refusal;
    NamedFloats found;
    const VertexRun run{&request,
                        vertices.count,
                        vertices.position.data(),
                        vertices.normal.data(),
                        vertices.tangent.data(),
                        vertices.binormal.data(),
                        vertices.uv.data(),
                        [](const void* of, const char* name) -> const float* {
                            const auto& all = *static_cast<const NamedFloats*>(of);
                            const auto uniform = all.find(name);
                            return uniform != all.end() ? uniform->second.data() : nullptr;
                        },
                        &uniforms,
                        [](void* to, const char* name, const float* values, std::int32_t number) {
                            (*static_cast<NamedFloats*>(to))[name].assign(values, values + number);
                        },
                        &found};
    if (!export_table().run_vertices(&run)) refuse(refusal);
    return found;
}

}  // namespace quadrel

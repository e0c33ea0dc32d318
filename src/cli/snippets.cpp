#include "cli/snippets.hpp"

#include <algorithm>
#include <cstdint>
#include <vector>

#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "file/data_path.hpp"
#include "file/read_file.hpp"
#include "quadrel/film/exr.hpp"
#include "text/suggest.hpp"

namespace quadrel::cli {
namespace {

std::string snippet(const std::string& file) {
    return read_whole_file(find_data_file(std::filesystem::path("snippets") / file));
}

ExitCode print_snippets(const std::string& language) {
    const std::vector<std::string> languages = {"glsl", "hlsl", "wgsl", "glsl-es"};
    if (language.empty()) {
        for (const char* file : {"pack.glsl", "pack.hlsl", "pack.wgsl"})
            print(std::string("// ") + file + "\n" + snippet(file) + "\n");
        return ExitCode::ok;
    }
    if (std::find(languages.begin(), languages.end(), language) == languages.end())
        throw UsageError("--language: found \"" + language + "\", expected " +
                         one_of(language, languages));
    if (language == "glsl-es") print("precision highp float;\nprecision highp int;\n");
    print(snippet("pack." + (language == "glsl-es" ? "glsl" : language)));
    return ExitCode::ok;
}

ExitCode write_pattern(const std::string& size, const std::string& output) {
    const Size pixels = parse_size("--pattern", size);
    check_output_kinds({{"-o", ".exr", output}});
    if (output.empty()) throw UsageError("--pattern: expected with -o pattern.exr");
    CommandFiles files;
    files.add_output("-o", output);
    files.check_writable();
    const Window frame{0, 0, pixels.width, pixels.height};
    Film film{frame, frame, {}};
    Plane& pattern = film.add("pattern", ChannelType::uint32);
    for (std::size_t i = 0; i < pattern.bits.size(); ++i) {
        const auto width = static_cast<std::size_t>(pixels.width);
        pattern.bits[i] = static_cast<std::uint32_t>(i % width) * 2654435761u +
                          static_cast<std::uint32_t>(i / width) * 2246822519u;
    }
    write_exr(output, film, {});
    say_written(output);
    return ExitCode::ok;
}

}  // namespace

void add_snippet_options(CLI::App& verb, SnippetArguments& arguments) {
    verb.add_flag("--snippets", arguments.snippets,
                  "print functions that pack a float's 32 bits into codes of 8, 10 or 16 bits, for "
                  "compare --decode");
    verb.add_option("--pattern", arguments.pattern,
                    "write what pattern_bits of the snippets gives, as an EXR of this size")
        ->type_name("WxH");
}

ExitCode run_snippets(const SnippetArguments& arguments, const std::string& language,
                      const std::string& output) {
    if (arguments.snippets && !arguments.pattern.empty())
        throw UsageError("export: found --snippets and --pattern, expected one of them");
    return arguments.snippets ? print_snippets(language) : write_pattern(arguments.pattern, output);
}

}  // namespace quadrel::cli

// quadrel compare: strict about NaN, infinities, sizes and channels.
#include "quadrel/compare.hpp"

#include <CLI/CLI.hpp>
#include <memory>

#include "cli/common/arguments.hpp"
#include "cli/common/command_files.hpp"
#include "cli/common/console.hpp"
#include "cli/common/hints.hpp"
#include "cli/common/plugins.hpp"
#include "cli/common/selection_options.hpp"
#include "cli/compare/against.hpp"
#include "cli/compare/arguments.hpp"
#include "cli/compare/blame.hpp"
#include "cli/compare/decode.hpp"
#include "cli/compare/images.hpp"
#include "cli/compare/legal.hpp"
#include "cli/compare/region.hpp"
#include "cli/verbs.hpp"
#include "cli/view.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/heatmap.hpp"
#include "quadrel/film/preview.hpp"
#include "text/printable.hpp"

namespace quadrel::cli {
namespace {

constexpr const char* details =
    "A channel differs where its bits differ and no tolerance given for it allows that; a NaN on "
    "one\n"
    "side, a missing channel, another size or window always do. CHANNEL is a channel or a group, "
    "as\n"
    "in --abs N=1e-3, and wins over a bare VALUE. Integers pass by equal bits, or by --abs of "
    "their\n"
    "full name.\n"
    "--encode srgb8 and unorm8: R G B A, and what either image stores in 8 bits, become the "
    "nearest\n"
    "code (rounded on the encoded side, 0.5 up; below 0 gives 0, above 1 gives 255; A is linear).\n"
    "Codes of an 8-bit file stay as they are; --ulp counts codes. half: every float becomes the\n"
    "nearest half, ties to even; --ulp counts halves.\n"
    "--legal: REF holds what each value may be, from gpu.lo.X to gpu.hi.X in gpu.paths.X ranges,\n"
    "of which none reaches into the gap from gpu.gap.lo.X to gpu.gap.hi.X, where REF has one.\n"
    "A value outside fails, as does a NaN where neither end is one, and a missing pixel. Within, "
    "it\n"
    "is unconstrained if nothing is known (no paths), or the ranges are infinite or wide; "
    "ambiguous "
    "if\n"
    "there are several ranges; else it passes. Exit code 0: nothing fails, no channel is lacking, "
    "and\n"
    "no channel has more ambiguous or unconstrained pixels than it may.";

struct CompareArguments {
    std::string reference, test, channels, heatmap, page, encode, blame, ignored_flags, against;
    std::vector<std::string> mappings, overrides, plugins, decode;
    ToleranceArguments tolerances;
    ImageSelection selection, reference_selection;
    RegionArguments region;
    LegalArguments legal;
    bool flip_y = false, json = false;
};

Encoding encoding_argument(const std::string& text) {
    if (text.empty()) return Encoding::none;
    const std::optional<Encoding> encoding = parse_encoding(text);
    if (!encoding)
        throw UsageError("--encode: found \"" + text + "\", expected srgb8, unorm8 or half");
    return *encoding;
}

/// The pixels that --ignore-flags leaves out.
std::vector<bool> left_out(const std::string& flags, const Film& reference) {
    if (flags.empty()) return {};
    try {
        return flagged_pixels(reference, parse_hit_flags(parse_list("--ignore-flags", flags)));
    } catch (const UsageError& error) {
        throw UsageError(std::string("--ignore-flags: ") + error.what());
    }
}

/// Gives the test image the reference's values where nothing is compared.
void fill_left_out(const Film& reference, Film& test, const std::vector<bool>& left_out) {
    for (Plane& plane : test.planes) {
        const Plane* right = reference.find(plane.name);
        for (std::size_t i = 0; right != nullptr && i < left_out.size(); ++i)
            if (left_out[i]) plane.bits[i] = right->bits[i];
    }
}

/// What need be read, where that is known beforehand.
std::optional<Window> wanted_part(const CompareArguments& arguments) {
    if (arguments.region.window.empty() || arguments.flip_y || !arguments.decode.empty())
        return std::nullopt;
    return parse_window("--window", arguments.region.window);
}

/// Both images, turned and renamed, and which pixels are compared.
Images read_images(const CompareArguments& arguments) {
    const Encoding encoding = encoding_argument(arguments.encode);
    const std::vector<ChannelMapping> mappings = parse_mappings(arguments.mappings);
    const auto wanted = wanted_part(arguments);
    Images images{read_comparable(arguments.reference, arguments.reference_selection, wanted),
                  read_comparable(arguments.test, arguments.selection, wanted),
                  {},
                  {}};
    ComparableImage &reference = images.reference, &test = images.test;
    decode_test(arguments.decode, arguments.legal.wanted, images);
    if (arguments.flip_y) flip_y(test.film);
    map_channels(test, mappings);
    const auto region = keep_region(arguments.region, reference.film, test.film);
    images.rules.left_out = left_out(arguments.ignored_flags, reference.film);
    images.preparation = {reference.file.string(), test.file.string(), "", "",    encoding,
                          arguments.flip_y,        mappings,           {}, region};
    images.preparation.decoded = decoded_channels(arguments.decode, test.file.string());
    return images;
}

/// Options that --against has no use for.
void refuse_beside_against(const CompareArguments& a) {
    const ToleranceArguments& t = a.tolerances;
    const std::pair<const char*, bool> given[] = {
        {"--rel", !t.rel.empty()},
        {"--ulp", !t.ulp.empty()},
        {"--encode", !a.encode.empty()},
        {"--decode", !a.decode.empty()},
        {"--blame", !a.blame.empty()},
        {"--heatmap", !a.heatmap.empty()},
        {"--page", !a.page.empty()},
        {"--ignore-flags", !a.ignored_flags.empty()},
        {"--overlap", a.region.overlap},
        {"--reference-layer", !a.reference_selection.layer.empty()},
        {"--reference-part", !a.reference_selection.part.empty()},
        {"--legal", a.legal.wanted}};
    for (const auto& [option, is_given] : given)
        if (is_given) throw UsageError(std::string(option) + ": not with --against");
}

ExitCode run_compare_against(const CompareArguments& a) {
    refuse_beside_against(a);
    return run_against({a.reference, a.test, a.channels, a.region.window, a.mappings, a.overrides,
                        a.plugins, a.tolerances, a.selection, a.flip_y, a.json});
}

Images prepare(const CompareArguments& arguments) {
    const std::vector<ToleranceRule> tolerances = parse_tolerances(arguments.tolerances);
    Images images = read_images(arguments);
    const std::vector<std::string> channels = arguments.channels.empty()
                                                  ? std::vector<std::string>()
                                                  : parse_list("--channels", arguments.channels);
    prepare_comparison(tolerances, "--channels", channels, images);
    return images;
}

template <class Report>
void print_report(Report& report, bool json) {
    if (json) return print_json(to_json(report));
    for (std::string* name : {&report.preparation->reference_file, &report.preparation->test_file})
        *name = printable(*name);
    print(to_text(report));
}

/// What has a meaning beside other options only.
void check_combinations(const CompareArguments& arguments) {
    const bool blame = !arguments.blame.empty(), legal = arguments.legal.wanted;
    if (!blame && !arguments.overrides.empty())
        throw UsageError("-D: expected with --blame or --against only");
    if (!blame && !arguments.plugins.empty())
        throw UsageError("--plugin: expected with --blame or --against only");
    if (legal && blame) throw UsageError("--blame: not with --legal");
    const ToleranceArguments& tolerances = arguments.tolerances;
    for (const auto& [option, values] : {std::pair{"--abs", &tolerances.abs},
                                         {"--rel", &tolerances.rel},
                                         {"--ulp", &tolerances.ulp},
                                         {"--fraction", &tolerances.fraction}})
        if (legal && !values->empty())
            throw UsageError(std::string(option) +
                             ": not with --legal, whose reference says what is permitted");
}

void write_page(const std::string& file, Images images) {
    if (file.empty()) return;
    write_view(file, named_sources({std::move(images.reference), std::move(images.test)}));
}

ExitCode run_legal(const CompareArguments& arguments, const CommandFiles& files) {
    const LegalRules rules = legal_rules(arguments.legal);
    Images images = read_images(arguments);
    ImageJudgement judgement = judge_legal(rules, images, arguments.channels);
    files.check();
    write_page(arguments.page, std::move(images));
    LegalReport& report = judgement.report;
    print_report(report, arguments.json);
    if (!arguments.heatmap.empty()) {
        if (report.channels.empty())
            say("quadrel: no heat map: no channel is judged");
        else
            write_png(arguments.heatmap,
                      legal_picture(judgement.reference, judgement.test, report.rules));
    }
    return report.passes() ? ExitCode::ok : ExitCode::difference;
}

ExitCode run_compare(const CompareArguments& arguments) {
    if (!arguments.against.empty()) return run_compare_against(arguments);
    check_combinations(arguments);
    legal_rules(arguments.legal);
    CommandFiles files;
    for (const std::string& image : {arguments.reference, arguments.test}) files.add_input(image);
    files.add_output("--heatmap", arguments.heatmap);
    files.add_output("--page", arguments.page);
    files.check_writable();
    check_output_kinds(
        {{"--heatmap", ".png", arguments.heatmap}, {"--page", ".html", arguments.page}});
    if (arguments.legal.wanted) return run_legal(arguments, files);
    load_plugins(arguments.plugins);
    Images images = prepare(arguments);
    std::optional<ProbedScene> scene;
    if (!arguments.blame.empty()) {
        scene = open_probed_scene(arguments.blame, arguments.overrides);
        scene->plugins = arguments.plugins;
    }
    files.check();
    const Film &reference = images.reference.film, &test = images.test.film;
    CompareReport report = compare(reference, test, images.rules);
    report.preparation = images.preparation;
    if (scene) {
        report.blame = find_blame(reference, test, images.rules, report);
        if (report.blame) point_at_probe(*report.blame, *scene, images.reference);
    }
    print_report(report, arguments.json);
    if (!arguments.heatmap.empty()) {
        if (reference.window == test.window) {
            fill_left_out(reference, images.test.film, images.rules.left_out);
            write_png(arguments.heatmap, heatmap(reference, test));
        } else {
            say("quadrel: no heat map: the windows differ");
        }
    }
    write_page(arguments.page, std::move(images));
    return report.equal() ? ExitCode::ok : ExitCode::difference;
}

void add_tolerances(CLI::App& verb, ToleranceArguments& tolerances) {
    const auto add = [&](const char* option, std::vector<std::string>& values, const char* help) {
        verb.add_option(option, values, help)
            ->type_name("[CHANNEL=]VALUE")
            ->allow_extra_args(false);
    };
    add("--abs", tolerances.abs, "allow this absolute error; repeatable, as all of these");
    add("--rel", tolerances.rel, "allow this error relative to the reference");
    add("--ulp", tolerances.ulp, "allow values to be so many floats (halves, codes) apart");
    add("--fraction", tolerances.fraction, "share of pixels, 0 to 1, that may exceed");
}

void add_preparation(CLI::App& verb, CompareArguments& a) {
    verb.add_option("--encode", a.encode, "round both to what 8 bits or half can hold")
        ->type_name("srgb8|unorm8|half");
    verb.add_option("--decode", a.decode,
                    "one image carries this channel's 32 bits as codes, as the snippets of "
                    "`export --snippets` pack them: bits:hit.U; repeatable")
        ->type_name("LAYOUT:CHANNEL[,CHANNEL...][=FILE]")
        ->allow_extra_args(false);
    verb.add_flag("--flip-y", a.flip_y, "the test image's first row is its bottom");
    verb.add_option("--map", a.mappings, "the test image's channel or group for a reference's")
        ->type_name("REF=TEST")
        ->allow_extra_args(false);
    add_selection_options(verb, a.selection, "", "the test image, an EXR");
    add_selection_options(verb, a.reference_selection, "reference-", "the reference, an EXR");
    add_region_options(verb, a.region);
    verb.add_option("--channels", a.channels, "compare these comma-separated channels only");
    verb.add_option("--ignore-flags", a.ignored_flags,
                    "leave out pixels whose reference has one of these hit.flags, such as "
                    "nan-look-up")
        ->type_name("LIST");
}

}  // namespace

void add_compare(CLI::App& app, Action& action) {
    CLI::App* verb = app.add_subcommand("compare", "compare two images, value by value");
    const auto a = std::make_shared<CompareArguments>();
    verb->add_option("reference", a->reference,
                     "the image that is right; with --against the scene of the test image")
        ->required();
    verb->add_option("--against", a->against,
                     "oracle: judge the test image by the proven first hits of the scene: its "
                     "hit.U, hit.V, hit.s, N, R, G, B, whichever it has; --abs and --fraction "
                     "are of err.uv and the like then")
        ->check(CLI::IsMember({"oracle"}))
        ->type_name("JUDGE");
    verb->add_option("test", a->test, "the image to be judged, of any format")->required();
    verb->footer(details);
    add_tolerances(*verb, a->tolerances);
    add_preparation(*verb, *a);
    verb->add_option("--blame", a->blame, "find the first wrong value of the worst pixel")
        ->type_name("SCENE");
    verb->add_option("-D,--define", a->overrides, "override a value of that scene; repeatable")
        ->type_name("KEY=VALUE")
        ->allow_extra_args(false);
    add_plugin_option(*verb, a->plugins);
    add_legal_options(*verb, a->legal);
    verb->add_option(
            "--heatmap", a->heatmap,
            "write a PNG of the largest differences, a panel for each kind of channel; with "
            "--legal of the verdicts")
        ->type_name("OUT.png");
    verb->add_option("--page", a->page, "write both images as `view` does, as they were compared")
        ->type_name("OUT.html");
    verb->add_flag("--json", a->json, "machine-readable, on standard output");
    verb->callback([a, &action] { action = [a] { return run_compare(*a); }; });
}

}  // namespace quadrel::cli

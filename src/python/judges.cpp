// Comparisons of two images, by tolerances or by the ranges that the reference holds.
#include <pybind11/stl.h>

#include <cmath>
#include <variant>

#include "film/compare/compared_images.hpp"
#include "film/legal/judge_images.hpp"
#include "film/legal/ranged_channels.hpp"
#include "python/bindings.hpp"
#include "render/probe/command.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel::python {
namespace {

using Box = std::array<int, 4>;
/// A film, or a file of any format.
using ImageSource = std::variant<std::shared_ptr<NamedFilm>, std::string>;

/// What is done to the images before they are compared, and what is allowed.
struct Comparison {
    /// "abs", "rel", "ulp" or "fraction"; a channel or group, empty for all; the value.
    std::vector<std::tuple<std::string, std::string, double>> tolerances;
    std::vector<std::string> channels, ignored_flags;
    std::vector<std::pair<std::string, std::string>> mappings;  ///< reference's name, test's name
    std::optional<Box> window;
    bool overlap = false, flip_y = false;
    std::string encode = "none";
};

ComparableImage image_of(const ImageSource& source) {
    if (const auto* file = std::get_if<std::string>(&source)) return read_comparable(*file);
    const NamedFilm& named = *std::get<std::shared_ptr<NamedFilm>>(source);
    ComparableImage image{"arrays", named.film, {}, named.attributes};
    canonicalize(image.film);  // its arrays may have been written to
    image.stored = named.stored;
    for (const Plane& plane : image.film.planes)
        image.stored.try_emplace(
            plane.name, plane.type == ChannelType::float32 ? Storage::float32 : Storage::uint32);
    return image;
}

void keep_region(const Comparison& comparison, ComparedImages& images) {
    Film &reference = images.reference.film, &test = images.test.film;
    std::optional<Window> kept;
    if (comparison.overlap) kept = intersection(reference.window, test.window);
    if (comparison.window) {
        const Box& box = *comparison.window;
        kept = Window{box[0], box[1], box[2], box[3]};
    }
    if (!kept) return;
    if (kept->width() < 1 || kept->height() < 1 || !contains(reference.window, *kept) ||
        !contains(test.window, *kept))
        throw UsageError("window: expected (x0, y0, x1, y1) with pixels of both images");
    crop(reference, *kept);
    crop(test, *kept);
    images.preparation.window = kept;
}

ComparedImages read_images(const ImageSource& reference, const ImageSource& test,
                           const Comparison& comparison) {
    ComparedImages images{image_of(reference), image_of(test), {}, {}};
    if (comparison.flip_y) flip_y(images.test.film);
    std::vector<ChannelMapping> mappings;
    for (const auto& [of_reference, of_test] : comparison.mappings)
        mappings.push_back({of_reference, of_test});
    map_channels(images.test, mappings);
    keep_region(comparison, images);
    if (!comparison.ignored_flags.empty())
        images.rules.left_out =
            flagged_pixels(images.reference.film, parse_hit_flags(comparison.ignored_flags));
    Preparation& preparation = images.preparation;
    preparation.reference_file = images.reference.file.string();
    preparation.test_file = images.test.file.string();
    preparation.flip_y = comparison.flip_y;
    const auto encoding = parse_encoding(comparison.encode);
    if (!encoding)
        throw UsageError("encode: found \"" + comparison.encode +
                         "\", expected srgb8, unorm8, half or none");
    preparation.encoding = *encoding;
    preparation.mappings = mappings;
    return images;
}

ToleranceRule rule_of(const std::string& kind, const std::string& channel, double value) {
    const auto rule = [&](auto member) {
        return ToleranceRule{kind, channel, kind == "fraction", [=](Tolerance& tolerance) {
                                 using Number =
                                     std::remove_reference_t<decltype(tolerance.*member)>;
                                 tolerance.*member = static_cast<Number>(value);
                             }};
    };
    const double most = kind == "fraction" ? 1 : kind == "ulp" ? 0xffffffffu : 1e300;
    if (!(value >= 0 && value <= most) || (kind == "ulp" && value != std::floor(value)))
        throw UsageError(kind + ": expected " +
                         (kind == "fraction" ? "0 to 1"
                          : kind == "ulp"    ? "a whole number of 0 or more"
                                             : "a number of 0 or more"));
    if (kind == "abs") return rule(&Tolerance::abs);
    if (kind == "rel") return rule(&Tolerance::rel);
    if (kind == "ulp") return rule(&Tolerance::ulp);
    return rule(&Tolerance::fraction);
}

void prepare(const Comparison& comparison, ComparedImages& images) {
    std::vector<ToleranceRule> rules;
    for (const auto& [kind, channel, value] : comparison.tolerances)
        rules.push_back(rule_of(kind, channel, value));
    prepare_comparison(rules, "channels", comparison.channels, images);
}

void blame_stage(const Scene& scene, const ComparedImages& images, CompareReport& report) {
    const Film &reference = images.reference.film, &test = images.test.film;
    report.blame = find_blame(reference, test, images.rules, report);
    if (!report.blame) return;
    const RenderOptions options;
    const ProbeCommand command(scene, select_kernels(options), options.isa);
    report.blame->command = command.text(report.blame->x, report.blame->y);
    const auto recorded = images.reference.attributes.find("quadrel:sceneHash");
    if (recorded != images.reference.attributes.end())
        report.blame->same_scene = recorded->second == scene.hash;
}

/// (JSON, text, whether it passes).
template <class Report>
py::tuple told(const Report& report, bool passes) {
    return py::make_tuple(to_json(report), to_text(report), passes);
}

py::tuple compare_images(const ImageSource& reference, const ImageSource& test,
                         const Comparison& comparison, const std::shared_ptr<LoadedScene>& blamed) {
    CompareReport report;
    {
        const Unlocked unlocked;
        ComparedImages images = read_images(reference, test, comparison);
        prepare(comparison, images);
        report = compare(images.reference.film, images.test.film, images.rules);
        if (blamed) blame_stage(*blamed, images, report);
        report.preparation = images.preparation;
    }
    return told(report, report.equal());
}

py::tuple judge_images(const ImageSource& reference, const ImageSource& test,
                       const Comparison& comparison, double widest, double most_ambiguous,
                       double most_unconstrained) {
    LegalReport report;
    {
        const Unlocked unlocked;
        ComparedImages images = read_images(reference, test, comparison);
        if (!comparison.channels.empty())
            keep_ranged_channels("channels", comparison.channels, images.reference.film,
                                 images.test.film);
        LegalRules rules{widest, most_ambiguous, most_unconstrained, {}};
        rules.left_out = std::move(images.rules.left_out);
        report =
            judge_images(images.reference, images.test, rules, images.preparation.encoding).report;
        images.preparation.reference_storage = storage_text(images.reference);
        images.preparation.test_storage = storage_text(images.test);
        report.preparation = images.preparation;
    }
    return told(report, report.passes());
}

}  // namespace

void bind_judges(py::module_& module) {
    py::class_<Comparison>(module, "Comparison")
        .def(py::init<>())
        .def_readwrite("tolerances", &Comparison::tolerances)
        .def_readwrite("channels", &Comparison::channels)
        .def_readwrite("ignored_flags", &Comparison::ignored_flags)
        .def_readwrite("mappings", &Comparison::mappings)
        .def_readwrite("window", &Comparison::window)
        .def_readwrite("overlap", &Comparison::overlap)
        .def_readwrite("flip_y", &Comparison::flip_y)
        .def_readwrite("encode", &Comparison::encode);
    module.def("compare", compare_images, py::arg("reference"), py::arg("test"),
               py::arg("comparison"), py::arg("blamed"));
    module.def("judge", judge_images, py::arg("reference"), py::arg("test"), py::arg("comparison"),
               py::arg("widest"), py::arg("most_ambiguous"), py::arg("most_unconstrained"));
}

}  // namespace quadrel::python

// What is computed of a scene: renders, probes, errors against the truth, sweeps.
#include <pybind11/stl.h>

#include <algorithm>

#include "python/bindings.hpp"
#include "python/interruptible.hpp"
#include "quadrel/errors.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/probe.hpp"
#include "quadrel/render.hpp"
#include "quadrel/stats.hpp"
#include "render/errors/judged.hpp"
#include "sweep/report/results.hpp"
#include "sweep/sweep.hpp"

namespace quadrel::python {
namespace {

using Box = std::array<int, 4>;
using HeldScene = std::shared_ptr<LoadedScene>;
using HeldFilm = std::shared_ptr<NamedFilm>;
/// Values, the film that they are taken from, and what messages call it.
using InjectedFilm = std::tuple<std::string, HeldFilm, std::string>;

std::optional<Window> window_of(const std::optional<Box>& box) {
    if (!box) return std::nullopt;
    return Window{(*box)[0], (*box)[1], (*box)[2], (*box)[3]};
}

void check_window(const std::optional<Window>& window, const Scene& scene) {
    if (!window) return;
    const Window frame{0, 0, scene.width, scene.height};
    if (window->width() < 1 || window->height() < 1 || !contains(frame, *window))
        throw UsageError("window: expected (x0, y0, x1, y1) with x0 < x1 and y0 < y1 within the " +
                         std::to_string(scene.width) + "x" + std::to_string(scene.height) +
                         " image");
}

std::vector<Injection> injections_of(const std::vector<InjectedFilm>& injected) {
    std::vector<Injection> all;
    for (const auto& [values, film, source] : injected)
        // The film lives as long as what is pointed to.
        all.push_back({values, std::shared_ptr<const Film>(film, &film->film), source});
    return all;
}

/// How shading is run.
struct Running {
    std::string number, isa;
    int threads = 0;
};

/// What is rendered beside the plain values.
struct Extras {
    std::string limits;
    std::optional<int> samples;
    std::optional<double> error;
    bool stats = false, touched = false;
};

/// Between two tiles a render can be stopped. Where a pixel takes milliseconds they are small,
/// which costs such a render little.
void shorten_tiles(RenderOptions& options) {
    constexpr int small_tile = 4;
    if (options.integral || !options.limits.empty() ||
        std::ranges::any_of(options.channels, is_drawn_apart))
        options.tile = small_tile;
}

py::tuple render_film(const HeldScene& held, const std::vector<std::string>& channels,
                      const std::optional<Box>& window, const Running& running,
                      const Extras& extras, const std::vector<InjectedFilm>& injected,
                      const py::object& progress) {
    const Scene& scene = *held;
    RenderOptions options;
    if (!channels.empty()) options.channels = expand_channels(channels);
    options.window = window_of(window);
    check_window(options.window, scene);
    options.number = running.number;
    options.isa = running.isa;
    options.threads = running.threads;
    options.limits = extras.limits;
    options.touched = extras.touched;
    options.injected = injections_of(injected);
    if (extras.samples || extras.error) {
        options.integral.emplace();
        options.integral->samples = extras.samples.value_or(options.integral->samples);
        options.integral->error = extras.error.value_or(0);
    }
    shorten_tiles(options);
    RenderStats stats;
    if (extras.stats || extras.touched) options.stats = &stats;
    const auto named = std::make_shared<NamedFilm>();
    named->inputs = held->inputs;
    for (const auto& [values, film, source] : injected) named->inputs.add(film->source);
    run_interruptibly(progress, [&](Work& work) {
        for (const auto& [name, value] : render_attributes(scene, options))
            named->attributes[name] = value;
        options.progress = [&](double share) { work.report(share); };
        options.baking = [&](const std::string&, double) { work.stop_if_interrupted(); };
        named->film = render(scene, options);
    });
    return py::make_tuple(
        named, options.stats != nullptr ? py::object(py::str(to_json(stats))) : py::none());
}

py::tuple probe_pixel(const HeldScene& scene, int x, int y, const std::string& number,
                      const std::string& isa, const std::vector<InjectedFilm>& injected) {
    ProbeReport report;
    run_interruptibly(py::none(), [&](Work&) {
        report = probe(*scene, x, y, number, isa, injections_of(injected));
    });
    return py::make_tuple(to_json(report), to_text(report));
}

py::tuple errors_of(const HeldScene& held, const HeldFilm& image, const std::optional<Box>& window,
                    const Running& running, std::size_t worst, const py::object& progress) {
    const Scene& scene = *held;
    const auto named = std::make_shared<NamedFilm>();
    named->inputs = held->inputs;
    if (image) named->inputs.add(image->source);
    ErrorOptions options;
    options.window = window_of(window);
    check_window(options.window, scene);
    options.number = running.number;
    options.isa = running.isa;
    options.threads = running.threads;
    options.worst = worst;
    options.film = &named->film;
    ErrorSummary summary;
    run_interruptibly(progress, [&](Work& work) {
        options.progress = [&](double share) { work.report(share); };
        summary =
            image ? measure_errors(image->film, scene, options) : measure_errors(scene, options);
        require_judged(summary, scene);
    });
    return py::make_tuple(to_json(summary), to_text(summary), named);
}

/// The runs as `results.json` has them.
std::string sweep_plan(const std::string& file, const std::string& output, int task, int of,
                       const py::object& progress) {
    if (task > of) throw UsageError("task: expected (I, N) with 1 <= I <= N, as (3, 8)");
    std::string results;
    run_interruptibly(progress, [&](Work& work) {
        sweep::Plan plan;
        const Inputs inputs = inputs_of([&] { plan = sweep::read_plan(file); });
        for (const char* name : {"results.json", "results.csv", "page.html", "part.json"})
            inputs.check("output", std::filesystem::path(output) / name);
        sweep::SweepOptions options{output, task, of, QUADREL_VERSION, {}};
        options.pause = [&] { work.stop_if_interrupted(); };
        options.progress = [&](std::size_t done, std::size_t all, const std::string&) {
            work.report(static_cast<double>(done) / static_cast<double>(all));
        };
        const sweep::SweepOutcome outcome = sweep::run_sweep(plan, options);
        sweep::write_results(output, plan.title, outcome.records);
        results = sweep::results_json(plan.title, outcome.records).dump();
    });
    return results;
}

}  // namespace

void bind_renders(py::module_& module) {
    py::class_<Running>(module, "Running")
        .def(py::init<std::string, std::string, int>(), py::arg("number"), py::arg("isa"),
             py::arg("threads"));
    py::class_<Extras>(module, "Extras")
        .def(py::init<std::string, std::optional<int>, std::optional<double>, bool, bool>(),
             py::arg("limits"), py::arg("samples"), py::arg("error"), py::arg("stats"),
             py::arg("touched"));
    module.def("render", render_film, py::arg("scene"), py::arg("channels"), py::arg("window"),
               py::arg("running"), py::arg("extras"), py::arg("injected"), py::arg("progress"));
    module.def("probe", probe_pixel, py::arg("scene"), py::arg("x"), py::arg("y"),
               py::arg("number"), py::arg("isa"), py::arg("injected"));
    module.def("errors", errors_of, py::arg("scene"), py::arg("image"), py::arg("window"),
               py::arg("running"), py::arg("worst"), py::arg("progress"));
    module.def("sweep", sweep_plan, py::arg("plan"), py::arg("output"), py::arg("task"),
               py::arg("of"), py::arg("progress"));
}

}  // namespace quadrel::python

// Frames that Quadrel and llvmpipe draw in turns.
#include <fmt/format.h>

#include "agreement.hpp"
#include "llvmpipe/llvmpipe.hpp"
#include "measure.hpp"
#include "tables/tables.hpp"

namespace quadrel::peers {
namespace {

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// One row at one angle: milliseconds, and how far the pictures are apart, the timed ones and
/// the judged.
struct Drawn {
    double quadrel = nothing, llvmpipe = nothing, timed_difference = nothing, difference = nothing;
};

/// The difference between what the shader drew and the picture that it has to draw.
double judge(Run& run, const Row& row, double angle, const std::vector<float>& drawn) {
    Picture picture = colour_picture(run, angle, row.judged_overrides());
    picture.draw(1);
    const double difference = mean_difference(picture.film(), drawn);
    run.judge(fmt::format("{} at {} degrees: Quadrel's picture and llvmpipe's", row.name, angle),
              difference, row.tolerance);
    return difference;
}

std::vector<std::string> planted(const Options& options) {
    if (!options.planted) return {};
    return {"PLANTED"};
}

Drawn draw_in_turns(Run& run, const Row& row, double angle, int threads, Llvmpipe* llvmpipe) {
    const Options& options = run.options;
    Picture picture = colour_picture(run, angle, row.overrides);
    picture.draw(threads);
    std::unique_ptr<ShadedFrame> frame;
    Drawn drawn;
    if (llvmpipe != nullptr) {
        frame = llvmpipe->frame(row, picture.scene(), planted(options));
        frame->draw();
        const std::vector<float> pixels = frame->read();
        drawn.timed_difference = mean_difference(picture.film(), pixels);
        drawn.difference = judge(run, row, angle, pixels);
    }
    LeastTime quadrel, peer;
    for (int i = 0; i < options.repeats; ++i) {
        quadrel.add(picture.draw(threads));
        if (frame) peer.add(time_of([&] { frame->draw(); }));
    }
    drawn.quadrel = quadrel.of(threads);
    if (frame) drawn.llvmpipe = peer.of(threads);
    return drawn;
}

std::string title(const Run& run, int threads, const std::string& peer) {
    std::string angles;
    for (const double angle : run.options.angles)
        angles += fmt::format("{}{}", angles.empty() ? "" : " / ", angle);
    return fmt::format(
        "Drawing {0}x{0} pixels, R G B A as float, maps of {1}x{1} texels, at {2} degrees, {3}: "
        "least of {4}, milliseconds of {5}. The peer is {6}. Difference: mean of |a - b| over R, "
        "G and B, of the timed pictures, and when Quadrel imitates llvmpipe's levels of detail and "
        "interpolation, which is judged.",
        run.options.size, run.options.map, angles, threads == 1 ? "one thread" : "two threads",
        run.options.repeats, threads == 1 ? "CPU time" : "wall time", peer);
}

}  // namespace

Table drawn_table(Run& run, int threads) {
    std::string why;
    const auto llvmpipe = open_llvmpipe(threads, why);
    if (!llvmpipe) run.skip("llvmpipe", why);
    Table table;
    table.title = title(run, threads, llvmpipe ? llvmpipe->description() : "missing: " + why);
    table.columns = {"work", "Quadrel", "llvmpipe", "Quadrel / llvmpipe", "difference", "imitated"};
    for (const Row& row : drawn_rows()) {
        if (!chosen(run.options.rows, row.name)) continue;
        std::vector<double> ours, theirs, timed, judged;
        for (const double angle : run.options.angles) {
            const Drawn drawn = draw_in_turns(run, row, angle, threads, llvmpipe.get());
            ours.push_back(drawn.quadrel);
            theirs.push_back(drawn.llvmpipe);
            timed.push_back(drawn.timed_difference);
            judged.push_back(drawn.difference);
        }
        table.rows.push_back({row.title,
                              {ours, 1},
                              {theirs, 1},
                              {ratios(ours, theirs), 2},
                              {timed, 5},
                              {judged, 6}});
    }
    return table;
}

}  // namespace quadrel::peers

#include "render/ranges/extremes.hpp"

#include <algorithm>
#include <cmath>

#include "quadrel/error.hpp"
#include "quadrel/raster/viewport.hpp"
#include "render/ranges/limits.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

/// How many shares of a candidate change at most, and how often one begins anew.
constexpr int most_changes = 12;
constexpr double new_start = 0.1;

PreparedRender prepare(const Scene& scene, std::vector<std::string> channels) {
    // What the errors of the stages before are made of.
    for (const char* name : {"bary", "dUVdx", "dUVdy"}) channels.emplace_back(name);
    RenderOptions options;
    options.channels = std::move(channels);
    return prepare_render(scene, options, select_kernels(options));
}

PermittedErrors between(const PermittedErrors& a, const PermittedErrors& b, double t) {
    PermittedErrors result;
    for (std::size_t i = 0; i < PermittedErrors::count; ++i)
        result.shares()[i] =
            std::clamp(static_cast<float>(std::lerp(static_cast<double>(a.shares()[i]),
                                                    static_cast<double>(b.shares()[i]), t)),
                       -1.0f, 1.0f);
    return result;
}

}  // namespace

FoundSpread spread_of(std::vector<float>& values) {
    std::erase_if(values, [](float x) { return !std::isfinite(x); });
    std::ranges::sort(values);
    double gap = 0;
    for (std::size_t i = 1; i < values.size(); ++i)
        gap = std::max(gap, static_cast<double>(values[i]) - static_cast<double>(values[i - 1]));
    FoundSpread spread;
    if (!values.empty())
        spread.width = static_cast<double>(values.back()) - static_cast<double>(values.front());
    spread.width_less_gap = spread.width - gap;
    return spread;
}

Extremes::Extremes(const Scene& scene, const std::vector<std::string>& channels,
                   const std::string& limits, const SearchEffort& effort)
    : effort_(effort), prepared_(prepare(scene, channels)), channel_count_(0) {
    if (scene.samples > 1) throw UsageError("ranges are of one sample per pixel");
    for (const ChannelSource& channel : prepared_.channels) {
        if (channel.value == Value::bary) break;
        if (channel.kind != ChannelSource::Kind::value || channel.type != ChannelType::float32)
            throw UsageError("\"" + channel.name + "\" is no value of a stage");
        ++channel_count_;
    }
    batch_ = std::make_unique<PermittedBatch>(prepared_.plan, prepared_.geometry,
                                              budget_of_limits(limits));
}

std::vector<FoundPixel> Extremes::search(const Window& window) {
    const Scene& scene = *prepared_.scene;
    const Viewport viewport{scene.width, scene.height, scene.conventions};
    prepared_.window = window;
    std::vector<FoundPixel> found;
    for (const QuadCoverage& quad : visible_quads(prepared_)) {
        search_quad(quad);
        for (int lane = 0; lane < 4; ++lane) {
            const auto k = static_cast<std::size_t>(lane);
            const int x = lane_x(quad, lane), y = flip_row(viewport, lane_y(quad, lane));
            if (quad.samples[k] == 0 || !contains(window, {x, y, x + 1, y + 1})) continue;
            pixels_[k].x = x;
            pixels_[k].y = y;
            found.push_back(std::move(pixels_[k]));
        }
    }
    return found;
}

void Extremes::search_quad(const QuadCoverage& quad) {
    random_.seed(1);
    for (FoundPixel& pixel : pixels_) pixel.values.assign(channel_count_, {});
    all_.assign(channel_count_, {});
    for (int level = 0; level < effort_.levels; ++level)
        search_level(quad, effort_.levels > 1 ? level / (effort_.levels - 1.0) : 0.5);
    search_between(quad);
}

/// Random errors, each as large as it may be, and from then on those that have led farthest,
/// changed a little.
void Extremes::search_level(const QuadCoverage& quad, double level) {
    ends_.assign(channel_count_, {});
    for (int batch = 0; batch < effort_.batches_a_level; ++batch) {
        for (PermittedErrors& errors : implementations_) {
            const Candidate* const end = random() < new_start ? nullptr : any_end();
            errors = end != nullptr ? mutated(end->errors) : corner();
        }
        run(quad, choices(level));
        keep(level);
    }
    for (std::size_t c = 0; c < channel_count_; ++c)
        for (std::size_t k = 0; k < 4; ++k) {
            const Ends& of = ends_[c][k];
            Ends& all = all_[c][k];
            if (of.least.found && (!all.least.found || of.least.value < all.least.value))
                all.least = of.least;
            if (of.greatest.found &&
                (!all.greatest.found || of.greatest.value > all.greatest.value))
                all.greatest = of.greatest;
        }
}

/// Between the least and the greatest value of all levels, where gaps are to be closed that are
/// none of what is permitted.
void Extremes::search_between(const QuadCoverage& quad) {
    for (int batch = 0; batch < effort_.batches_between; ++batch) {
        const double part =
            effort_.batches_between > 1 ? batch / (effort_.batches_between - 1.0) : 0.5;
        for (std::size_t q = 0; q < implementations_.size(); ++q) {
            const Ends& ends = all_[q % channel_count_][q / channel_count_ % 4];
            const double from = ends.least.level, to = ends.greatest.level;
            const double t =
                from == to ? random() : std::clamp((part - from) / (to - from), 0., 1.);
            implementations_[q] = between(ends.least.errors, ends.greatest.errors, t);
        }
        SharedChoices shared;
        shared.level = part;
        run(quad, shared);
    }
}

void Extremes::run(const QuadCoverage& quad, const SharedChoices& shared) {
    const Scene& scene = *prepared_.scene;
    batch_->run(quad, scene.samples, scene.centroid, implementations_, shared);
    for (std::size_t c = 0; c < channel_count_; ++c)
        for (int lane = 0; lane < 4; ++lane)
            for (std::size_t q = 0; q < implementations_.size(); ++q)
                pixels_[static_cast<std::size_t>(lane)].values[c].push_back(
                    batch_->value(prepared_.channels[c].slot(), q, lane));
}

/// Which of the implementations that ran last lead farther than any before.
void Extremes::keep(double level) {
    for (std::size_t c = 0; c < channel_count_; ++c)
        for (int lane = 0; lane < 4; ++lane) {
            Ends& ends = ends_[c][static_cast<std::size_t>(lane)];
            for (std::size_t q = 0; q < implementations_.size(); ++q) {
                const float value = batch_->value(prepared_.channels[c].slot(), q, lane);
                if (!std::isfinite(value)) continue;
                if (!ends.least.found || value < ends.least.value)
                    ends.least = {implementations_[q], level, value, true};
                if (!ends.greatest.found || value > ends.greatest.value)
                    ends.greatest = {implementations_[q], level, value, true};
            }
        }
}

/// One of those that lead farthest at this level; null where there is none.
const Extremes::Candidate* Extremes::any_end() {
    const auto pick = static_cast<std::size_t>(random() * static_cast<double>(8 * channel_count_));
    const Ends& ends = ends_[pick / 8][pick / 2 % 4];
    const Candidate& end = pick % 2 == 0 ? ends.least : ends.greatest;
    return end.found ? &end : nullptr;
}

double Extremes::random() { return static_cast<double>(random_() >> 11) * 0x1p-53; }

PermittedErrors Extremes::corner() {
    PermittedErrors errors;
    for (float& share : errors.shares()) share = random() < 0.5 ? -1.0f : 1.0f;
    return errors;
}

/// Some shares go to an end, or anywhere.
PermittedErrors Extremes::mutated(const PermittedErrors& of) {
    PermittedErrors errors = of;
    const int changes = 1 + static_cast<int>(random() * most_changes);
    for (int i = 0; i < changes; ++i) {
        const auto which = static_cast<std::size_t>(random() * PermittedErrors::count);
        const double kind = random();
        errors.shares()[which] = kind < 0.4   ? -1.0f
                                 : kind < 0.8 ? 1.0f
                                              : static_cast<float>(2 * random() - 1);
    }
    return errors;
}

SharedChoices Extremes::choices(double level) {
    SharedChoices shared;
    shared.level = level;
    shared.filtered = std::floor(random() * 3) - 1;
    shared.srgb = std::floor(random() * 3) - 1;
    shared.derivatives = random() < 0.25 ? DerivativeMode::coarse : DerivativeMode::fine;
    return shared;
}

}  // namespace quadrel

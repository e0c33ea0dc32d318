// Values that are taken from images instead of being computed: which arrays of a batch they
// replace.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quadrel/raster/coverage.hpp"
#include "quadrel/raster/viewport.hpp"
#include "quadrel/render.hpp"
#include "render/plan/plan.hpp"

namespace quadrel {

/// An array of a batch and the plane that it is taken from.
struct InjectedArray {
    Value value;
    int slot = 0;   ///< of the array
    int light = 0;  ///< of values that each light has one of
    const Plane* plane = nullptr;
    const Film* image = nullptr;
    const Plane* coverage = nullptr;  ///< the image's channel A; null: it has none
    const Injection* asked = nullptr;
};

class InjectedValues {
  public:
    /// What `injections` name, for a render of that window. Throws
    /// UsageError for a name that is no value of a stage, InputError for an image of another size,
    /// without the channels, or with other types or codes than stages store.
    InjectedValues(std::vector<Injection> injections, const Scene& scene, const Window& window);
    InjectedValues(const InjectedValues&) = delete;
    InjectedValues& operator=(const InjectedValues&) = delete;

    /// NAME=FILE of each injection.
    std::span<const std::string> options() const { return options_; }

    /// Whether every lane of the quad is seen and replaced, of all that is.
    bool covers(const QuadCoverage& quad) const;

    /// Whether each component of a value is replaced, of a light where it is the lights'.
    bool has(Value value, int light) const;

    /// Throws UsageError for an injection of whose values none of the plans computes and reads any.
    void check_used(std::span<const MaterialPlan> plans) const;

    /// Calls `put(slot, lane, bits)` for every value that replaces one of those that stage `number`
    /// of the plan has stored and no later one stores again, since images have what is left in the
    /// end: in lanes of the quads that are seen, where their image has a fragment. `bits` are a
    /// float's or an integer's.
    template <class Put>
    void replace(const MaterialPlan& plan, std::size_t number, std::span<const QuadCoverage> quads,
                 const Put& put) const {
        const PlannedStage& stage = plan.stages[number];
        for (const InjectedArray& array : arrays_) {
            if (!stores(stage, array.value)) continue;
            if (info(array.value).per_light && stage.light != array.light) continue;
            if (!is_last_to_store(plan, number, array.value)) continue;
            for (std::size_t q = 0; q < quads.size(); ++q)
                for (int lane = 0; lane < 4; ++lane) replace_lane(array, quads[q], q, lane, put);
        }
    }

  private:
    void add(const Injection& injection, const std::string& name);

    /// The pixel of the array's image that a lane gets, if it gets any.
    std::optional<std::size_t> pixel_of(const InjectedArray& array, const QuadCoverage& quad,
                                        int lane) const {
        if (quad.samples[static_cast<std::size_t>(lane)] == 0) return std::nullopt;
        const int x = lane_x(quad, lane), y = flip_row(viewport_, lane_y(quad, lane));
        if (!contains(array.image->window, {x, y, x + 1, y + 1})) return std::nullopt;
        const std::size_t pixel = array.image->index(x, y);
        if (array.coverage != nullptr && !(array.coverage->as_float(pixel) > 0))
            return std::nullopt;
        return pixel;
    }

    template <class Put>
    void replace_lane(const InjectedArray& array, const QuadCoverage& quad, std::size_t q, int lane,
                      const Put& put) const {
        if (const auto pixel = pixel_of(array, quad, lane))
            put(array.slot, static_cast<int>(4 * q) + lane, array.plane->bits[*pixel]);
    }

    std::vector<Injection> injections_;
    Viewport viewport_;
    std::vector<InjectedArray> arrays_;
    std::vector<std::string> options_;
};

/// What the header of a film says about it: names and hashes of what was injected.
std::string injection_text(const std::vector<Injection>& injections);

}  // namespace quadrel

#include "sweep/run_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadrel/check.hpp"
#include "quadrel/quad/value.hpp"

namespace quadrel::sweep {
namespace {

struct Hits {
    explicit Hits(const Film& film)
        : s(*film.find("hit.s")),
          u(*film.find("hit.U")),
          v(*film.find("hit.V")),
          status(*film.find("hit.status")),
          K_u(*film.find("K.U")),
          K_v(*film.find("K.V")) {}
    Status status_at(std::size_t i) const { return static_cast<Status>(status.bits[i]); }
    const Plane &s, &u, &v, &status, &K_u, &K_v;
};

/// Whether the ray goes on below the relief.
bool is_miss(Status status) { return status == Status::floor; }

bool has_ray(Status status) { return status != Status::none && status != Status::no_frame; }

Percentiles percentiles_of(std::vector<float> values) {
    Percentiles result;
    result.sorted = std::move(values);
    std::sort(result.sorted.begin(), result.sorted.end());
    if (result.sorted.empty()) return result;
    for (const float value : result.sorted) result.mean += value;
    result.mean /= static_cast<double>(result.sorted.size());
    result.median = result.at(50);
    result.p90 = result.at(90);
    result.p99 = result.at(99);
    result.most = result.sorted.back();
    return result;
}

struct Judged {
    RayEnd end;
    double s, texels;
    bool before;  ///< the true hit
};

class Judge {
  public:
    Judge(const Film& run, const Film& truth, int width, int height, double tolerance)
        : run_(run), truth_(truth), width_(width), height_(height), tolerance_(tolerance) {}

    Judged operator()(std::size_t i) const {
        const Status found = run_.status_at(i), real = truth_.status_at(i);
        const double s = std::fabs(double(run_.s.as_float(i)) - truth_.s.as_float(i));
        const double du = double(run_.u.as_float(i)) - truth_.u.as_float(i);
        const double dv = double(run_.v.as_float(i)) - truth_.v.as_float(i);
        const double across = du * width_, down = dv * height_;
        const double texels = std::sqrt(across * across + down * down);
        if (!has_ray(found) || !has_ray(real) || real == Status::nan)
            return {RayEnd::none, 0, 0, false};
        if (found == Status::nan || !std::isfinite(texels)) return {RayEnd::nan, 0, 0, false};
        // By where it lies along the ray: traces without a search have no depth of their own.
        const bool before = du * truth_.K_u.as_float(i) + dv * truth_.K_v.as_float(i) < 0;
        RayEnd end = before ? RayEnd::early : RayEnd::late;
        if (is_miss(found) != is_miss(real))
            end = is_miss(real) ? RayEnd::hit_of_miss : RayEnd::miss_of_hit;
        return {texels > tolerance_ ? end : RayEnd::same, s, texels, before};
    }

  private:
    Hits run_, truth_;
    double width_, height_, tolerance_;
};

}  // namespace

double Percentiles::at(double percent) const {
    if (sorted.empty()) return 0;
    const double place = percent / 100 * static_cast<double>(sorted.size());
    const auto rank = static_cast<std::size_t>(std::max(1.0, std::ceil(place)));
    return sorted[std::min(rank, sorted.size()) - 1];
}

std::vector<std::string> error_channels() {
    return {"hit.s", "hit.U", "hit.V", "hit.status", "K.U", "K.V"};
}

RunError run_error(const Film& run, const Film& truth, int width, int height, double tolerance) {
    QUADREL_CHECK(run.window == truth.window, run.window.width());
    const Judge judge(run, truth, width, height, tolerance);
    RunError error;
    std::vector<float> s, texels;
    std::uint64_t ends[7] = {};
    for (std::size_t i = 0; i < run.window.area(); ++i) {
        const Judged judged = judge(i);
        const bool measured = judged.end != RayEnd::none && judged.end != RayEnd::nan;
        error.ends.push_back(judged.end);
        error.map.push_back(measured
                                ? static_cast<float>(judged.before ? -judged.texels : judged.texels)
                                : std::numeric_limits<float>::quiet_NaN());
        ++ends[static_cast<std::size_t>(judged.end)];
        if (judged.end != RayEnd::none) ++error.rays;
        if (!measured) continue;
        s.push_back(static_cast<float>(judged.s));
        texels.push_back(static_cast<float>(judged.texels));
    }
    error.s = percentiles_of(std::move(s));
    error.texels = percentiles_of(std::move(texels));
    const auto share = [&](RayEnd end) {
        const auto rays = static_cast<double>(std::max<std::uint64_t>(1, error.rays));
        return static_cast<double>(ends[static_cast<std::size_t>(end)]) / rays;
    };
    error.late = share(RayEnd::late);
    error.early = share(RayEnd::early);
    error.hit_of_miss = share(RayEnd::hit_of_miss);
    error.miss_of_hit = share(RayEnd::miss_of_hit);
    error.nan = share(RayEnd::nan);
    return error;
}

}  // namespace quadrel::sweep

#include "render/errors/judgement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "quadrel/relief/cells.hpp"
#include "quadrel/relief/trace/oracle/emerges.hpp"
#include "render/errors/layer_truth.hpp"

namespace quadrel {
namespace {

/// What a GPU's filter cannot tell apart: its weights have 8 bits.
constexpr double same_texels = 1.0 / 256;
/// And heights of 16 bits.
constexpr double same_s = 0x1p-16;

double width_of(const TrueHit& truth) { return truth.field.heights->view.width[0]; }
double height_of(const TrueHit& truth) { return truth.field.heights->view.height[0]; }

/// How far s may be off where a ray is given in float32: what the heights under it move by, times
/// what s moves by with these. Where the ray grazes that is much; then it is the judge's word.
double rounding_of_s(const TrueHit& truth) {
    constexpr double most = 0x1p-12, ulps = 0x1p-22;
    const oracle::Ray& ray = truth.ray;
    const double in_u = std::fabs(truth.gradient_u) * (std::fabs(truth.u) + std::fabs(ray.Ku));
    const double in_v = std::fabs(truth.gradient_v) * (std::fabs(truth.v) + std::fabs(ray.Kv));
    const double off = truth.bound + ulps * truth.condition * (1 + in_u + in_v);
    return off < most ? off : most;
}

double length(double x, double y) { return std::sqrt(x * x + y * y); }

double ray_texels(const TrueHit& truth) {
    return length(truth.ray.Ku * width_of(truth), truth.ray.Kv * height_of(truth));
}

/// How much further along the ray in texture space, in units of s; 0 where the ray stands still
/// there.
double along_ray(const TrueHit& truth, const FoundHit& found) {
    const oracle::Ray& ray = truth.ray;
    const double length = ray.Ku * ray.Ku + ray.Kv * ray.Kv;
    const double along = (found.u - truth.u) * ray.Ku + (found.v - truth.v) * ray.Kv;
    return length > 0 ? along / length : 0;
}

bool is_hit(Status status) { return status == Status::hit || status == Status::cap; }

/// Late, early or elsewhere, of two points that are not the same.
ErrorKind kind_of_place(const TrueHit& truth, const FoundHit& found, double off) {
    const bool known = found.s == found.s;
    const double along = along_ray(truth, found);
    double later = known ? found.s - truth.s : along;
    if (std::fabs(later) <= off) later = std::fabs(along) > off ? along : 0;
    if (later == 0 || later != later) return ErrorKind::other_surface;
    if (later < 0) return ErrorKind::early;
    const double from = truth.s + off, to = truth.s + later - off;
    const bool emerges =
        truth.layers > 0 ? leaves_layers(*truth.field.heights, truth.layers, truth.ray, from, to)
                         : oracle::emerges(truth.field, truth.ray, from, to);
    return emerges ? ErrorKind::other_surface : ErrorKind::late;
}

/// Whether position x of an axis, in cells, is in the truth's cell, at whose `place` it is at
/// `true_x`.
bool in_cell(double x, double true_x, double cell, double place, const GridAxis& axis) {
    constexpr double far = std::numeric_limits<double>::infinity();
    double low = std::floor(true_x - place + 0.5), high = low + 1;
    if (!axis.periodic) {
        low = cell > axis.first ? cell : -far;
        high = cell < axis.first + axis.count - 1 ? cell + 1 : far;
    }
    return x >= low - same_texels && x <= high + same_texels;
}

}  // namespace

void TrueHit::of_layers(const SampledTexture& map, int count) {
    field = {&map, &map, oracle::Surface::bilinear};
    layers = count;
    const double x = u * width_of(*this) - 0.5, y = v * height_of(*this) - 0.5;
    cell_x = std::floor(x);
    cell_y = std::floor(y);
    place_x = x - cell_x;
    place_y = y - cell_y;
    const LayerSlope slope = layer_slope(map, count, ray, u, v, s);
    gradient_u = slope.gradient_u;
    gradient_v = slope.gradient_v;
    condition = slope.condition;
}

double texels_apart(const TrueHit& truth, const FoundHit& found) {
    return length((found.u - truth.u) * width_of(truth), (found.v - truth.v) * height_of(truth));
}

bool in_other_cell(const TrueHit& truth, const FoundHit& found) {
    if (truth.status != Status::hit || !(found.u == found.u && found.v == found.v)) return false;
    const SampledTexture& map = *truth.field.heights;
    const bool blocks = truth.field.surface == oracle::Surface::block;
    const double centre = blocks ? 0 : 0.5;
    const int width = map.view.width[0], height = map.view.height[0];
    const Grid grid =
        blocks ? texel_grid(width, height, map.sampler) : cell_grid(width, height, map.sampler);
    const auto x = [&](double u) { return u * width - centre; };
    const auto y = [&](double v) { return v * height - centre; };
    return !in_cell(x(found.u), x(truth.u), truth.cell_x, truth.place_x, grid.u) ||
           !in_cell(y(found.v), y(truth.v), truth.cell_y, truth.place_y, grid.v);
}

ErrorKind judge_hit(const TrueHit& truth, const FoundHit& found) {
    if (!truth.is_judged()) return ErrorKind::not_judged;
    const double off = same_s + rounding_of_s(truth);
    const double near = same_texels + (off - same_s) * ray_texels(truth);
    const double apart = texels_apart(truth, found), later = std::fabs(found.s - truth.s);
    const bool same_place = apart <= near && !(later > off);
    const bool by_s_alone = apart != apart && later <= off;
    const bool true_hit = truth.status == Status::hit, found_hit = is_hit(found.status);
    if (same_place || by_s_alone) return ErrorKind::same;
    if (true_hit && !found_hit) return ErrorKind::missed;
    if (!true_hit && found_hit) return ErrorKind::invented;
    return kind_of_place(truth, found, off);
}

}  // namespace quadrel

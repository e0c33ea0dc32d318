#include "conformance/judge/perturbations.hpp"

#include <bit>

#include "quadrel/num/exp.hpp"

namespace quadrel::conformance {
namespace {

template <class Change>
void change(Film& film, const std::string& channel, const Change& changed) {
    Plane* const plane = film.find(channel);
    if (plane == nullptr) return;
    for (std::uint32_t& bits : plane->bits)
        bits = std::bit_cast<std::uint32_t>(
            static_cast<float>(changed(static_cast<double>(std::bit_cast<float>(bits)))));
}

void shift(Film& film, const std::string& channel, double by) {
    if (by != 0) change(film, channel, [by](double x) { return x + by; });
}

void scale(Film& film, const std::string& channel, double by) {
    if (by != 1) change(film, channel, [by](double x) { return x * by; });
}

/// With this part of each error, to both sides.
void add_perturbations(std::vector<Perturbation>& all, GroupKind group,
                       const PermittedErrors& errors, bool vertex_rays, double part) {
    for (const int v : {-1, 0, 1})
        for (const int u : {-1, 0, 1})
            if (u != 0 || v != 0)
                all.push_back({"weight", u * part * errors.weight, v * part * errors.weight});
    for (const double by : {-part, part}) {
        all.push_back({"level", 0, 0, by * errors.level});
        if (group == GroupKind::hit) {
            all.push_back({"ray", 0, 0, 0, by * errors.ray});
            all.push_back({"rate", 0, 0, 0, 0, by * errors.ray});
        }
        const bool has_rays = group == GroupKind::hit || group == GroupKind::shadow;
        for (std::size_t axis = 0; has_rays && axis < 3; ++axis) {
            all.push_back({"direction"});
            all.back().turn[axis] = by * errors.ray;
        }
        all.push_back({"texel", 0, 0, 0, 0, 0, by * errors.texel});
        for (std::size_t axis = 0; group == GroupKind::shadow && axis < 3; ++axis) {
            all.push_back({"normal"});
            all.back().tilt[axis] = by * errors.normal;
        }
        for (std::size_t axis = 0; group == GroupKind::hit && vertex_rays && axis < 3; ++axis) {
            all.push_back({"eye"});
            all.back().eye[axis] = by * errors.ray;
        }
    }
}

}  // namespace

std::vector<Perturbation> perturbations_of(GroupKind group, const PermittedErrors& errors,
                                           bool vertex_rays) {
    std::vector<Perturbation> all;
    if (group < GroupKind::hit) return all;
    for (const double part : permitted_parts)
        add_perturbations(all, group, errors, vertex_rays, part);
    return all;
}

Film perturbed(Film film, GroupKind group, const Perturbation& perturbation,
               const TexelSize& texel) {
    const bool searches = group == GroupKind::hit;
    shift(film, searches ? "uv.U" : "hit.U", perturbation.u * texel.u);
    shift(film, searches ? "uv.V" : "hit.V", perturbation.v * texel.v);
    for (const char* channel : {"dUVdx.U", "dUVdx.V", "dUVdy.U", "dUVdy.V"})
        scale(film, channel, exp2(perturbation.level));
    for (const char* channel : {"K.U", "K.V"}) scale(film, channel, 1 + perturbation.ray);
    scale(film, "relief.depth", 1 + perturbation.ray);  // of which K is a multiple
    scale(film, "r", 1 + perturbation.rate);
    for (std::size_t axis = 0; axis < 3; ++axis)
        scale(film, std::string(searches ? "P." : "hit.P.") + "XYZ"[axis],
              1 + perturbation.turn[axis]);
    for (std::size_t axis = 0; axis < 3; ++axis)
        shift(film, std::string("frame_normal.") + "XYZ"[axis], perturbation.tilt[axis]);
    return film;
}

double moved_along(const std::string& channel, GroupKind group, const Perturbation& perturbation,
                   const TexelSize& texel) {
    if (group != GroupKind::hit) return 0;
    if (channel == "hit.U") return perturbation.u * texel.u;
    return channel == "hit.V" ? perturbation.v * texel.v : 0;
}

}  // namespace quadrel::conformance

// What stages of the judge share: the field that they search, its results of a quad, one plain ray
// a lane, and how these are stored.
#pragma once

#include "quadrel/relief/trace/oracle/first_hit.hpp"
#include "quadrel/relief/trace/search/search.hpp"

namespace quadrel::oracle {

/// The parameter `surface` of a stage.
template <auto member>
constexpr ParameterText surface_parameter() {
    return choice<member>("surface", "how texels are read", surface_names, 0);
}

/// The maps of the stage's material, read as that says.
template <class Io>
Field field_of(const Io& io, Surface surface) {
    return {io.template texture<TextureSlot::height>(), io.template texture<TextureSlot::max_mip>(),
            surface};
}

/// The first hits of the four lanes of a Quad<T>.
template <class T>
class QuadHits {
  public:
    using F = Quad<T>;

    template <class Io>
    QuadHits(const Io& io, const SearchRay<F>& ray, Surface surface)
        : field_(field_of(io, surface)), ray_(ray) {
        for (int lane = 0; lane < 4; ++lane) hits_[lane] = hit(lane);
    }

    /// of(hit) of every lane.
    template <class Of>
    F real(const Of& of) const {
        return {static_cast<T>(of(hits_[0])), static_cast<T>(of(hits_[1])),
                static_cast<T>(of(hits_[2])), static_cast<T>(of(hits_[3]))};
    }
    template <class Of>
    Int<F> integer(const Of& of) const {
        Int<F> made;
        for (int lane = 0; lane < 4; ++lane)
            made.lane[lane] = static_cast<std::int32_t>(of(hits_[lane]));
        return made;
    }
    F s() const {
        return real([](const Hit& hit) { return hit.s; });
    }
    vec2<F> uv() const {
        return {real([](const Hit& hit) { return hit.u; }),
                real([](const Hit& hit) { return hit.v; })};
    }
    Int<F> status() const {
        return integer([](const Hit& hit) { return hit.status; });
    }

  private:
    Hit hit(int lane) const {
        const Ray ray{ray_.uv.x.lane[lane], ray_.uv.y.lane[lane], ray_.K.x.lane[lane],
                      ray_.K.y.lane[lane], ray_.s_polygon};
        if (!ray_.active.lane[lane]) return unsearched(lane, ray, Uncertified::no_ray);
        if (!field_.heights || !field_.maxima)
            return unsearched(lane, ray, Uncertified::no_height_map);
        return first_hit(field_, ray);
    }
    /// On the polygon. With the frame's status where there is no ray (a lane without fragment is as
    /// one without a frame); where there are no heights to judge by, with none.
    Hit unsearched(int lane, const Ray& ray, Uncertified reason) const {
        Hit none;
        none.s = ray.s_polygon;
        none.u = ray.u;
        none.v = ray.v;
        none.status = reason == Uncertified::no_ray
                          ? static_cast<Status>(ray_.frame_status.lane[lane])
                          : Status::none;
        none.reason = reason;
        return none;
    }

    Field field_;
    SearchRay<F> ray_;
    Hit hits_[4];
};

/// Stores oracle.* and certified. The bound is that of the number that is stored.
template <class Io, class T>
void store_hits(const Io& io, const QuadHits<T>& hits) {
    io.template store<Value::oracle_s>(hits.s());
    io.template store<Value::oracle_uv>(hits.uv());
    const auto pair = [&](auto x, auto y) { return vec2<Quad<T>>(hits.real(x), hits.real(y)); };
    io.template store<Value::oracle_cell>(
        pair([](const Hit& hit) { return hit.cell_x; }, [](const Hit& hit) { return hit.cell_y; }));
    io.template store<Value::oracle_place>(pair([](const Hit& hit) { return hit.place_x; },
                                                [](const Hit& hit) { return hit.place_y; }));
    io.template store<Value::oracle_gradient>(pair([](const Hit& hit) { return hit.gradient_u; },
                                                   [](const Hit& hit) { return hit.gradient_v; }));
    io.template store<Value::oracle_condition>(
        hits.real([](const Hit& hit) { return hit.condition; }));
    io.template store<Value::oracle_bound>(
        hits.real([](const Hit& hit) { return bound_of<T>(hit); }));
    io.template store<Value::oracle_status>(hits.status());
    io.template store<Value::certified>(
        hits.integer([](const Hit& hit) { return hit.certificate; }));
    io.template store<Value::certified_reason>(
        hits.integer([](const Hit& hit) { return hit.reason; }));
}

}  // namespace quadrel::oracle

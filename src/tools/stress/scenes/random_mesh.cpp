#include "stress/scenes/random_mesh.hpp"

#include <fmt/format.h>

#include <array>

namespace quadrel::stress {
namespace {

/// (x, y) -> (a x + b y + c, d x + e y + f).
struct UvMap {
    double a = 0.5, b = 0, c = 0.5, d = 0, e = 0.5, f = 0.5;
};

/// An OBJ file under construction: corners in order, three per triangle.
class Obj {
  public:
    explicit Obj(const UvMap& uv) : uv_(uv) {}

    void triangle(const std::array<std::array<double, 3>, 3>& corners) {
        for (const auto& [x, y, z] : corners) {
            text_ += fmt::format("v {} {} {}\nvt {} {}\n", x, y, z, uv_.a * x + uv_.b * y + uv_.c,
                                 uv_.d * x + uv_.e * y + uv_.f);
            ++corners_;
        }
        text_ += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\n", corners_ - 2, corners_ - 1, corners_);
    }
    const std::string& text() const { return text_; }

  private:
    UvMap uv_;
    std::string text_;
    int corners_ = 0;
};

void add_square(Obj& obj, double side) {
    const double s = side / 2;
    obj.triangle({{{-s, -s, 0}, {s, -s, 0}, {s, s, 0}}});
    obj.triangle({{{-s, -s, 0}, {s, s, 0}, {-s, s, 0}}});
}

UvMap random_uv(Random& random, double wild) {
    UvMap uv;
    const auto tiles = static_cast<int>(6 * wild);
    uv.a = random.signed_decade(-tiles, tiles);
    uv.e = random.coin() ? random.signed_decade(-tiles, tiles) : -uv.a;
    if (random.chance(0.4)) uv.b = uv.a * random.between(-2, 2);
    if (random.chance(0.4)) uv.d = uv.e * random.between(-2, 2);
    const auto far = static_cast<int>(9 * wild);
    if (random.chance(0.4)) uv.c = random.signed_decade(0, far);
    if (random.chance(0.4)) uv.f = random.signed_decade(0, far);
    switch (random.index(12)) {
        case 0:
            return {0, 0, uv.c, 0, 0, uv.f};  // a point
        case 1:
            return {uv.a, uv.b, uv.c, uv.a, uv.b, uv.f};  // a line
        case 2:
            return {1.0 / 16, 0, 0, 0, 1.0 / 16, 0};  // borders of texels
        case 3:
            return {1.0 / 16, 0, 1.0 / 32, 0, 1.0 / 16, 1.0 / 32};  // centres of texels
        case 4:
            return {uv.a * 1e-38, 0, 0, 0, uv.e * 1e-38, 0};  // denormal
        default:
            return uv;
    }
}

}  // namespace

std::string random_mesh(Random& random, double wild) {
    Obj obj(random_uv(random, wild));
    const int shape = random.index(4);
    if (shape == 0) {
        add_square(obj, 2);
        return obj.text();
    }
    const int triangles = random.whole(1, 40);
    const double size = shape == 1 ? 1.0 : shape == 2 ? 0.1 : random.decade(-6, -1);
    for (int i = 0; i < triangles; ++i) {
        const std::array<double, 3> place = {random.between(-1, 1), random.between(-1, 1),
                                             shape == 1 ? random.between(-0.3, 0.3) : 0};
        std::array<std::array<double, 3>, 3> corners;
        for (auto& corner : corners)
            for (std::size_t axis = 0; axis < 3; ++axis)
                corner[axis] = place[axis] + size * random.between(-1, 1);
        if (random.chance(0.05)) corners[2] = corners[1];  // no area
        obj.triangle(corners);
    }
    return obj.text();
}

std::string tiny_triangles(Random& random, int count) {
    Obj obj({});
    for (int i = 0; i < count; ++i) {
        const double x = random.between(-1, 1), y = random.between(-1, 1), s = 0.001;
        obj.triangle({{{x, y, 0}, {x + s, y, 0}, {x, y + s, 0}}});
    }
    return obj.text();
}

std::string square_with_uv(double a, double b, double c, double d, double e, double f) {
    Obj obj({a, b, c, d, e, f});
    add_square(obj, 2);
    return obj.text();
}

}  // namespace quadrel::stress

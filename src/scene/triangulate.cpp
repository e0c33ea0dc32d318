#include "scene/triangulate.hpp"

#include <numeric>

#include "quadrel/num/functions.hpp"

namespace quadrel {
namespace {

using Triangle = std::array<std::size_t, 3>;

glm::dvec3 newell_normal(std::span<const glm::dvec3> corners) {
    glm::dvec3 normal(0);
    for (std::size_t i = 0; i < corners.size(); ++i)
        normal += cross(corners[i], corners[(i + 1) % corners.size()]);
    return normal;
}

class EarClipper {
  public:
    explicit EarClipper(std::span<const glm::dvec3> corners)
        : corners_(corners), normal_(newell_normal(corners)), left_(corners.size()) {
        std::iota(left_.begin(), left_.end(), std::size_t(0));
    }

    std::vector<Triangle> clip() {
        std::vector<Triangle> triangles;
        while (left_.size() > 3) {
            const std::size_t tip = is_simple_ ? find_ear() : 1;
            triangles.push_back(triangle_at(tip));
            left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(tip));
        }
        triangles.push_back({left_[0], left_[1], left_[2]});
        return triangles;
    }

  private:
    // The triangle whose middle corner is the place `tip` of those left.
    Triangle triangle_at(std::size_t tip) const {
        const std::size_t n = left_.size();
        return {left_[(tip + n - 1) % n], left_[tip], left_[(tip + 1) % n]};
    }

    // Twice the area of a, b, c in the polygon's plane, positive for its own sense of rotation.
    double turn(std::size_t a, std::size_t b, std::size_t c) const {
        return dot(cross(corners_[b] - corners_[a], corners_[c] - corners_[a]), normal_);
    }

    bool is_ear(std::size_t tip) const {
        const auto [a, b, c] = triangle_at(tip);
        if (!(turn(a, b, c) > 0)) return false;
        for (std::size_t i : left_) {
            if (i == a || i == b || i == c) continue;
            if (turn(a, b, i) >= 0 && turn(b, c, i) >= 0 && turn(c, a, i) >= 0) return false;
        }
        return true;
    }

    // Tips 1, 1, 1, ... of a convex polygon make the fan around corner 0.
    // A simple polygon always has an ear; without one, further searches would take the cube of the
    // number of corners.
    std::size_t find_ear() {
        for (std::size_t i = 1; i <= left_.size(); ++i)
            if (is_ear(i % left_.size())) return i % left_.size();
        is_simple_ = false;
        return 1;
    }

    std::span<const glm::dvec3> corners_;
    glm::dvec3 normal_;
    std::vector<std::size_t> left_;
    bool is_simple_ = true;
};

}  // namespace

std::vector<Triangle> triangulate(std::span<const glm::dvec3> corners) {
    if (corners.size() < 3) return {};
    return EarClipper(corners).clip();
}

}  // namespace quadrel

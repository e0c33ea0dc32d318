// The cone maps of Rabbid76's compute shader, bit for bit what it stores. Source: Rabbid76,
// github.com/Rabbid76/graphics-snippets, documentation/normal_parallax_relief.md, "Cone Step
// Mapping" (without SOURCE_TEXTURE: heights come from an rgba8 image). The shader goes through the
// rings around one texel; here all texels go through one ring after the other, each with the
// shader's operations in the shader's order, in float. What GLSL leaves open: halves round to even,
// as D3D and Mesa do; an image read outside of the image, which a remainder below 0 leads to on
// maps more than twice as wide as high, is 0; quotients and roots are correctly rounded. (Mesa's
// llvmpipe 22.3.6 has other quotients where sides are no powers of two: of 15 maps that the page's
// text was run on, one of 48 x 64 has one code that is one lower.)
#include <atomic>
#include <cmath>

#include "bake/generators.hpp"

namespace quadrel {

namespace {

/// What an rgba8 image holds of a value in [0, 1].
float stored(float value) {
    return std::nearbyint(std::clamp(value, 0.0f, 1.0f) * 255.0f) / 255.0f;
}

/// A texel's place relative to the cone's, one quarter of the plane.
struct Offset {
    int dx, dy;
};

/// What a pass of the shader's outer loop reads, mirrored in both axes, for every texel.
std::vector<Offset> ring_offsets(float dist, float step, int cx, int cy) {
    const float step_y = 1.0f / static_cast<float>(cy);
    const auto d2 = static_cast<std::int64_t>(std::nearbyint(dist * dist / (step * step)));
    int dy = static_cast<int>(std::nearbyint(dist / step_y));
    const auto squared = [](int x, int y) { return std::int64_t(x) * x + std::int64_t(y) * y; };
    std::vector<Offset> offsets;
    for (int dx = 0; static_cast<float>(dx) / static_cast<float>(cx) <= dist; ++dx) {
        if (squared(dx, dy) < d2 && dy < cy - 1) ++dy;
        do {
            offsets.push_back({dx, dy});
            --dy;
        } while (dy > 0 && squared(dx, dy) >= d2);
    }
    return offsets;
}

class RingSearch {
  public:
    explicit RingSearch(const HeightPlane& plane)
        : cx_(plane.width), cy_(plane.height), cones_(std::size_t(cx_) * cy_, 1.0f) {
        heights_.reserve(cones_.size());
        for (int j = 0; j < cy_; ++j)
            for (int i = 0; i < cx_; ++i) heights_.push_back(stored(plane.texel(i, j)));
        top_ = *std::max_element(heights_.begin(), heights_.end());
    }

    float height(std::size_t texel) const { return heights_[texel]; }
    float root(std::size_t texel) const { return stored(std::sqrt(cones_[texel])); }

    /// A row's texels by one ring; for how many of them neither it nor a wider one can matter.
    int narrow(float dist, const std::vector<Offset>& ring, int y) {
        const std::vector<const float*> rows = rows_of(ring, y);
        int done = 0;
        for (int x = 0; x < cx_; ++x) {
            const std::size_t texel = std::size_t(y) * cx_ + x;
            if (!reaches(dist, heights_[texel], cones_[texel])) {
                ++done;
                continue;
            }
            const float sample_h = highest_of(ring, rows, x);
            const float h = heights_[texel];
            if (sample_h > h) cones_[texel] = std::min(cones_[texel], dist / (sample_h - h));
        }
        return done;
    }

  private:
    /// The shader's condition; and whether even the map's top would narrow the cone.
    bool reaches(float dist, float h, float c) const {
        const float max_h = 1.0f - h;
        return dist <= max_h && c > dist / max_h && top_ > h && dist / (top_ - h) < c;
    }

    /// The two image rows of each offset; null outside.
    std::vector<const float*> rows_of(const std::vector<Offset>& ring, int y) const {
        std::vector<const float*> rows;
        for (const Offset& offset : ring) {
            for (const int dy : {-offset.dy, offset.dy}) {
                const int row = (cy_ + y + dy) % cy_;
                rows.push_back(row < 0 ? nullptr : &heights_[std::size_t(row) * cx_]);
            }
        }
        return rows;
    }

    float highest_of(const std::vector<Offset>& ring, const std::vector<const float*>& rows,
                     int x) const {
        float sample_h = 0;
        for (std::size_t k = 0; k < ring.size() && sample_h < top_; ++k) {
            const int left = x < ring[k].dx ? x - ring[k].dx + cx_ : x - ring[k].dx;
            const int right = x + ring[k].dx >= cx_ ? x + ring[k].dx - cx_ : x + ring[k].dx;
            for (const float* row : {rows[2 * k], rows[2 * k + 1]})
                if (row) sample_h = std::max({sample_h, row[left], row[right]});
        }
        return sample_h;
    }

    int cx_, cy_;
    std::vector<float> heights_, cones_;
    float top_;
};

}  // namespace

std::shared_ptr<Texture> bake_cone_rabbid(const BakeJob& job) {
    const int cx = job.plane.width, cy = job.plane.height;
    RingSearch search(job.plane);
    const float step = std::max(1.0f / static_cast<float>(cx), 1.0f / static_cast<float>(cy));
    const int texels = cx * cy;
    int done = 0;
    for (float dist = step; dist <= 1.0f && done < texels; dist += step) {
        const std::vector<Offset> ring = ring_offsets(dist, step, cx, cy);
        std::atomic<int> now = 0;
        tbb::parallel_for(0, cy, [&](int y) {
            now += search.narrow(dist, ring, y);
            job.progress.check_time();
        });
        // Rings widen and cones narrow: a texel that is done stays so.
        job.progress.add(static_cast<double>(now - done) / texels);
        done = now;
    }
    const auto map = job.make(2, 1, {{cx, cy}});
    float* const out = map->level_texels(0, 0);
    for (std::size_t k = 0; k < std::size_t(cx) * cy; ++k) {
        out[2 * k] = search.height(k);
        out[2 * k + 1] = search.root(k);
    }
    return map;
}

}  // namespace quadrel

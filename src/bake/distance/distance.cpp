// Distance volumes over a height field of blocks. Layer k of `slices` holds voxels from height
// k / slices up; a voxel is a cube, one texel wide, so lengths in the plane are in texels and all
// lengths are divided by the number of slices. Source: Donnelly, "Per-Pixel Displacement Mapping
// with Distance Functions", GPU Gems 2, chapter 8: solid voxels are those below the height and the
// two lowest; vectors to the nearest solid voxel are swept through each slice and from slice to
// slice, upwards and downwards (Danielsson, "Euclidean Distance Mapping", 1980), which finds nearly
// the least distance; values are min(1, distance), cut to 8 bits.
#include <array>

#include "bake/generators.hpp"
#include "bake/rounding.hpp"

namespace quadrel {

namespace {

using Vector = std::array<int, 3>;

constexpr Vector unknown{10000, 10000, 10000};

std::int64_t length_squared(const Vector& v) {
    return std::int64_t(v[0]) * v[0] + std::int64_t(v[1]) * v[1] + std::int64_t(v[2]) * v[2];
}

/// Vectors to the nearest solid voxel, propagated from neighbour to neighbour.
class VectorSweep {
  public:
    VectorSweep(const HeightPlane& plane, int slices)
        : u_(plane.grid.u),
          v_(plane.grid.v),
          slices_(slices),
          vectors_(static_cast<std::size_t>(u_.count) * v_.count * slices, unknown) {
        for (int k = 0; k < slices; ++k)
            for (int j = 0; j < v_.count; ++j)
                for (int i = 0; i < u_.count; ++i)
                    if (k <= 1 || k < plane.at(i, j) * slices) at(i, j, k) = {0, 0, 0};
    }

    /// As the next `share` of the whole work.
    void run(Progress& progress, double share) {
        for (int n = 0; n < 2 * slices_; ++n) {
            const bool up = n < slices_;
            const int k = up ? n : 2 * slices_ - 1 - n;
            sweep_slice(k, up ? k - 1 : k + 1);
            progress.add(share / (2 * slices_));
        }
    }

    /// In voxels, of stored texel (i, j).
    double distance(int i, int j, int k) {
        return std::sqrt(static_cast<double>(length_squared(at(i, j, k))));
    }

  private:
    Vector& at(int i, int j, int k) {
        return vectors_[(static_cast<std::size_t>(k) * v_.count + j) * u_.count + i];
    }

    void take(Vector& mine, const Vector& other, const Vector& step) {
        const Vector candidate{other[0] + step[0], other[1] + step[1], other[2] + step[2]};
        if (length_squared(candidate) < length_squared(mine)) mine = candidate;
    }

    void sweep_slice(int k, int from) {
        if (from >= 0 && from < slices_) {
            for (int j = 0; j < v_.count; ++j)
                for (int i = 0; i < u_.count; ++i)
                    take(at(i, j, k), at(i, j, from), {0, 0, from - k});
        }
        sweep_rows(k, 1);
        sweep_rows(k, -1);
    }

    /// Rows in one direction, each to the right and to the left; twice around where they wrap.
    void sweep_rows(int k, int step) {
        const int turns = v_.periodic ? 2 * v_.count : v_.count;
        for (int n = 0; n < turns; ++n) {
            const int j = (step > 0 ? n : turns - 1 - n) % v_.count;
            const int before = j - step;
            if (v_.periodic || (before >= 0 && before < v_.count)) {
                const int row = HeightPlane::wrap_step(before, v_);
                for (int i = 0; i < u_.count; ++i) take(at(i, j, k), at(i, row, k), {0, -step, 0});
            }
            sweep_columns(j, k, 1);
            sweep_columns(j, k, -1);
        }
    }

    void sweep_columns(int j, int k, int step) {
        const int turns = u_.periodic ? 2 * u_.count : u_.count;
        for (int n = 0; n < turns; ++n) {
            const int i = (step > 0 ? n : turns - 1 - n) % u_.count;
            const int before = i - step;
            if (!u_.periodic && (before < 0 || before >= u_.count)) continue;
            take(at(i, j, k), at(HeightPlane::wrap_step(before, u_), j, k), {-step, 0, 0});
        }
    }

    GridAxis u_, v_;
    int slices_;
    std::vector<Vector> vectors_;
};

}  // namespace

std::shared_ptr<Texture> bake_distance(const BakeJob& job) {
    const HeightPlane& plane = job.plane;
    const int slices = job.whole("slices");
    const auto map = job.make(1, slices, {{plane.width, plane.height}});
    VectorSweep sweep(plane, slices);
    sweep.run(job.progress, 0.9);
    job.rows(slices, 0.1, [&](int k) {
        float* out = map->level_texels(0, k);
        for (int j = 0; j < plane.height; ++j) {
            for (int i = 0; i < plane.width; ++i) {
                const double distance =
                    sweep.distance(i - plane.grid.u.first, j - plane.grid.v.first, k);
                *out++ = floor_to_code(static_cast<float>(std::min(1.0, distance / slices)), 8);
            }
        }
    });
    return map;
}

}  // namespace quadrel

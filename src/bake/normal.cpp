// Normal maps from heights. Sources for the three kernels: Rabbid76, "Parallax mapping" (graphics
// snippets), whose sums leave out the divisions by 2, 2 and 8 that make them slopes; here they are
// slopes. n = normalize(-depth dh/du, -depth dh/dv, 1), stored as 0.5 + 0.5 n with the height in
// alpha, as sources pack them: n.y > 0 where heights fall as v grows.
#include "bake/generators.hpp"
#include "bake/rounding.hpp"

namespace quadrel {

namespace {

struct Slopes {
    double u, v;  ///< height a texel
};

/// Texel (i, j) and its neighbours towards +u and +v: the forward differences of the 2x2, averaged.
Slopes gather_slopes(const HeightPlane& p, int i, int j) {
    const double h00 = p.texel(i, j), h10 = p.texel(i + 1, j), h01 = p.texel(i, j + 1);
    const double h11 = p.texel(i + 1, j + 1);
    return {((h10 - h00) + (h11 - h01)) / 2, ((h01 - h00) + (h11 - h10)) / 2};
}

Slopes central_slopes(const HeightPlane& p, int i, int j) {
    const auto h = [&](int di, int dj) { return static_cast<double>(p.texel(i + di, j + dj)); };
    return {(h(1, 0) - h(-1, 0)) / 2, (h(0, 1) - h(0, -1)) / 2};
}

Slopes sobel_slopes(const HeightPlane& p, int i, int j) {
    const auto h = [&](int di, int dj) { return static_cast<double>(p.texel(i + di, j + dj)); };
    return {((h(1, -1) - h(-1, -1)) + 2 * (h(1, 0) - h(-1, 0)) + (h(1, 1) - h(-1, 1))) / 8,
            ((h(-1, 1) - h(-1, -1)) + 2 * (h(0, 1) - h(0, -1)) + (h(1, 1) - h(1, -1))) / 8};
}

using Kernel = Slopes (*)(const HeightPlane& plane, int i, int j);

std::shared_ptr<Texture> make_normals(const BakeJob& job, Kernel kernel) {
    const HeightPlane& plane = job.plane;
    const auto map = job.make(4, 1, {{plane.width, plane.height}});
    const double depth = job.parameter("depth");
    float* const texels = map->level_texels(0, 0);
    job.rows(plane.height, 1, [&](int j) {
        float* out = texels + static_cast<std::size_t>(j) * plane.width * 4;
        for (int i = 0; i < plane.width; ++i, out += 4) {
            const Slopes slopes = kernel(plane, i, j);
            const double x = -depth * slopes.u * plane.width;
            const double y = -depth * slopes.v * plane.height;
            const double length = std::sqrt(x * x + y * y + 1);
            out[0] = static_cast<float>(0.5 + 0.5 * (x / length));
            out[1] = static_cast<float>(0.5 + 0.5 * (y / length));
            out[2] = static_cast<float>(0.5 + 0.5 / length);
            out[3] = plane.texel(i, j);
        }
    });
    return map;
}

}  // namespace

std::shared_ptr<Texture> bake_normal_gather(const BakeJob& job) {
    return make_normals(job, gather_slopes);
}
std::shared_ptr<Texture> bake_normal_4tap(const BakeJob& job) {
    return make_normals(job, central_slopes);
}
std::shared_ptr<Texture> bake_normal_sobel(const BakeJob& job) {
    return make_normals(job, sobel_slopes);
}

}  // namespace quadrel

// Rabbid76's compute shader for cone maps, line by line, for one texel; above each line of code
// stands the shader's. Source: github.com/Rabbid76/graphics-snippets,
// documentation/normal_parallax_relief.md, "Cone Step Mapping", without SOURCE_TEXTURE.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace quadrel::listings {

/// layout(rgba8, binding = 1) uniform image2D: red and green; blue and alpha are stored as 0.
struct ConeMapImage {
    int width, height;
    std::vector<std::array<std::uint8_t, 2>> texels;

    bool inside(int x, int y) const { return x >= 0 && y >= 0 && x < width && y < height; }
    /// imageLoad().x; 0 outside.
    float load(int x, int y) const {
        return inside(x, y) ? static_cast<float>(texels[std::size_t(y) * width + x][0]) / 255.0f
                            : 0;
    }
    /// imageStore of (r, g, 0, 0).
    void store(int x, int y, float r, float g) {
        texels[std::size_t(y) * width + x] = {code(r), code(g)};
    }
    static std::uint8_t code(float v) {
        return static_cast<std::uint8_t>(std::nearbyint(std::clamp(v, 0.0f, 1.0f) * 255.0f));
    }
};

/// main() for gl_GlobalInvocationID.xy = (x, y).
inline void rabbid_cone_map(ConeMapImage& cone_map_image, int x, int y) {
    const auto get_height = [&](int column, int row) { return cone_map_image.load(column, row); };
    // const float max_cone_c = 1.0;
    const float max_cone_c = 1.0f;
    // ivec2 map_dim = imageSize(cone_map_image); int cx = map_dim.x; int cy = map_dim.y;
    const int cx = cone_map_image.width, cy = cone_map_image.height;
    // float step_x = 1.0 / float(cx);
    const float step_x = 1.0f / static_cast<float>(cx);
    // float step_y = 1.0 / float(cy);
    const float step_y = 1.0f / static_cast<float>(cy);
    // float step = max(step_x, step_y);
    const float step = std::max(step_x, step_y);
    // float h = get_height(pixel_coords);
    const float h = get_height(x, y);
    // float c = max_cone_c;
    float c = max_cone_c;
    // float max_h = 1.0 - h;
    const float max_h = 1.0f - h;
    // float max_dist = min(max_cone_c * max_h, 1.0);
    const float max_dist = std::min(max_cone_c * max_h, 1.0f);
    // for( float dist = step; dist <= max_dist && c > dist / max_h; dist += step )
    for (float dist = step; dist <= max_dist && c > dist / max_h; dist += step) {
        // int d2 = int(round((dist*dist) / (step*step)));
        const int d2 = static_cast<int>(std::nearbyint((dist * dist) / (step * step)));
        // int dy = int(round(dist / step_y));
        int dy = static_cast<int>(std::nearbyint(dist / step_y));
        // float sample_h = 0;
        float sample_h = 0;
        // for( int dx = 0; sample_h < 1.0 && float(dx) / float(cx) <= dist; ++ dx )
        for (int dx = 0; sample_h < 1.0f && static_cast<float>(dx) / static_cast<float>(cx) <= dist;
             ++dx) {
            // if ( (dx*dx + dy*dy) < d2 && dy < cy-1 ) dy ++;
            if ((dx * dx + dy * dy) < d2 && dy < cy - 1) dy++;
            // do
            do {
                // int sx_n = ((cx + x - dx) % cx);
                const int sx_n = ((cx + x - dx) % cx);
                // int sx_p = ((cx + x + dx) % cx);
                const int sx_p = ((cx + x + dx) % cx);
                // int sy_n = ((cy + y - dy) % cy);
                const int sy_n = ((cy + y - dy) % cy);
                // int sy_p = ((cy + y + dy) % cy);
                const int sy_p = ((cy + y + dy) % cy);
                // sample_h = max( sample_h, get_height(ivec2(sx_p, sy_p)) );
                sample_h = std::max(sample_h, get_height(sx_p, sy_p));
                // sample_h = max( sample_h, get_height(ivec2(sx_p, sy_n)) );
                sample_h = std::max(sample_h, get_height(sx_p, sy_n));
                // sample_h = max( sample_h, get_height(ivec2(sx_n, sy_p)) );
                sample_h = std::max(sample_h, get_height(sx_n, sy_p));
                // sample_h = max( sample_h, get_height(ivec2(sx_n, sy_n)) );
                sample_h = std::max(sample_h, get_height(sx_n, sy_n));
                // dy --;
                dy--;
                // while ( dy > 0 && (dx*dx + dy*dy) >= d2 );
            } while (dy > 0 && (dx * dx + dy * dy) >= d2);
        }
        // if ( sample_h > h )
        if (sample_h > h) {
            // float d_h = float(sample_h - h);
            const float d_h = sample_h - h;
            // float sample_c = dist / d_h;
            const float sample_c = dist / d_h;
            // c = min(c, sample_c);
            c = std::min(c, sample_c);
        }
    }
    // vec4 cone_map = vec4(h, sqrt(c), 0.0, 0.0);
    // imageStore(cone_map_image, pixel_coords, cone_map);
    cone_map_image.store(x, y, h, std::sqrt(c));
}

}  // namespace quadrel::listings

// Transcriptions of the searches of engines, for one fragment: what the stages named after an
// engine have to reproduce bit for bit. They state the shaders' steps in their order, in words of
// this project; the names are those of the shaders where that helps to find the line.
#pragma once

#include "relief/trace/trace_listings.hpp"

namespace quadrel::listings {

/// Epic Games, UMaterialExpressionBumpOffset: the documented formula.
inline End unreal(const Vec2& coordinate, const Vec3& eye_vector, float height_ratio,
                  float reference_plane, const Sampler& map) {
    End end;
    const float height = map(coordinate);
    end.map = height;
    end.fetches = 1;
    end.s = 1.0f - height;
    // Eye: the camera's unit vector in tangent space.
    const Vec3 eye = normalize(eye_vector);
    // Coordinate + Eye.xy * (Height - ReferencePlane) * HeightRatio
    end.uv = {coordinate.x + eye.x * (height - reference_plane) * height_ratio,
              coordinate.y + eye.y * (height - reference_plane) * height_ratio};
    return end;
}

}  // namespace quadrel::listings

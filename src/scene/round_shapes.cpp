#include "quadrel/scene/shapes.hpp"
#include "scene/degrees.hpp"
#include "scene/grid.hpp"

namespace quadrel {

// gluSphere: x = -sin(theta) sin(rho), y = cos(theta) sin(rho), z = -cos(rho) with rho upwards
// from -z here; u = theta / 360. Turning from +y towards -x is counter-clockwise seen from +z.
Mesh make_sphere(double radius, int slices, int stacks) {
    Mesh mesh;
    mesh.name = "sphere";
    append_grid(mesh, slices, stacks, [&](int slice, int stack) {
        // The seam's two columns must be equal in every bit: sin_cos_degrees(360) is that of 0.
        const SinCos around = sin_cos_degrees(360.0 * slice / slices);
        const SinCos up = sin_cos_degrees(180.0 * stack / stacks);
        const glm::dvec3 normal(-around.sine * up.sine, around.cosine * up.sine, -up.cosine);
        return GridVertex{
            normal * radius, normal, {double(slice) / slices, double(stack) / stacks}};
    });
    return mesh;
}

Mesh make_torus(double inner_radius, double outer_radius, int sides, int rings) {
    Mesh mesh;
    mesh.name = "torus";
    append_grid(mesh, rings, sides, [&](int ring, int side) {
        const SinCos around = sin_cos_degrees(360.0 * ring / rings);
        const SinCos tube = sin_cos_degrees(360.0 * side / sides);
        const glm::dvec3 normal(around.cosine * tube.cosine, around.sine * tube.cosine, tube.sine);
        const glm::dvec3 centre = glm::dvec3(around.cosine, around.sine, 0) * outer_radius;
        return GridVertex{
            centre + normal * inner_radius, normal, {double(ring) / rings, double(side) / sides}};
    });
    return mesh;
}

}  // namespace quadrel

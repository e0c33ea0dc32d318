#include "io/glib/shapes.hpp"

#include "quadrel/check.hpp"

namespace quadrel {
namespace {

GlibShape of_kind(const char* shape) {
    GlibShape out;
    out.object["mesh"]["shape"] = shape;
    return out;
}

void set(GlibShape& shape, const std::string& key, const GlibNumber& number) {
    shape.object["mesh"][key] = number.value;
    shape.positions.emplace_back("mesh." + key, number.at);
}

void set_cells(GlibShape& shape, GlibArguments& arguments) {
    Json cells = Json::array();
    for (std::size_t i = 0; i < 2; ++i) {
        const GlibNumber count = arguments.number(i == 0 ? "columns" : "rows");
        shape.positions.emplace_back(join_index("mesh.subdivide", i), count.at);
        cells.push_back(count.value);
    }
    shape.object["mesh"]["subdivide"] = std::move(cells);
}

// The plane's z and half of the side; glman's files may leave out the cells.
GlibShape read_quad_xy(GlibArguments& arguments) {
    GlibShape shape = of_kind("quad");
    const GlibNumber z = arguments.number("the plane's z");
    const GlibNumber half = arguments.positive_number("half of the side");
    set(shape, "size", {half.value * 2, half.at});
    if (arguments.has_more()) set_cells(shape, arguments);
    Json step = Json::object();
    step["translate"] = Json::array({0, 0, z.value});
    shape.object["transform"] = Json::array({step});
    shape.positions.emplace_back("transform", z.at);
    return shape;
}

GlibShape read_sphere(GlibArguments& arguments) {
    GlibShape shape = of_kind("sphere");
    set(shape, "radius", arguments.number("the radius"));
    set(shape, "slices", arguments.number("the number of slices"));
    set(shape, "stacks", arguments.number("the number of stacks"));
    return shape;
}

GlibShape read_torus(GlibArguments& arguments) {
    GlibShape shape = of_kind("torus");
    set(shape, "inner_radius", arguments.number("the tube's radius"));
    set(shape, "outer_radius", arguments.number("the distance of the tube's centre"));
    set(shape, "sides", arguments.number("the number of sides"));
    set(shape, "rings", arguments.number("the number of rings"));
    return shape;
}

}  // namespace

GlibShape read_glib_shape(GlibVerb verb, GlibArguments& arguments) {
    switch (verb) {
        case GlibVerb::quad_xy:
            return read_quad_xy(arguments);
        case GlibVerb::sphere:
            return read_sphere(arguments);
        case GlibVerb::torus:
            return read_torus(arguments);
        case GlibVerb::teapot:
            return of_kind("teapot");
        default:
            QUADREL_CHECK(false, static_cast<int>(verb));
    }
    return {};
}

}  // namespace quadrel

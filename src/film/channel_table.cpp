#include "quadrel/film/channels.hpp"

namespace quadrel {
namespace {

using Table = std::vector<ChannelInfo>;
constexpr ChannelType real = ChannelType::float32;
constexpr ChannelType integer = ChannelType::uint32;

/// `suffixes` is a string of one-letter components: "XYZ" adds name.X, name.Y and name.Z.
void add_vector(Table& table, const std::string& name, const std::string& suffixes,
                const std::string& unit, const std::string& meaning) {
    for (const char suffix : suffixes) table.push_back({name + "." + suffix, real, unit, meaning});
}

void add_color(Table& table) {
    for (const char* name : {"R", "G", "B"})
        table.push_back({name, real, "linear radiance, Rec. 709 primaries", "shaded colour"});
    table.push_back({"A", real, "0 to 1", "coverage"});
    table.push_back({"Z", real, "eye-space length", "distance of the hit along the view axis"});
    table.push_back({"depth", real, "window depth", "depth as tested"});
}

void add_geometry(Table& table) {
    add_vector(table, "P", "XYZ", "eye space", "interpolated point on the polygon");
    add_vector(table, "hit.P", "XYZ", "eye space",
               "displaced point where the ray meets the relief");
    add_vector(table, "N", "XYZ", "eye space, unit", "shading normal");
    add_vector(table, "Ng", "XYZ", "eye space, unit", "normal of the triangle");
    add_vector(table, "T", "XYZ", "eye space",
               "tangent of the frame: direction of growing u (frame-thesis: of window x)");
    add_vector(table, "B", "XYZ", "eye space",
               "bitangent of the frame: direction of growing v (frame-thesis: of window y)");
    for (const char* vertex : {"0", "1", "2"})
        table.push_back({std::string("bary.") + vertex, real, "0 to 1, perspective-correct",
                         std::string("barycentric coordinate of vertex ") + vertex});
}

void add_derivatives(Table& table) {
    add_vector(table, "uv", "UV", "texture coordinates", "interpolated texture coordinates");
    add_vector(table, "dUVdx", "UV", "texture coordinates per pixel", "dFdx of uv");
    add_vector(table, "dUVdy", "UV", "texture coordinates per pixel", "dFdy of uv, window y");
    add_vector(table, "dPdx", "XYZ", "eye-space length per pixel", "dFdx of P");
    add_vector(table, "dPdy", "XYZ", "eye-space length per pixel", "dFdy of P, window y");
}

/// Beside the finite differences that stages take, and what these are off by.
void add_exact(Table& table) {
    struct Kind {
        const char *prefix, *what;
    };
    for (const Kind kind : {Kind{"exact", "exact derivative"},
                            Kind{"derr", "finite difference as drawn minus exact derivative"}}) {
        const std::string prefix(kind.prefix), what(kind.what);
        for (const std::string axis : {"x", "y"}) {
            const std::string in = " in window " + axis;
            add_vector(table, prefix + ".dUVd" + axis, "UV", "texture coordinates per pixel",
                       what + " of uv" + in);
            add_vector(table, prefix + ".dPd" + axis, "XYZ", "eye-space length per pixel",
                       what + " of P" + in);
            add_vector(table, prefix + ".dhitUVd" + axis, "UV", "texture coordinates per pixel",
                       what + " of hit.U and hit.V" + in);
            add_vector(table, prefix + ".dNd" + axis, "XYZ", "1 / pixel",
                       what + " of the shading normal" + in);
            add_vector(table, prefix + ".dcolord" + axis, "RGB", "linear radiance per pixel",
                       what + " of R, G and B" + in);
            add_vector(table, prefix + ".dmirroredd" + axis, "XYZ", "1 / pixel",
                       what +
                           " of the direction in which the environment is looked up, in eye "
                           "space: the viewer's, mirrored by the shading normal" +
                           in);
            table.push_back(
                {prefix + ".dhd" + axis, real, "height per pixel",
                 what + " of the map's height at the hit, filtered as marches do" + in});
        }
    }
    table.push_back(
        {"exact.lod.rho", real, "texels a pixel", "lod.rho of the exact derivatives of uv"});
    table.push_back(
        {"exact.lod.lambda", real, "levels", "lod.lambda of the exact derivatives of uv"});
    table.push_back({"derr.lod.rho", real, "texels a pixel", "lod.rho as drawn minus exact"});
    table.push_back({"derr.lod.lambda", real, "levels", "lod.lambda as drawn minus exact"});
}

void add_frame(Table& table) {
    add_vector(table, "frame_normal", "XYZ", "eye space, unit", "normal of the frame");
    add_vector(table, "J.U", "XYZ", "1 / eye-space length",
               "surface gradient of u: first row of J");
    add_vector(table, "J.V", "XYZ", "1 / eye-space length",
               "surface gradient of v: second row of J");
    table.push_back(
        {"r", real, "ratio", "depth rate: share of the ray's length that goes into depth"});
    table.push_back(
        {"relief.depth", real, "world length", "thickness of the relief, after fading"});
    add_vector(table, "K", "UV", "texture coordinates",
               "shift of uv from the top to the bottom of the relief");
}

void add_hit(Table& table) {
    add_vector(table, "hit", "UV", "texture coordinates", "texture coordinates of the hit");
    table.push_back({"hit.s", real, "0 top to 1 bottom", "ray parameter of the hit"});
    table.push_back({"hit.h", real, "0 to 1", "height at the hit"});
    table.push_back({"hit.status", integer, "code",
                     "0 none, 1 hit, 2 floor, 3 cap, 4 clip, 5 no frame, 6 NaN, 7 outside"});
    table.push_back({"hit.flags", integer, "bits",
                     "1 degenerate-uv, 2 ambiguous, 4 start-below (the surface), 8 wrapped, "
                     "32 nan-look-up (what it gives is the implementation's choice)"});
    table.push_back({"frag.depth", real, "window depth", "depth of the hit by the projection"});
    table.push_back({"hit.steps", integer, "count", "steps of the search"});
    table.push_back({"hit.fetches", integer, "count", "height fetches of the search"});
}

void add_oracle(Table& table) {
    table.push_back({"oracle.s", real, "0 top to 1 bottom",
                     "ray parameter at which the ray first meets the height field of level 0"});
    add_vector(table, "oracle", "UV", "texture coordinates", "texture coordinates there");
    add_vector(table, "oracle.cell", "XY", "index",
               "column and row of the cell there: between the centres of that texel and the next; "
               "of blocks the texel");
    add_vector(table, "oracle.place", "XY", "0 to 1", "where in that cell");
    add_vector(table, "oracle.gradient", "UV", "height a texture coordinate",
               "gradient of the height there; 0 on blocks");
    table.push_back(
        {"oracle.condition", real, "ratio",
         "how far oracle.s moves with the heights, |ds/dh|; 0 at the top and on walls"});
    table.push_back({"oracle.bound", real, "0 to 1",
                     "how far oracle.s is from the exact one at most, as proven"});
    table.push_back({"oracle.status", integer, "code",
                     "as hit.status; 0 where there are no heights to judge by, as of noise"});
    table.push_back({"certified", integer, "code",
                     "how oracle.* were proven: 0 not, 1 by bounds of double's rounding, 2 by "
                     "rational arithmetic"});
    table.push_back({"certified.reason", integer, "code",
                     "why not: 0 proven, 1 no frame, 2 the ray is not finite, 3 a height on the "
                     "way is not, 4 too many cells, 5 no rational arithmetic in this build, 6 no "
                     "height map"});
    table.push_back({"certified.pixel", integer, "code",
                     "whether the pixel's ray by exact arithmetic on the same inputs meets the "
                     "field first in the cell of oracle.*, or nothing as that: 1 proven, 0 not"});
    table.push_back({"certified.pixel.reason", integer, "code",
                     "why not: as certified.reason, 7 hit or miss or the cell is open, 8 it ends "
                     "elsewhere"});
}

/// What is drawn less what the judge has; `part` is "", "search." or "frame.".
void add_errors(Table& table, const std::string& part, const std::string& of) {
    const auto add = [&](const char* name, ChannelType type, const char* unit,
                         const std::string& meaning) {
        table.push_back({"err." + part + name, type, unit, meaning + of});
    };
    add("s", real, "-1 early to 1 late", "hit.s minus the judge's");
    add("uv", real, "texels of level 0", "distance of hit.U, hit.V from the judge's");
    add("cell", integer, "0 or 1", "1: the hit is in another cell than the judge's");
    add("kind", integer, "code",
        "0 same (1/256 texel, 2^-16 of s), 1 late, 2 early, 3 hit where the judge has none, 4 none "
        "where it has one, 5 other surface, 6 not judged");
    add("normal", real, "degrees", "angle between N and that of the same stage at the judge's hit");
    add("shadow", real, "-1 to 1",
        "visibility of light 0 minus that of shadow-oracle at the judge's hit");
    for (const char* name : {"color.R", "color.G", "color.B"})
        add(name, real, "linear radiance",
            "colour minus that of the same stages at the judge's hit");
}

void add_errors(Table& table) {
    add_errors(table, "", "");
    table.push_back(
        {"err.certified", integer, "code", "how the judge's hit was proven: certified"});
    add_errors(table, "search.", ": the search alone, on the exact frame");
    add_errors(table, "frame.", ": the frame alone, under the judge's search");
    table.push_back(
        {"err.frame.K", real, "ratio", "length of K minus the exact K, to that of the exact K"});
}

void add_level_of_detail(Table& table) {
    table.push_back({"lod.rho", real, "texels a pixel", "scale factor of the pixel's footprint"});
    table.push_back(
        {"lod.lambda", real, "levels", "level of detail before clamping: log2(rho) + bias"});
    table.push_back({"lod.level", real, "levels",
                     "level of detail after clamping; its floor is the finer level that is read"});
    table.push_back({"lod.frac", real, "0 to 1", "weight of the coarser level"});
}

void add_shading(Table& table) {
    table.push_back({"occlusion", real, "0 closed to 1 open", "ambient visibility of the hit"});
    table.push_back({"occlusion.error", real, "0 to 0.5",
                     "standard error of occlusion, where that is an estimate (ao-oracle)"});
    table.push_back({"shadow.visibility", real, "0 dark to 1 lit", "visibility of light 0"});
    table.push_back({"shadow.steps", integer, "count", "steps of the shadow search of light 0"});
    table.push_back({"shadow.<i>.visibility", real, "0 dark to 1 lit", "visibility of light <i>"});
    table.push_back(
        {"shadow.<i>.steps", integer, "count", "steps of the shadow search of light <i>"});
    for (const char* term :
         {"ambient", "diffuse", "specular", "emissive", "reflection", "refraction"})
        add_vector(table, std::string("light.") + term, "RGB", "linear radiance",
                   std::string(term) + " term of the shaded colour");
}

/// Of renders whose pixels are integrals alone.
void add_integral(Table& table) {
    for (const char* name : {"R", "G", "B"})
        table.push_back({std::string("integral.error.") + name, real, "linear radiance",
                         std::string("standard error of ") + name + " as a mean over the pixel"});
    table.push_back({"integral.samples", integer, "count", "samples of the pixel's area"});
}

void add_identity(Table& table) {
    table.push_back(
        {"id.object", integer, "index",
         "object in the scene's list, behind it further materials of glTF; 0xffffffff uncovered"});
    table.push_back(
        {"id.primitive", integer, "index", "triangle in its mesh; 0xffffffff uncovered"});
    table.push_back(
        {"quad.lane", integer, "0 to 3", "lane in its quad: 1 odd x, 2 odd y (window)"});
    table.push_back(
        {"quad.coverage", integer, "bits", "lanes of the quad that are covered, bit = lane"});
}

/// Of any float channel X of the stages, and of Z.
void add_ranges(Table& table) {
    const std::string any = "<channel>";
    table.push_back({"gpu.lo." + any, real, "the channel's",
                     "least value that a GPU may give (render --limits)"});
    table.push_back({"gpu.hi." + any, real, "the channel's", "greatest value that a GPU may give"});
    table.push_back({"gpu.paths." + any, integer, "ranges",
                     "disjoint ranges that open decisions leave; 0: nothing is known"});
    table.push_back({"gpu.gap.lo." + any, real, "the channel's",
                     "where the widest gap between these ranges begins: no GPU gives a value "
                     "between the two ends of it"});
    table.push_back({"gpu.gap.hi." + any, real, "the channel's",
                     "where that gap ends; no more than gpu.gap.lo where there is none"});
    table.push_back({"bound.lo." + any, real, "the channel's",
                     "least value by exact arithmetic on the same inputs"});
    table.push_back({"bound.hi." + any, real, "the channel's",
                     "greatest value by exact arithmetic on the same inputs"});
    table.push_back({"undecided", integer, "bits",
                     "what may be decided either way by a GPU, or without --limits by rounding: 1 "
                     "coverage, 2 a test of the search, 4 cell of the hit, "
                     "8 mip level, 16 cube face, 32 branch, "
                     "64 whether the pixel has a fragment at all"});
}

Table make_table() {
    Table table;
    add_color(table);
    add_geometry(table);
    add_derivatives(table);
    add_exact(table);
    add_frame(table);
    add_hit(table);
    add_oracle(table);
    add_errors(table);
    add_level_of_detail(table);
    add_shading(table);
    add_identity(table);
    add_ranges(table);
    add_integral(table);
    return table;
}

}  // namespace

const std::vector<ChannelInfo>& channel_table() {
    static const Table table = make_table();
    return table;
}

const std::vector<std::string>& default_channels() {
    static const std::vector<std::string> names = {"R", "G", "B", "A", "Z"};
    return names;
}

}  // namespace quadrel

#include "stress/scenes/random_scene.hpp"

#include <algorithm>

#include "quadrel/num/math.hpp"
#include "quadrel/relief/registry.hpp"
#include "stress/scenes/listings.hpp"
#include "stress/scenes/random.hpp"
#include "stress/scenes/random_mesh.hpp"

namespace quadrel::stress {
namespace {

/// One scene under construction.
class Draw {
  public:
    Draw(std::uint64_t seed, std::uint64_t number) : random_(seed, number) {
        scene_.name = "random/" + std::to_string(number);
        scene_.number = number;
        wild_ = random_.chance(0.3) ? 0 : random_.unit();
        corrected_ = random_.chance(0.6);
    }

    StressScene scene() {
        const double scale = wild_ > 0 && random_.chance(0.3) ? decade(20) : 1;
        Json& document = scene_.document;
        document["quadrel"] = 1;
        document["size"] = {random_.whole(8, 32), random_.whole(8, 32)};
        add_settings(document);
        document["camera"] = camera(scale);
        document["materials"]["stress"] = material(scale);
        document["objects"] = Json::array({object(scale)});
        document["lights"] = lights(scale);
        return scene_;
    }

  private:
    bool wild(double share) { return random_.chance(share * wild_); }
    /// 10^-n to 10^n, n up to `most` with how wild the scene is.
    double decade(int most) {
        const auto n = static_cast<int>(most * wild_);
        return random_.decade(-n, n);
    }

    void add_settings(Json& document) {
        if (random_.chance(0.2)) document["samples"] = 1 << random_.index(5);
        if (random_.chance(0.2)) document["shade_at"] = "centroid";
        document["conventions"] = random_.pick({"gl", "vulkan", "d3d"});
        if (random_.chance(0.3))
            document["hardware"] =
                random_.pick({"exact", "d3d", "vulkan-min", "llvmpipe", "swiftshader"});
        if (random_.chance(0.3)) document["derivatives"] = random_.pick({"fine", "coarse"});
    }

    /// Degrees between the view and the square's normal.
    double angle() {
        switch (random_.index(6)) {
            case 0:
                return 0;
            case 1:
                return 45;
            case 2:
                return 90 - random_.decade(-2, 0);  // up to 89.99
            case 3:
                return wild(0.5) ? random_.between(85, 100) : 70;
            default:
                return random_.between(-89, 89);
        }
    }

    Json camera(double scale) {
        const double turn = angle() * 0.017453292519943295;
        double distance = 3 * scale;
        if (wild(0.3)) distance *= decade(3);
        if (wild(0.1)) distance = scale * random_.between(0, 0.2);  // inside of the slab
        far_ = place_far(scale);
        const Json target = far_;
        Json camera;
        camera["eye"] = {target[0].get<double>(),
                         target[1].get<double>() - distance * quadrel::sin(turn),
                         target[2].get<double>() + distance * quadrel::cos(turn) + 1e-30};
        camera["target"] = target;
        if (random_.chance(0.2)) {
            camera["type"] = "orthographic";
            camera["height"] = std::max(2.2 * scale, 1e-37);
        } else {
            camera["fov_y"] = wild(0.3) ? random_.between(1, 170) : 40;
            if (random_.chance(0.2)) camera["far"] = "infinite";
        }
        if (random_.chance(0.2)) camera["reversed_z"] = true;
        camera["near"] = std::max(0.01 * std::min(scale, distance), 1e-37);
        if (!camera.contains("far"))
            camera["far"] = std::max(100 * std::max(scale, distance), 1e-30);
        return camera;
    }

    /// Where the object stands.
    Json place_far(double scale) {
        if (!wild(0.3)) return {0, 0, 0};
        const auto most = static_cast<int>(9 * wild_);
        return {scale * random_.signed_decade(0, most), scale * random_.signed_decade(0, most),
                scale * random_.signed_decade(0, most)};
    }

    Json object(double scale) {
        Json mesh;
        switch (random_.index(8)) {
            case 0:
                mesh = {{"shape", "sphere"}, {"slices", 12}, {"stacks", 8}};
                break;
            case 1:
                mesh = Json::object({{"shape", random_.pick({"cube", "icosahedron"})}});
                break;
            case 2:
                mesh = {{"shape", "teapot"}, {"tessellation", 2}};
                break;
            case 3:
                mesh = {{"shape", "torus"}, {"sides", 8}, {"rings", 12}};
                break;
            case 4:
            case 5:
                scene_.mesh = random_mesh(random_, wild_);
                mesh = Json::object({{"file", scene_.mesh_file()}});
                if (random_.coin()) mesh["normals"] = "flat";
                break;
            default:
                mesh = Json::object({{"shape", "quad"}});
                if (random_.chance(0.2)) mesh["subdivide"] = {random_.whole(1, 40), 3};
        }
        Json steps = Json::array({Json::object({{"scale", scale}})});
        if (wild(0.2))
            steps.push_back(Json::object({{"scale", {decade(4), decade(4), decade(4)}}}));
        steps.push_back(Json::object({{"translate", far_}}));
        return {{"mesh", mesh}, {"material", "stress"}, {"transform", steps}};
    }

    MapName map(const std::vector<std::string>& kinds) {
        const auto& [width, height] = random_.pick(map_sizes());
        return {random_.pick(kinds), width, height};
    }

    Json texture(bool height) {
        const bool nan = wild(0.05);
        Json texture = texture_of(map(nan ? nan_map_kinds() : map_kinds()));
        scene_.has_nan = scene_.has_nan || nan;
        const auto wrap = [&] {
            return random_.pick(
                {"repeat", "mirrored-repeat", "clamp-to-edge", "clamp-to-border", "mirror-once"});
        };
        if (random_.coin()) texture["wrap"] = {wrap(), wrap()};
        if (random_.chance(0.2)) texture["mag"] = "nearest";
        if (random_.chance(0.4))
            texture["min"] = random_.pick({"nearest", "linear", "nearest-mipmap-nearest",
                                           "linear-mipmap-nearest", "nearest-mipmap-linear"});
        if (random_.chance(0.2)) texture["mip"] = random_.pick({"none", "box", "area"});
        if (random_.chance(0.2)) texture["lod_bias"] = random_.between(-20, 20) * wild_;
        if (wild(0.1)) texture["lod_min"] = random_.between(-3, 3);
        if (!nan && random_.chance(0.2))
            texture["format"] = random_.pick({"unorm8", "srgb8", "unorm16", "half"});
        if (height && wild(0.2)) texture["border"] = {random_.between(-1, 2), 0, 0};
        return texture;
    }

    Json material(double scale) {
        Json material;
        for (const char* slot : {"color", "gloss", "emissive", "normal"})
            if (random_.chance(0.8)) material[slot] = texture(false);
        if (random_.chance(0.05))
            material["height"]["noise"]["frequency"] = random_.whole(1, 64);
        else
            material["height"] = texture(true);
        material["layers"] = texture_of({"noise", 16, 16});
        material["relief"] = relief(scale);
        material["shade"] = stage("shade");
        if (wild(0.5) || random_.chance(0.2)) material["texture_matrix"] = texture_matrix();
        material["shininess"] = wild(0.3) ? decade(6) : 50;
        if (wild(0.1)) material["specular"] = {decade(20), 1, 0};
        if (random_.chance(0.05)) material["discard_below"] = 0.5;
        if (random_.chance(0.1)) material["cull"] = random_.pick({"back", "front"});
        return material;
    }

    Json texture_matrix() {
        Json matrix;
        matrix["scale"] = {decade(6), decade(6)};
        matrix["rotate"] = random_.between(-180, 180);
        if (wild(0.6)) matrix["offset"] = {far_offset(), far_offset()};
        return matrix;
    }

    double far_offset() { return random_.signed_decade(0, static_cast<int>(9 * wild_)); }

    Json relief(double scale) {
        Json relief = stage("trace");
        relief["trace"] = relief["id"];
        relief.erase("id");
        for (const char* room : {"frame", "surface", "shadow"}) relief[room] = stage(room);
        if (random_.chance(0.1)) relief["clip"] = stage("clip");
        if (random_.chance(0.1)) relief["frag_depth"] = stage("frag-depth");
        if (random_.chance(0.1)) relief["occlusion"] = stage("occlusion");
        relief["depth"] = std::min(depth(scale), 1e12);
        if (random_.chance(0.2))
            relief["seat"] = random_.pick(std::vector<double>{0, 0.5, 1, 1e-30});
        if (random_.chance(0.1)) relief["grazing_fade"] = {random_.between(0, 40), 80};
        return relief;
    }

    double depth(double scale) {
        if (random_.chance(0.05)) return 0;
        if (wild(0.1)) return random_.decade(-44, -38);
        return (wild(0.3) ? decade(6) : 0.1) * scale;
    }

    /// A stage of a room with some of its parameters.
    Json stage(const std::string& room) {
        // Judges are for rays that pass few tiles.
        std::vector<std::string> ids = stage_ids(room, wild_ < 0.1);
        if (corrected_) std::erase_if(ids, is_listing);
        const std::string id = random_.pick(ids);
        Json stage = Json::object({{"id", id}});
        for (const ParameterText& parameter : find_stage(id)->parameters)
            if (random_.chance(0.3)) stage[parameter.name] = value(parameter);
        return stage;
    }

    /// Mostly something of use, sometimes an end of the range; counts stay small enough to wait
    /// for.
    double value(const ParameterText& parameter) {
        constexpr double most_steps = 512;
        constexpr double farthest = 1e3;  // of what may be anywhere, such as a rectangle
        const double low = std::max(parameter.minimum, -farthest);
        double high = parameter.integer ? parameter.maximum
                                        : std::min(parameter.maximum, std::max(farthest, low + 1));
        if (parameter.integer) high = std::min(high, std::max(low + 1, most_steps));
        if (random_.chance(0.15 + 0.3 * wild_)) return random_.coin() ? low : high;
        const double around = std::max(parameter.default_value, low);
        double chosen = random_.between(low, std::min(high, 4 * around + 1));
        if (parameter.integer) chosen = static_cast<double>(static_cast<std::int64_t>(chosen));
        return std::clamp(chosen, low, high);
    }

    Json lights(double scale) {
        Json lights = Json::array();
        for (int count = random_.chance(0.1) ? random_.whole(0, 8) : 1; count > 0; --count) {
            Json light;
            light["space"] = random_.pick({"eye", "world"});
            const double far = scale * (wild(0.3) ? decade(6) : 3);
            const Json place = {far * random_.between(-1, 1), far * random_.between(-1, 1),
                                random_.chance(0.2) ? 0.0 : far * random_.between(-1, 1)};
            if (random_.chance(0.3)) {
                light["type"] = "directional";
                light["direction_to_light"] = direction();
            } else {
                light["position"] = place;
                if (random_.chance(0.2)) light["attenuation"] = {0, decade(6), decade(6)};
            }
            if (wild(0.2)) light["intensity"] = decade(20);
            lights.push_back(light);
        }
        return lights;
    }

    /// The zenith, the horizon, from below, along an axis, anywhere.
    Json direction() {
        switch (random_.index(4)) {
            case 0:
                return {0, 0, 1};
            case 1:
                return {random_.sign(), 0, 0};
            case 2:
                return {0.3, 0, -1};
            default:
                return {random_.between(-1, 1), random_.between(-1, 1), decade(12)};
        }
    }

    Random random_;
    StressScene scene_;
    double wild_ = 0;         ///< 0 tame to 1 absurd
    bool corrected_ = false;  ///< no stage that follows a listing
    Json far_;
};

}  // namespace

StressScene random_scene(std::uint64_t seed, std::uint64_t number) {
    return Draw(seed, number).scene();
}

}  // namespace quadrel::stress

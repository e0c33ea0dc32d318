#include "io/scene/read.hpp"
#include "io/scene/setting_words.hpp"

namespace quadrel {
namespace {

constexpr Word<DerivativeMode> derivative_words[] = {{"fine", DerivativeMode::fine},
                                                     {"coarse", DerivativeMode::coarse}};
constexpr Word<bool> shade_at_words[] = {{"center", false}, {"centroid", true}};

void read_size(const SceneValue& value, Scene& out) {
    if (!value.json().is_array() || value.json().size() != 2)
        value.reject("an array of 2 integers: width, height");
    out.width = value.element(0).integer(1, 65536);
    out.height = value.element(1).integer(1, 65536);
}

int read_samples(const SceneValue& value) {
    const int samples = value.integer(1, 16);
    if ((samples & (samples - 1)) != 0) value.reject("1, 2, 4, 8 or 16");
    return samples;
}

}  // namespace

void read_settings(Fields& scene, Scene& out) {
    if (scene.has("size")) read_size(scene.get("size"), out);
    if (scene.has("samples")) out.samples = read_samples(scene.get("samples"));
    scene.read("shade_at", out.centroid, shade_at_words);
    scene.read("conventions", out.conventions, conventions_words);
    scene.read("hardware", out.hardware, hardware_words);
    if (scene.has("derivatives")) out.derivatives = scene.get("derivatives").word(derivative_words);
    scene.read("background", out.background);
}

}  // namespace quadrel

#include "stress/planted.hpp"

#include <csignal>

#include "quadrel/check.hpp"

namespace quadrel::stress {

std::vector<StressScene> planted_scenes() {
    const std::pair<const char*, const char*> errors[] = {
        {"segmentation fault", "crash"}, {"failed check", "crash"},
        {"endless loop", "hang"},        {"K is NaN", "NaN"},
        {"hit.s is NaN", "NaN"},         {"status NAN", "status"},
        {"unknown status", "status"},    {"hit beyond the bottom", "status"},
        {"lanes differ", "other bits"}};
    std::vector<StressScene> scenes;
    for (const auto& [name, kind] : errors) {
        scenes.push_back(plain_scene(name, {"fractal", 64, 64}, 45, "max-mip"));
        scenes.back().planted = kind;
    }
    return scenes;
}

void plant_fault(const StressScene& scene) {
    if (scene.planted.empty()) return;
    if (scene.name == "segmentation fault") std::raise(SIGSEGV);
    if (scene.name == "failed check") QUADREL_CHECK(scene.planted.empty(), scene.planted);
    for (volatile bool on = scene.name == "endless loop"; on;) on = true;
}

void plant_error(const StressScene& scene, Film& single, Film& lanes) {
    if (scene.planted.empty()) return;
    const Window& window = single.window;
    const std::size_t middle =
        single.index((window.x0 + window.x1) / 2, (window.y0 + window.y1) / 2);
    const auto plant = [&](const char* channel, std::uint32_t bits, bool in_both) {
        lanes.find(channel)->bits[middle] = bits;
        if (in_both) single.find(channel)->bits[middle] = bits;
    };
    constexpr std::uint32_t two = 0x40000000;
    if (scene.name == "K is NaN") plant("K.U", canonical_nan, true);
    if (scene.name == "hit.s is NaN") plant("hit.s", canonical_nan, true);
    if (scene.name == "status NAN") plant("hit.status", 6, true);
    if (scene.name == "unknown status") plant("hit.status", 9, true);
    if (scene.name == "hit beyond the bottom") plant("hit.s", two, true);
    if (scene.name == "lanes differ") plant("hit.s", two, false);
}

}  // namespace quadrel::stress

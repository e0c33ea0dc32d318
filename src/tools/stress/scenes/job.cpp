#include "stress/scenes/job.hpp"

#include <charconv>

#include "quadrel/error.hpp"
#include "stress/scenes/lists.hpp"

namespace quadrel::stress {

Job::Job(std::uint64_t seed, std::uint64_t random_scenes, std::size_t stride)
    : seed_(seed), random_(random_scenes) {
    if (stride == 0) return;
    const std::vector<StressScene> all = listed_scenes();
    for (std::size_t i = 0; i < all.size(); i += stride) listed_.push_back(all[i]);
}

StressScene Job::scene(std::uint64_t number) const {
    if (number < listed_.size()) return listed_[number];
    return random_scene(seed_, number - listed_.size());
}

StressScene scene_by_name(std::uint64_t seed, const std::string& name) {
    const std::string prefix = "random/";
    const std::string digits = name.starts_with(prefix) ? name.substr(prefix.size()) : name;
    std::uint64_t number = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    if (error == std::errc() && stop == end && !digits.empty()) return random_scene(seed, number);
    for (StressScene& scene : listed_scenes())
        if (scene.name == name) return scene;
    throw UsageError("--only: found \"" + name +
                     "\", expected the number of a random scene, or the name of a listed one as "
                     "--list prints them");
}

}  // namespace quadrel::stress

#include "stress/scenes/job.hpp"

#include <algorithm>
#include <charconv>

#include "quadrel/error.hpp"
#include "stress/scenes/lists.hpp"

namespace quadrel::stress {
namespace {

const std::string random_prefix = "random/";

/// All of `digits` as a number.
std::optional<std::uint64_t> number_in(const std::string& digits) {
    std::uint64_t number = 0;
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    if (error != std::errc() || stop != end) return std::nullopt;
    return number;
}

}  // namespace

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

std::optional<std::uint64_t> Job::number_of(const std::string& name) const {
    if (name.starts_with(random_prefix)) {
        const auto number = number_in(name.substr(random_prefix.size()));
        if (!number || *number >= random_) return std::nullopt;
        return listed_.size() + *number;
    }
    const auto found = std::ranges::find(listed_, name, &StressScene::name);
    if (found == listed_.end()) return std::nullopt;
    return static_cast<std::uint64_t>(found - listed_.begin());
}

std::uint64_t Job::next(std::uint64_t first, std::uint64_t stride) const {
    while (first < count() && left_out_.contains(first)) first += stride;
    return first;
}

StressScene scene_by_name(std::uint64_t seed, const std::string& name) {
    const std::string digits =
        name.starts_with(random_prefix) ? name.substr(random_prefix.size()) : name;
    if (const auto number = number_in(digits)) return random_scene(seed, *number);
    for (StressScene& scene : listed_scenes())
        if (scene.name == name) return scene;
    throw UsageError("--only: found \"" + name +
                     "\", expected the number of a random scene, or the name of a listed one as "
                     "--list prints them");
}

}  // namespace quadrel::stress

// What is to be run, and how each scene of it is found again.
#pragma once

#include <cstdint>
#include <vector>

#include "stress/scenes/random_scene.hpp"

namespace quadrel::stress {

/// The listed scenes first, then random ones, numbered through.
class Job {
  public:
    /// Of the listed ones every `stride`-th, none if 0.
    Job(std::uint64_t seed, std::uint64_t random_scenes, std::size_t stride);

    explicit Job(std::vector<StressScene> scenes)
        : seed_(0), random_(0), listed_(std::move(scenes)) {}

    std::uint64_t count() const { return listed_.size() + random_; }
    StressScene scene(std::uint64_t number) const;

  private:
    std::uint64_t seed_, random_;
    std::vector<StressScene> listed_;
};

/// A scene by its name: a listed one's, or "K" or "random/K" for scene K of the seed. Throws
/// UsageError.
StressScene scene_by_name(std::uint64_t seed, const std::string& name);

}  // namespace quadrel::stress

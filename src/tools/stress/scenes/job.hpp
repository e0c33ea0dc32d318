// What is to be run, and how each scene of it is found again.
#pragma once

#include <cstdint>
#include <optional>
#include <set>
#include <string>
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
    /// Of the scene of that name; none if it is not a part of the job.
    std::optional<std::uint64_t> number_of(const std::string& name) const;

    /// Leaves a scene out: it has been run.
    void leave_out(std::uint64_t number) { left_out_.insert(number); }
    /// The first number from `first` on, in strides, that is not left out; count() or more if none
    /// is.
    std::uint64_t next(std::uint64_t first, std::uint64_t stride) const;

  private:
    std::uint64_t seed_, random_;
    std::vector<StressScene> listed_;
    std::set<std::uint64_t> left_out_;
};

/// A scene by its name: a listed one's, or "K" or "random/K" for scene K of the seed. Throws
/// UsageError.
StressScene scene_by_name(std::uint64_t seed, const std::string& name);

}  // namespace quadrel::stress

// What a run has found.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "stress/checks.hpp"

namespace quadrel::stress {

/// Findings of one kind and place.
struct FindingGroup {
    std::uint64_t count = 0;
    std::vector<std::string> scenes;  ///< the first ones, with what was found in each
};

class Report {
  public:
    void add(const std::string& scene, const SceneResult& result);

    std::uint64_t scenes() const { return scenes_; }
    bool has_errors() const { return errors_ > 0; }
    /// Markdown.
    std::string to_text() const;

  private:
    std::string findings_text(bool errors) const;
    std::string departures_text() const;

    std::string left_out_text() const;

    std::uint64_t scenes_ = 0, refused_ = 0, unjudged_ = 0, errors_ = 0;
    std::uint64_t in_part_ = 0, pixels_ = 0, left_out_ = 0;  ///< of scenes that were drawn in part
    std::uint64_t fragments_ = 0, certified_ = 0;            ///< of scenes that were judged
    std::map<std::pair<std::string, std::string>, FindingGroup> findings_;
    std::map<std::string, std::uint64_t> refusals_;
    std::map<std::uint32_t, std::uint64_t> statuses_;
    std::map<std::string, Departure> by_frame_, by_trace_;
};

}  // namespace quadrel::stress

// A scene that is ready to be drawn with given kernels, any number of times.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "kernels/table.hpp"
#include "render/plan/prepared.hpp"

namespace quadrel::bench {

/// A scene and what overrides make of it.
struct PictureText {
    const char* name;   ///< in the name of the benchmark
    const char* scene;  ///< installed scene
    std::vector<std::string> overrides;
};

/// 1024 x 1024, default channels.
class Picture {
  public:
    Picture(const PictureText& text, const KernelTable& kernels);

    Film draw(int threads, StageTimes* times = nullptr) const;
    /// Pixels that something covers.
    std::size_t covered() const;

  private:
    std::unique_ptr<Scene> scene_;
    PreparedRender prepared_;
};

/// The thesis' quad as the scenes have it: it covers a fifth of the frame.
const std::vector<PictureText>& thesis_pictures();
/// The same and a plain trilinear texture, each filling the frame.
const std::vector<PictureText>& full_pictures();

}  // namespace quadrel::bench

// Mesa's software rasterizer, asked through EGL without a window system.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "quadrel/scene/scene.hpp"
#include "rows.hpp"

namespace quadrel::peers {

/// One frame: a program, a scene's quad, maps and uniforms, and a target of RGBA32F.
class ShadedFrame {
  public:
    virtual ~ShadedFrame() = default;
    /// Clears and draws; returns when all is done.
    virtual void draw() = 0;
    /// R, G, B and A of each pixel, the top row first.
    virtual std::vector<float> read() = 0;
};

class Llvmpipe {
  public:
    virtual ~Llvmpipe() = default;
    /// The row's shader over the scene. `defines` go before the row's own. Throws
    /// std::runtime_error with the compiler's message.
    virtual std::unique_ptr<ShadedFrame> frame(const Row& row, const Scene& scene,
                                               const std::vector<std::string>& defines) = 0;
    /// Name and version.
    virtual std::string description() const = 0;
};

/// With so many threads (1: the caller's own). One at a time. Null where there is none; then `why`
/// says so.
std::unique_ptr<Llvmpipe> open_llvmpipe(int threads, std::string& why);

}  // namespace quadrel::peers

// The command line that re-runs one pixel of a render, for messages about our own mistakes.
#pragma once

#include <span>
#include <string>

#include "kernels/table.hpp"
#include "quadrel/check.hpp"
#include "quadrel/raster/coverage.hpp"
#include "quadrel/scene/scene.hpp"

namespace quadrel {

/// `quadrel probe` for pixels of a scene on given kernels. The scene must outlive it.
class ProbeCommand {
  public:
    /// On the kernels of `table`, which were asked for as `isa` (as render options name it).
    ProbeCommand(const Scene& scene, const KernelTable& table, const std::string& isa);

    /// Another option of the command line, with its value.
    void add(const std::string& option, const std::string& value);

    /// For a pixel of the quad that is seen, ready for a shell.
    std::string text(const QuadCoverage& quad) const;
    /// For a pixel in image coordinates.
    std::string text(int x, int y) const;

  private:
    const Scene& scene_;
    std::string options_;
};

/// While it lives, failed checks of the thread name the quads that it is about and the command that
/// re-runs the first.
class QuadContext : public CheckContext {
  public:
    /// Both must outlive it.
    QuadContext(const ProbeCommand& command, std::span<const QuadCoverage> quads)
        : command_(command), quads_(quads) {}
    std::string text() const override;

  private:
    const ProbeCommand& command_;
    std::span<const QuadCoverage> quads_;
};

}  // namespace quadrel

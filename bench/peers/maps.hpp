// The maps that the pictures show: the bricks of data/textures, of any size.
#pragma once

#include <filesystem>
#include <glm/vec2.hpp>
#include <string>

namespace quadrel::peers {

/// A folder of its own under the system's temporary one, removed at the end, and when the program
/// is interrupted.
class TemporaryFolder {
  public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Writes height.exr, color.exr and gloss.exr, `side` texels a side, a power of two; above 1024 the
/// wall of 1024 texels, interpolated. Where `heights_alone`, only the first.
void write_wall(const std::filesystem::path& folder, int side, bool heights_alone = false);

/// The same of any width and height up to 1024.
void write_wall(const std::filesystem::path& folder, glm::ivec2 size);

/// Writes heights alone: of a kind that `quadrel sweep` makes, with the kind's usual parameters.
void write_heights(const std::filesystem::path& file, const std::string& kind, int side);

}  // namespace quadrel::peers

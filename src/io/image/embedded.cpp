// Images that lie within glTF files.
#include <fmt/format.h>
#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <new>

#include "io/gltf/material/images.hpp"
#include "io/image/readers.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

/// Bytes in memory under the name of a file, which is what readers want.
class MemoryFile {
  public:
    explicit MemoryFile(const std::vector<unsigned char>& bytes)
        : descriptor_(memfd_create("image", MFD_CLOEXEC)) {
        std::size_t done = 0;
        while (descriptor_ >= 0 && done < bytes.size()) {
            const ssize_t now = write(descriptor_, bytes.data() + done, bytes.size() - done);
            if (now < 0 && errno == EINTR) continue;
            if (now <= 0) break;
            done += static_cast<std::size_t>(now);
        }
        if (descriptor_ >= 0 && done == bytes.size()) return;
        if (descriptor_ >= 0) close(descriptor_);
        throw std::bad_alloc();
    }
    ~MemoryFile() { close(descriptor_); }
    MemoryFile(const MemoryFile&) = delete;
    MemoryFile& operator=(const MemoryFile&) = delete;

    std::string name() const { return fmt::format("/proc/self/fd/{}", descriptor_); }

  private:
    int descriptor_;
};

}  // namespace

Image read_embedded_image(const FileBytes& file, const ImageSelection& selection,
                          const std::string& key) {
    const std::string name = file.file().string();
    if (!selection.layer.empty())
        throw InputError(name, key, "a file without layers", "an EXR file");
    std::string bytes(static_cast<std::size_t>(file.size()), '\0');
    bytes.resize(file.read(0, bytes.data(), bytes.size()));
    const MemoryFile image(read_gltf_image(name, bytes, selection.part, key));
    try {
        return read_other_image(image.name(), key).decoded();
    } catch (const InputError& error) {
        throw InputError(name, key, "in the image within: " + error.found, error.expected);
    }
}

}  // namespace quadrel

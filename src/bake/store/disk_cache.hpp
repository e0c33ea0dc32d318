// Baked maps as files of one folder, bounded in size.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>

#include "quadrel/texture/texture.hpp"

namespace quadrel {

class DiskCache {
  public:
    DiskCache(std::filesystem::path folder, std::uintmax_t most_bytes)
        : folder_(std::move(folder)), most_bytes_(most_bytes) {}

    /// The user's cache, or nothing where there is no home or it is switched off. Throws UsageError
    /// if QUADREL_CACHE_MIB is not a number.
    static std::optional<DiskCache> of_user();

    /// Whether QUADREL_CACHE_MIB is 0.
    static bool is_switched_off();

    /// The entry of this id, or null if there is none, or none that is whole: such a one is
    /// removed, and so is what is no file at all (a pipe, a link to nowhere), but for folders.
    std::shared_ptr<const Texture> load(const std::string& id) const;

    /// Writes an entry under the texture's id and removes what is too much. Returns why it could
    /// not, or nothing.
    std::optional<std::string> store(const Texture& map) const;
    /// Whether storing would fail now, and why: for finding out before long work.
    std::optional<std::string> reason_not_to_write(const std::string& id) const;

    const std::filesystem::path& folder() const { return folder_; }
    std::filesystem::path file_of(const std::string& id) const;

  private:
    void remove_oldest() const;

    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
};

}  // namespace quadrel

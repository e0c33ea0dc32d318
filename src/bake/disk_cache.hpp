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

    /// The entry of this id, or null if there is none, or none that is whole: such a one is
    /// removed.
    std::shared_ptr<const Texture> load(const std::string& id) const;

    /// Writes an entry under the texture's id and removes what is too much. Failing is no error.
    void store(const Texture& map) const;

    std::filesystem::path file_of(const std::string& id) const;

  private:
    void remove_oldest() const;

    std::filesystem::path folder_;
    std::uintmax_t most_bytes_;
};

}  // namespace quadrel

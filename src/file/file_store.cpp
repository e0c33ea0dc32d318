#include "file/file_store.hpp"

#include <utility>

#include "file/file_hash.hpp"
#include "file/input_record.hpp"

namespace quadrel {

FileStore::Contents FileStore::read(const std::filesystem::path& file, const std::string& key) {
    const auto bytes = std::make_shared<FileBytes>(file, key);
    {
        const std::lock_guard lock(mutex_);
        if (bytes->size() > room_) return {bytes, quadrel::file_hash(*bytes, key)};
    }
    bytes->keep(key);
    return {bytes, quadrel::file_hash(*bytes, key)};
}

std::string FileStore::file_hash(const std::filesystem::path& file, const std::string& key) {
    if (auto hash = known_file_hash(file)) {
        note_input(file);
        return *std::move(hash);
    }
    Contents contents = read(file, key);
    std::string hash = contents.hash;
    const std::lock_guard lock(mutex_);
    if (!contents.bytes->kept() || contents.bytes->size() > room_) return hash;
    if (kept_.emplace(file, contents).second) room_ -= contents.bytes->size();
    return hash;
}

FileStore::Contents FileStore::take(const std::filesystem::path& file, const std::string& key) {
    const auto known = known_file_hash(file);
    Contents contents;
    {
        const std::lock_guard lock(mutex_);
        if (const auto found = kept_.find(file); found != kept_.end()) {
            contents = std::move(found->second);
            room_ += contents.bytes->size();
            kept_.erase(found);
        }
    }
    // Known only as long as the file is as it was when it was hashed.
    if (contents.bytes && known == contents.hash) return contents;
    if (known) return {std::make_shared<FileBytes>(file, key), *known};
    return read(file, key);
}

void FileStore::forget() {
    const std::lock_guard lock(mutex_);
    for (const auto& [file, contents] : kept_) room_ += contents.bytes->size();
    kept_.clear();
}

}  // namespace quadrel

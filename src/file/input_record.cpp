#include "file/input_record.hpp"

#include <algorithm>
#include <mutex>

namespace quadrel {

namespace {

std::mutex& record_mutex() {
    static std::mutex mutex;
    return mutex;
}

InputRecord* youngest = nullptr;

}  // namespace

InputRecord::InputRecord() {
    const std::lock_guard lock(record_mutex());
    outer_ = youngest;
    youngest = this;
}

InputRecord::~InputRecord() {
    const std::lock_guard lock(record_mutex());
    youngest = outer_;
}

std::vector<InputFile> InputRecord::files() const {
    const std::lock_guard lock(record_mutex());
    return files_;
}

void InputRecord::add(const std::filesystem::path& file) {
    const auto identity = identity_of(file);
    if (!identity || !identity->free_name.empty()) return;
    const bool known = std::any_of(files_.begin(), files_.end(), [&](const InputFile& other) {
        return other.identity == *identity;
    });
    if (!known) files_.push_back({file, *identity});
}

void note_input(const std::filesystem::path& file) {
    const std::lock_guard lock(record_mutex());
    if (youngest != nullptr) youngest->add(file);
}

}  // namespace quadrel

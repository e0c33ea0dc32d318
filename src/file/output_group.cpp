#include "file/output_group.hpp"

#include <unistd.h>

#include "file/file_identity.hpp"
#include "file/temporary_registry.hpp"
#include "quadrel/error.hpp"

namespace quadrel {

OutputGroup*& OutputGroup::current() {
    thread_local OutputGroup* group = nullptr;
    return group;
}

OutputGroup::OutputGroup() : outer_(current()) { current() = this; }

OutputGroup::~OutputGroup() { current() = outer_; }

void OutputGroup::commit() {
    publish_through();
    rename_all();
    files_.clear();
}

/// Devices, pipes and links first: these may fail, and only a rename hardly can.
void OutputGroup::publish_through() {
    for (AtomicFile& file : files_)
        if (file.is_through()) file.publish();
}

void OutputGroup::rename_all() {
    const SignalHold hold;
    std::vector<std::filesystem::path> made;
    try {
        for (AtomicFile& file : files_) {
            if (file.is_through()) continue;
            const auto before = identity_of(file.target_);
            file.publish();
            if (before && !before->free_name.empty()) made.push_back(file.target_);
        }
    } catch (const OutputError&) {
        for (const auto& file : made) unlink(file.c_str());
        throw;
    }
}

}  // namespace quadrel

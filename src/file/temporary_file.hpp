// Files and folders under a name of their own, to be renamed when they are whole. The name says
// host and process, and whoever writes holds a lock on the file (flock), so that what a killed
// process has left can be told from what is being written: nobody locks it.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace quadrel {

/// ".quadrel-HOST-PROCESS-RANDOM.tmp", new each time. HOST is the host's name and a checksum of its
/// machine id: over a network file system another host's locks may not be seen, so its files are
/// left alone.
std::string temporary_name();

/// Whether `name` is one that this host gives.
bool is_temporary_of_this_host(std::string_view name);

/// What a lock was answered with. File systems without locks answer `unsupported`; there nothing is
/// ever taken for abandoned.
enum class Lock { held, taken, unsupported };
Lock try_lock(int descriptor);

/// Whether `name` (no link followed) still leads to the open file.
bool leads_to(const std::filesystem::path& name, int descriptor);

/// Creates `name` and locks it; returns its descriptor. -1 with errno EEXIST where the name was
/// taken or, before the lock was held, removed by a process that tidies up: to be tried again with
/// another. -1 with any other errno where no file can be made there.
int create_locked(const std::filesystem::path& name);

/// The same for a folder.
int create_locked_folder(const std::filesystem::path& name);

/// Removes temporaries of this host and user in `folder`, folders among them with all that is in
/// them, that nobody locks. Failing is no error.
void remove_abandoned(const std::filesystem::path& folder);

/// The same, the first time that this process asks for the folder.
void remove_abandoned_once(const std::filesystem::path& folder);

}  // namespace quadrel

// An EXR file opened at the part and layer that are meant.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "file/file_bytes.hpp"
#include "quadrel/texture/selection.hpp"

namespace quadrel {

/// Headers, without pixels. All parts are flat or deep as the file has them.
struct ExrHeaders {
    std::vector<Imf::Header> parts;
    std::vector<bool> complete;  ///< whether a part was written to its end

    std::vector<std::string> names() const;  ///< of the parts; empty where a part has none
};

/// What a selection means in a file.
struct ExrChoice {
    int part = 0;
    std::string prefix;  ///< of the channels' names: "<layer>.", or nothing
};

/// Throws InputError for what is no EXR file or damaged in its headers; `key` is for the message.
ExrHeaders read_exr_headers(const FileBytes& file, const std::string& key);

/// Throws InputError where the selection names nothing or could mean several parts, for a part that
/// is deep or was not written to its end, and for a layer without channels.
ExrChoice choose_exr(const ExrHeaders& headers, const ImageSelection& selection,
                     const std::filesystem::path& file, const std::string& key);

/// Names of a part's channels that begin with `prefix`, without it.
std::vector<std::string> exr_channels(const Imf::Header& header, const std::string& prefix);

/// "a", "b" and so on, for messages; a part without a name by its number.
std::string quoted_parts(const ExrHeaders& headers);

/// Runs what reads an EXR file: exceptions of libraries become InputError; std::bad_alloc passes.
void reading_exr(const std::filesystem::path& file, const std::string& key,
                 const std::function<void()>& read);

}  // namespace quadrel

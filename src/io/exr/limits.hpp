// How much the header of an EXR file is believed.
#pragma once

#include <OpenEXR/ImfHeader.h>

#include <cstdint>
#include <string>

#include "file/file_bytes.hpp"

namespace quadrel {

/// OpenEXR allocates what an attribute says that it holds, up to 2 GB, before it reads any of it.
/// Throws InputError if one claims more than the rest of the file.
void check_exr_attributes(const FileBytes& file, const std::string& key);

/// More values than a file of this size can hold, so that a small damaged file cannot claim
/// gigabytes. Deflate makes at most 1032 bytes of one; DWA deflates a code for 64 values.
std::int64_t most_exr_values(const FileBytes& file, const Imf::Header& header);

}  // namespace quadrel

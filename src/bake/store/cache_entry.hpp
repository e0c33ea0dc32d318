// A baked map as the bytes of a cache entry: a line of text, the id, sizes, texels, and the SHA-256
// of all of it. In the machine's byte order, which the entry tells.
#pragma once

#include <memory>
#include <string>

#include "quadrel/texture/texture.hpp"

namespace quadrel {

std::string encode_entry(const Texture& map);

/// Null unless the bytes are a whole entry of this id.
std::shared_ptr<const Texture> decode_entry(const std::string& bytes, const std::string& id);

}  // namespace quadrel

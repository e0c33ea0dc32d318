#include "bake/store/cache_entry.hpp"

#include <cstring>
#include <string_view>

#include "bake/layout.hpp"
#include "text/hash.hpp"

namespace quadrel {

namespace {

constexpr std::string_view signature = "quadrel baked map, format 1\n";
constexpr std::int32_t byte_order = 0x01020304;
constexpr std::size_t digest_size = 64;

std::size_t level_bytes(const TextureView& view, int level) {
    return static_cast<std::size_t>(view.width[level]) * view.height[level] * view.channels *
           view.faces * sizeof(float);
}

void append(std::string& bytes, std::int32_t number) {
    bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

/// Takes parts off the front; everything is false or empty after the end.
class Reader {
  public:
    explicit Reader(std::string_view bytes) : rest_(bytes) {}

    bool take(std::string_view expected) {
        if (!rest_.starts_with(expected)) return false;
        rest_.remove_prefix(expected.size());
        return true;
    }
    std::int32_t number() {
        std::int32_t value = 0;
        copy(&value, sizeof value);
        return value;
    }
    bool copy(void* to, std::size_t size) {
        if (rest_.size() < size) return false;
        std::memcpy(to, rest_.data(), size);
        rest_.remove_prefix(size);
        return true;
    }
    std::size_t size() const { return rest_.size(); }

  private:
    std::string_view rest_;
};

/// The layout that an entry tells, if it is one of these many bytes of texels.
std::optional<TextureView> read_layout(Reader& reader) {
    const std::int32_t channels = reader.number(), layers = reader.number();
    const std::int32_t levels = reader.number();
    const bool known_channels = channels == 1 || channels == 2 || channels == 4;
    if (!known_channels || layers < 1 || layers > 4096 || levels < 1 || levels > max_mip_levels)
        return std::nullopt;
    std::vector<LevelSize> sizes;
    for (int level = 0; level < levels; ++level) {
        const std::int32_t width = reader.number(), height = reader.number();
        constexpr std::int32_t widest = 4 * max_image_side;
        if (width < 1 || height < 1 || width > widest || height > widest) return std::nullopt;
        sizes.emplace_back(width, height);
    }
    const auto layout = make_layout(channels, layers, sizes);
    std::size_t texels = 0;
    for (int level = 0; layout && level < levels; ++level) texels += level_bytes(*layout, level);
    return texels == reader.size() ? layout : std::nullopt;
}

}  // namespace

std::string encode_entry(const Texture& map) {
    const TextureView& view = map.view();
    std::string bytes(signature);
    bytes += map.id() + "\n";
    for (const std::int32_t n : {byte_order, view.channels, view.faces, view.levels})
        append(bytes, n);
    for (int level = 0; level < view.levels; ++level) {
        append(bytes, view.width[level]);
        append(bytes, view.height[level]);
    }
    for (int level = 0; level < view.levels; ++level)
        bytes.append(reinterpret_cast<const char*>(map.level_texels(level, 0)),
                     level_bytes(view, level));
    return bytes + sha256_hex(bytes);
}

std::shared_ptr<const Texture> decode_entry(const std::string& bytes, const std::string& id) {
    if (bytes.size() < digest_size) return nullptr;
    const std::string_view all(bytes);
    const std::string_view body = all.substr(0, all.size() - digest_size);
    if (sha256_hex(body) != all.substr(body.size())) return nullptr;
    Reader reader(body);
    if (!reader.take(signature) || !reader.take(id + "\n") || reader.number() != byte_order)
        return nullptr;
    const auto layout = read_layout(reader);
    if (!layout) return nullptr;
    const auto map = std::make_shared<Texture>(*layout, TexelFormat::float32, id);
    for (int level = 0; level < layout->levels; ++level)
        reader.copy(map->level_texels(level, 0), level_bytes(*layout, level));
    return map;
}

}  // namespace quadrel

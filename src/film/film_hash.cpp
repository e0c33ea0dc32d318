#include <algorithm>
#include <bit>

#include "quadrel/film/film.hpp"
#include "text/hash.hpp"

namespace quadrel {
namespace {

static_assert(std::endian::native == std::endian::little, "hashes are over little-endian words");

void hash_words(Sha256& hash, std::span<const std::uint32_t> words) {
    hash.update({reinterpret_cast<const char*>(words.data()), words.size_bytes()});
}

void hash_number(Sha256& hash, std::uint64_t number) {
    hash.update({reinterpret_cast<const char*>(&number), sizeof number});
}

void hash_window(Sha256& hash, const Window& window) {
    for (const int value : {window.x0, window.y0, window.x1, window.y1})
        hash_number(hash, static_cast<std::uint64_t>(std::int64_t{value}));
}

/// Lengths go before their contents, so that no two films give the same stream of bytes.
void hash_plane(Sha256& hash, const Plane& plane) {
    hash_number(hash, plane.name.size());
    hash.update(plane.name);
    hash_number(hash, static_cast<std::uint64_t>(plane.type));
    hash_number(hash, plane.bits.size());
    if (plane.type == ChannelType::uint32) return hash_words(hash, plane.bits);
    std::vector<std::uint32_t> canonical(plane.bits);
    for (std::uint32_t& bits : canonical) bits = canonical_bits(bits);
    hash_words(hash, canonical);
}

}  // namespace

std::string film_hash(const Film& film) {
    std::vector<const Plane*> planes;
    for (const Plane& plane : film.planes) planes.push_back(&plane);
    std::sort(planes.begin(), planes.end(),
              [](const Plane* a, const Plane* b) { return a->name < b->name; });
    Sha256 hash;
    hash_window(hash, film.frame);
    hash_window(hash, film.window);
    for (const Plane* plane : planes) hash_plane(hash, *plane);
    return hash.hex();
}

}  // namespace quadrel

// Films for tests: small, with every kind of value that a channel can hold.
#pragma once

#include <unistd.h>

#include <bit>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>

#include "quadrel/film/film.hpp"

namespace quadrel::testing_films {

inline std::uint32_t bits(float value) { return std::bit_cast<std::uint32_t>(value); }

/// Random bits: every class of float appears, NaNs with payloads included.
inline Film random_film(unsigned seed, Window frame = {0, 0, 17, 13},
                        Window window = {3, 2, 12, 11}) {
    std::mt19937 random(seed);
    Film film{frame, window, {}};
    for (const char* name : {"R", "G", "B", "A", "Z", "uv.U", "hit.P.X"})
        film.add(name, ChannelType::float32);
    film.add("hit.steps", ChannelType::uint32);
    for (Plane& plane : film.planes)
        for (std::uint32_t& bits : plane.bits) bits = static_cast<std::uint32_t>(random());
    constexpr std::uint32_t special[] = {0x7fc00000, 0x7fc00001, 0xffc00000, 0x7f800001, 0x7f800000,
                                         0xff800000, 0x80000000, 0x00000001, 0x7f7fffff};
    for (Plane& plane : film.planes)
        std::copy(std::begin(special), std::end(special), plane.bits.begin());
    return film;
}

/// Random finite values of moderate size.
inline Film smooth_film(unsigned seed, Window window = {0, 0, 16, 9}) {
    std::mt19937 random(seed);
    Film film{{0, 0, 16, 9}, window, {}};
    for (const char* name : {"R", "G", "B"}) film.add(name, ChannelType::float32);
    for (Plane& plane : film.planes)
        for (std::uint32_t& bits : plane.bits)
            bits = std::bit_cast<std::uint32_t>(static_cast<float>(random() % 65536) / 65536.0f);
    return film;
}

inline Film sorted_by_name(Film film) {
    std::sort(film.planes.begin(), film.planes.end(),
              [](const Plane& a, const Plane& b) { return a.name < b.name; });
    return film;
}

/// A folder that goes with its contents.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        std::string pattern = (std::filesystem::temp_directory_path() / "quadrel-XXXXXX").string();
        path_ = mkdtemp(pattern.data());
    }
    ~TemporaryFolder() { std::filesystem::remove_all(path_); }
    std::filesystem::path operator/(const std::string& name) const { return path_ / name; }
    const std::filesystem::path& path() const { return path_; }
    /// Names in the folder, hidden ones included.
    std::size_t count() const {
        return static_cast<std::size_t>(
            std::distance(std::filesystem::directory_iterator(path_), {}));
    }

  private:
    std::filesystem::path path_;
};

inline std::string file_bytes(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

inline void write_bytes(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
}

}  // namespace quadrel::testing_films

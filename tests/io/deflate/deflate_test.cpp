// Deflated bytes as zlib reads them.
#include "io/deflate/deflate.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include <functional>
#include <random>

#include "film/planted.hpp"

namespace quadrel {
namespace {

using planted::FilmError;
using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

using Bytes = std::vector<std::uint8_t>;
using Compressor = std::function<Bytes(const Bytes&)>;

Bytes deflated(const Bytes& bytes) {
    Deflate deflate;
    const auto stream = deflate.compress(bytes);
    return {stream.begin(), stream.end()};
}

AssertionResult comes_back(const Compressor& compress, const Bytes& bytes) {
    const Bytes stream = compress(bytes);
    Bytes back(bytes.size() + 1);
    uLongf size = back.size();
    const int result = uncompress(back.data(), &size, stream.data(), stream.size());
    if (result != Z_OK) return AssertionFailure() << bytes.size() << " bytes: zlib says " << result;
    back.resize(size);
    if (back != bytes) return AssertionFailure() << bytes.size() << " bytes: others";
    return AssertionSuccess();
}

/// Noise of many entropies, runs, ramps, copies from near and far, and the skewed counts that make
/// code words long.
Bytes some_bytes(std::mt19937& random, std::size_t size) {
    Bytes bytes(size);
    const unsigned kind = random() % 6, range = 1u << random() % 9;
    for (std::size_t i = 0; i < size; ++i) {
        const auto noise = static_cast<std::uint8_t>(random());
        const std::size_t back = 1 + random() % (kind == 3 ? 40 : 40000);
        unsigned value = noise % range;
        if (kind == 1) value = static_cast<unsigned>(i / (1 + range));
        if (kind == 2) value = random() % (4 * range) == 0 ? noise : 7;
        if (kind == 3 || kind == 4) value = i >= back ? bytes[i - back] : noise;
        if (kind == 5) value = static_cast<unsigned>(std::countl_zero(std::uint32_t(random()) | 1));
        bytes[i] = static_cast<std::uint8_t>(value);
    }
    return bytes;
}

AssertionResult comes_back_always(const Compressor& compress) {
    std::mt19937 random(1);
    for (std::size_t size = 0; size < 300; ++size)
        if (auto result = comes_back(compress, some_bytes(random, size)); !result) return result;
    for (int i = 0; i < 60; ++i)
        if (auto result = comes_back(compress, some_bytes(random, random() % 150000)); !result)
            return result;
    for (const std::size_t size : {49151u, 49152u, 49153u, 98304u, 300000u})
        if (auto result = comes_back(compress, Bytes(size, 128)); !result) return result;
    return AssertionSuccess();
}

Bytes deflated_with(FilmError error, Bytes bytes) {
    if (error == FilmError::deflate_drops_repeat && bytes.size() > 100000) bytes.pop_back();
    Bytes stream = deflated(bytes);
    if (error == FilmError::deflate_bit && bytes.size() > 100) stream[stream.size() / 2] ^= 4;
    if (error == FilmError::deflate_no_check) stream.back() = 0;
    return stream;
}

TEST(Deflate, ComesBack) {
    EXPECT_TRUE(comes_back_always(deflated));
    for (const FilmError error :
         {FilmError::deflate_drops_repeat, FilmError::deflate_bit, FilmError::deflate_no_check})
        EXPECT_FALSE(
            comes_back_always([&](const Bytes& bytes) { return deflated_with(error, bytes); }));
}

/// Buffers of streams before are used again.
TEST(Deflate, StreamsDoNotDependOnThoseBefore) {
    std::mt19937 random(2);
    Deflate used;
    for (int i = 0; i < 20; ++i) {
        const Bytes bytes = some_bytes(random, random() % 100000);
        const auto stream = used.compress(bytes);
        ASSERT_TRUE(Bytes(stream.begin(), stream.end()) == deflated(bytes));
    }
}

TEST(Deflate, NoiseStaysAsItIsAndRunsVanish) {
    std::mt19937 random(3);
    Bytes noise(200000);
    for (auto& byte : noise) byte = static_cast<std::uint8_t>(random());
    EXPECT_LE(deflated(noise).size(), noise.size() + 40);
    EXPECT_LE(deflated(Bytes(200000, 3)).size(), 1200u);
}

/// Where bytes are like those of films, hardly larger than zlib's.
TEST(Deflate, IsAboutAsSmallAsZlib) {
    std::mt19937 random(4);
    Bytes bytes(300000);
    for (std::size_t i = 0; i < bytes.size(); ++i)
        bytes[i] = static_cast<std::uint8_t>(
            i % 2000 < 700 ? 128 : 128 + std::popcount(random() & 0xfff) - 6);
    uLongf size = compressBound(bytes.size());
    Bytes room(size);
    ASSERT_EQ(compress2(room.data(), &size, bytes.data(), bytes.size(), 3), Z_OK);
    EXPECT_LE(static_cast<double>(deflated(bytes).size()), 1.1 * static_cast<double>(size));
}

}  // namespace
}  // namespace quadrel

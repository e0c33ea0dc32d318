// EXR's ZIP: what was packed comes back; what is damaged, cut off or of another length does not.
#include "io/exr/zip_stream.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <random>

namespace quadrel::io_tests {
namespace {

using Bytes = std::vector<std::uint8_t>;
using Unzip = std::function<bool(std::span<const std::uint8_t>, std::span<std::uint8_t>)>;

/// Bytes that differ little from those two places before, so that streams are shorter.
Bytes smooth_bytes(std::mt19937& random, std::size_t size) {
    Bytes bytes(size);
    for (std::size_t i = 0; i < size; ++i)
        bytes[i] = static_cast<std::uint8_t>((i < 2 ? 250u : bytes[i - 2]) + random() % 2);
    return bytes;
}

testing::AssertionResult gives_back(const Unzip& unzip_with) {
    std::mt19937 random(1);
    ZipStream zip;
    int streams = 0;
    for (std::size_t size = 1; size < 3000; size += size < 300 ? 1 : 67) {
        const Bytes bytes = smooth_bytes(random, size);
        const auto stream = zip.compress(bytes);
        if (stream.empty()) continue;
        ++streams;
        Bytes found(size);
        if (!unzip_with(stream, found) || found != bytes)
            return testing::AssertionFailure() << size << " bytes";
    }
    return streams > 100 ? testing::AssertionSuccess() : testing::AssertionFailure() << streams;
}

TEST(ZipStream, GivesBack) {
    EXPECT_TRUE(gives_back(unzip));
    EXPECT_FALSE(gives_back([](auto stream, auto bytes) {
        const bool is_whole = unzip(stream, bytes);
        ++bytes.back();
        return is_whole;
    }));
}

TEST(ZipStream, RefusesWhatIsDamaged) {
    std::mt19937 random(2);
    ZipStream zip;
    const Bytes bytes = smooth_bytes(random, 2000);
    const auto packed = zip.compress(bytes);
    const Bytes stream(packed.begin(), packed.end());
    Bytes found(bytes.size());
    ASSERT_TRUE(unzip(stream, found));
    for (std::size_t i = 0; i < stream.size(); ++i) {
        Bytes changed = stream;
        changed[i] ^= 0x10;
        // A few bits mean nothing: codes that are not used, the end of the last byte.
        EXPECT_TRUE(!unzip(changed, found) || found == bytes) << i;
        EXPECT_FALSE(unzip(std::span(stream).first(i), found)) << i;
    }
    for (const std::size_t size : {1u, 1999u, 2001u, 4000u}) {
        Bytes other(size);
        EXPECT_FALSE(unzip(stream, other)) << size;
    }
    EXPECT_FALSE(unzip({}, found));
    EXPECT_FALSE(unzip(stream, {}));
}

}  // namespace
}  // namespace quadrel::io_tests

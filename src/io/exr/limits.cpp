#include "io/exr/limits.hpp"

#include <algorithm>
#include <fstream>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

class HeaderScan {
  public:
    HeaderScan(const std::filesystem::path& file, const std::string& key)
        : file_(file.string()), key_(key), stream_(file, std::ios::binary) {
        std::error_code error;
        const std::uintmax_t size = std::filesystem::file_size(file, error);
        size_ = error ? 0 : static_cast<std::int64_t>(size);
    }

    void run() {
        number();  // the magic number
        constexpr std::int64_t multi_part = 0x1000;
        const bool parts = (number() & multi_part) != 0;
        while (one_header() && parts) {
        }
    }

  private:
    [[noreturn]] void fail(const std::string& found) const {
        throw InputError(file_, key_, found, "a complete EXR file");
    }

    /// False for the header without attributes that ends a list of headers.
    bool one_header() {
        std::string name = text();
        const bool any = !name.empty();
        for (; !name.empty(); name = text()) {
            text();  // its type
            const std::int64_t bytes = number();
            if (bytes > size_ - stream_.tellg())
                fail("an attribute \"" + name + "\" of " + std::to_string(bytes) + " bytes");
            stream_.seekg(bytes, std::ios::cur);
        }
        return any;
    }

    /// Four bytes, little-endian, unsigned.
    std::int64_t number() {
        unsigned char bytes[4] = {};
        if (!stream_.read(reinterpret_cast<char*>(bytes), 4)) fail("the end of the file");
        return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | std::int64_t(bytes[3]) << 24;
    }

    std::string text() {
        std::string text;
        constexpr std::size_t longest = 255;  // of names with the flag for long ones
        for (int c = stream_.get(); c != 0; c = stream_.get()) {
            if (!stream_) fail("the end of the file");
            if (text.size() == longest) fail("a name of more than 255 bytes");
            text += static_cast<char>(c);
        }
        return text;
    }

    std::string file_;
    const std::string& key_;
    std::ifstream stream_;
    std::int64_t size_ = 0;
};

}  // namespace

void check_exr_attributes(const std::filesystem::path& file, const std::string& key) {
    HeaderScan(file, key).run();
}

std::int64_t most_exr_values(const std::filesystem::path& file, const Imf::Header& header) {
    std::error_code error;
    const std::uintmax_t size = std::filesystem::file_size(file, error);
    if (error) return 0;
    const bool dwa = header.compression() == Imf::DWAA_COMPRESSION ||
                     header.compression() == Imf::DWAB_COMPRESSION;
    constexpr std::uintmax_t most_bytes = std::uintmax_t(1) << 40;
    return static_cast<std::int64_t>(std::min(size, most_bytes)) * (dwa ? 1 << 15 : 1 << 10);
}

}  // namespace quadrel

#include "io/exr/limits.hpp"

#include <algorithm>
#include <string_view>

#include "quadrel/error.hpp"

namespace quadrel {
namespace {

class HeaderScan {
  public:
    HeaderScan(const FileBytes& file, const std::string& key) : file_(file), key_(key) {}

    void run() {
        number();  // the magic number
        constexpr std::int64_t multi_part = 0x1000;
        const bool parts = (number() & multi_part) != 0;
        while (one_header() && parts) {
        }
    }

  private:
    [[noreturn]] void fail(const std::string& found) const {
        throw InputError(file_.file().string(), key_, found, "a complete EXR file");
    }

    /// False for the header without attributes that ends a list of headers.
    bool one_header() {
        std::string name = text();
        const bool any = !name.empty();
        for (; !name.empty(); name = text()) {
            text();  // its type
            const std::int64_t bytes = number();
            if (bytes > static_cast<std::int64_t>(file_.size() - at_))
                fail("an attribute \"" + name + "\" of " + std::to_string(bytes) + " bytes");
            at_ += static_cast<std::uint64_t>(bytes);
        }
        return any;
    }

    /// Four bytes, little-endian, unsigned.
    std::int64_t number() {
        unsigned char bytes[4] = {};
        if (file_.read(at_, bytes, 4) != 4) fail("the end of the file");
        at_ += 4;
        return bytes[0] | bytes[1] << 8 | bytes[2] << 16 | std::int64_t(bytes[3]) << 24;
    }

    std::string text() {
        constexpr std::size_t longest = 255;  // of names with the flag for long ones
        char room[longest + 1];
        const std::string_view bytes(room, file_.read(at_, room, sizeof room));
        const std::size_t end = bytes.find('\0');
        if (end == bytes.npos)
            fail(bytes.size() == sizeof room ? "a name of more than 255 bytes"
                                             : "the end of the file");
        at_ += end + 1;
        return std::string(bytes.substr(0, end));
    }

    const FileBytes& file_;
    const std::string& key_;
    std::uint64_t at_ = 0;
};

}  // namespace

void check_exr_attributes(const FileBytes& file, const std::string& key) {
    HeaderScan(file, key).run();
}

std::int64_t most_exr_values(const FileBytes& file, const Imf::Header& header) {
    const bool dwa = header.compression() == Imf::DWAA_COMPRESSION ||
                     header.compression() == Imf::DWAB_COMPRESSION;
    constexpr std::uint64_t most_bytes = std::uint64_t(1) << 40;
    return static_cast<std::int64_t>(std::min(file.size(), most_bytes)) * (dwa ? 1 << 15 : 1 << 10);
}

}  // namespace quadrel

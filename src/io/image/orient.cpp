#include "io/image/orient.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <utility>

#include "quadrel/check.hpp"

namespace quadrel {
namespace {

/// How an orientation's stored rows and columns run.
struct Turn {
    bool columns;       ///< stored rows are columns of the picture
    bool row_backward;  ///< the first stored row lies at the bottom, or at the right
    bool backward;      ///< within a row from the right, or from the bottom
};

constexpr Turn turns[] = {{false, false, false}, {false, false, true}, {false, true, true},
                          {false, true, false},  {true, false, false}, {true, true, false},
                          {true, true, true},    {true, false, true}};

}  // namespace

void orient(std::vector<unsigned char>& pixels, QuadrelOiioInfo& info, int orientation) {
    QUADREL_CHECK(orientation >= 1 && orientation <= 8, orientation);
    if (orientation == 1) return;
    const Turn turn = turns[orientation - 1];
    const std::size_t size = static_cast<std::size_t>(info.channels) * value_size(info.type);
    const int rows = info.height, row_length = info.width;
    const std::vector<unsigned char> stored = pixels;
    if (turn.columns) std::swap(info.width, info.height);
    const unsigned char* from = stored.data();
    for (int r = 0; r < rows; ++r)
        for (int i = 0; i < row_length; ++i, from += size) {
            const int major = turn.row_backward ? rows - 1 - r : r;
            const int minor = turn.backward ? row_length - 1 - i : i;
            const int x = turn.columns ? major : minor, y = turn.columns ? minor : major;
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(info.width) +
                static_cast<std::size_t>(x);
            std::copy_n(from, size, pixels.data() + pixel * size);
        }
}

std::optional<int> radiance_orientation(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    std::string line;
    if (!std::getline(in, line) || !line.starts_with("#?")) return std::nullopt;
    while (std::getline(in, line) && !line.empty()) {  // a blank line ends the header
    }
    if (!std::getline(in, line)) return std::nullopt;
    char major_sign = 0, major = 0, minor_sign = 0, minor = 0;
    int rows = 0, row_length = 0;
    if (std::sscanf(line.c_str(), "%c%c %d %c%c %d", &major_sign, &major, &rows, &minor_sign,
                    &minor, &row_length) != 6)
        return std::nullopt;
    const bool columns = major == 'X';
    // y grows upwards there: -Y is from the top.
    const bool row_backward = columns ? major_sign == '-' : major_sign == '+';
    const bool backward = columns ? minor_sign == '+' : minor_sign == '-';
    for (int orientation = 1; orientation <= 8; ++orientation) {
        const Turn& turn = turns[orientation - 1];
        if (turn.columns == columns && turn.row_backward == row_backward &&
            turn.backward == backward)
            return orientation;
    }
    return std::nullopt;
}

}  // namespace quadrel

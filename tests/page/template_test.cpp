// What pages are made of: text that stays text, and bits that come back.
#include "page/template.hpp"

#include <gtest/gtest.h>
#include <zlib.h>

#include "page/bits.hpp"
#include "page/planted.hpp"

namespace quadrel::page_tests {
namespace {

TEST(Template, TextStaysText) {
    EXPECT_EQ(page::escaped_text("a<b>&c"), "a&lt;b>&amp;c");
    const std::string text = page::embedded_json({{"name", "</script><script>alert(1)"}});
    EXPECT_EQ(text.find('<'), std::string::npos)
        << static_cast<int>(planted::PageError::open_element);
    EXPECT_EQ(Json::parse(text)["name"], "</script><script>alert(1)");
    EXPECT_NO_THROW(page::embedded_json({{"name", "\xff"}}));
}

/// RFC 4648, section 10.
TEST(Template, Base64IsThatOfTheStandard) {
    const std::pair<const char*, const char*> vectors[] = {{"", ""},
                                                           {"f", "Zg=="},
                                                           {"fo", "Zm8="},
                                                           {"foo", "Zm9v"},
                                                           {"foob", "Zm9vYg=="},
                                                           {"fooba", "Zm9vYmE="},
                                                           {"foobar", "Zm9vYmFy"}};
    for (const auto& [plain, coded] : vectors) EXPECT_EQ(page::base64(plain), coded);
    EXPECT_EQ(page::base64("\xfb\xff"), "+/8=");
}

/// What is equal to an earlier image takes next to nothing.
TEST(Bits, EqualOnesTakeNoRoom) {
    std::vector<std::uint32_t> bits(4096);
    for (std::size_t i = 0; i < bits.size(); ++i)
        bits[i] = static_cast<std::uint32_t>(i * i * 2654435761u);
    EXPECT_GT(page::packed_bits(bits).size(), 8000u);
    EXPECT_LT(page::packed_bits(bits, bits).size(), 100u);
}

/// What bends from row to row is what its neighbours say.
TEST(Bits, SlopesTakeLessInRows) {
    std::vector<std::uint32_t> bits(4096);
    for (std::uint32_t i = 0; i < bits.size(); ++i)
        bits[i] = 0x3f800000u + i % 64 * (i % 64) * (i / 64) * 7919;
    EXPECT_LT(page::packed_bits(bits, {}, 64).size(), page::packed_bits(bits).size() / 4);
}

}  // namespace
}  // namespace quadrel::page_tests

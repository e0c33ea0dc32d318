// No terminal obeys what is printable, and what is harmless stays as it is.
#include "text/printable.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <nlohmann/json.hpp>

namespace quadrel {
namespace {

using Escape = std::function<std::string(std::string_view)>;

testing::AssertionResult disarms(const Escape& escape) {
    for (int c = 0; c < 256; ++c) {
        const std::string text = "a" + std::string(1, static_cast<char>(c)) + "b";
        const bool plain = c >= 0x20 && c < 0x7f;
        if ((escape(text) == text) != plain) return testing::AssertionFailure() << "byte " << c;
    }
    for (int c = 0x80; c < 0x100; ++c) {
        const std::string text{static_cast<char>(0xc0 | c >> 6),
                               static_cast<char>(0x80 | (c & 63))};
        if ((escape(text) == text) != (c >= 0xa0))
            return testing::AssertionFailure() << "character " << c;
    }
    // Too long, a half of a pair, beyond the last, cut off.
    for (const char* bad :
         {"\xc0\x9b", "\xe0\x82\x9b", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe2\x82"})
        if (escape(bad) == bad) return testing::AssertionFailure() << "no UTF-8";
    for (const char* good : {"\xe2\x82\xac", "\xf0\x9f\x8f\x94", "caf\xc3\xa9"})
        if (escape(good) != good) return testing::AssertionFailure() << good;
    return testing::AssertionSuccess();
}

TEST(Printable, EveryControlCharacter) {
    EXPECT_TRUE(disarms(printable));
    EXPECT_EQ(printable("a\x1b[2J\n\t\x7f\xc2\x9b\xff"), "a\\x1b[2J\\n\\t\\x7f\\x9b\\xff");
    EXPECT_EQ(printable_lines("a\nb\x1b"), "a\nb\\x1b");
    // C0 alone; bytes one by one, which escapes accents.
    EXPECT_FALSE(disarms([](std::string_view text) {
        std::string out;
        for (const char c : text) out += c >= 0 && c < ' ' ? '?' : c;
        return out;
    }));
    EXPECT_FALSE(disarms([](std::string_view text) {
        std::string out;
        for (const char c : text) out += c < ' ' || c == 0x7f ? '?' : c;
        return out;
    }));
}

TEST(Printable, JsonStaysJson) {
    const std::string text = "a\x1b\x7f\xc2\x9b\xc3\xa9\n";
    const nlohmann::json json{{"k" + text, text}};
    const std::string out = printable_json(json.dump(2));
    EXPECT_EQ(nlohmann::json::parse(out), json);
    EXPECT_EQ(out.find('\x7f'), std::string::npos);
    EXPECT_EQ(out.find('\x9b'), std::string::npos);
}

TEST(Printable, Shortened) {
    EXPECT_EQ(shortened("abc", 3), "abc");
    EXPECT_EQ(shortened("abcd", 3), "abc...");
}

}  // namespace
}  // namespace quadrel

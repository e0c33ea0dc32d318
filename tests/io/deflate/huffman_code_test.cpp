// Codes of limited length: complete, unambiguous, and short where symbols are frequent.
#include "io/deflate/huffman_code.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <random>

#include "film/planted.hpp"

namespace quadrel {
namespace {

using testing::AssertionFailure;
using testing::AssertionResult;
using testing::AssertionSuccess;

using Counts = std::vector<std::uint32_t>;
using Coder = std::function<std::vector<CodeWord>(const Counts&, int)>;

std::vector<CodeWord> code_of(const Counts& counts, int longest) {
    return huffman_code(counts, longest);
}

/// As words are read: no word begins with another, and none is missing.
AssertionResult is_complete(const std::vector<CodeWord>& code, int longest) {
    std::vector<int> seen(std::size_t(1) << longest);
    for (const CodeWord& word : code) {
        if (word.length > longest) return AssertionFailure() << "a word of " << int(word.length);
        if (word.bits >> word.length != 0) return AssertionFailure() << "bits beyond a word's end";
        if (word.length == 0) continue;
        for (std::size_t rest = word.bits; rest < seen.size();
             rest += std::size_t(1) << word.length)
            ++seen[rest];
    }
    if (std::count(seen.begin(), seen.end(), 1) != static_cast<std::ptrdiff_t>(seen.size()))
        return AssertionFailure() << "words that nothing or two symbols have";
    return AssertionSuccess();
}

AssertionResult suits(const Counts& counts, const std::vector<CodeWord>& code) {
    for (std::size_t a = 0; a < counts.size(); ++a) {
        if (counts[a] > 0 && code[a].length == 0) return AssertionFailure() << "no word for " << a;
        for (std::size_t b = 0; b < counts.size(); ++b)
            if (counts[a] > counts[b] && counts[b] > 0 && code[a].length > code[b].length)
                return AssertionFailure() << a << " is frequent and has a long word";
    }
    return AssertionSuccess();
}

AssertionResult works(const Coder& coder) {
    std::mt19937 random(1);
    for (int i = 0; i < 200; ++i) {
        Counts counts(2 + random() % 28);
        for (auto& count : counts) count = random() % 3 == 0 ? 0 : 1u << random() % 20;
        for (const int longest : {5, 7, 15}) {
            const auto code = coder(counts, longest);
            if (auto result = is_complete(code, longest); !result) return result;
            if (auto result = suits(counts, code); !result) return result;
        }
    }
    return AssertionSuccess();
}

/// Lengths as Huffman has them without a limit, cut; numbered as before.
std::vector<CodeWord> with_words_cut(const Counts& counts, int longest) {
    auto code = huffman_code(counts, 15);
    for (CodeWord& word : code) word.length = std::min<std::uint8_t>(word.length, longest);
    return code;
}

TEST(HuffmanCode, IsCompleteAndSuitsTheCounts) {
    EXPECT_TRUE(works(code_of));
    EXPECT_FALSE(works(with_words_cut)) << static_cast<int>(planted::FilmError::words_cut);
}

/// Fibonacci's numbers make the longest words that there are.
TEST(HuffmanCode, LongWordsAreLimited) {
    Counts counts = {1, 1};
    while (counts.size() < 40) counts.push_back(counts.end()[-1] + counts.end()[-2]);
    for (const int longest : {6, 7, 14, 15})
        EXPECT_TRUE(is_complete(huffman_code(counts, longest), longest));
}

/// Entropy and a bit bound what Huffman's code takes a symbol.
TEST(HuffmanCode, IsNearTheEntropy) {
    const Counts counts = {1000, 500, 250, 125, 63, 62};
    const auto code = huffman_code(counts, 15);
    const int lengths[] = {1, 2, 3, 4, 5, 5};
    for (std::size_t s = 0; s < counts.size(); ++s) EXPECT_EQ(code[s].length, lengths[s]);
}

TEST(HuffmanCode, TwoSymbolsHaveWordsAtLeast) {
    for (const Counts& counts : {Counts{0, 0, 0}, Counts{0, 9, 0}, Counts{0, 0, 1}})
        EXPECT_TRUE(is_complete(huffman_code(counts, 7), 7));
}

}  // namespace
}  // namespace quadrel

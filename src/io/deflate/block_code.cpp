#include "io/deflate/block_code.hpp"

#include <algorithm>
#include <array>
#include <span>

namespace quadrel {
namespace {

constexpr std::size_t literal_symbols = 286, distance_symbols = 30, length_symbols = 19;

/// Fewer than the 15 that deflate allows, so that four literals fit between two flushes.
constexpr int longest_literal = 14, longest_distance = 15, longest_length = 7;

/// The order in which the lengths of the lengths' own words are written.
constexpr std::array<std::uint8_t, length_symbols> written_order = {
    16, 17, 18, 0, 8, 7, 9, 6, 10, 5, 11, 4, 12, 3, 13, 2, 14, 1, 15};

struct Counts {
    std::array<std::uint32_t, literal_symbols> literals{};
    std::array<std::uint32_t, distance_symbols> distances{};
    std::uint64_t extra_bits = 0;
};

/// In four tables: of equal bytes in a row each count would wait for the one before.
void count_literals(const std::uint8_t* bytes, const std::vector<Match>& matches, Counts& counts) {
    std::array<std::array<std::uint32_t, 256>, 4> tables{};
    for (const Match& match : matches) {
        const std::uint8_t* const end = bytes + match.literals;
        for (; end - bytes >= 4; bytes += 4)
            for (std::size_t i = 0; i < 4; ++i) ++tables[i][bytes[i]];
        for (; bytes < end; ++bytes) ++tables[0][*bytes];
        bytes += match.length;
    }
    for (std::size_t s = 0; s < 256; ++s)
        counts.literals[s] = tables[0][s] + tables[1][s] + tables[2][s] + tables[3][s];
}

Counts count(const std::uint8_t* bytes, const std::vector<Match>& matches) {
    Counts counts;
    count_literals(bytes, matches, counts);
    for (const Match& match : matches) {
        if (match.length == 0) continue;
        const Coded length = coded_length(match.length), distance = coded_distance(match.distance);
        ++counts.literals[length.symbol];
        ++counts.distances[distance.symbol];
        counts.extra_bits += static_cast<std::uint64_t>(length.extra_bits + distance.extra_bits);
    }
    return counts;
}

std::uint64_t bits_of(std::span<const std::uint32_t> counts, const std::vector<CodeWord>& code) {
    std::uint64_t bits = 0;
    for (std::size_t s = 0; s < counts.size(); ++s)
        bits += std::uint64_t(counts[s]) * code[s].length;
    return bits;
}

/// How many words there are up to the last one that occurs, at least `least`.
std::size_t words_up_to_last(const std::vector<CodeWord>& code, std::size_t least) {
    std::size_t words = code.size();
    while (words > least && code[words - 1].length == 0) --words;
    return words;
}

}  // namespace

BlockCode::BlockCode(const std::uint8_t* bytes, const std::vector<Match>& matches) {
    Counts counts = count(bytes, matches);
    counts.literals[end_symbol] = 1;
    literals_ = huffman_code(counts.literals, longest_literal);
    distances_ = huffman_code(counts.distances, longest_distance);
    literal_words_ = words_up_to_last(literals_, end_symbol + 1);
    distance_words_ = words_up_to_last(distances_, 1);
    list_lengths();
    std::array<std::uint32_t, length_symbols> used{};
    for (const LengthSymbol& listed : listed_) {
        ++used[listed.symbol];
        bits_ += listed.extra_bits;
    }
    lengths_ = huffman_code(used, longest_length);
    length_words_ = length_symbols;
    while (length_words_ > 4 && lengths_[written_order[length_words_ - 1]].length == 0)
        --length_words_;
    bits_ += 3 + 5 + 5 + 4 + 3 * length_words_ + bits_of(used, lengths_) +
             bits_of(counts.literals, literals_) + bits_of(counts.distances, distances_) +
             counts.extra_bits;
}

/// Runs of equal lengths become a length and repeats.
void BlockCode::list_lengths() {
    std::vector<std::uint8_t> all;
    for (std::size_t s = 0; s < literal_words_; ++s) all.push_back(literals_[s].length);
    for (std::size_t s = 0; s < distance_words_; ++s) all.push_back(distances_[s].length);
    for (std::size_t i = 0; i < all.size();) {
        const std::uint8_t length = all[i];
        std::size_t run = 1;
        while (i + run < all.size() && all[i + run] == length) ++run;
        i += run;
        if (length != 0) {
            listed_.push_back({length, 0, 0});
            --run;
        }
        const auto repeat = [&](std::size_t least, std::size_t most, std::uint8_t symbol,
                                std::uint8_t bits) {
            for (; run >= least; run -= std::min(run, most))
                listed_.push_back(
                    {symbol, static_cast<std::uint8_t>(std::min(run, most) - least), bits});
        };
        if (length == 0) {
            repeat(11, 138, 18, 7);
            repeat(3, 10, 17, 3);
        } else {
            repeat(3, 6, 16, 2);
        }
        for (; run > 0; --run) listed_.push_back({length, 0, 0});
    }
}

void BlockCode::write_lengths(BitWriter& out) const {
    out.add(literal_words_ - 257, 5);
    out.add(distance_words_ - 1, 5);
    out.add(length_words_ - 4, 4);
    out.flush();
    for (std::size_t i = 0; i < length_words_; ++i) {
        out.add(lengths_[written_order[i]].length, 3);
        out.flush();
    }
    for (const LengthSymbol& listed : listed_) {
        add(lengths_[listed.symbol], out);
        out.add(listed.extra, listed.extra_bits);
        out.flush();
    }
}

}  // namespace quadrel

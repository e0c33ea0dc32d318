#include "io/deflate/huffman_code.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace quadrel {
namespace {

constexpr int longest_of_all = 64;

struct Leaf {
    std::uint32_t count;
    std::uint32_t symbol;
};

/// Those that occur, rare ones first, and at least two.
std::vector<Leaf> used_symbols(std::span<const std::uint32_t> counts) {
    std::vector<Leaf> used;
    for (std::size_t s = 0; s < counts.size(); ++s)
        if (counts[s] > 0) used.push_back({counts[s], static_cast<std::uint32_t>(s)});
    for (std::size_t s = 0; used.size() < 2; ++s)
        if (counts[s] == 0) used.push_back({1, static_cast<std::uint32_t>(s)});
    std::sort(used.begin(), used.end(), [](const Leaf& a, const Leaf& b) {
        return a.count != b.count ? a.count < b.count : a.symbol < b.symbol;
    });
    return used;
}

/// The depth of each leaf in Huffman's tree: two queues, of leaves and of inner nodes, both of
/// which grow heavier.
std::vector<int> tree_depths(const std::vector<Leaf>& leaves) {
    const std::size_t n = leaves.size(), nodes = 2 * n - 1;
    std::vector<std::uint64_t> weight(nodes);
    std::vector<std::size_t> parent(nodes);
    for (std::size_t i = 0; i < n; ++i) weight[i] = leaves[i].count;
    std::size_t leaf = 0, inner = n;
    for (std::size_t made = n; made < nodes; ++made)
        for (int child = 0; child < 2; ++child) {
            const bool take_leaf = leaf < n && (inner >= made || weight[leaf] <= weight[inner]);
            const std::size_t lightest = take_leaf ? leaf++ : inner++;
            weight[made] += weight[lightest];
            parent[lightest] = made;
        }
    std::vector<int> depth(nodes);
    for (std::size_t i = nodes - 1; i-- > 0;) depth[i] = depth[parent[i]] + 1;
    depth.resize(n);
    return depth;
}

/// How many words there are of each length, none longer than `longest`: those that would be are cut
/// to it, and others grow until all fit.
std::array<std::uint32_t, longest_of_all> words_of_length(const std::vector<int>& depths,
                                                          int longest) {
    std::array<std::uint32_t, longest_of_all> words{};
    for (const int depth : depths) ++words[static_cast<std::size_t>(std::min(depth, longest))];
    std::uint64_t taken = 0;  // in units of a word of the greatest length
    for (int length = 1; length <= longest; ++length)
        taken += std::uint64_t(words[static_cast<std::size_t>(length)]) << (longest - length);
    for (; taken > std::uint64_t(1) << longest; --taken) {
        // One of the longest goes beside the longest word that can still grow.
        auto length = static_cast<std::size_t>(longest - 1);
        while (words[length] == 0) --length;
        --words[length];
        words[length + 1] += 2;
        --words[static_cast<std::size_t>(longest)];
    }
    return words;
}

std::uint16_t reversed(std::uint32_t code, int length) {
    code = (code & 0x5555) << 1 | (code >> 1 & 0x5555);
    code = (code & 0x3333) << 2 | (code >> 2 & 0x3333);
    code = (code & 0x0f0f) << 4 | (code >> 4 & 0x0f0f);
    code = (code & 0x00ff) << 8 | (code >> 8 & 0x00ff);
    return static_cast<std::uint16_t>(code >> (16 - length));
}

}  // namespace

std::vector<CodeWord> huffman_code(std::span<const std::uint32_t> counts, int longest) {
    const std::vector<Leaf> leaves = used_symbols(counts);
    const auto words = words_of_length(tree_depths(leaves), longest);
    std::vector<CodeWord> code(counts.size());
    std::size_t leaf = 0;
    for (int length = longest; length > 0; --length)
        for (std::uint32_t i = 0; i < words[static_cast<std::size_t>(length)]; ++i)
            code[leaves[leaf++].symbol].length = static_cast<std::uint8_t>(length);
    std::array<std::uint32_t, longest_of_all> next{};  // word by length
    for (std::size_t length = 1; length < static_cast<std::size_t>(longest); ++length)
        next[length + 1] = (next[length] + words[length]) << 1;
    for (CodeWord& word : code)
        if (word.length > 0) word.bits = reversed(next[word.length]++, word.length);
    return code;
}

}  // namespace quadrel

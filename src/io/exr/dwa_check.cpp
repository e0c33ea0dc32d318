// The layout of a chunk: eleven counters of 8 bytes, little-endian; rules that say how a channel
// of some name and type is packed (since version 2); then four blocks: values that are only
// deflated, coefficients of cosine transforms other than the first (AC), the first ones (DC), and
// values packed by runs.
#include "io/exr/dwa_check.hpp"

#include <OpenEXR/ImfHuf.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace quadrel {
namespace {

using Bytes = std::span<const std::uint8_t>;

void require(bool condition) {
    if (!condition) throw std::runtime_error("damaged DWA data");
}

enum class Scheme { deflated, cosine, runs };

/// How channels of a name (behind the last dot) and type are packed.
struct Rule {
    std::string suffix;
    Scheme scheme = Scheme::deflated;
    int type = 0;
    bool any_case = false;
};

std::string lower(std::string text) {
    for (char& c : text)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
    return text;
}

/// Of chunks before version 2.
std::vector<Rule> legacy_rules() {
    std::vector<Rule> rules;
    for (const char* name : {"r", "red", "g", "grn", "green", "b", "blu", "blue", "y", "by", "ry"})
        for (const int type : {EXR_PIXEL_HALF, EXR_PIXEL_FLOAT})
            rules.push_back({name, Scheme::cosine, type, true});
    for (const int type : {EXR_PIXEL_UINT, EXR_PIXEL_HALF, EXR_PIXEL_FLOAT})
        rules.push_back({"a", Scheme::runs, type, true});
    return rules;
}

/// `bytes` are those of all rules. A rule is its name with a 0, a byte of flags, a type.
std::vector<Rule> parse_rules(Bytes bytes) {
    std::vector<Rule> rules;
    while (!bytes.empty()) {
        const auto end = std::find(bytes.begin(), bytes.end(), std::uint8_t{0});
        require(bytes.end() - end >= 3);
        const std::uint8_t flags = end[1], type = end[2];
        const int scheme = flags >> 2 & 3;
        require(scheme <= 2);
        const bool any_case = (flags & 1) != 0;
        const std::string name(bytes.begin(), end);
        rules.push_back(
            {any_case ? lower(name) : name, static_cast<Scheme>(scheme), type, any_case});
        bytes = bytes.subspan(static_cast<std::size_t>(end + 3 - bytes.begin()));
    }
    return rules;
}

Scheme scheme_of(const exr_coding_channel_info_t& channel, const std::vector<Rule>& rules) {
    std::string name = channel.channel_name;
    name = name.substr(name.rfind('.') + 1);  // npos + 1 is 0
    Scheme scheme = Scheme::deflated;
    for (const Rule& rule : rules)
        if (rule.type == channel.data_type && rule.suffix == (rule.any_case ? lower(name) : name))
            scheme = rule.scheme;
    return scheme;
}

/// What a chunk must hold.
struct Needs {
    std::uint64_t deflated = 0;  ///< bytes
    std::uint64_t runs = 0;      ///< bytes
    std::uint64_t blocks = 0;    ///< of 8 by 8 pixels, over all channels

    void add(const exr_coding_channel_info_t& channel, Scheme scheme) {
        const auto width = static_cast<std::uint64_t>(channel.width);
        const auto height = static_cast<std::uint64_t>(channel.height);
        const std::uint64_t bytes =
            width * height * static_cast<std::uint64_t>(channel.bytes_per_element);
        if (scheme == Scheme::cosine)
            blocks += (width + 7) / 8 * ((height + 7) / 8);
        else
            (scheme == Scheme::runs ? runs : deflated) += bytes;
    }
};

/// The counters in the order in which they stand.
struct Counters {
    std::uint64_t version, deflated, deflated_packed, ac_packed, dc_packed, runs_packed,
        runs_unpacked, runs, ac, dc, ac_packing;
};

/// Takes bytes from the front.
Bytes take(Bytes& bytes, std::uint64_t count) {
    require(count <= bytes.size());
    const Bytes taken = bytes.first(static_cast<std::size_t>(count));
    bytes = bytes.subspan(taken.size());
    return taken;
}

void inflate_exactly(Bytes packed, void* to, std::uint64_t bytes) {
    uLongf size = bytes;
    require(uncompress(static_cast<Bytef*>(to), &size, packed.data(), packed.size()) == Z_OK);
    require(size == bytes);
}

std::vector<std::uint16_t> unpack_ac(const Counters& counters, Bytes packed) {
    std::vector<std::uint16_t> values(static_cast<std::size_t>(counters.ac));
    if (values.empty()) return values;
    require(counters.ac_packing <= 1);
    if (counters.ac_packing == 1)
        inflate_exactly(packed, values.data(), 2 * values.size());
    else
        Imf::hufUncompress(reinterpret_cast<const char*>(packed.data()),
                           static_cast<int>(packed.size()), values.data(),
                           static_cast<int>(values.size()));
    return values;
}

/// Every block ends by its 63 coefficients or by a mark; 0xff00 is the mark, 0xffnn are nn zeros.
void check_ac(const std::vector<std::uint16_t>& values, std::uint64_t blocks) {
    std::size_t next = 0;
    for (std::uint64_t block = 0; block < blocks; ++block)
        for (int filled = 1; filled < 64;) {
            require(next < values.size());
            const std::uint16_t value = values[next++];
            if (value == 0xff00) break;
            filled += value >> 8 == 0xff ? value & 0xff : 1;
        }
    require(next == values.size());
}

std::vector<Rule> take_rules(Bytes& bytes, std::uint64_t version) {
    if (version < 2) return legacy_rules();
    const Bytes size = take(bytes, 2);
    const int with_size = size[0] | size[1] << 8;
    require(with_size >= 2);
    return parse_rules(take(bytes, static_cast<std::uint64_t>(with_size - 2)));
}

void check_chunk(std::span<const exr_coding_channel_info_t> channels, Bytes bytes) {
    Counters counters{};
    static_assert(sizeof counters == 88);
    std::memcpy(&counters, take(bytes, sizeof counters).data(), sizeof counters);
    require(counters.version <= 2);
    const std::vector<Rule> rules = take_rules(bytes, counters.version);
    Needs needs;
    for (const exr_coding_channel_info_t& channel : channels)
        needs.add(channel, scheme_of(channel, rules));
    require(counters.deflated == needs.deflated && counters.runs == needs.runs &&
            counters.dc == needs.blocks && counters.ac <= 63 * needs.blocks);
    const Bytes deflated = take(bytes, counters.deflated_packed);
    const Bytes ac = take(bytes, counters.ac_packed);
    const Bytes dc = take(bytes, counters.dc_packed);
    require(dc.empty() == (counters.dc == 0) && ac.empty() == (counters.ac == 0));
    if (needs.deflated > 0) {
        std::vector<std::uint8_t> values(static_cast<std::size_t>(needs.deflated));
        inflate_exactly(deflated, values.data(), values.size());
    }
    check_ac(unpack_ac(counters, ac), needs.blocks);
}

}  // namespace

void check_dwa_chunks(const ExrContext& context, int y0, int y1) {
    context.for_each_chunk(y0, y1, [&](const exr_chunk_info_t& chunk, int, int) {
        // As large as unpacked: stored without compression.
        if (chunk.packed_size >= chunk.unpacked_size) return;
        const ExrPipeline pipeline(context, chunk);
        std::vector<std::uint8_t> packed(static_cast<std::size_t>(chunk.packed_size));
        check_exr(exr_read_chunk(context.get(), context.part(), &chunk, packed.data()));
        check_chunk(
            {pipeline.decode.channels, static_cast<std::size_t>(pipeline.decode.channel_count)},
            packed);
    });
}

}  // namespace quadrel

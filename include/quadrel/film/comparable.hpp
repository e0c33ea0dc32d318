// Images made comparable: what engines write is turned into a film that has a reference's channel
// names, orientation and precision.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "quadrel/film/encoding.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {

/// How a file stores a channel. Codes (unorm8, unorm16) are read as code / (2^bits - 1); which
/// transfer function they went through, a file does not say.
enum class Storage : std::int32_t { unorm8, unorm16, half, float32, uint32 };

const char* storage_name(Storage storage);

struct ComparableImage {
    std::filesystem::path file;
    Film film;
    std::map<std::string, Storage> stored;  ///< by channel
    Attributes attributes;                  ///< of an EXR's header
};

/// "float32 uint32": how the channels of an image are stored.
std::string storage_text(const ComparableImage& image);

/// Reads any image: an EXR with all channels of what is selected (see read_exr); everything else by
/// load_image, with its channels named as channel_names says, as a whole frame. Of an EXR that has
/// all of `part_of_it` only that. Throws InputError.
ComparableImage read_comparable(const std::filesystem::path& file,
                                const ImageSelection& selection = {},
                                const std::optional<Window>& part_of_it = {});

/// The bottom row becomes the top row; the window is mirrored within the frame.
void flip_y(Film& film);

/// The test image's channel that stands for a reference's: full names, or groups on both sides
/// ("N" = "gbuffer.normal").
struct ChannelMapping {
    std::string reference, test;
    bool operator==(const ChannelMapping&) const = default;
};

/// Renames channels, all at once: R = B with B = R swaps the two. A channel whose name another one
/// takes is dropped. Throws UsageError if the image lacks what a mapping names or if two channels
/// take one name.
void map_channels(ComparableImage& image, std::span<const ChannelMapping> mappings);

/// Channels that one image stores as integers and the other as floats become floats in both, so
/// that they are compared by value: integers become the nearest float (exact up to 2^24), -0
/// becomes 0. Returns their names.
std::vector<std::string> compare_by_value(Film& reference, Film& test);

/// Rounds both images to what `encoding` can hold, and returns the encoding of each channel so
/// treated. 8 bits: R, G, B and A, and every channel that either image stores in 8 bits; A is
/// always linear; codes of an 8-bit file stay as they are. half: every float channel. Throws
/// InputError for codes of 16 bits, or for codes at all with half.
std::map<std::string, Encoding> encode_both(ComparableImage& reference, ComparableImage& test,
                                            Encoding encoding);

}  // namespace quadrel

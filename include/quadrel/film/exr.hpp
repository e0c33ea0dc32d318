// Films as OpenEXR files. Channels are float32 or uint, never half; compressed without loss;
// displayWindow is the frame, dataWindow the window. Equal films, attributes and compressions give
// equal bytes.
#pragma once

#include <filesystem>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "quadrel/film/film.hpp"
#include "quadrel/texture/selection.hpp"

namespace quadrel {

/// Header attributes by name; the renderer's own begin with "quadrel:".
using Attributes = std::map<std::string, std::string>;

/// How pixels are stored; they are the same for all. rle is fast and wins where much is empty, piz
/// on noise; zips is zip row by row, for readers that want single rows.
enum class ExrCompression : std::int32_t { none, rle, zips, zip, piz };

/// Their names.
inline constexpr std::pair<std::string_view, ExrCompression> exr_compressions[] = {
    {"none", ExrCompression::none},
    {"rle", ExrCompression::rle},
    {"zips", ExrCompression::zips},
    {"zip", ExrCompression::zip},
    {"piz", ExrCompression::piz}};

/// How a film is written.
struct ExrWriting {
    ExrCompression compression = ExrCompression::zip;
    int threads = 0;  ///< that compress; 0 or too many: as many as the process may use
};

/// Writes the film whole or not at all: to a temporary name that is synced and renamed. NaNs are
/// written as canonical_nan. Throws OutputError.
void write_exr(const std::filesystem::path& file, const Film& film, const Attributes& attributes,
               const ExrWriting& writing = {});

/// The bytes of the file that write_exr would write, for pipes.
std::string exr_bytes(const Film& film, const Attributes& attributes,
                      const ExrWriting& writing = {});

enum class StoredType { half, float32, uint32 };

/// What an EXR file holds, one part of it.
struct ExrFile {
    Film film;  ///< planes sorted by name; half read as float, NaNs canonical
    Attributes
        attributes;  ///< the part's header; other types than strings and numbers by type name
    std::map<std::string, StoredType> stored;  ///< pixel type in the file, by channel
    std::vector<std::string> parts;            ///< names of all parts; one, maybe empty, mostly
};

/// The most values of a film in memory: 8 GB.
inline constexpr std::int64_t most_film_values = std::int64_t(1) << 31;

/// Reads the part and layer that are meant; the film's channels lack the layer's name. Where the
/// data window has all of `part_of_it`, only that, and chunks without pixels of it are not read.
/// Throws InputError for a file that is missing, truncated, damaged, deep, sub-sampled or larger
/// than 65536 pixels a side, most_film_values or 1024 values a byte of the file (32768 for DWA),
/// and for one of several parts where the selection does not tell which.
ExrFile read_exr(const std::filesystem::path& file, const ImageSelection& selection = {},
                 const std::optional<Window>& part_of_it = {});

/// The same for images of any number of values: `take` is given films of some rows each, from the
/// top down. The film that is returned has planes without values.
ExrFile read_exr_in_bands(const std::filesystem::path& file, const ImageSelection& selection,
                          const std::function<void(const Film& band)>& take);

/// What the header of a part says.
struct ExrPartInfo {
    std::string name;                   ///< empty where it has none
    Window frame, window;               ///< display and data window
    std::vector<std::string> channels;  ///< full names
    Attributes attributes;
};

/// All parts, in the file's order, at least one. Reads no pixels. Throws InputError.
std::vector<ExrPartInfo> exr_parts(const std::filesystem::path& file);

}  // namespace quadrel

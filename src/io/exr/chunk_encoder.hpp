// Rows of films to chunks of a file: packed and compressed, to be written later.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "io/exr/write_context.hpp"
#include "io/exr/zip_stream.hpp"

namespace quadrel {

/// An image in films, each of whose windows begins where the one before ends.
using FilmRows = std::vector<std::shared_ptr<const Film>>;

struct EncodedChunk {
    int y = 0;  ///< of its first row
    std::vector<std::uint8_t> bytes;
};

/// A part of a file, as its chunks are made.
struct ExrChunkLayout {
    ExrChunkLayout(const ExrWriteContext& file, int part, const Film& layout);

    int part;
    Window window;
    int rows = 1;                    ///< of a chunk, but for the last one
    std::vector<std::size_t> order;  ///< the planes of a film as the file has its channels
    bool deflated = false;           ///< ZIP or ZIPS, which OpenEXR is not asked to make
    bool plain = false;              ///< as packed, likewise
};

/// One thread's: its buffers serve one chunk after the other.
class ChunkEncoder {
  public:
    /// Both must outlive it.
    ChunkEncoder(const ExrWriteContext& file, const ExrChunkLayout& layout)
        : file_(file), layout_(layout) {}
    ~ChunkEncoder();
    ChunkEncoder(const ChunkEncoder&) = delete;
    ChunkEncoder& operator=(const ChunkEncoder&) = delete;

    /// The chunk that begins with row `y`, all rows of which are in `films`. NaNs become
    /// canonical_nan.
    EncodedChunk encode(int y, const FilmRows& films);

  private:
    void prepare(int y);
    void pack(int first, int rows, void* to) const;
    std::vector<std::uint8_t> deflated(std::vector<std::uint8_t> packed);
    std::vector<std::uint8_t> compressed(int y);
    static exr_result_t pack(exr_encode_pipeline_t* encode);

    const ExrWriteContext& file_;
    const ExrChunkLayout& layout_;
    const FilmRows* films_ = nullptr;  ///< of the chunk at hand
    exr_encode_pipeline_t encode_ = EXR_ENCODE_PIPELINE_INITIALIZER;
    bool initialized_ = false;
    ZipStream zip_;
};

void write_chunk(const ExrWriteContext& file, const ExrChunkLayout& layout,
                 const EncodedChunk& chunk);

}  // namespace quadrel

#include "io/exr/pixels.hpp"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>
#include <stdexcept>

#include "io/exr/byte_stream.hpp"
#include "io/exr/context.hpp"
#include "io/exr/dwa_check.hpp"
#include "io/exr/zip_stream.hpp"
#include "quadrel/num/half.hpp"
#include "text/first_error.hpp"

namespace quadrel {
namespace {

/// Rows of one channel as the file stores them, in memory that begins as zeros.
struct NativeRows {
    std::vector<std::uint8_t> bytes;
    bool halves = false;
};

/// The row in the form that is handed out, in `room`.
const std::uint32_t* converted(const std::uint8_t* native, bool halves,
                               std::vector<std::uint32_t>& room) {
    if (!halves) {
        std::memcpy(room.data(), native, room.size() * sizeof room[0]);
        return room.data();
    }
    for (std::size_t i = 0; i < room.size(); ++i) {
        std::uint16_t half = 0;
        std::memcpy(&half, native + 2 * i, sizeof half);
        room[i] = std::bit_cast<std::uint32_t>(half_to_float(half));
    }
    return room.data();
}

void hand_out(const std::vector<NativeRows>& channels, int x, int y, int width, int height,
              const ExrSink& sink) {
    std::vector<std::uint32_t> room(static_cast<std::size_t>(width));
    for (std::size_t c = 0; c < channels.size(); ++c) {
        const std::size_t row = static_cast<std::size_t>(width) * (channels[c].halves ? 2 : 4);
        if (channels[c].bytes.size() != row * static_cast<std::size_t>(height))
            throw std::runtime_error("a channel is missing");
        for (int r = 0; r < height; ++r) {
            const std::uint8_t* const native =
                &channels[c].bytes[static_cast<std::size_t>(r) * row];
            sink({c, x, y + r, width, converted(native, channels[c].halves, room)});
        }
    }
}

/// A step of the C library's, for ZIP and ZIPS.
exr_result_t unzip_chunk(exr_decode_pipeline_t* decode) {
    const std::uint64_t packed = decode->chunk.packed_size, unpacked = decode->chunk.unpacked_size;
    if (packed == 0) return EXR_ERR_SUCCESS;
    if (packed == unpacked) {  // got no shorter, and is stored as it was
        if (decode->unpacked_buffer != decode->packed_buffer)
            std::memcpy(decode->unpacked_buffer, decode->packed_buffer, unpacked);
        return EXR_ERR_SUCCESS;
    }
    const auto* const stream = static_cast<const std::uint8_t*>(decode->packed_buffer);
    auto* const bytes = static_cast<std::uint8_t*>(decode->unpacked_buffer);
    try {
        return unzip({stream, packed}, {bytes, unpacked}) ? EXR_ERR_SUCCESS : EXR_ERR_CORRUPT_CHUNK;
    } catch (const std::bad_alloc&) {
        return EXR_ERR_OUT_OF_MEMORY;
    }
}

/// Lossless compressions and Pxr24, by the C library, chunks in parallel.
class ChunkPixels : public ExrPixels {
  public:
    ChunkPixels(std::unique_ptr<ExrContext> context, std::vector<std::string> channels)
        : context_(std::move(context)), channels_(std::move(channels)) {}

    void read(int y0, int y1, const ExrSink& sink) override {
        std::vector<Chunk> chunks;
        context_->for_each_chunk(y0, y1, [&](const exr_chunk_info_t& info, int x, int y) {
            chunks.push_back({info, x, y});
        });
        FirstError error;
        tbb::parallel_for(std::size_t(0), chunks.size(), [&](std::size_t i) {
            const Chunk& at = chunks[i];
            error.run(i, [&] {
                hand_out(decode(at.info), at.x, at.y, at.info.width, at.info.height, sink);
            });
        });
        error.rethrow();
    }

  private:
    struct Chunk {
        exr_chunk_info_t info;
        int x, y;
    };

    std::vector<NativeRows> decode(const exr_chunk_info_t& chunk) const {
        ExrPipeline pipeline(*context_, chunk);
        std::vector<NativeRows> rows(channels_.size());
        for (int c = 0; c < pipeline.decode.channel_count; ++c)
            place(pipeline.decode.channels[c], chunk, rows);
        check_exr(exr_decoding_choose_default_routines(context_->get(), context_->part(),
                                                       &pipeline.decode));
        const exr_compression_t compression = context_->compression();
        // There are no steps where pixels are read right to where they go.
        if (pipeline.decode.decompress_fn != nullptr &&
            (compression == EXR_COMPRESSION_ZIP || compression == EXR_COMPRESSION_ZIPS))
            pipeline.decode.decompress_fn = unzip_chunk;
        check_decoded(exr_decoding_run(context_->get(), context_->part(), &pipeline.decode));
        return rows;
    }

    /// Tells the decoder where a channel goes; nowhere if nobody asks for it.
    void place(exr_coding_channel_info_t& info, const exr_chunk_info_t& chunk,
               std::vector<NativeRows>& rows) const {
        const auto name = std::find(channels_.begin(), channels_.end(), info.channel_name);
        if (name == channels_.end()) return;
        if (info.width != chunk.width || info.height != chunk.height)
            throw std::runtime_error("a sub-sampled channel");
        NativeRows& to = rows[static_cast<std::size_t>(name - channels_.begin())];
        const int row = chunk.width * info.bytes_per_element;
        to.halves = info.data_type == EXR_PIXEL_HALF;
        to.bytes.resize(static_cast<std::size_t>(row) * static_cast<std::size_t>(chunk.height));
        info.user_pixel_stride = info.bytes_per_element;
        info.user_line_stride = row;
        info.decode_to_ptr = to.bytes.data();
    }

    std::unique_ptr<ExrContext> context_;
    std::vector<std::string> channels_;
};

/// B44 and DWA, by the C++ library. What its DWA decoder would leave as it was in its buffers is
/// refused beforehand.
class LossyPixels : public ExrPixels {
  public:
    LossyPixels(const FileBytes& file, std::unique_ptr<ExrContext> context,
                std::vector<std::string> channels)
        : context_(std::move(context)),
          channels_(std::move(channels)),
          stream_(file),
          file_(stream_, 0, false),
          part_(file_, context_->part()) {}

    /// In steps of the most rows that a chunk has.
    void read(int y0, int y1, const ExrSink& sink) override {
        constexpr int most = 256;
        const int top = context_->window().min.y;
        for (int y = y0; y < y1;) {
            const int next = std::min(y1, y + most - (y - top) % most);
            read_block(y, next, sink);
            y = next;
        }
    }

  private:
    void read_block(int y0, int y1, const ExrSink& sink) {
        const bool dwa = context_->compression() == EXR_COMPRESSION_DWAA ||
                         context_->compression() == EXR_COMPRESSION_DWAB;
        if (dwa) check_dwa_chunks(*context_, y0, y1);
        const Imath::Box2i whole = part_.header().dataWindow();
        const Imath::Box2i box({whole.min.x, y0}, {whole.max.x, y1 - 1});
        const int width = whole.max.x - whole.min.x + 1;
        std::vector<NativeRows> rows(channels_.size());
        Imf::FrameBuffer buffer;
        for (std::size_t c = 0; c < channels_.size(); ++c) {
            const Imf::PixelType type = part_.header().channels()[channels_[c].c_str()].type;
            rows[c].halves = type == Imf::HALF;
            rows[c].bytes.resize(static_cast<std::size_t>(width) *
                                 static_cast<std::size_t>(y1 - y0) * (type == Imf::HALF ? 2 : 4));
            buffer.insert(channels_[c], Imf::Slice::Make(type, rows[c].bytes.data(), box));
        }
        part_.setFrameBuffer(buffer);
        part_.readPixels(y0, y1 - 1);
        hand_out(rows, whole.min.x, y0, width, y1 - y0, sink);
    }

    std::unique_ptr<ExrContext> context_;
    std::vector<std::string> channels_;
    ByteStream stream_;
    Imf::MultiPartInputFile file_;
    Imf::InputPart part_;
};

}  // namespace

std::unique_ptr<ExrPixels> open_exr_pixels(const FileBytes& file, int part,
                                           std::vector<std::string> channels) {
    auto context = std::make_unique<ExrContext>(file, part);
    switch (context->compression()) {
        case EXR_COMPRESSION_NONE:
        case EXR_COMPRESSION_RLE:
        case EXR_COMPRESSION_ZIPS:
        case EXR_COMPRESSION_ZIP:
        case EXR_COMPRESSION_PIZ:
        case EXR_COMPRESSION_PXR24:
            return std::make_unique<ChunkPixels>(std::move(context), std::move(channels));
        default:
            return std::make_unique<LossyPixels>(file, std::move(context), std::move(channels));
    }
}

}  // namespace quadrel

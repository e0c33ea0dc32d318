#include "io/exr/chunk_encoder.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

#include "quadrel/check.hpp"

namespace quadrel {
namespace {

const Film& film_of(const FilmRows& films, int y) {
    for (const auto& film : films)
        if (y >= film->window.y0 && y < film->window.y1) return *film;
    check_failed(__FILE__, __LINE__, "a film has the row", std::to_string(y));
}

/// canonical_bits, by a mask, which compilers make vectors of.
std::uint32_t masked_canonical(std::uint32_t bits) {
    const bool nan = static_cast<std::int32_t>(bits & 0x7fffffffu) > 0x7f800000;
    const std::uint32_t mask = nan ? 0xffffffffu : 0u;
    return (bits & ~mask) | (canonical_nan & mask);
}

}  // namespace

/// Files have their channels in the order of their names, as bytes.
ExrChunkLayout::ExrChunkLayout(const ExrWriteContext& file, int part_index, const Film& layout)
    : part(part_index), window(layout.window), order(layout.planes.size()) {
    std::int32_t lines = 1;
    file.check(exr_get_scanlines_per_chunk(file.get(), part, &lines));
    rows = lines;
    exr_compression_t compression = EXR_COMPRESSION_NONE;
    file.check(exr_get_compression(file.get(), part, &compression));
    plain = compression == EXR_COMPRESSION_NONE;
    deflated = compression == EXR_COMPRESSION_ZIP || compression == EXR_COMPRESSION_ZIPS;
    std::iota(order.begin(), order.end(), std::size_t(0));
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return layout.planes[a].name < layout.planes[b].name;
    });
}

ChunkEncoder::~ChunkEncoder() {
    if (initialized_) exr_encoding_destroy(file_.get(), &encode_);
}

EncodedChunk ChunkEncoder::encode(int y, const FilmRows& films) {
    films_ = &films;
    if (!layout_.plain && !layout_.deflated) return {y, compressed(y)};
    const int rows = std::min(layout_.rows, layout_.window.y1 - y);
    std::vector<std::uint8_t> packed(static_cast<std::size_t>(rows) *
                                     static_cast<std::size_t>(layout_.window.width()) *
                                     layout_.order.size() * sizeof(std::uint32_t));
    pack(y, rows, packed.data());
    return {y, layout_.plain ? std::move(packed) : deflated(std::move(packed))};
}

/// By the library.
std::vector<std::uint8_t> ChunkEncoder::compressed(int y) {
    prepare(y);
    file_.check(exr_encoding_run(file_.get(), layout_.part, &encode_));
    // Readers take what is as long as the pixels for the pixels themselves, which the library (3.1)
    // overlooks where compressed ones are exactly that long.
    const bool shrunk = encode_.compressed_bytes < encode_.packed_bytes;
    const auto* const bytes = static_cast<const std::uint8_t*>(shrunk ? encode_.compressed_buffer
                                                                      : encode_.packed_buffer);
    return {bytes, bytes + (shrunk ? encode_.compressed_bytes : encode_.packed_bytes)};
}

/// Or as they are where they do not shrink, as readers expect.
std::vector<std::uint8_t> ChunkEncoder::deflated(std::vector<std::uint8_t> packed) {
    const auto stream = zip_.compress(packed);
    if (!stream.empty()) packed.assign(stream.begin(), stream.end());
    return packed;
}

void ChunkEncoder::prepare(int y) {
    exr_chunk_info_t info{};
    file_.check(exr_write_scanline_chunk_info(file_.get(), layout_.part, y, &info));
    if (initialized_) {
        file_.check(exr_encoding_update(file_.get(), layout_.part, &info, &encode_));
    } else {
        file_.check(exr_encoding_initialize(file_.get(), layout_.part, &info, &encode_));
        initialized_ = true;
    }
    QUADREL_CHECK_OP(==, static_cast<std::size_t>(encode_.channel_count), layout_.order.size());
    for (int c = 0; c < encode_.channel_count; ++c) {
        exr_coding_channel_info_t& channel = encode_.channels[c];
        const Plane& plane = (*films_)[0]->planes[layout_.order[static_cast<std::size_t>(c)]];
        QUADREL_CHECK(plane.name == channel.channel_name, plane.name);
        channel.user_data_type = channel.data_type;
        channel.user_bytes_per_element = sizeof(std::uint32_t);
        channel.user_pixel_stride = sizeof(std::uint32_t);
        channel.user_line_stride = layout_.window.width() * static_cast<int>(sizeof(std::uint32_t));
        // For the choice of routines alone: ours packs.
        channel.encode_from_ptr = reinterpret_cast<const std::uint8_t*>(plane.bits.data());
    }
    file_.check(exr_encoding_choose_default_routines(file_.get(), layout_.part, &encode_));
    encode_.encoding_user_data = this;
    encode_.convert_and_pack_fn = pack;
    encode_.yield_until_ready_fn = nullptr;
    encode_.write_fn = nullptr;
}

exr_result_t ChunkEncoder::pack(exr_encode_pipeline_t* encode) {
    const auto& self = *static_cast<const ChunkEncoder*>(encode->encoding_user_data);
    const int rows = encode->chunk.height;
    self.pack(encode->chunk.start_y, rows, encode->packed_buffer);
    encode->packed_bytes = static_cast<std::uint64_t>(rows) *
                           static_cast<std::uint64_t>(self.layout_.window.width()) *
                           self.layout_.order.size() * sizeof(std::uint32_t);
    return EXR_ERR_SUCCESS;
}

/// Row by row the rows of all channels.
void ChunkEncoder::pack(int first, int rows, void* to) const {
    static_assert(std::endian::native == std::endian::little, "as EXR files are");
    const int width = layout_.window.width();
    auto* out = static_cast<std::uint32_t*>(to);
    for (int y = first; y < first + rows; ++y) {
        const Film& film = film_of(*films_, y);
        const std::size_t at = film.index(layout_.window.x0, y);
        for (const std::size_t p : layout_.order) {
            const Plane& plane = film.planes[p];
            const std::uint32_t* const row = plane.bits.data() + at;
            if (plane.type == ChannelType::uint32)
                std::copy_n(row, width, out);
            else
                for (int x = 0; x < width; ++x) out[x] = masked_canonical(row[x]);
            out += width;
        }
    }
}

void write_chunk(const ExrWriteContext& file, const ExrChunkLayout& layout,
                 const EncodedChunk& chunk) {
    file.check(exr_write_scanline_chunk(file.get(), layout.part, chunk.y, chunk.bytes.data(),
                                        chunk.bytes.size()));
}

}  // namespace quadrel

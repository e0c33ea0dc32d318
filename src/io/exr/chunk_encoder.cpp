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

}  // namespace

/// Files have their channels in the order of their names, as bytes.
ExrChunkLayout::ExrChunkLayout(const ExrWriteContext& file, int part_index, const Film& layout)
    : part(part_index), window(layout.window), order(layout.planes.size()) {
    std::int32_t lines = 1;
    file.check(exr_get_scanlines_per_chunk(file.get(), part, &lines));
    rows = lines;
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
    prepare(y);
    file_.check(exr_encoding_run(file_.get(), layout_.part, &encode_));
    // Readers take what is as long as the pixels for the pixels themselves, which the library (3.1)
    // overlooks where compressed ones are exactly that long.
    const bool shrunk = encode_.compressed_bytes < encode_.packed_bytes;
    const auto* const bytes = static_cast<const std::uint8_t*>(shrunk ? encode_.compressed_buffer
                                                                      : encode_.packed_buffer);
    return {y, {bytes, bytes + (shrunk ? encode_.compressed_bytes : encode_.packed_bytes)}};
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
    static_cast<ChunkEncoder*>(encode->encoding_user_data)->pack();
    return EXR_ERR_SUCCESS;
}

/// Row by row the rows of all channels.
void ChunkEncoder::pack() {
    static_assert(std::endian::native == std::endian::little, "as EXR files are");
    const int width = layout_.window.width(), first = encode_.chunk.start_y;
    auto* out = static_cast<std::uint32_t*>(encode_.packed_buffer);
    for (int y = first; y < first + encode_.chunk.height; ++y) {
        const Film& film = film_of(*films_, y);
        const std::size_t at = film.index(layout_.window.x0, y);
        for (const std::size_t p : layout_.order) {
            const Plane& plane = film.planes[p];
            const std::uint32_t* const row = plane.bits.data() + at;
            out = plane.type == ChannelType::uint32
                      ? std::copy_n(row, width, out)
                      : std::transform(row, row + width, out, canonical_bits);
        }
    }
    encode_.packed_bytes = static_cast<std::uint64_t>(reinterpret_cast<char*>(out) -
                                                      static_cast<char*>(encode_.packed_buffer));
}

void write_chunk(const ExrWriteContext& file, const ExrChunkLayout& layout,
                 const EncodedChunk& chunk) {
    file.check(exr_write_scanline_chunk(file.get(), layout.part, chunk.y, chunk.bytes.data(),
                                        chunk.bytes.size()));
}

}  // namespace quadrel

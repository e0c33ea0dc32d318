#include "io/exr/context.hpp"

#include <cstdlib>
#include <mutex>
#include <new>
#include <stdexcept>
#include <utility>

namespace quadrel {
namespace {

thread_local bool memory_ran_out = false;

void* allocate_zeros(std::size_t bytes) {
    void* const zeros = std::calloc(1, bytes);
    memory_ran_out |= zeros == nullptr;
    return zeros;
}

/// Some buffers do not come from the context's allocator but from the whole library's.
void zero_library_buffers() {
    static std::once_flag once;
    std::call_once(once, [] { exr_set_default_memory_routines(allocate_zeros, std::free); });
}

std::int64_t read_bytes(exr_const_context_t, void* user_data, void* to, std::uint64_t count,
                        std::uint64_t position, exr_stream_error_func_ptr_t) {
    const auto& file = *static_cast<const FileBytes*>(user_data);
    return static_cast<std::int64_t>(file.read(position, to, static_cast<std::size_t>(count)));
}

std::int64_t size_of(exr_const_context_t, void* user_data) {
    return static_cast<std::int64_t>(static_cast<const FileBytes*>(user_data)->size());
}

}  // namespace

void say_nothing(exr_const_context_t, exr_result_t, const char*) {}

void check_exr(exr_result_t result) {
    if (result == EXR_ERR_SUCCESS) return;
    if (result == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
    throw std::runtime_error(exr_get_default_error_message(result));
}

void check_decoded(exr_result_t result) {
    const bool ran_out = std::exchange(memory_ran_out, false);
    check_exr(result == EXR_ERR_OUT_OF_MEMORY && !ran_out ? EXR_ERR_CORRUPT_CHUNK : result);
}

ExrContext::ExrContext(const FileBytes& file, int part) : part_(part) {
    try {
        open(file);
    } catch (...) {
        exr_finish(&context_);
        throw;
    }
}

ExrContext::~ExrContext() { exr_finish(&context_); }

void ExrContext::open(const FileBytes& file) {
    zero_library_buffers();
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.alloc_fn = allocate_zeros;
    start.free_fn = std::free;
    start.error_handler_fn = say_nothing;
    start.user_data = const_cast<FileBytes*>(&file);  // handed back to the two functions alone
    start.read_fn = read_bytes;
    start.size_fn = size_of;
    check_exr(exr_start_read(&context_, file.file().c_str(), &start));
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    check_exr(exr_get_storage(context_, part_, &storage));
    if (storage != EXR_STORAGE_SCANLINE && storage != EXR_STORAGE_TILED)
        throw std::runtime_error("a deep image");
    tiled_ = storage == EXR_STORAGE_TILED;
    check_exr(exr_get_data_window(context_, part_, &window_));
    check_exr(exr_get_compression(context_, part_, &compression_));
}

void ExrContext::for_each_chunk(int y0, int y1, const Visit& visit) const {
    if (tiled_)
        visit_tiles(y0, y1, visit);
    else
        visit_scan_lines(y0, y1, visit);
}

void ExrContext::require_inside(const exr_chunk_info_t& chunk, int x, int y) const {
    const bool inside = chunk.width >= 1 && chunk.height >= 1 &&
                        chunk.width <= window_.max.x - x + 1 &&
                        chunk.height <= window_.max.y - y + 1;
    if (!inside) throw std::runtime_error("a chunk beyond the data window");
}

void ExrContext::visit_scan_lines(int y0, int y1, const Visit& visit) const {
    std::int32_t lines = 1;
    check_exr(exr_get_scanlines_per_chunk(context_, part_, &lines));
    // OpenEXR counts none where a header of scan lines describes tiles.
    if (lines < 1) throw std::runtime_error("scan lines with a description of tiles");
    for (int y = y0 - (y0 - window_.min.y) % lines; y < y1; y += lines) {
        exr_chunk_info_t chunk{};
        check_exr(exr_read_scanline_chunk_info(context_, part_, y, &chunk));
        if (chunk.start_y != y || chunk.width != window_.max.x - window_.min.x + 1)
            throw std::runtime_error("a chunk of other rows");
        require_inside(chunk, window_.min.x, y);
        visit(chunk, window_.min.x, y);
    }
}

void ExrContext::visit_tiles(int y0, int y1, const Visit& visit) const {
    std::int32_t width = 1, height = 1;
    check_exr(exr_get_tile_sizes(context_, part_, 0, 0, &width, &height));
    if (width < 1 || height < 1) throw std::runtime_error("tiles without a size");
    const int columns = (window_.max.x - window_.min.x) / width + 1;
    for (int row = (y0 - window_.min.y) / height; window_.min.y + row * height < y1; ++row)
        for (int column = 0; column < columns; ++column) {
            exr_chunk_info_t chunk{};
            check_exr(exr_read_tile_chunk_info(context_, part_, column, row, 0, 0, &chunk));
            const int x = window_.min.x + column * width, y = window_.min.y + row * height;
            require_inside(chunk, x, y);
            visit(chunk, x, y);
        }
}

}  // namespace quadrel

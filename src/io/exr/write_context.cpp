#include "io/exr/write_context.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

#include "io/exr/context.hpp"
#include "quadrel/check.hpp"

namespace quadrel {
namespace {

/// Longer names of attributes and channels need a flag in the file.
constexpr std::size_t longest_short_name = 31;

exr_compression_t compression_of(ExrCompression compression) {
    switch (compression) {
        case ExrCompression::none:
            return EXR_COMPRESSION_NONE;
        case ExrCompression::rle:
            return EXR_COMPRESSION_RLE;
        case ExrCompression::zips:
            return EXR_COMPRESSION_ZIPS;
        case ExrCompression::zip:
            return EXR_COMPRESSION_ZIP;
        case ExrCompression::piz:
            break;
    }
    return EXR_COMPRESSION_PIZ;
}

/// OpenEXR's windows include their last pixel.
exr_attr_box2i_t inclusive(const Window& window) {
    return {{window.x0, window.y0}, {window.x1 - 1, window.y1 - 1}};
}

bool has_long_names(const ExrPartView& part) {
    const auto is_long = [](const std::string& name) { return name.size() > longest_short_name; };
    return std::any_of(part.attributes->begin(), part.attributes->end(),
                       [&](const auto& attribute) { return is_long(attribute.first); }) ||
           std::any_of(part.film->planes.begin(), part.film->planes.end(),
                       [&](const Plane& plane) { return is_long(plane.name); });
}

}  // namespace

ExrWriteContext::ExrWriteContext(std::span<const ExrPartView> parts, ExrCompression compression,
                                 ExrOutput output)
    : output_(std::move(output)) {
    try {
        start(std::any_of(parts.begin(), parts.end(), has_long_names));
        for (const ExrPartView& part : parts) add_part(part, compression);
        check(exr_write_header(context_));
    } catch (...) {
        exr_finish(&context_);
        throw;
    }
}

ExrWriteContext::~ExrWriteContext() {
    if (context_ != nullptr) exr_finish(&context_);
}

void ExrWriteContext::start(bool long_names) {
    exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
    start.error_handler_fn = say_nothing;
    start.alloc_fn = std::malloc;
    start.free_fn = std::free;
    start.user_data = this;
    start.write_fn = write;
    check(exr_start_write(&context_, "film", EXR_WRITE_FILE_DIRECTLY, &start));
    check(exr_set_longname_support(context_, long_names ? 1 : 0));
}

void ExrWriteContext::add_part(const ExrPartView& part, ExrCompression compression) {
    const Film& film = *part.film;
    QUADREL_CHECK(film.window.width() > 0 && film.window.height() > 0, film.window.width());
    QUADREL_CHECK(!film.planes.empty(), film.planes.size());
    int index = 0;
    check(exr_add_part(context_, part.name, EXR_STORAGE_SCANLINE, &index));
    const exr_attr_box2i_t frame = inclusive(film.frame), window = inclusive(film.window);
    const exr_attr_v2f_t centre{};
    check(exr_initialize_required_attr(context_, index, &frame, &window, 1, &centre, 1,
                                       EXR_LINEORDER_INCREASING_Y, compression_of(compression)));
    for (const Plane& plane : film.planes) {
        QUADREL_CHECK_OP(==, film.find(plane.name), &plane);
        const bool is_float = plane.type == ChannelType::float32;
        check(exr_add_channel(context_, index, plane.name.c_str(),
                              is_float ? EXR_PIXEL_FLOAT : EXR_PIXEL_UINT,
                              EXR_PERCEPTUALLY_LOGARITHMIC, 1, 1));
    }
    for (const auto& [name, value] : *part.attributes)
        check(exr_attr_set_string(context_, index, name.c_str(), value.c_str()));
}

void ExrWriteContext::check(exr_result_t result) const {
    if (error_) std::rethrow_exception(error_);
    check_exr(result);
}

std::int64_t ExrWriteContext::write(exr_const_context_t, void* user_data, const void* bytes,
                                    std::uint64_t size, std::uint64_t position,
                                    exr_stream_error_func_ptr_t) {
    auto& self = *static_cast<ExrWriteContext*>(user_data);
    if (self.error_) return -1;
    try {
        self.output_(position, bytes, size);
    } catch (...) {
        self.error_ = std::current_exception();
        return -1;
    }
    return static_cast<std::int64_t>(size);
}

}  // namespace quadrel

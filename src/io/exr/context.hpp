// OpenEXR's C library, whose callers may allocate: its decoders, like those of the C++ library,
// leave parts of their buffers as they were where a chunk is damaged, so that these must begin as
// something known.
#pragma once

#include <OpenEXR/openexr.h>

#include <functional>

#include "file/file_bytes.hpp"

namespace quadrel {

/// Throws std::bad_alloc, or std::runtime_error with the library's text, unless it is a success.
void check_exr(exr_result_t result);

/// The same of a decoded chunk. Damaged chunks make the library say that memory has run out, too;
/// that is believed where it has.
void check_decoded(exr_result_t result);

/// A handler of the library's messages: check_exr tells what is wrong.
void say_nothing(exr_const_context_t, exr_result_t, const char*);

/// One part of a file, which must outlive it. Everything allocated for it begins as zeros. Throws
/// as check_exr, and for deep parts.
class ExrContext {
  public:
    ExrContext(const FileBytes& file, int part);
    ~ExrContext();
    ExrContext(const ExrContext&) = delete;
    ExrContext& operator=(const ExrContext&) = delete;

    exr_const_context_t get() const { return context_; }
    int part() const { return part_; }
    const exr_attr_box2i_t& window() const { return window_; }
    exr_compression_t compression() const { return compression_; }

    /// What is done with a chunk whose first pixel is (x, y).
    using Visit = std::function<void(const exr_chunk_info_t&, int x, int y)>;
    /// All chunks, of the full resolution, that hold pixels of the rows y0 to y1 - 1; from the top,
    /// from the left.
    void for_each_chunk(int y0, int y1, const Visit& visit) const;

  private:
    void open(const FileBytes& file);
    void require_inside(const exr_chunk_info_t& chunk, int x, int y) const;
    void visit_scan_lines(int y0, int y1, const Visit& visit) const;
    void visit_tiles(int y0, int y1, const Visit& visit) const;

    exr_context_t context_ = nullptr;
    int part_;
    exr_attr_box2i_t window_{};
    exr_compression_t compression_ = EXR_COMPRESSION_NONE;
    bool tiled_ = false;
};

/// Buffers for one chunk: those of the next begin as zeros again.
class ExrPipeline {
  public:
    ExrPipeline(const ExrContext& context, const exr_chunk_info_t& chunk) : context_(context) {
        check_exr(exr_decoding_initialize(context.get(), context.part(), &chunk, &decode));
    }
    ~ExrPipeline() { exr_decoding_destroy(context_.get(), &decode); }
    ExrPipeline(const ExrPipeline&) = delete;
    ExrPipeline& operator=(const ExrPipeline&) = delete;

    exr_decode_pipeline_t decode = EXR_DECODE_PIPELINE_INITIALIZER;

  private:
    const ExrContext& context_;
};

}  // namespace quadrel

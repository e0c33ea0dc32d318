// A file that OpenEXR's C library writes: its header, and where its bytes go.
#pragma once

#include <OpenEXR/openexr.h>

#include <exception>
#include <functional>
#include <span>

#include "quadrel/film/exr.hpp"

namespace quadrel {

/// One part of a file. What it points to must outlive the writing.
struct ExrPartView {
    const char* name = nullptr;  ///< null for the only part of a file
    const Film* film = nullptr;  ///< of which headers need no values
    const Attributes* attributes = nullptr;
};

/// Takes bytes for a position in the file, later ones for an earlier position included. Called by
/// one thread at a time. May throw.
using ExrOutput = std::function<void(std::uint64_t position, const void* bytes, std::size_t size)>;

/// Begins with the headers; then chunks are to be written, and finish().
class ExrWriteContext {
  public:
    ExrWriteContext(std::span<const ExrPartView> parts, ExrCompression compression,
                    ExrOutput output);
    ~ExrWriteContext();
    ExrWriteContext(const ExrWriteContext&) = delete;
    ExrWriteContext& operator=(const ExrWriteContext&) = delete;

    exr_context_t get() const { return context_; }

    /// Throws what the output threw, else as check_exr does.
    void check(exr_result_t result) const;

    void finish() { check(exr_finish(&context_)); }

  private:
    void start(bool long_names);
    void add_part(const ExrPartView& part, ExrCompression compression);
    static std::int64_t write(exr_const_context_t, void* user_data, const void* bytes,
                              std::uint64_t size, std::uint64_t position,
                              exr_stream_error_func_ptr_t);

    ExrOutput output_;
    std::exception_ptr error_;
    exr_context_t context_ = nullptr;
};

}  // namespace quadrel

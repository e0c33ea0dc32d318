// What writers of EXR files share: films as headers and slices, and a stream that keeps errors.
#pragma once

#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfIO.h>

#include <exception>
#include <string>

#include "file/atomic_file.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {

/// The first error sticks: OpenEXR writes its offset table in a destructor, which swallows
/// exceptions, so the stream is asked once the file object is gone.
class ErrorKeepingStream : public Imf::OStream {
  public:
    ErrorKeepingStream(AtomicFile& file, const std::string& name)
        : Imf::OStream(name.c_str()), file_(file) {}

    void write(const char bytes[], int size) override {
        rethrow();
        try {
            file_.write(bytes, static_cast<std::size_t>(size));
        } catch (const OutputError&) {
            error_ = std::current_exception();
            throw;
        }
    }
    uint64_t tellp() override { return file_.position(); }
    void seekp(uint64_t position) override { file_.seek(position); }
    void rethrow() const {
        if (error_) std::rethrow_exception(error_);
    }

  private:
    AtomicFile& file_;
    std::exception_ptr error_;
};

Imf::Header make_exr_header(const Film& film, const Attributes& attributes);

/// Slices that point into the film, which must outlive the writing.
void add_film_slices(Imf::FrameBuffer& buffer, const Film& film);

}  // namespace quadrel

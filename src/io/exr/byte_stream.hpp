// A file as OpenEXR's C++ library reads it.
#pragma once

#include <OpenEXR/ImfIO.h>

#include <stdexcept>

#include "file/file_bytes.hpp"

namespace quadrel {

/// The file must outlive it.
class ByteStream : public Imf::IStream {
  public:
    explicit ByteStream(const FileBytes& file) : Imf::IStream(file.file().c_str()), file_(file) {}

    /// Throws std::runtime_error if there is less.
    bool read(char to[], int count) override {
        const auto wanted = static_cast<std::size_t>(count);
        if (file_.read(at_, to, wanted) != wanted) throw std::runtime_error("early end of file");
        at_ += wanted;
        return at_ < file_.size();
    }
    std::uint64_t tellg() override { return at_; }
    void seekg(std::uint64_t position) override { at_ = position; }

  private:
    const FileBytes& file_;
    std::uint64_t at_ = 0;
};

}  // namespace quadrel

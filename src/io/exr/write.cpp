#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>

#include "io/exr/film.hpp"
#include "quadrel/check.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel {
namespace {

/// OpenEXR's windows include their last pixel.
Imath::Box2i inclusive(const Window& window) {
    return {{window.x0, window.y0}, {window.x1 - 1, window.y1 - 1}};
}

}  // namespace

Imf::Header make_exr_header(const Film& film, const Attributes& attributes) {
    Imf::Header header(inclusive(film.frame), inclusive(film.window), 1, {0, 0}, 1,
                       Imf::INCREASING_Y, Imf::ZIP_COMPRESSION);
    for (const Plane& plane : film.planes) {
        QUADREL_CHECK_OP(==, plane.bits.size(), film.window.area());
        QUADREL_CHECK(header.channels().findChannel(plane.name) == nullptr, plane.name);
        const bool is_float = plane.type == ChannelType::float32;
        header.channels().insert(plane.name, Imf::Channel(is_float ? Imf::FLOAT : Imf::UINT));
    }
    for (const auto& [name, value] : attributes) header.insert(name, Imf::StringAttribute(value));
    return header;
}

void add_film_slices(Imf::FrameBuffer& buffer, const Film& film) {
    for (const Plane& plane : film.planes) {
        const auto type = plane.type == ChannelType::float32 ? Imf::FLOAT : Imf::UINT;
        // OpenEXR's slices are for reading and writing, hence not const.
        char* base = const_cast<char*>(reinterpret_cast<const char*>(plane.bits.data()));
        buffer.insert(plane.name, Imf::Slice::Make(type, base, inclusive(film.window)));
    }
}

namespace {

/// A file in memory.
class MemoryStream : public Imf::OStream {
  public:
    MemoryStream() : Imf::OStream("memory") {}

    void write(const char bytes[], int size) override {
        const auto count = static_cast<std::size_t>(size);
        if (bytes_.size() < position_ + count) bytes_.resize(position_ + count);
        std::copy_n(bytes, count, bytes_.begin() + static_cast<std::ptrdiff_t>(position_));
        position_ += count;
    }
    uint64_t tellp() override { return position_; }
    void seekp(uint64_t position) override { position_ = position; }
    std::string take() { return std::move(bytes_); }

  private:
    std::string bytes_;
    std::size_t position_ = 0;
};

bool is_canonical(const Plane& plane) {
    return plane.type == ChannelType::uint32 ||
           std::all_of(plane.bits.begin(), plane.bits.end(),
                       [](std::uint32_t bits) { return canonical_bits(bits) == bits; });
}

void write_pixels(Imf::OStream& stream, const Film& film, const Attributes& attributes) {
    Imf::OutputFile output(stream, make_exr_header(film, attributes), 0);
    Imf::FrameBuffer buffer;
    add_film_slices(buffer, film);
    output.setFrameBuffer(buffer);
    output.writePixels(film.window.height());
}

/// The film with its NaNs canonical: itself, or `copy`.
const Film& canonical(const Film& film, Film& copy) {
    QUADREL_CHECK(film.window.width() > 0 && film.window.height() > 0, film.window.width());
    QUADREL_CHECK(!film.planes.empty(), film.planes.size());
    if (std::all_of(film.planes.begin(), film.planes.end(), is_canonical)) return film;
    copy = film;
    canonicalize(copy);
    return copy;
}

void write_canonical(const std::filesystem::path& path, const Film& film,
                     const Attributes& attributes) {
    AtomicFile file(path);
    ErrorKeepingStream stream(file, path.string());
    try {
        write_pixels(stream, film, attributes);
    } catch (const Iex::BaseExc& error) {
        stream.rethrow();
        throw OutputError(path, error.what());
    }
    stream.rethrow();
    file.commit();
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Film& film, const Attributes& attributes) {
    Film copy;
    write_canonical(path, canonical(film, copy), attributes);
}

std::string exr_bytes(const Film& film, const Attributes& attributes) {
    Film copy;
    MemoryStream stream;
    write_pixels(stream, canonical(film, copy), attributes);
    return stream.take();
}

}  // namespace quadrel

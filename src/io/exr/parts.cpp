#include "io/exr/parts.hpp"

#include <OpenEXR/Iex.h>
#include <OpenEXR/ImfMultiPartOutputFile.h>
#include <OpenEXR/ImfOutputPart.h>
#include <OpenEXR/ImfPartType.h>

#include "io/exr/film.hpp"
#include "quadrel/check.hpp"

namespace quadrel {
namespace {

std::vector<Imf::Header> make_headers(const std::vector<ExrPart>& parts) {
    std::vector<Imf::Header> headers;
    for (const ExrPart& part : parts) {
        headers.push_back(make_exr_header(part.film, part.attributes));
        headers.back().setName(part.name);
        headers.back().setType(Imf::SCANLINEIMAGE);
    }
    return headers;
}

void write_parts(Imf::OStream& stream, const std::vector<ExrPart>& parts) {
    const std::vector<Imf::Header> headers = make_headers(parts);
    Imf::MultiPartOutputFile output(stream, headers.data(), static_cast<int>(parts.size()), false,
                                    0);
    for (std::size_t i = 0; i < parts.size(); ++i) {
        Imf::OutputPart part(output, static_cast<int>(i));
        Imf::FrameBuffer buffer;
        add_film_slices(buffer, parts[i].film);
        part.setFrameBuffer(buffer);
        part.writePixels(parts[i].film.window.height());
    }
}

}  // namespace

void write_exr_parts(const std::filesystem::path& path, std::vector<ExrPart> parts) {
    QUADREL_CHECK(!parts.empty(), parts.size());
    if (parts.size() == 1) return write_exr(path, parts[0].film, parts[0].attributes);
    for (ExrPart& part : parts) canonicalize(part.film);
    AtomicFile file(path);
    ErrorKeepingStream stream(file, path.string());
    try {
        write_parts(stream, parts);
    } catch (const Iex::BaseExc& error) {
        stream.rethrow();
        throw OutputError(path, error.what());
    }
    stream.rethrow();
    file.commit();
}

}  // namespace quadrel

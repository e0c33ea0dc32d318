#include <algorithm>
#include <stdexcept>

#include "file/atomic_file.hpp"
#include "io/exr/encode.hpp"
#include "io/exr/parts.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

void write_file(const std::filesystem::path& path, std::span<const ExrPartView> parts,
                const ExrWriting& writing) {
    AtomicFile file(path);
    try {
        encode_exr(parts, writing,
                   [&](std::uint64_t position, const void* bytes, std::size_t size) {
                       file.seek(position);
                       file.write(bytes, size);
                   });
    } catch (const OutputError&) {
        throw;
    } catch (const std::runtime_error& error) {
        throw OutputError(path, error.what());
    }
    file.commit();
}

}  // namespace

void write_exr(const std::filesystem::path& path, const Film& film, const Attributes& attributes,
               const ExrWriting& writing) {
    const ExrPartView part{nullptr, &film, &attributes};
    write_file(path, {&part, 1}, writing);
}

void write_exr_parts(const std::filesystem::path& path, const std::vector<ExrPart>& parts,
                     const ExrWriting& writing) {
    std::vector<ExrPartView> views;
    for (const ExrPart& part : parts)
        views.push_back({part.name.c_str(), &part.film, &part.attributes});
    if (views.size() == 1) views[0].name = nullptr;
    write_file(path, views, writing);
}

std::string exr_bytes(const Film& film, const Attributes& attributes, const ExrWriting& writing) {
    const ExrPartView part{nullptr, &film, &attributes};
    std::string all;
    encode_exr({&part, 1}, writing, append_to(all));
    return all;
}

}  // namespace quadrel

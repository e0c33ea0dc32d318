// What a file is by its first bytes, for messages about a file of another kind than was meant.
#pragma once

#include <string_view>

namespace quadrel {

/// "a PNG image" and the like; null for what is none of these.
inline const char* kind_by_first_bytes(std::string_view bytes) {
    struct Kind {
        std::string_view start;
        const char* name;
    };
    static constexpr Kind kinds[] = {
        {"\x89PNG\r\n\x1a\n", "a PNG image"},
        {"\x76\x2f\x31\x01", "an EXR image"},
        {"\xff\xd8\xff", "a JPEG image"},
        {{"II*\0", 4}, "a TIFF image"},
        {{"MM\0*", 4}, "a TIFF image"},
        {"#?RADIANCE", "a Radiance image"},
        {"#?RGBE", "a Radiance image"},
        {"DDS ", "a DDS image"},
        {"\xabKTX 20\xbb", "a KTX2 image"},
        {"GIF8", "a GIF image"},
        {"RIFF", "a RIFF file (WebP?)"},
        {"glTF", "a mesh (GLB)"},
        {"%PDF", "a PDF file"},
        {"PK\x03\x04", "a ZIP archive"},
        {"\x1f\x8b", "a gzip file"},
        {"\x7f\x45LF", "a program or shared object"},
    };
    for (const Kind& kind : kinds)
        if (bytes.starts_with(kind.start)) return kind.name;
    return nullptr;
}

}  // namespace quadrel

/* The border between the program and quadrel-oiio.so, in C: plain structs, memory owned by the
   caller, no exceptions. The module exists because linking OpenImageIO costs a program 0.2 s and
   over 100 MB whether or not it reads an image. */
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

/** How the module hands over a value: as the file stores it. */
enum QuadrelOiioType : std::int32_t {
    quadrel_oiio_uint8,
    quadrel_oiio_uint16,
    quadrel_oiio_uint32,
    quadrel_oiio_half,
    quadrel_oiio_float,
    quadrel_oiio_double
};

struct QuadrelOiioInfo {
    std::int32_t width, height, channels;
    QuadrelOiioType type;
    std::int32_t luminance;   /**< 1: channels are Y or Y A */
    std::int32_t orientation; /**< as TIFF and Exif number it, 1 to 8; 1 where the file says none */
};

/** One read. The caller fills the first three fields. */
struct QuadrelOiioRequest {
    std::uint32_t version; /**< quadrel_oiio_version */
    void* user;
    /** Called once, before any pixel is read; returns memory for width * height * channels values,
        rows from the top, or null to give up. */
    void* (*allocate)(void* user, const QuadrelOiioInfo* info);
    char error[512]; /**< filled when the read fails */
};

/** Returns 0 for success, 1 with `error` set, 2 when `allocate` gave up,
    quadrel_oiio_unknown_format where no reader knows the file. */
typedef std::int32_t QuadrelOiioRead(const char* path, QuadrelOiioRequest* request);
}

inline constexpr std::uint32_t quadrel_oiio_version = 3;
inline constexpr std::int32_t quadrel_oiio_unknown_format = 3;
inline constexpr const char* quadrel_oiio_symbol = "quadrel_oiio_read";

#include "texture/oiio_request.hpp"

#include <OpenImageIO/imageio.h>

#include <cstdio>
#include <exception>
#include <memory>
#include <string>

namespace {

int fail(QuadrelOiioRequest& request, const std::string& reason) {
    std::snprintf(request.error, sizeof request.error, "%s", reason.c_str());
    return 1;
}

bool native_type(OIIO::TypeDesc type, QuadrelOiioType& out) {
    switch (type.basetype) {
        case OIIO::TypeDesc::UINT8:
            out = quadrel_oiio_uint8;
            return true;
        case OIIO::TypeDesc::UINT16:
            out = quadrel_oiio_uint16;
            return true;
        case OIIO::TypeDesc::UINT32:
            out = quadrel_oiio_uint32;
            return true;
        case OIIO::TypeDesc::HALF:
            out = quadrel_oiio_half;
            return true;
        case OIIO::TypeDesc::FLOAT:
            out = quadrel_oiio_float;
            return true;
        case OIIO::TypeDesc::DOUBLE:
            out = quadrel_oiio_double;
            return true;
        default:
            return false;
    }
}

/// What a reader or the library complained about, once; a truncated JPEG or TIFF complains and yet
/// reads as a success.
std::string pending_error(OIIO::ImageInput* input) {
    std::string error = input != nullptr ? input->geterror() : "";
    const std::string global = OIIO::geterror();
    if (error.empty()) error = global;
    return error;
}

/// For these libtiff mirrors rows and columns itself, but does not turn, and OpenImageIO (2.4) says
/// nothing of it.
bool is_turned_in_part(const OIIO::ImageInput& input, const OIIO::ImageSpec& spec) {
    constexpr int ycbcr = 6;
    const std::string compression = spec.get_string_attribute("compression");
    return std::string(input.format_name()) == "tiff" &&
           (compression == "jpeg" || compression == "ojpeg" ||
            spec.get_int_attribute("tiff:PhotometricInterpretation", 0) == ycbcr);
}

int read(const char* path, QuadrelOiioRequest& request) {
    OIIO::ImageSpec config;
    // Otherwise colours come back multiplied by alpha, which may hold heights.
    config.attribute("oiio:UnassociatedAlpha", 1);
    const auto input = OIIO::ImageInput::open(path, &config);
    if (!input) {
        fail(request, pending_error(nullptr));
        const bool known = OIIO::ImageInput::create(path) != nullptr;
        pending_error(nullptr);  // or the next read would have it
        return known ? 1 : quadrel_oiio_unknown_format;
    }
    const OIIO::ImageSpec& spec = input->spec();
    QuadrelOiioInfo info{spec.width, spec.height, spec.nchannels, quadrel_oiio_uint8, 0, 1};
    if (spec.depth > 1) return fail(request, "a volume");
    if (spec.deep) return fail(request, "a deep image");
    if (!native_type(spec.format, info.type)) {
        return fail(request, std::string("values of type ") + spec.format.c_str());
    }
    info.luminance = spec.nchannels == 1 || (spec.nchannels == 2 && spec.alpha_channel == 1);
    info.orientation = spec.get_int_attribute("Orientation", 1);
    if (info.orientation < 1 || info.orientation > 8) info.orientation = 1;  // reserved values
    if (info.orientation != 1 && is_turned_in_part(*input, spec))
        return fail(request, "a TIFF of JPEG or YCbCr data with another orientation than 1");
    void* const pixels = request.allocate(request.user, &info);
    if (pixels == nullptr) return 2;
    // In the native type: the library's own conversion to float misses half of the 8-bit codes.
    const bool ok = input->read_image(0, 0, 0, spec.nchannels, spec.format, pixels);
    const std::string error = pending_error(input.get());
    if (!ok || !error.empty()) return fail(request, error.empty() ? "unreadable pixels" : error);
    return 0;
}

}  // namespace

extern "C" __attribute__((visibility("default"))) std::int32_t quadrel_oiio_read(
    const char* path, QuadrelOiioRequest* request) {
    if (request->version != quadrel_oiio_version) return fail(*request, "another module version");
    try {
        return read(path, *request);
    } catch (const std::exception& error) {
        return fail(*request, error.what());
    } catch (...) {
        return fail(*request, "an unknown exception");
    }
}

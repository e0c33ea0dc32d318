// Reads images through the OpenImageIO module, as the files store them.
#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <exception>
#include <mutex>

#include "file/module_path.hpp"
#include "io/image/orient.hpp"
#include "io/image/readers.hpp"
#include "quadrel/error.hpp"
#include "text/out_of_memory.hpp"
#include "texture/oiio_request.hpp"

namespace quadrel {

namespace {

constexpr const char* module_name = "quadrel-oiio";

struct Module {
    QuadrelOiioRead* read = nullptr;
    std::string problem;
};

Module open_module() {
    const auto path = find_module(module_name);
    if (!path) return {nullptr, fmt::format("{} was not found", module_name)};
    // Never closed: the library starts threads.
    void* const handle = dlopen(path->c_str(), RTLD_NOW | RTLD_LOCAL);
    void* const symbol = handle != nullptr ? dlsym(handle, quadrel_oiio_symbol) : nullptr;
    if (symbol == nullptr) return {nullptr, dlerror()};
    return {reinterpret_cast<QuadrelOiioRead*>(symbol), ""};
}

const Module& image_module() {
    static const Module module = open_module();
    return module;
}

/// Standard error goes nowhere as long as this lives: libpng writes about damaged files there,
/// besides returning the error. One at a time.
class QuietLibraries {
  public:
    QuietLibraries() : lock_(mutex()), saved_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
        const int nowhere = open("/dev/null", O_WRONLY | O_CLOEXEC);
        if (saved_ >= 0 && nowhere >= 0) dup2(nowhere, STDERR_FILENO);
        if (nowhere >= 0) close(nowhere);
    }
    ~QuietLibraries() {
        std::fflush(stderr);
        if (saved_ < 0) return;
        dup2(saved_, STDERR_FILENO);
        close(saved_);
    }
    QuietLibraries(const QuietLibraries&) = delete;
    QuietLibraries& operator=(const QuietLibraries&) = delete;

  private:
    static std::mutex& mutex() {
        static std::mutex mutex;
        return mutex;
    }
    std::lock_guard<std::mutex> lock_;
    int saved_;
};

int read_quietly(const Module& module, const std::string& file, QuadrelOiioRequest& request) {
    const QuietLibraries quiet;
    return module.read(file.c_str(), &request);
}

/// What a read fills. Exceptions must not cross the module: they wait here.
struct Read {
    std::string file, key;
    QuadrelOiioInfo info{};
    std::vector<unsigned char> pixels;
    std::exception_ptr exception;
};

void* allocate(void* user, const QuadrelOiioInfo* info) {
    Read& read = *static_cast<Read*>(user);
    try {
        read.info = *info;
        check_image_size(info->width, info->height, info->channels, read.file, read.key);
        if (info->channels > 4) {
            throw InputError(read.file, read.key, fmt::format("{} channels", info->channels),
                             "1 to 4 channels");
        }
        read.pixels.resize(static_cast<std::size_t>(info->width) * info->height * info->channels *
                           value_size(info->type));
        return read.pixels.data();
    } catch (...) {
        read.exception = std::current_exception();
        return nullptr;
    }
}

}  // namespace

StoredImage read_other_image(const std::string& file, const std::string& key) {
    const Module& module = image_module();
    if (module.read == nullptr) {
        if (says_out_of_memory(module.problem)) throw std::bad_alloc();
        throw InputError(file, key,
                         fmt::format("a file other than EXR, and no reader: {}", module.problem),
                         fmt::format("an EXR file, or an installation with {}", module_name));
    }
    Read read{file, key, {}, {}, nullptr};
    QuadrelOiioRequest request{quadrel_oiio_version, &read, allocate, {}};
    const int result = read_quietly(module, file, request);
    if (read.exception) std::rethrow_exception(read.exception);
    if (result != 0 && says_out_of_memory(request.error)) throw std::bad_alloc();
    if (result == quadrel_oiio_unknown_format)
        throw InputError(file, key, "no image format that is known",
                         "PNG, JPEG, TIFF, EXR, HDR, BMP, TGA, DDS or another of OpenImageIO's");
    if (result != 0) throw InputError(file, key, request.error, "a complete image file");
    // OpenImageIO (2.4) exchanges two of the orientations of Radiance files.
    const int orientation = radiance_orientation(file).value_or(read.info.orientation);
    orient(read.pixels, read.info, orientation);
    return {read.info, std::move(read.pixels)};
}

}  // namespace quadrel

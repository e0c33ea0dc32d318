#include "io/exr/file_sink.hpp"
#include "quadrel/render.hpp"
#include "render/bands/draw_bands.hpp"

namespace quadrel {
namespace {

/// Hands bands on as they come.
class CallingSink : public BandSink {
  public:
    explicit CallingSink(const std::function<void(const Film&)>& call) : call_(call) {}

    BandStep take(std::shared_ptr<const Film> band) override {
        call_(*band);
        return {};
    }

  private:
    const std::function<void(const Film&)>& call_;
};

}  // namespace

void render_in_bands(const Scene& scene, const RenderOptions& options,
                     const std::function<void(const Film& band)>& take) {
    render_bands(scene, options, [&](const Film&) { return std::make_unique<CallingSink>(take); });
}

BandSinkMaker to_exr(const std::filesystem::path& file, const Scene& scene,
                     const RenderOptions& options, ExrCompression compression) {
    const auto named = render_attributes(scene, options);
    return [file, attributes = Attributes(named.begin(), named.end()), compression](
               const Film& layout) { return exr_file_sink(file, layout, attributes, compression); };
}

void render_to_exr(const std::filesystem::path& file, const Scene& scene,
                   const RenderOptions& options, ExrCompression compression) {
    render_bands(scene, options, to_exr(file, scene, options, compression));
}

}  // namespace quadrel

#include "io/exr/file_sink.hpp"

#include <stdexcept>
#include <utility>

#include "file/atomic_file.hpp"
#include "io/exr/encode.hpp"
#include "quadrel/error.hpp"

namespace quadrel {
namespace {

class ExrFileSink : public BandSink {
  public:
    ExrFileSink(const std::filesystem::path& path, const Film& layout, const Attributes& attributes,
                ExrCompression compression)
        : path_(path), file_(path) {
        writing([&] {
            bands_ =
                exr_band_sink(layout, attributes, compression,
                              [this](std::uint64_t position, const void* bytes, std::size_t size) {
                                  file_.seek(position);
                                  file_.write(bytes, size);
                              });
        });
    }

    BandStep take(std::shared_ptr<const Film> band) override {
        const BandStep step = bands_->take(std::move(band));
        return {guarded(step.work), guarded(step.finish)};
    }

    void end() override {
        writing([&] { bands_->end(); });
        file_.commit();
    }

  private:
    /// Whatever the library says is about the file.
    template <class F>
    void writing(const F& f) const {
        try {
            f();
        } catch (const OutputError&) {
            throw;
        } catch (const std::runtime_error& error) {
            throw OutputError(path_, error.what());
        }
    }

    std::function<void()> guarded(const std::function<void()>& f) const {
        if (!f) return {};
        return [this, f] { writing(f); };
    }

    std::filesystem::path path_;
    AtomicFile file_;  // outlives what writes into it
    std::unique_ptr<BandSink> bands_;
};

}  // namespace

std::unique_ptr<BandSink> exr_file_sink(const std::filesystem::path& file, const Film& layout,
                                        const Attributes& attributes, ExrCompression compression) {
    return std::make_unique<ExrFileSink>(file, layout, attributes, compression);
}

}  // namespace quadrel

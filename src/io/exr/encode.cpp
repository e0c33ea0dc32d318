#include "io/exr/encode.hpp"

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_pipeline.h>

#include <algorithm>
#include <array>
#include <utility>

#include "io/exr/chunk_encoder.hpp"
#include "quadrel/check.hpp"
#include "text/threads.hpp"

namespace quadrel {
namespace {

/// Chunks that follow each other, passed on together: some compressions have but a row a chunk.
using Chunks = std::vector<EncodedChunk>;

/// A part that is being written.
class PartWriter {
  public:
    PartWriter(const ExrWriteContext& file, int part, const Film& layout)
        : file_(file),
          layout_(file, part, layout),
          encoders_([this] { return ChunkEncoder(file_, layout_); }) {}
    PartWriter(const PartWriter&) = delete;
    PartWriter& operator=(const PartWriter&) = delete;

    const ExrChunkLayout& layout() const { return layout_; }

    /// The chunks that begin with the rows `first` to `last` - 1, of films that hold all their
    /// rows. By several threads, and for several of them.
    Chunks encode(int first, int last, const FilmRows& films) {
        Chunks chunks(static_cast<std::size_t>((last - first + layout_.rows - 1) / layout_.rows));
        tbb::parallel_for(std::size_t(0), chunks.size(), [&](std::size_t i) {
            chunks[i] = encoders_.local().encode(first + static_cast<int>(i) * layout_.rows, films);
        });
        return chunks;
    }

    void write(const Chunks& chunks) const {
        for (const EncodedChunk& chunk : chunks) write_chunk(file_, layout_, chunk);
    }

  private:
    const ExrWriteContext& file_;
    const ExrChunkLayout layout_;
    tbb::enumerable_thread_specific<ChunkEncoder> encoders_;
};

void write_part(const ExrWriteContext& file, int part, const Film& film) {
    constexpr int band = 32;  // rows; those of chunks divide it
    PartWriter writer(file, part, film);
    const FilmRows rows{std::shared_ptr<const Film>(std::shared_ptr<void>(), &film)};
    const Window& window = film.window;
    int next = window.y0;
    const auto first_row = [&](tbb::flow_control& control) {
        if (next >= window.y1) control.stop();
        return std::exchange(next, next + band);
    };
    const auto encode = [&](int first) {
        return std::make_shared<Chunks>(
            writer.encode(first, std::min(first + band, window.y1), rows));
    };
    const auto write = [&](const std::shared_ptr<Chunks>& chunks) { writer.write(*chunks); };
    const auto most = 2 * static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
    using Mode = tbb::filter_mode;
    tbb::parallel_pipeline(
        most, tbb::make_filter<void, int>(Mode::serial_in_order, first_row) &
                  tbb::make_filter<int, std::shared_ptr<Chunks>>(Mode::parallel, encode) &
                  tbb::make_filter<std::shared_ptr<Chunks>, void>(Mode::serial_in_order, write));
}

/// Writes chunks as bands come; those that reach into the next band wait for it.
class ExrBandSink : public BandSink {
  public:
    ExrBandSink(const Film& layout, const Attributes& attributes, ExrCompression compression,
                ExrOutput output)
        : file_(std::array{ExrPartView{nullptr, &layout, &attributes}}, compression,
                std::move(output)),
          writer_(file_, 0, layout),
          next_(layout.window.y0) {}

    BandStep take(std::shared_ptr<const Film> band) override {
        const Window& window = writer_.layout().window;
        const int rows = writer_.layout().rows, end = band->window.y1;
        films_.push_back(std::move(band));
        const int last = end == window.y1 ? end : end - (end - window.y0) % rows;
        const int first = std::exchange(next_, last);
        if (first == last) return {};
        const auto films = std::make_shared<FilmRows>(films_);
        std::erase_if(films_, [&](const auto& film) { return film->window.y1 <= last; });
        const auto chunks = std::make_shared<Chunks>();
        return {[this, first, last, films, chunks] {
                    *chunks = writer_.encode(first, last, *films);
                    films->clear();
                },
                [this, chunks] { writer_.write(*chunks); }};
    }

    void end() override {
        QUADREL_CHECK_OP(==, next_, writer_.layout().window.y1);
        file_.finish();
    }

  private:
    ExrWriteContext file_;
    PartWriter writer_;
    int next_;        ///< first row that no step has been given
    FilmRows films_;  ///< that hold rows from there on
};

}  // namespace

void encode_exr(std::span<const ExrPartView> parts, const ExrWriting& writing,
                const ExrOutput& output) {
    for (const ExrPartView& part : parts)
        for (const Plane& plane : part.film->planes)
            QUADREL_CHECK_OP(==, plane.bits.size(), part.film->window.area());
    ExrWriteContext file(parts, writing.compression, output);
    arena_of(writing.threads).execute([&] {
        for (std::size_t i = 0; i < parts.size(); ++i)
            write_part(file, static_cast<int>(i), *parts[i].film);
    });
    file.finish();
}

ExrOutput append_to(std::string& all) {
    return [&all](std::uint64_t position, const void* bytes, std::size_t size) {
        if (all.size() < position + size) all.resize(position + size);
        std::copy_n(static_cast<const char*>(bytes), size, all.data() + position);
    };
}

std::unique_ptr<BandSink> exr_band_sink(const Film& layout, const Attributes& attributes,
                                        ExrCompression compression, ExrOutput output) {
    return std::make_unique<ExrBandSink>(layout, attributes, compression, std::move(output));
}

}  // namespace quadrel

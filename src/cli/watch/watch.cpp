#include "cli/watch/watch.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <set>
#include <utility>

#include "cli/common/console.hpp"
#include "cli/common/quiet.hpp"
#include "cli/watch/file_watcher.hpp"
#include "file/output_group.hpp"
#include "io/tev/packets.hpp"
#include "io/tev/sink.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/preview.hpp"
#include "render/changes/image_inputs.hpp"

namespace quadrel::cli {
namespace {

using Clock = std::chrono::steady_clock;

/// Puts the pixels of `part`, which has the same planes, into the film.
void paste(const Film& part, Film& film) {
    const auto width = static_cast<std::size_t>(part.window.width());
    for (std::size_t p = 0; p < film.planes.size(); ++p)
        for (int y = part.window.y0; y < part.window.y1; ++y)
            std::copy_n(part.planes[p].bits.begin() +
                            static_cast<std::ptrdiff_t>(part.index(part.window.x0, y)),
                        width,
                        film.planes[p].bits.begin() +
                            static_cast<std::ptrdiff_t>(film.index(part.window.x0, y)));
}

/// The image and what it was drawn of.
class WatchedImage {
  public:
    explicit WatchedImage(const WatchedRender& render) : render_(render) {}

    /// Loads the scene and draws what differs from the image before. Returns a line about it. What
    /// changes while it is drawn is watched already.
    std::string update(FileWatcher& watcher) {
        const auto begin = Clock::now();
        Scene scene = load(watcher);
        if (scene_) scene.texture_cache = scene_->texture_cache;
        const ImageInputs inputs = image_inputs(scene, render_.options);
        const ImageChange change =
            scene_ ? change_between(inputs_, inputs) : ImageChange{{"all"}, inputs.window};
        const bool same_header = scene_ && scene_->hash == scene.hash;
        scene_.reset();  // should drawing fail, the film is that of no scene
        if (change.pixels) draw(scene, *change.pixels);
        if (change.pixels || !same_header) write(scene);
        if (change.pixels && render_.tev != nullptr) send(*change.pixels);
        scene_ = std::move(scene);
        inputs_ = inputs;
        return text_of(change, begin);
    }

    /// That were read for it the last time.
    const std::vector<std::filesystem::path>& files() const { return files_; }

  private:
    Scene load(FileWatcher& watcher) {
        watcher.add(files_);  // folders may have come anew
        try {
            Scene scene = render_.load(files_);
            watcher.add(files_);
            return scene;
        } catch (...) {
            watcher.add(files_);
            throw;
        }
    }

    void draw(const Scene& scene, const Window& pixels) {
        RenderOptions options = render_.options;
        options.window = pixels;
        const Window all = render_.options.window.value_or(Window{0, 0, scene.width, scene.height});
        if (film_.window != all || pixels == all) {
            options.window = render_.options.window;
            render_into(film_, scene, options);
        } else {
            paste(render(scene, options), film_);
        }
    }

    void write(const Scene& scene) const {
        const auto named = render_attributes(scene, render_.options);
        OutputGroup outputs;
        write_exr(render_.output, film_, Attributes(named.begin(), named.end()),
                  {render_.compression, render_.options.threads});
        if (!render_.preview.empty()) write_png(render_.preview, preview(film_));
        outputs.commit();
    }

    void send(const Window& pixels) {
        const std::string name = render_.output.string();
        if (shown_ != film_.window) render_.tev->send(tev_create_image(name, film_));
        shown_ = film_.window;
        send_to_tev(*render_.tev, name, film_, pixels, film_.window);
        const bool lost = !render_.tev->lost().empty();
        if (lost && !std::exchange(told_lost_, true))
            say("quadrel: warning: tev is sent nothing more: " + render_.tev->lost());
    }

    std::string text_of(const ImageChange& change, Clock::time_point begin) const {
        if (change.what.empty()) return "no pixel of the image depends on it";
        std::string what;
        for (const std::string& part : change.what) what += (what.empty() ? "" : ", ") + part;
        const Window pixels = change.pixels.value_or(Window{});
        const std::chrono::duration<double> seconds = Clock::now() - begin;
        return fmt::format("{}: {}x{} of {}x{} pixels drawn in {:.2f} s", what, pixels.width(),
                           pixels.height(), film_.window.width(), film_.window.height(),
                           seconds.count());
    }

    const WatchedRender& render_;
    std::optional<Scene> scene_;
    ImageInputs inputs_;
    std::vector<std::filesystem::path> files_;
    Film film_;
    std::optional<Window> shown_;
    bool told_lost_ = false;
};

std::string names_text(const std::set<std::filesystem::path>& files) {
    std::string text;
    for (const std::filesystem::path& file : files)
        text += (text.empty() ? "" : ", ") + file.filename().string();
    return text;
}

/// A line about the change, or about why there is no image of it.
std::string update_and_tell(WatchedImage& image, FileWatcher& watcher) {
    try {
        return image.update(watcher);
    } catch (const InputError& error) {
        return error.what();
    } catch (const UsageError& error) {
        return error.what();
    } catch (const OutputError& error) {
        return error.what();
    }
}

}  // namespace

void watch(const WatchedRender& render) {
    FileWatcher watcher;
    WatchedImage image(render);
    image.update(watcher);
    say_written(render.output);
    if (!render.preview.empty()) say_written(render.preview);
    watcher.add(image.files());  // baked maps and others that drawing has read
    tell(fmt::format("quadrel: watching {} files", image.files().size()));
    while (true) {
        const std::string changed = names_text(watcher.wait());
        tell(fmt::format("quadrel: {} changed: {}", changed, update_and_tell(image, watcher)));
        watcher.add(image.files());
    }
}

}  // namespace quadrel::cli

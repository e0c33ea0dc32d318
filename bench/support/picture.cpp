#include "support/picture.hpp"

#include <algorithm>

#include "quadrel/scene/load.hpp"

namespace quadrel::bench {
namespace {

std::unique_ptr<Scene> load(const PictureText& text) {
    std::vector<std::string> overrides = text.overrides;
    overrides.emplace_back("size=[1024,1024]");
    return std::make_unique<Scene>(load_scene(text.scene, overrides));
}

/// The quad of side 2, seen from 3 in front, then just fills the frame.
constexpr const char* fill_frame = "camera.fov_y=36.8698";

}  // namespace

Picture::Picture(const PictureText& text, const KernelTable& kernels)
    : scene_(load(text)), prepared_(prepare_render(*scene_, RenderOptions{}, kernels)) {}

Film Picture::draw(int threads, StageTimes* times) const {
    RenderOptions options;
    options.threads = threads;
    if (times == nullptr) return quadrel::draw(prepared_, options);
    quadrel::DrawRecord record;
    Film film = quadrel::draw(prepared_, options, &record);
    merge(*times, record.stages);
    return film;
}

std::size_t Picture::covered() const {
    const Film film = draw(0);
    const auto& alpha = film.find("A")->bits;
    return alpha.size() -
           static_cast<std::size_t>(std::count(alpha.begin(), alpha.end(), std::uint32_t(0)));
}

const std::vector<PictureText>& thesis_pictures() {
    static const std::vector<PictureText> all{{"thesis", "thesis-quad", {}},
                                              {"published", "thesis-quad-published", {}}};
    return all;
}

const std::vector<PictureText>& full_pictures() {
    static const std::vector<PictureText> all{
        {"trilinear",
         "thesis-quad",
         {fill_frame, "materials.bricks.shade=shade-texture",
          R"(materials.bricks.relief={"frame": "none", "trace": "none", "surface": "none",)"
          R"( "shadow": "none"})"}},
        {"thesis", "thesis-quad", {fill_frame}},
        {"published", "thesis-quad-published", {fill_frame}}};
    return all;
}

}  // namespace quadrel::bench

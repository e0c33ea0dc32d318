#include <utility>

#include "quadrel/prepare.hpp"
#include "render/bands/draw_bands.hpp"
#include "render/plan/prepared.hpp"
#include "render/prepare/geometry_cache.hpp"

namespace quadrel {

struct PreparedScene::State {
    Scene scene;
    RenderOptions options;
    GeometryCache geometry;
};

PreparedScene::PreparedScene(Scene scene, RenderOptions options)
    : state_(std::make_unique<State>(State{std::move(scene), std::move(options), {}})) {
    load_ahead(state_->scene, state_->options, state_->geometry);
}

PreparedScene::~PreparedScene() = default;
PreparedScene::PreparedScene(PreparedScene&&) noexcept = default;
PreparedScene& PreparedScene::operator=(PreparedScene&&) noexcept = default;

Scene& PreparedScene::scene() { return state_->scene; }
RenderOptions& PreparedScene::options() { return state_->options; }
int PreparedScene::assembled() const { return state_->geometry.assembled(); }

Film PreparedScene::draw() {
    Film film;
    draw_into(film);
    return film;
}

void PreparedScene::draw_into(Film& film) {
    State& s = *state_;
    render_by(s.scene, s.options, drawing_into(film, s.options), &s.geometry);
}

void PreparedScene::draw_to_exr(const std::filesystem::path& file, ExrCompression compression) {
    State& s = *state_;
    render_bands(s.scene, s.options, to_exr(file, s.scene, s.options, compression), &s.geometry);
}

}  // namespace quadrel

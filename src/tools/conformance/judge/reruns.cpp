#include "conformance/judge/reruns.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "render/draw/shell.hpp"
#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel::conformance {
namespace {

/// The values of a window, which both films hold.
void copy_rows(const Film& film, const Plane& from, const Window& window, const Film& into,
               Plane& to) {
    for (int y = window.y0; y < window.y1; ++y)
        std::copy_n(from.bits.begin() + static_cast<std::ptrdiff_t>(film.index(window.x0, y)),
                    window.width(),
                    to.bits.begin() + static_cast<std::ptrdiff_t>(into.index(window.x0, y)));
}

/// Texels of all levels, the last one's included.
std::size_t size_of(const TextureView& view) {
    std::size_t end = 0;
    for (int l = 0; l < view.levels; ++l)
        end = std::max(end, static_cast<std::size_t>(view.offset[l]) +
                                static_cast<std::size_t>(view.width[l]) *
                                    static_cast<std::size_t>(view.height[l]) *
                                    static_cast<std::size_t>(view.channels * view.faces));
    return end;
}

}  // namespace

ScaledHeights::ScaledHeights(RenderPlan& plan, double factor) {
    using enum TextureSlot;
    for (std::size_t m = 0; m < plan.textures.size(); ++m)
        for (const TextureSlot slot : {height, layers, layers_2, layers_3}) {
            const auto of = static_cast<std::size_t>(slot);
            if (plan.textures[m].owned[of] == nullptr) continue;
            TextureView& view = plan.textures[m].sampled[of].view;
            std::vector<float>& texels = texels_.emplace_back(size_of(view));
            std::transform(view.texels, view.texels + texels.size(), texels.begin(), [&](float h) {
                return static_cast<float>(static_cast<double>(h) * factor);
            });
            view.texels = texels.data();
            plan.uniforms[m].heights_bounded = 0;
            plan.uniforms[m].maxima = nullptr;
        }
}

bool has_vertex_rays(const Scene& scene) {
    return std::ranges::any_of(scene.objects, [&](const Object& object) {
        const Material& material = scene.materials[object.material];
        if (shell_kind(material) != ShellKind::none) return false;
        return std::ranges::any_of(material_stages(scene, material), [](const PlannedStage& stage) {
            return std::string_view(stage.info->text.room) == "trace" && stage.info->reads_vertices;
        });
    });
}

void move_eye(Geometry& geometry, const std::array<double, 3>& parts) {
    for (PrimitiveVertices& row : geometry.vertices) {
        double square = 0;
        for (int axis = 0; axis < 3; ++axis) {
            const double at = row.to_object[4 * axis + 3];
            square += at * at;
        }
        const double distance = std::sqrt(square);
        for (std::size_t axis = 0; axis < 3; ++axis) {
            float& at = row.to_object[4 * axis + 3];
            at = static_cast<float>(static_cast<double>(at) + parts[axis] * distance);
        }
    }
}

Film Reruns::reference(const std::vector<std::string>& channels) const {
    RenderOptions options;
    options.channels = channels;
    options.threads = threads_;
    return render(scene_, options);
}

RenderOptions Reruns::options(const std::vector<std::string>& channels,
                              const std::vector<std::string>& names, const Film& image) const {
    RenderOptions options;
    options.channels = channels;
    options.threads = threads_;
    options.window = image.window;
    if (!names.empty())
        options.injected = {{fmt::format("{}", fmt::join(names, ",")),
                             std::make_shared<const Film>(image), "the implementation's image"}};
    return options;
}

Film Reruns::made_of(const std::vector<std::string>& channels,
                     const std::vector<std::string>& names, const Film& image,
                     const std::vector<Window>& parts, const Moved& moved) const {
    const RenderOptions with_image = options(channels, names, image);
    PreparedRender prepared = prepare_render(scene_, with_image, select_kernels(with_image));
    std::optional<ScaledHeights> scaled;
    if (moved.heights != 1) scaled.emplace(prepared.plan, moved.heights);
    if (moved.eye != std::array<double, 3>{}) move_eye(prepared.geometry, moved.eye);
    for (MaterialTextures& of : prepared.plan.textures)
        of.sampled[static_cast<std::size_t>(TextureSlot::height)].sampler.lod_bias +=
            static_cast<float>(moved.levels);
    Film whole{image.frame, image.window, {}};
    for (const Window& window : parts) {
        prepared.window = window;
        const Film part = draw(prepared, with_image);
        for (const Plane& plane : part.planes) {
            Plane* const known = whole.find(plane.name);
            copy_rows(part, plane, window, whole,
                      known != nullptr ? *known : whole.add(plane.name, plane.type));
        }
    }
    return whole;
}

void Reruns::ranges(const std::vector<std::string>& channels, const std::vector<std::string>& names,
                    const Film& image, const std::string& limits,
                    const std::vector<Window>& windows,
                    const std::function<void(const Window&, const Film&)>& take) const {
    RenderOptions with_limits = options(channels, names, image);
    with_limits.limits = limits;
    // Planned once: most windows are single quads.
    PreparedRender prepared = prepare_render(scene_, with_limits, select_kernels(with_limits));
    for (const Window& window : windows) {
        prepared.window = window;
        take(window, draw(prepared, with_limits));
    }
}

Film part_of(const Film& film, const std::vector<std::string>& names, const Window& window) {
    Film part{film.frame, window, {}};
    std::vector<std::string> all = names;
    all.emplace_back("A");
    for (const std::string& name : all) {
        const Plane* const from = film.find(name);
        if (from == nullptr || part.find(name) != nullptr) continue;
        copy_rows(film, *from, window, part, part.add(name, from->type));
    }
    return part;
}

std::vector<Window> squares_around(const std::vector<std::size_t>& pixels, const Window& frame,
                                   const Window& window) {
    constexpr int side = 16;
    std::set<std::pair<int, int>> squares;
    for (const std::size_t i : pixels)
        squares.insert({static_cast<int>(i) / frame.width() / side,
                        static_cast<int>(i) % frame.width() / side});
    std::vector<Window> windows;
    for (const auto& [y, x] : squares)
        windows.push_back(
            intersection({side * x, side * y, side * x + side, side * y + side}, window));
    return windows;
}

Window window_around(const std::vector<std::size_t>& pixels, const Window& frame) {
    Window window{frame.x1, frame.y1, frame.x0, frame.y0};
    for (const std::size_t i : pixels) {
        const int x = static_cast<int>(i) % frame.width(), y = static_cast<int>(i) / frame.width();
        window = {std::min(window.x0, x), std::min(window.y0, y), std::max(window.x1, x + 1),
                  std::max(window.y1, y + 1)};
    }
    return intersection({window.x0 / 2 * 2 - 2, window.y0 / 2 * 2 - 2, window.x1 / 2 * 2 + 4,
                         window.y1 / 2 * 2 + 4},
                        frame);
}

}  // namespace quadrel::conformance

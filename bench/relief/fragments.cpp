#include "relief/fragments.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <sstream>

#include "io/document/stage_parameters.hpp"
#include "quadrel/error.hpp"

namespace quadrel::bench {

Row::Row(const std::string& row) : text(row) {
    std::istringstream words(row);
    words >> id;
    if (find_stage(id) == nullptr) throw UsageError("no search is named \"" + id + "\"");
    if (stage().reads_vertices)
        throw UsageError("\"" + id + "\" makes its ray of a mesh's vertices: here are none");
    if (std::ranges::count(stage().textures, TextureSlot::prewarp) != 0)
        throw UsageError("\"" + id + "\" reads a map that is made for a view: here is none");
    for (std::string word; words >> word;) {
        const std::size_t equals = word.find('=');
        if (equals == std::string::npos) throw UsageError("\"" + word + "\" is not name=value");
        const std::string name = word.substr(0, equals), value = word.substr(equals + 1);
        if (name.starts_with("bake.")) {
            baking[name.substr(5)] = std::stod(value);
            continue;
        }
        const ParameterText* parameter = find_parameter(id, name);
        if (!parameter) throw UsageError(id + " has no parameter \"" + name + "\"");
        const std::optional<double> named = number_of(*parameter, value);
        parameters[name] = named ? *named : std::stod(value);
    }
}

Fragments::Fragments(int count, double depth)
    : count_((count + 15) / 16 * 16),
      active_(static_cast<std::size_t>(count_), 1),
      reals_(slot_count, std::vector<double>(active_.size())),
      integers_(slot_count, std::vector<std::int32_t>(active_.size())) {
    material_.depth = static_cast<float>(depth);
    material_.seat = 1;
    frame_.derivatives = DerivativeMode::fine;
    const auto fill = [&](Value v, int component, double x) {
        reals_[slot(v, component)].assign(active_.size(), x);
    };
    fill(Value::relief_depth, 0, depth);
    fill(Value::J, 0, 1);
    fill(Value::J, 4, 1);
    fill(Value::T, 0, 1);
    fill(Value::B, 1, 1);
    fill(Value::frame_normal, 2, 1);
    integers_[slot(Value::frame_status)].assign(active_.size(), static_cast<int>(Status::hit));
}

void Fragments::set_ray(int lane, double u, double v, double Ku, double Kv, double cosine) {
    const auto i = static_cast<std::size_t>(lane);
    const double depth = reals_[slot(Value::relief_depth)][i];
    // The same numbers for every number type.
    const auto set = [&](Value value, int component, double x) {
        reals_[slot(value, component)][i] = static_cast<float>(x);
    };
    set(Value::uv, 0, u);
    set(Value::uv, 1, v);
    set(Value::K, 0, Ku);
    set(Value::K, 1, Kv);
    set(Value::uv_rate, 0, Ku / depth);
    set(Value::uv_rate, 1, Kv / depth);
    set(Value::r, 0, cosine);
    // A point from which the eye, at the origin, sees the plane along K.
    set(Value::P, 0, Ku / depth);
    set(Value::P, 1, Kv / depth);
    set(Value::P, 2, -1);
}

void Fragments::curve_base(double curvature) {
    constexpr double pixel = 0.01;  // tiles
    for (int lane = 0; lane < count_; ++lane) {
        const auto i = static_cast<std::size_t>(lane);
        reals_[slot(Value::dPdx, 0)][i] = reals_[slot(Value::dPdy, 1)][i] = pixel;
        reals_[slot(Value::dUVdx, 0)][i] = reals_[slot(Value::dUVdy, 1)][i] = pixel;
        reals_[slot(Value::frame_normal, 0)][i] = lane % 2 * pixel * curvature;
        reals_[slot(Value::frame_normal, 1)][i] = lane / 2 % 2 * pixel * curvature;
    }
}

void Fragments::bind(const Texture& height, const SamplerState& sampler) {
    height_ = &height;
    baked_ = {};
    textures_[static_cast<std::size_t>(TextureSlot::height)] = {height.view(), sampler};
}

void Fragments::bake_for(const Row& row) {
    const SamplerState sampler = textures_[static_cast<std::size_t>(TextureSlot::height)].sampler;
    BakedTextureOptions options;
    options.parameters = row.baking;
    options.seconds_limit = std::numeric_limits<double>::infinity();
    std::string key;
    for (const auto& [name, value] : row.baking) key += fmt::format(" {}={}", name, value);
    double floats = 0;
    for (const TextureSlot slot : row.stage().textures) {
        if (source_of(slot) != TextureSlot::height || slot < first_baked_slot) continue;
        auto& map = baked_[std::string(slot_name(slot)) + key];
        if (!map)
            map = baked_texture(*height_, bake_kind_from_name(slot_name(slot)), sampler, options);
        const TextureView& view = map->view();
        textures_[static_cast<std::size_t>(slot)] = {view, sampler};
        for (int level = 0; level < view.levels; ++level)
            floats += double(view.width[level]) * view.height[level] * view.channels * view.faces;
    }
    baked_mebibytes_ = floats * sizeof(float) / (1 << 20);
}

void Fragments::run(const Row& row) {
    const StageInfo& stage = row.stage();
    bake_for(row);
    std::vector<std::max_align_t> params(stage.params_size / sizeof(std::max_align_t) + 1);
    stage.set_defaults(params.data());
    for (const auto& [name, value] : row.parameters)
        find_parameter(row.id, name)->set(params.data(), value);
    std::array<void*, slot_count> arrays;
    for (int v = 0; v < static_cast<int>(Value::count); ++v) {
        const auto value = static_cast<Value>(v);
        for (int k = 0; k < arrays_of(value); ++k) {
            const std::size_t at = slot(value, k);
            arrays[at] = info(value).kind == ValueKind::real
                             ? static_cast<void*>(reals_[at].data())
                             : static_cast<void*>(integers_[at].data());
        }
    }
    StageCall call{};
    call.values = arrays.data();
    call.active = active_.data();
    call.lanes = count_;
    call.parameters = params.data();
    call.material = &material_;
    call.frame = &frame_;
    for (const TextureSlot slot : stage.textures) {
        const auto i = static_cast<std::size_t>(slot);
        call.textures[i] = &textures_[i];
    }
    find_kernel(scalar_double_kernels(), row.id)(&call);
}

}  // namespace quadrel::bench

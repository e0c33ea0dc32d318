#include "quadrel/probe.hpp"

#include <fmt/format.h>

#include <bit>

#include "kernels/table.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/channels.hpp"
#include "quadrel/raster/quad_points.hpp"
#include "quadrel/relief/registry.hpp"
#include "render/exact/exact_batch.hpp"
#include "render/exact/exact_plan.hpp"
#include "render/plan/names.hpp"
#include "render/plan/prepared.hpp"
#include "render/registry/added_stages.hpp"

namespace quadrel {
namespace {

constexpr int quad_lanes = 4;

template <class Packet, class Element>
void copy_lanes(const Packet& from, std::array<Element, 4>& to) {
    for (int lane = 0; lane < quad_lanes; ++lane) to[lane] = from.lane[lane];
}

/// Fills the stage that is running with what it reports.
class Collector : public StageLog {
  public:
    explicit Collector(const StageCall& call) : call_(call) {}

    void begin(ProbeStage& stage) { stage_ = &stage; }

    void fetch(const FetchEvent& event) override {
        ProbeFetch fetch;
        copy_lanes(event.active, fetch.active);
        // Padding quads report nothing of interest.
        if (event.active.lane[0] + event.active.lane[1] + event.active.lane[2] +
                event.active.lane[3] ==
            0)
            return;
        for (int slot = 0; slot < texture_slot_count; ++slot)
            if (call_.textures[slot] == event.texture)
                fetch.texture = slot_name(static_cast<TextureSlot>(slot));
        copy_lanes(event.uv.x, fetch.u);
        copy_lanes(event.uv.y, fetch.v);
        for (int lane = 0; lane < quad_lanes; ++lane) {
            for (int c = 0; c < 4; ++c) fetch.value[lane][c] = event.value[c].lane[lane];
            fetch.footprint[lane] = event.texture->view.faces == 1
                                        ? lane_footprint(*event.texture, event.uv, event.lod, lane)
                                        : LaneFootprint{detail::lane_lod(event.lod, lane), {}};
        }
        stage_->fetches.push_back(std::move(fetch));
    }

    void march_step(const MarchStep& step) override {
        ProbeStep out;
        copy_lanes(step.active, out.active);
        if (!any(step.active)) return;
        copy_lanes(step.s, out.s);
        copy_lanes(step.uv.x, out.u);
        copy_lanes(step.uv.y, out.v);
        copy_lanes(step.ray_height, out.ray_height);
        copy_lanes(step.map_height, out.map_height);
        out.fetches_end = stage_->fetches.size();
        stage_->steps.push_back(out);
    }

  private:
    const StageCall& call_;
    ProbeStage* stage_ = nullptr;
};

ProbeValue integer_value(const Batch& batch, std::string name, int slot) {
    ProbeValue value{std::move(name), true, {}, {}};
    for (int lane = 0; lane < quad_lanes; ++lane)
        value.whole[lane] = std::bit_cast<std::int32_t>(batch.integer(slot, lane));
    return value;
}

ProbeValue real_value(const Batch& batch, std::string name, int slot) {
    ProbeValue value{std::move(name), false, {}, {}};
    for (int lane = 0; lane < quad_lanes; ++lane) value.real[lane] = batch.real(slot, lane);
    return value;
}

/// The arrays of one value, with channel-like names.
void append_value(const Batch& batch, Value v, int light, std::vector<ProbeValue>& out) {
    for (int c = 0; c < info(v).components; ++c) {
        const int slot = slot_of(v) + std::max(light, 0) * info(v).components + c;
        if (!batch.has(slot)) continue;
        std::string name = component_name(v, c, std::max(light, 0));
        out.push_back(info(v).kind == ValueKind::integer
                          ? integer_value(batch, std::move(name), slot)
                          : real_value(batch, std::move(name), slot));
    }
}

/// Fine and coarse differences of one component, and its exact derivatives.
void append_derivatives(const Batch& batch, const ExactBatch& exact, Value v, int component,
                        std::vector<ProbeValue>& out) {
    Quad<float> q;
    for (int lane = 0; lane < quad_lanes; ++lane)
        q.lane[lane] = batch.real(slot_of(v) + component, lane);
    const std::string name = component_name(v, component);
    const auto add = [&](const char* text, Quad<float> d) {
        ProbeValue value{fmt::format(fmt::runtime(text), name), false, {}, {}};
        copy_lanes(d, value.real);
        out.push_back(std::move(value));
    };
    add("dFdx fine of {}", dFdx(q, DerivativeMode::fine));
    add("dFdx coarse of {}", dFdx(q, DerivativeMode::coarse));
    add("dFdy fine of {}", dFdy(q, DerivativeMode::fine));
    add("dFdy coarse of {}", dFdy(q, DerivativeMode::coarse));
    const auto derivatives = [&](int axis) {
        Quad<float> d;
        for (int lane = 0; lane < quad_lanes; ++lane)
            d.lane[lane] = static_cast<float>(exact.derivative(v, component, axis, lane));
        return d;
    };
    add("exact d/dx of {}", derivatives(0));
    add("exact d/dy of {}", derivatives(1));
}

/// Of P and uv, of a quad whose stages have run in `batch`.
void append_derivatives(const PreparedRender& prepared, const QuadCoverage& quad,
                        const Batch& batch, std::vector<ProbeValue>& out) {
    const Scene& scene = *prepared.scene;
    const std::uint32_t material = prepared.geometry.triangles[quad.triangle].material;
    const MaterialPlan plan =
        plan_on_duals(scene, scene.materials[material], {Value::P, Value::uv}, "probe");
    ExactBatch exact;
    exact.run(plan, stage_call(prepared.plan, material), &quad, 1, prepared.geometry, scene.samples,
              scene.centroid);
    for (int c = 0; c < 3; ++c) append_derivatives(batch, exact, Value::P, c, out);
    for (int c = 0; c < 2; ++c) append_derivatives(batch, exact, Value::uv, c, out);
}

std::vector<ProbeStage> run_stages(const PreparedRender& prepared, const MaterialPlan& plan,
                                   std::uint32_t material, Batch& batch) {
    StageCall call = stage_call(prepared.plan, material);
    Collector collector(call);
    if (prepared.plan.kernels == &scalar_float_kernels()) call.log = &collector;
    std::vector<ProbeStage> stages;
    for (const PlannedStage& planned : plan.stages) {
        MaterialPlan alone;
        alone.stages.push_back(planned);
        ProbeStage& stage = stages.emplace_back();
        stage.id = planned.info->text.id;
        stage.light = planned.light;
        collector.begin(stage);
        batch.run(alone, call, prepared.geometry);
        for (const Value v : planned.info->outputs)
            append_value(batch, v, planned.light, stage.outputs);
    }
    return stages;
}

ProbeFragment probe_fragment(const PreparedRender& prepared, const QuadCoverage& quad) {
    const Scene& scene = *prepared.scene;
    const DrawnTriangle& triangle = prepared.geometry.triangles[quad.triangle];
    ProbeFragment fragment;
    fragment.object = triangle.object;
    fragment.primitive = triangle.primitive;
    fragment.object_name = scene.objects[triangle.object].name;
    fragment.material = scene.materials[triangle.material].name;
    fragment.visible = quad.samples;
    const QuadPoints centres = quad_centres(quad.x, quad.y);
    const QuadPoints points =
        scene.centroid ? quad_centroids(triangle.screen, quad.x, quad.y, scene.samples) : centres;
    fragment.edges = edge_values(triangle.screen, points);
    for (int lane = 0; lane < quad_lanes; ++lane) {
        fragment.covered[lane] =
            coverage_mask(triangle.screen, lane_x(quad, lane), lane_y(quad, lane), scene.samples);
        fragment.depth[lane] = depth_at(triangle.screen, centres.x[lane], centres.y[lane]);
    }

    const MaterialPlan& plan = prepared.plan.materials[triangle.material];
    Batch batch(prepared.plan.scalar_bytes);
    batch.inject(prepared.plan.injected.get());
    batch.prepare(plan);
    batch.load(&quad, 1, prepared.geometry, scene.samples, scene.centroid);
    fragment.stages = run_stages(prepared, plan, triangle.material, batch);
    append_derivatives(prepared, quad, batch, fragment.derivatives);
    return fragment;
}

/// Every channel of a value that needs no light's number: between them they read every value.
std::vector<std::string> every_channel() {
    std::vector<std::string> names;
    for (const ChannelInfo& channel : channel_table())
        if (channel.name.find('<') == std::string::npos && !is_drawn_apart(channel.name))
            names.push_back(channel.name);
    return names;
}

}  // namespace

ProbeReport probe(const Scene& scene, int x, int y, const std::string& number,
                  const std::string& isa, const std::vector<Injection>& injected) {
    if (x < 0 || y < 0 || x >= scene.width || y >= scene.height)
        throw UsageError(fmt::format("pixel {},{} is outside of the {}x{} image", x, y, scene.width,
                                     scene.height));
    RenderOptions options;
    options.channels = every_channel();
    options.window = Window{x, y, x + 1, y + 1};
    options.number = number;
    options.isa = isa;
    options.injected = injected;
    const PreparedRender prepared = prepare_render(scene, options, select_kernels(options));

    const Viewport viewport{scene.width, scene.height, scene.conventions};
    ProbeReport report;
    report.image_x = x;
    report.image_y = y;
    report.window_x = x;
    report.window_y = flip_row(viewport, y);
    report.quad_x = report.window_x & ~1;
    report.quad_y = report.window_y & ~1;
    report.lane = (report.window_x & 1) + 2 * (report.window_y & 1);
    report.samples = scene.samples;
    report.conventions = name_of(scene.conventions);
    report.number = number;
    report.isa = prepared.plan.kernels->isa;
    for (const QuadCoverage& quad : visible_quads(prepared))
        report.fragments.push_back(probe_fragment(prepared, quad));
    return report;
}

}  // namespace quadrel

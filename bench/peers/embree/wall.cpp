#include <fmt/format.h>

#include <atomic>
#include <cmath>
#include <thread>

#include "embree/embree.hpp"
#include "embree/packets.hpp"
#include "scene_maps.hpp"

namespace quadrel::peers {
namespace {

class TracedWall : public EmbreeWall {
  public:
    TracedWall(const Scene& scene, int threads)
        : rays_(rays_of(scene)), depth_(scene.materials.at(0).depth), threads_(threads) {
        traced_.depth.resize(rays_.pixel.size());
        traced_.lit.resize(rays_.pixel.size());
        const auto heights = load_map(scene, scene.materials.at(0).textures.at("height"));
        const Part part = crossed(rays_, depth_);
        for (const GeometryKind kind : {GeometryKind::grid, GeometryKind::triangles})
            scenes_.push_back(std::make_unique<EmbreeScene>(*heights, part, depth_, kind, threads));
        for (std::size_t i = 0; i < scenes_.size(); ++i)
            for (const int packet : {8, 16})
                if (packet <= std::max(8, scenes_[i]->widest_packet())) add_way(i, packet);
    }

    const std::vector<EmbreeWay>& ways() const override { return ways_; }

    void trace(std::size_t way, bool shadows) override {
        std::atomic<std::size_t> next = 0;
        const auto work = [&] {
            for (std::size_t first; (first = next.fetch_add(chunk)) < rays_.pixel.size();)
                trace_packets(scenes_[chosen_[way].scene]->scene(), rays_, first,
                              std::min(first + chunk, rays_.pixel.size()), chosen_[way].packet,
                              depth_ * 1.001f, shadows, traced_);
        };
        std::vector<std::thread> others;
        for (int i = 1; i < threads_; ++i) others.emplace_back(work);
        work();
        for (std::thread& thread : others) thread.join();
    }

    std::vector<float> depths() const override {
        std::vector<float> all(rays_.pixel.size());
        for (std::size_t i = 0; i < all.size(); ++i)
            all[rays_.pixel[i]] = std::min(traced_.depth[i] / depth_, 1.0f);
        return all;
    }

    std::vector<float> lit() const override {
        std::vector<float> all(rays_.pixel.size());
        for (std::size_t i = 0; i < all.size(); ++i) all[rays_.pixel[i]] = traced_.lit[i];
        return all;
    }

    double missed() const override {
        const auto none = std::count_if(traced_.depth.begin(), traced_.depth.end(),
                                        [](float depth) { return std::isinf(depth); });
        return static_cast<double>(none) / static_cast<double>(traced_.depth.size());
    }

  private:
    struct Choice {
        std::size_t scene;
        int packet;
    };
    static constexpr std::size_t chunk = 4096;

    void add_way(std::size_t scene, int packet) {
        const char* const kind = scene == 0 ? "grid" : "triangles";
        chosen_.push_back({scene, packet});
        ways_.push_back({fmt::format("{}, packets of {}", kind, packet), scenes_[scene]->build(),
                         scenes_[scene]->memory_mib()});
    }

    Rays rays_;
    float depth_;
    int threads_;
    Traced traced_;
    std::vector<std::unique_ptr<EmbreeScene>> scenes_;
    std::vector<Choice> chosen_;
    std::vector<EmbreeWay> ways_;
};

}  // namespace

std::unique_ptr<EmbreeWall> build_embree_wall(const Scene& scene, int threads, std::string& why) {
    try {
        return std::make_unique<TracedWall>(scene, threads);
    } catch (const std::runtime_error& error) {
        why = error.what();
        return nullptr;
    }
}

}  // namespace quadrel::peers

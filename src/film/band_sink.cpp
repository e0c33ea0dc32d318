#include "film/band_sink.hpp"

#include <utility>

namespace quadrel {
namespace {

class JoinedSinks : public BandSink {
  public:
    explicit JoinedSinks(std::vector<std::unique_ptr<BandSink>> sinks) : sinks_(std::move(sinks)) {}

    BandStep take(std::shared_ptr<const Film> band) override {
        std::vector<BandStep> steps;
        for (const auto& sink : sinks_) steps.push_back(sink->take(band));
        const auto shared = std::make_shared<std::vector<BandStep>>(std::move(steps));
        return {[shared] {
                    for (const BandStep& step : *shared)
                        if (step.work) step.work();
                },
                [shared] {
                    for (const BandStep& step : *shared)
                        if (step.finish) step.finish();
                }};
    }

    void end() override {
        for (const auto& sink : sinks_) sink->end();
    }

  private:
    std::vector<std::unique_ptr<BandSink>> sinks_;
};

}  // namespace

std::unique_ptr<BandSink> join_sinks(std::vector<std::unique_ptr<BandSink>> sinks) {
    if (sinks.size() == 1) return std::move(sinks[0]);
    return std::make_unique<JoinedSinks>(std::move(sinks));
}

}  // namespace quadrel

#include "llvmpipe/llvmpipe.hpp"

#include <stdexcept>

#include "llvmpipe/frame.hpp"

namespace quadrel::peers {
namespace {

class MesaLlvmpipe : public Llvmpipe {
  public:
    explicit MesaLlvmpipe(int threads)
        : context_(gl::Context::llvmpipe(threads == 1 ? 0 : threads)) {}

    std::unique_ptr<ShadedFrame> frame(const Row& row, const Scene& scene,
                                       const std::vector<std::string>& defines) override {
        return std::make_unique<GlFrame>(row, scene, defines);
    }
    std::string description() const override { return context_.description(); }

  private:
    gl::Context context_;
};

}  // namespace

std::unique_ptr<Llvmpipe> open_llvmpipe(int threads, std::string& why) {
    try {
        return std::make_unique<MesaLlvmpipe>(threads);
    } catch (const std::runtime_error& error) {
        why = error.what();
        return nullptr;
    }
}

}  // namespace quadrel::peers

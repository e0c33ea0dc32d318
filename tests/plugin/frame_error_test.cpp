// The error of a frame of one's own: what err.frame.* say of one whose error is known.
#include <gtest/gtest.h>

#include "quadrel/errors.hpp"
#include "quadrel/relief/frame/face.hpp"
#include "quadrel/relief/registry.hpp"
#include "render/errors/judged_scenes.hpp"

namespace quadrel::plugin_tests {
namespace {

using namespace render_tests;

/// frame-face with a J that is too large by so many thousandths.
template <int thousandths>
struct EnlargedFrame : FrameFace {
    static constexpr StageText text{thousandths == 20 ? "frame-enlarged" : "frame-unchanged",
                                    "frame", "frame-face with an error", "-"};

    template <class Io>
    void operator()(Io& io, const Params& params) const {
        using F = typename Io::Number;
        const auto J = io.template load<Value::face_J>();
        const F scale(Scalar<F>(1000 + thousandths) / Scalar<F>(1000));
        const vec3<F> face_normal = io.template load<Value::Ng>();
        store_split_frame(
            io,
            SurfaceJacobian<F>{J[0] * scale, J[1] * scale, dot(face_normal, face_normal) > F(0),
                               gradients_degenerate(J[0], J[1])},
            params);
    }
};

Film film_with(const std::string& frame) {
    static const bool registered = [] {
        register_stages<EnlargedFrame<0>, EnlargedFrame<20>>();
        return true;
    }();
    EXPECT_TRUE(registered);
    RenderOptions options;
    options.isa = "scalar";
    return errors_of(render, judged_scene("max-mip", hills(), frame), options);
}

testing::AssertionResult frame_error_is(const Film& film, double expected) {
    return everywhere(film, covered(film), [&](int x, int y) {
        return differs("err.frame.K", value(film, "err.frame.K", x, y), expected,
                       expected * 1e-3 + 1e-6);
    });
}

TEST(FrameError, IsWhatWasPlanted) {
    EXPECT_TRUE(frame_error_is(film_with("frame-face"), 0));
    EXPECT_TRUE(frame_error_is(film_with("frame-unchanged"), 0));
    const Film enlarged = film_with("frame-enlarged");
    EXPECT_TRUE(frame_error_is(enlarged, 0.02));
    EXPECT_FALSE(frame_error_is(enlarged, 0.021));
    // It is the frame's alone: an exact search on the exact frame has none.
    EXPECT_TRUE(everywhere(enlarged, covered(enlarged), [&](int x, int y) -> std::string {
        if (kind_at(enlarged, x, y, "err.search.") != ErrorKind::same) return "of the search";
        return differs("uv", value(enlarged, "err.uv", x, y), value(enlarged, "err.frame.uv", x, y),
                       1e-3);
    }));
    ErrorOptions options;
    options.isa = "scalar";
    const ErrorSummary summary =
        measure_errors(judged_scene("max-mip", hills(), "frame-enlarged"), options);
    EXPECT_LT(summary.parts.at(2).share(ErrorKind::same), 0.5);
    EXPECT_EQ(summary.parts.at(1).share(ErrorKind::same), 1);
}

}  // namespace
}  // namespace quadrel::plugin_tests

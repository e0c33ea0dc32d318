// The limits that the specifications and the renderers' own sources state.
#include <gtest/gtest.h>

#include "quadrel/scene/settings.hpp"

namespace quadrel {
namespace {

/// At least what a specification demands of every implementation.
testing::AssertionResult at_least(const HardwareModel& model, int subpixel, int weight, int lod) {
    const bool enough = model.subpixel_bits >= subpixel &&
                        (model.weight_bits == 0 || model.weight_bits >= weight) &&
                        (model.lod_bits == 0 || model.lod_bits >= lod);
    return enough ? testing::AssertionSuccess() : testing::AssertionFailure() << "too coarse";
}

TEST(Hardware, MeetsTheRequiredLimits) {
    for (auto kind : {Hardware::exact, Hardware::d3d, Hardware::vulkan_min, Hardware::llvmpipe,
                      Hardware::swiftshader, Hardware::chromium})
        EXPECT_TRUE(at_least(hardware_model(kind), 4, 4, 4));  // Vulkan 1.0
    EXPECT_TRUE(at_least(hardware_model(Hardware::d3d), 8, 8, 8));
    EXPECT_FALSE(at_least(hardware_model(Hardware::vulkan_min), 8, 8, 8));
}

TEST(Hardware, VulkanMinimumIsTheMinimum) {
    const HardwareModel model = hardware_model(Hardware::vulkan_min);
    EXPECT_EQ(model.subpixel_bits, 4);
    EXPECT_EQ(model.weight_bits, 4);
    EXPECT_EQ(model.lod_bits, 4);
    EXPECT_TRUE(model.scale_first);
}

TEST(Hardware, RenderersDifferWhereTheirSourcesDo) {
    const HardwareModel llvmpipe = hardware_model(Hardware::llvmpipe);
    EXPECT_EQ(llvmpipe.interpolation, Interpolation::llvmpipe);
    EXPECT_EQ(llvmpipe.lod_form, LodForm::linear_log2);
    EXPECT_EQ(llvmpipe.derivatives, DerivativeMode::fine);
    EXPECT_TRUE(llvmpipe.quad_lod);
    EXPECT_EQ(llvmpipe.level_rounding, LevelRounding::even);
    const HardwareModel swiftshader = hardware_model(Hardware::swiftshader);
    EXPECT_EQ(swiftshader.interpolation, Interpolation::swiftshader);
    EXPECT_EQ(swiftshader.lod_form, LodForm::quartic_log2);
    EXPECT_EQ(swiftshader.derivatives, DerivativeMode::coarse);
    EXPECT_TRUE(swiftshader.quad_lod);
    EXPECT_EQ(swiftshader.level_rounding, LevelRounding::even);
    EXPECT_EQ(hardware_model(Hardware::chromium).subpixel_bits, 4);
    EXPECT_EQ(hardware_model(Hardware::d3d).lod_form, LodForm::ellipse);
}

TEST(Hardware, ExactIsExact) {
    const HardwareModel model = hardware_model(Hardware::exact);
    EXPECT_EQ(model.subpixel_bits, 8);
    EXPECT_EQ(model.interpolation, Interpolation::exact);
    EXPECT_EQ(model.weight_bits, 0);
    EXPECT_EQ(model.lod_bits, 0);
    EXPECT_EQ(model.lod_form, LodForm::sqrt_max);
    EXPECT_FALSE(model.scale_first);
    EXPECT_FALSE(model.quad_lod);
    EXPECT_EQ(model.level_rounding, LevelRounding::finer);
}

}  // namespace
}  // namespace quadrel

// cone-rabbid maps: the codes of the compute shader that they are named after.
#include "bake/cone_rabbid_listing.hpp"
#include "bake/files.hpp"
#include "bake/support.hpp"
#include "quadrel/bake/packed_map.hpp"
#include "quadrel/texture/image.hpp"

namespace quadrel::test {
namespace {

using listings::ConeMapImage;

/// The shader over a whole image. Its invocations only read red, which none of them changes.
ConeMapImage run_shader(const Texture& field) {
    const TextureView& view = field.view();
    ConeMapImage image{view.width[0], view.height[0], {}};
    image.texels.resize(std::size_t(image.width) * image.height);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) image.store(x, y, texel_of(field, 0, 0, x, y), 0);
    for (int y = 0; y < image.height; ++y)
        for (int x = 0; x < image.width; ++x) listings::rabbid_cone_map(image, x, y);
    return image;
}

/// Every value of the map is the shader's code over 255.
testing::AssertionResult is_the_shaders(const Baker& baked, const Texels& field,
                                        const ConeMapImage& image) {
    const Texels map = baked(*field, repeat());
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            for (int c = 0; c < 2; ++c) {
                const int code = image.texels[std::size_t(y) * image.width + x][c];
                const float value = texel_of(*map, 0, 0, x, y, c);
                if (value != static_cast<float>(code) / 255.0f)
                    return testing::AssertionFailure()
                           << "texel " << x << " " << y << ", channel " << c << ": " << value * 255
                           << ", code " << code << " of " << image.width << "x" << image.height;
            }
        }
    }
    return testing::AssertionSuccess();
}

/// Rows of bricks with sloping sides, 5 texels of mortar between.
double bricks(int i, int j) {
    const int x = (i + j / 16 % 2 * 16) % 32, y = j % 16;
    const int edge = std::min({x, 31 - x, y, 15 - y});
    return edge < 2   ? 0.1
           : edge < 5 ? 0.1 + 0.25 * (edge - 1)
                      : 0.875 + ((i * 7 + j * 13) % 16) / 128.0;
}
double spikes(int i, int j) { return (i * 5 + j * 3) % 17 == 0 ? 1.0 : ((i ^ j) % 8) / 32.0; }
double hills(int i, int j) {
    const auto hill = [](int k) { return 1 - std::abs(k % 32 - 16) / 16.0; };
    return hill(i) * hill(j) * 0.8 + hill(3 * i + j) * 0.2;
}
double walls(int i, int j) { return i % 21 == 3 || j % 27 == 9 ? 0.9 : 0.3 * (i + j) / 128; }

std::vector<Texels> fields_of_64() {
    return {make_field(64, 64, bricks), make_field(64, 64, spikes), make_field(64, 64, hills),
            make_field(64, 64, walls), random_field(64, 64, 41)};
}

TEST(ConeRabbid, Is64x64ForAllTheShadersCodes) {
    const auto fields = fields_of_64();
    std::vector<ConeMapImage> images;
    for (const Texels& field : fields) {
        images.push_back(run_shader(*field));
        EXPECT_TRUE(is_the_shaders(baker(BakeKind::cone_rabbid), field, images.back()));
    }
    const auto caught = [&](const Baker& flawed, std::size_t k, Planted planted) {
        EXPECT_FALSE(is_the_shaders(flawed, fields[k], images[k])) << static_cast<int>(planted);
    };
    const auto root_again = [](float v, int, int, int, int, int c) {
        return c == 0 ? v : std::nearbyint(v * v * 255) / 255;  // the ratio itself
    };
    caught(changed(baker(BakeKind::cone_rabbid), root_again), 0, Planted::ratio_not_root);
    const auto packed = [](float v, int, int, int, int, int c) {
        return std::nearbyint((c == 0 ? v : std::sqrt(v)) * 255) / 255;
    };
    for (std::size_t k = 0; k < fields.size(); ++k)
        caught(changed(baker(BakeKind::cone), packed), k, Planted::exact_distances);
    const auto next_code = [](float v, int, int, int i, int j, int c) {
        return i == 40 && j == 3 && c == 1 ? v + 1.0f / 255 : v;
    };
    caught(changed(baker(BakeKind::cone_rabbid), next_code), 2, Planted::code_rounded_up);
}

/// Small fields of all kinds: flat ones go through every ring, those that are not square have rings
/// of other shapes, those more than twice as wide as high reads outside of the image.
TEST(ConeRabbid, IsTheShadersOnAnyShape) {
    for (const auto& [width, height] :
         {std::pair(12, 12), std::pair(16, 9), std::pair(9, 16), std::pair(24, 5), std::pair(5, 24),
          std::pair(13, 1), std::pair(1, 7), std::pair(1, 1)}) {
        auto fields = stress_fields(width, height);
        fields.push_back(random_field(width, height, 42));
        fields.push_back(
            make_field(width, height, [](int i, int j) { return i * 0.5 - j * 0.25; }));
        for (const Texels& field : fields)
            EXPECT_TRUE(is_the_shaders(baker(BakeKind::cone_rabbid), field, run_shader(*field)));
    }
    const Texels field = random_field(24, 5, 42);
    const auto transposed = [](const Texture& of, const SamplerState& sampler) {
        const int width = of.view().width[0], height = of.view().height[0];
        const Texels map =
            bake(*make_field(height, width, [&](int i, int j) { return texel_of(of, 0, 0, j, i); }),
                 BakeKind::cone_rabbid, sampler);
        return with_values(
            *bake(of, BakeKind::cone_rabbid, sampler),
            [&](float, int, int, int i, int j, int c) { return texel_of(*map, 0, 0, j, i, c); });
    };
    EXPECT_FALSE(is_the_shaders(transposed, field, run_shader(*field)))
        << static_cast<int>(Planted::square_metric);
}

/// The shader's image repeats, whatever the sampler does.
TEST(ConeRabbid, RepeatsUnderEveryWrapMode) {
    const Texels field = random_field(9, 6, 43);
    const Texels map = bake(*field, BakeKind::cone_rabbid, repeat());
    for (const SamplerState& sampler : all_samplers())
        EXPECT_TRUE(same_texels(*bake(*field, BakeKind::cone_rabbid, sampler), *map));
}

testing::AssertionResult packs_the_codes(PackRounding rounding,
                                         const std::function<int(int code)>& written) {
    const TemporaryFolder folder;
    const Texels field = make_field(32, 32, spikes);
    const Texels map = bake(*field, BakeKind::cone_rabbid, repeat());
    write_packed(folder / "r.png", *map, *field, repeat(),
                 packing_from_name("dummer", BakeKind::cone_rabbid), rounding);
    const Image image = load_image(folder / "r.png");
    if (image.channels != 3) return testing::AssertionFailure() << image.channels << " channels";
    const ConeMapImage codes = run_shader(*field);
    for (std::size_t k = 0; k < codes.texels.size(); ++k) {
        for (std::size_t c = 0; c < 3; ++c) {
            const int code = c < 2 ? written(codes.texels[k][c]) : 0;
            if (std::nearbyint(image.values[3 * k + c] * 255) != static_cast<float>(code))
                return testing::AssertionFailure() << "texel " << k << " channel " << c;
        }
    }
    return testing::AssertionSuccess();
}

TEST(ConeRabbid, PacksTheShadersCodes) {
    const auto same = [](int code) { return code; };
    EXPECT_TRUE(packs_the_codes(PackRounding::nearest, same));
    EXPECT_TRUE(packs_the_codes(PackRounding::conservative, same));
    EXPECT_FALSE(packs_the_codes(PackRounding::nearest, [](int code) { return code / 2; }))
        << static_cast<int>(Planted::code_rounded_up);
    EXPECT_TRUE(is_packable(BakeKind::cone_rabbid, Packing::height_root));
    EXPECT_FALSE(is_packable(BakeKind::cone, Packing::height_root));
    EXPECT_FALSE(is_packable(BakeKind::cone_rabbid, Packing::height_sqrt_cone));
}

}  // namespace
}  // namespace quadrel::test

// Baked maps as files: what is written is what is read, and what does not belong is refused.
#include "quadrel/bake/baked_file.hpp"

#include "bake/files.hpp"
#include "quadrel/bake/packed_map.hpp"
#include "quadrel/error.hpp"
#include "quadrel/film/exr.hpp"

namespace quadrel::test {
namespace {

TEST(BakedFile, RoundTripsEveryKind) {
    const TemporaryFolder folder;
    const Texels field = random_field(9, 5, 81);
    const SamplerState sampler = sampler_with(Wrap::clamp_to_border, Wrap::mirrored_repeat, 0.3f);
    for (const BakeKindInfo& info : bake_kinds()) {
        const Texels map = bake(*field, info.kind, sampler);
        const auto file = folder / (std::string(info.name) + ".exr");
        write_baked(file, *map, *field, info.kind, sampler);
        const Texels read = load_baked(file, info.kind, sampler, *field);
        EXPECT_TRUE(same_texels(*map, *read)) << info.name;
        EXPECT_EQ(map->id(), read->id()) << info.name;
    }
}

TEST(BakedFile, SaysWhatItIs) {
    const TemporaryFolder folder;
    const Texels field = random_field(6, 4, 82);
    BakeOptions options;
    options.parameters["c_max"] = 0.5;
    const auto map = bake(*field, BakeKind::cone, repeat(), options);
    write_baked(folder / "map.exr", *map, *field, BakeKind::cone, repeat(), options);
    const Attributes found = read_exr(folder / "map.exr").attributes;
    const std::pair<const char*, const char*> expected[] = {
        {"kind", "cone"},      {"field", "texels"},        {"metric", "tile"},
        {"rounding", "down"},  {"wrapU", "repeat"},        {"wrapV", "repeat"},
        {"heightSize", "6x4"}, {"parameter.c_max", "0.5"}, {"version", "1"}};
    for (const auto& [name, value] : expected)
        EXPECT_EQ(found.at(std::string("quadrel:bake.") + name), value) << name;
    EXPECT_EQ(found.at("quadrel:bake.heightSha256"), height_id(*field));
    // What was read back is an image for every other program: R and G.
    EXPECT_EQ(load_image(folder / "map.exr").channels, 2);
}

using Load = std::function<Texels(const std::filesystem::path&, BakeKind, const SamplerState&,
                                  const Texture& height)>;

Texels load(const std::filesystem::path& file, BakeKind kind, const SamplerState& sampler,
            const Texture& height) {
    return load_baked(file, kind, sampler, height);
}

/// One line that names `word`, from an InputError.
testing::AssertionResult refuses(const Load& loader, const std::filesystem::path& file,
                                 BakeKind kind, const SamplerState& sampler, const Texture& height,
                                 const std::string& word) {
    try {
        loader(file, kind, sampler, height);
    } catch (const InputError& error) {
        const std::string what = error.what();
        if (what.find(word) != what.npos && what.find('\n') == what.npos)
            return testing::AssertionSuccess();
        return testing::AssertionFailure() << "says: " << what;
    }
    return testing::AssertionFailure() << "takes it";
}

testing::AssertionResult refuses_what_does_not_belong(const Load& loader) {
    const TemporaryFolder folder;
    const Texels field = random_field(5, 5, 83), other = random_field(5, 5, 84);
    const auto file = folder / "map.exr";
    const SamplerState border = sampler_with(Wrap::repeat, Wrap::clamp_to_border, 0.5f);
    write_baked(file, *bake(*field, BakeKind::max_mip, border), *field, BakeKind::max_mip, border);
    if (!loader(file, BakeKind::max_mip, border, *field)) return testing::AssertionFailure();
    const auto result = [&](BakeKind kind, const SamplerState& sampler, const Texture& height,
                            const char* word) {
        return refuses(loader, file, kind, sampler, height, word);
    };
    for (const auto& check :
         {result(BakeKind::min_max, border, *field, "kind max-mip"),
          result(BakeKind::max_mip, repeat(), *field, "wrapV clamp-to-border"),
          result(BakeKind::max_mip, sampler_with(Wrap::repeat, Wrap::clamp_to_border, 0.25f),
                 *field, "border 0.5"),
          result(BakeKind::max_mip, border, *other, "heightSha256")})
        if (!check) return check;
    return testing::AssertionSuccess();
}

TEST(BakedFile, RefusesMapsOfOtherFields) {
    EXPECT_TRUE(refuses_what_does_not_belong(load));
    // A loader that does not look at the wrap mode.
    EXPECT_FALSE(refuses_what_does_not_belong([](const std::filesystem::path& file, BakeKind kind,
                                                 const SamplerState&, const Texture& height) {
        return load_baked(file, kind, sampler_with(Wrap::repeat, Wrap::clamp_to_border, 0.5f),
                          height);
    })) << static_cast<int>(Planted::wrap_forgotten);
}

TEST(BakedFile, RefusesWhatIsNoBakedMap) {
    const TemporaryFolder folder;
    const Texels field = random_field(5, 5, 85);
    Film film;
    film.frame = film.window = {0, 0, 5, 5};
    film.add("Y", ChannelType::float32);
    write_exr(folder / "plain.exr", film, {});
    EXPECT_TRUE(
        refuses(load, folder / "plain.exr", BakeKind::max_mip, repeat(), *field, "no baked map"));
    EXPECT_TRUE(
        refuses(load, folder / "none.exr", BakeKind::max_mip, repeat(), *field, "none.exr"));
    // Attributes of a map, pixels of another shape.
    const auto map = bake(*field, BakeKind::cone, repeat());
    write_baked(folder / "map.exr", *map, *field, BakeKind::cone, repeat());
    write_exr(folder / "odd.exr", film, read_exr(folder / "map.exr").attributes);
    EXPECT_TRUE(refuses(load, folder / "odd.exr", BakeKind::cone, repeat(), *field, "1 channels"));
    // Attributes that are missing or make no sense.
    Film cones = read_exr(folder / "map.exr").film;
    for (const char* name : {"channels", "layers", "parameter.c_max", "kind", "version"}) {
        for (const char* value : {"", "-1", "nonsense", "99999999999"}) {
            Attributes attributes = read_exr(folder / "map.exr").attributes;
            attributes[std::string("quadrel:bake.") + name] = value;
            write_exr(folder / "odd.exr", cones, attributes);
            EXPECT_THROW(load(folder / "odd.exr", BakeKind::cone, repeat(), *field), InputError)
                << name << " " << value;
        }
    }
    // Cut at every length, it is refused or, if nothing needed is missing, whole.
    const std::string bytes = bytes_of(folder / "map.exr");
    for (std::size_t size = 0; size < bytes.size(); size += 7) {
        write_bytes(folder / "cut.exr", bytes.substr(0, size));
        EXPECT_THROW(load(folder / "cut.exr", BakeKind::cone, repeat(), *field), InputError)
            << size;
    }
}

// ---- Packings -----------------------------------------------------------------------------------

struct PackCase {
    const char* file;
    Packing packing;
    PackRounding rounding;
};

using Pack = std::function<void(const std::filesystem::path&, const Texture& map,
                                const Texture& height, const PackCase&)>;

void pack(const std::filesystem::path& file, const Texture& map, const Texture& height,
          const PackCase& how) {
    write_packed(file, map, height, repeat(), how.packing, how.rounding);
}

constexpr PackCase pack_cases[] = {
    {"d.png", Packing::height_sqrt_cone, PackRounding::conservative},
    {"d.exr", Packing::height_sqrt_cone, PackRounding::conservative},
    {"g.png", Packing::normal_cone_depth, PackRounding::conservative},
    {"g.exr", Packing::normal_cone_depth, PackRounding::conservative},
    {"dn.png", Packing::height_sqrt_cone, PackRounding::nearest},
    {"gn.png", Packing::normal_cone_depth, PackRounding::nearest}};

/// Read back, heights are not below, ratios not above, and neither is off by more than a code;
/// rounded to nearest, off by half a code.
testing::AssertionResult packs_safely(const Pack& packer) {
    const TemporaryFolder folder;
    const Texels field = random_field(16, 16, 86);
    const Texels map = bake(*field, BakeKind::cone, repeat());
    for (const PackCase& how : pack_cases) {
        packer(folder / how.file, *map, *field, how);
        const PackedMap read = load_packed(folder / how.file, how.packing);
        const bool codes = std::string(how.file).find(".png") != std::string::npos;
        const bool nearest = how.rounding == PackRounding::nearest;
        const double code = codes ? (nearest ? 0.501 : 1.001) / 255 : 1e-7;
        for (int k = 0; k < 256; ++k) {
            const double h = texel_of(*map, 0, 0, k % 16, k / 16, 0);
            const double c = texel_of(*map, 0, 0, k % 16, k / 16, 1);
            const double read_h = texel_of(*read.height, 0, 0, k % 16, k / 16);
            const double read_c = texel_of(*read.cones, 0, 0, k % 16, k / 16, 1);
            const bool square = how.packing == Packing::height_sqrt_cone;
            const double off = square ? std::sqrt(c) - std::sqrt(read_c) : c - read_c;
            const bool safe = nearest || (read_h >= h && read_c <= c);
            if (!safe || std::abs(read_h - h) > code || std::abs(off) > code)
                return testing::AssertionFailure() << how.file << " texel " << k << ": " << read_h
                                                   << " of " << h << ", " << read_c << " of " << c;
            if (texel_of(*read.cones, 0, 0, k % 16, k / 16, 0) != static_cast<float>(read_h))
                return testing::AssertionFailure() << how.file << " heights differ";
        }
    }
    return testing::AssertionSuccess();
}

TEST(PackedMap, RoundsSafelyOrToNearest) {
    EXPECT_TRUE(packs_safely(pack));
    EXPECT_FALSE(
        packs_safely([](const auto& file, const Texture& map, const Texture& height, PackCase how) {
            how.rounding = PackRounding::nearest;
            pack(file, map, height, how);
        }));
    EXPECT_FALSE(packs_safely([](const auto& file, const Texture& map, const Texture& height,
                                 PackCase how) {
        how.rounding = PackRounding::conservative;
        pack(file, map, height, how);
    })) << static_cast<int>(Planted::code_rounded_up);
}

/// The channels where the sources have them.
TEST(PackedMap, ChannelsAreTheSources) {
    const TemporaryFolder folder;
    const Texels field = make_field(8, 8, [](int i, int j) { return (i + 0.25 * j) / 10; });
    const Texels map = bake(*field, BakeKind::relaxed_cone, repeat());
    write_packed(folder / "d.exr", *map, *field, repeat(), Packing::height_sqrt_cone);
    write_packed(folder / "g.exr", *map, *field, repeat(), Packing::normal_cone_depth);
    const Image dummer = load_image(folder / "d.exr"), gg3 = load_image(folder / "g.exr");
    ASSERT_EQ(dummer.channels, 3);
    ASSERT_EQ(gg3.channels, 4);
    const float h = texel_of(*map, 0, 0, 3, 3, 0), c = texel_of(*map, 0, 0, 3, 3, 1);
    const std::size_t texel = 3 * 8 + 3;
    EXPECT_EQ(dummer.values[3 * texel], h);
    EXPECT_FLOAT_EQ(dummer.values[3 * texel + 1] * dummer.values[3 * texel + 1], c);
    EXPECT_LT(gg3.values[4 * texel], 0.5f);      // rises with u: leans towards -u
    EXPECT_GT(gg3.values[4 * texel + 1], 0.5f);  // and so does v, but green is negated when read
    EXPECT_EQ(gg3.values[4 * texel + 2], c);
    EXPECT_EQ(gg3.values[4 * texel + 3], 1 - h);  // black is the top
}

TEST(PackedMap, RefusesWhatItCannotHold) {
    const TemporaryFolder folder;
    const Texels field = random_field(4, 4, 87);
    const auto write = [&](BakeKind kind, const char* name) {
        write_packed(folder / name, *bake(*field, kind, repeat()), *field, repeat(),
                     Packing::height_sqrt_cone);
    };
    EXPECT_NO_THROW(write(BakeKind::cone, "a.png"));
    EXPECT_THROW(write(BakeKind::cone, "a.jpg"), UsageError);
    EXPECT_THROW(write(BakeKind::max_mip, "a.png"), UsageError);
    EXPECT_THROW(load_packed(folder / "a.png", Packing::normal_cone_depth), InputError);
    EXPECT_THROW(packing_from_name("gg4"), UsageError);
}

}  // namespace
}  // namespace quadrel::test

// Baked maps that no disk keeps.
#include <cstdlib>

#include "bake/files.hpp"
#include "quadrel/bake/baked_texture.hpp"

namespace quadrel::test {
namespace {

/// What is quicker made than read: no entry, and a name that takes no hash of the texels.
TEST(InMemory, MapsForThisProcessAloneAreOnNoDisk) {
    const TemporaryFolder folder;
    setenv("XDG_CACHE_HOME", folder.path().c_str(), 1);
    const auto place = folder / "quadrel/baked";
    const Texels field = random_field(6, 5, 98);
    BakedTextureOptions options;
    options.in_memory = true;
    const Texels map = baked_texture(*field, BakeKind::max_mip, repeat(), options);
    EXPECT_FALSE(std::filesystem::exists(place));
    EXPECT_TRUE(same_texels(*map, *bake(*field, BakeKind::max_mip, repeat())));
    EXPECT_EQ(map, baked_texture(*field, BakeKind::max_mip, repeat(), options));
    EXPECT_NE(map, baked_texture(*field, BakeKind::min_max, repeat(), options));
    EXPECT_NE(map, baked_texture(*field, BakeKind::max_mip, repeat()));
    EXPECT_FALSE(std::filesystem::is_empty(place));
    const Texels other = random_field(6, 5, 99);
    EXPECT_NE(map, baked_texture(*other, BakeKind::max_mip, repeat(), options));
    unsetenv("XDG_CACHE_HOME");
}

}  // namespace
}  // namespace quadrel::test

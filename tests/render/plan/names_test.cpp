// Names of the components of values, as probe prints them.
#include "render/plan/names.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <set>

namespace quadrel::render_tests {
namespace {

using Namer = std::function<std::string(Value, int component, int light)>;

/// Every component of every value has a name of its own, of printable characters.
testing::AssertionResult names_differ(const Namer& name_of) {
    std::set<std::string> names;
    for (int v = 0; v < static_cast<int>(Value::count); ++v) {
        const auto value = static_cast<Value>(v);
        for (int light = 0; light < (info(value).per_light ? max_lights : 1); ++light) {
            for (int c = 0; c < info(value).components; ++c) {
                const std::string name = name_of(value, c, light);
                for (const char letter : name)
                    if (letter <= ' ' || letter > '~')
                        return testing::AssertionFailure() << info(value).name << ", " << c;
                if (!names.insert(name).second) return testing::AssertionFailure() << name;
            }
        }
    }
    return testing::AssertionSuccess();
}

TEST(ComponentNames, AreUniqueAndPrintable) {
    EXPECT_TRUE(names_differ(component_name));
    EXPECT_FALSE(names_differ(
        [](Value v, int component, int light) { return component_name(v, component % 3, light); }));
}

}  // namespace
}  // namespace quadrel::render_tests

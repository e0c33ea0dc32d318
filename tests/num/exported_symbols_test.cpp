// Every instruction-set module exports exactly one symbol: a second one, an inline function say,
// would be merged by the loader with code compiled for another CPU.
#include <gtest/gtest.h>

#include <filesystem>
#include <sstream>

#include "num/command.hpp"
#include "num/module_loader.hpp"
#include "num/planted.hpp"

namespace quadrel::num_tests {
namespace {

/// Of nm's list, one symbol a line.
testing::AssertionResult is_one_symbol(const std::string& defined_symbols) {
    std::istringstream lines(defined_symbols);
    int count = 0;
    for (std::string line; std::getline(lines, line);) count += line.empty() ? 0 : 1;
    if (count == 1) return testing::AssertionSuccess();
    return testing::AssertionFailure() << count << " symbols:\n" << defined_symbols;
}

TEST(ExportedSymbols, AreOneAModule) {
    int modules = 0;
    for (const auto& entry : std::filesystem::directory_iterator(QUADREL_TEST_MODULE_DIR)) {
        if (entry.path().extension() != ".so") continue;
        ++modules;
        const std::string command = QUADREL_NM " -D --defined-only " + entry.path().string();
        EXPECT_TRUE(is_one_symbol(output_of(command))) << entry.path();
    }
    EXPECT_GE(modules, static_cast<int>(built_isas().size()));
}
TEST(ExportedSymbols, CatchPlantedErrors) {
    EXPECT_FALSE(is_one_symbol("00001180 T table\n00002000 W _ZN7quadrel3dotE\n"))
        << static_cast<int>(Planted::leaked_symbol);
    EXPECT_FALSE(is_one_symbol("")) << static_cast<int>(Planted::leaked_symbol);
}

}  // namespace
}  // namespace quadrel::num_tests

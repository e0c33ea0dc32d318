// Plugins that must be refused. PLANTED says why: of another version, or the id of another stage.
#include "quadrel/quad/plugin_table.hpp"

namespace {

using namespace quadrel;

constexpr Value outputs[] = {Value::N};
constexpr const char* id = PLANTED == 2 ? "linear" : "test-planted";
const StageRow row{{id, "surface", "stores nothing", "these tests"},
                   nullptr,
                   outputs,
                   nullptr,
                   nullptr,
                   0,
                   1,
                   0,
                   0,
                   0,
                   0,
                   0,
                   0,
                   0,
                   "",
                   nullptr,
                   [](void*) {},
                   [](const StageCall*) {},
                   [](const StageCall*) {},
                   nullptr};
const PluginRows rows{&row, 1, nullptr};
const PluginTable table{plugin_magic, stage_abi_version + (PLANTED == 1 ? 1u : 0u), "scalar", 4,
                        &rows};

}  // namespace

extern "C" __attribute__((visibility("default"))) const quadrel::PluginTable* quadrel_plugin() {
    return &table;
}

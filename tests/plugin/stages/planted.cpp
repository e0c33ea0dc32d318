// Plugins that must be refused. PLANTED says why: of another version, or the id of another stage.
#include "quadrel/quad/plugin_table.hpp"

namespace {

using namespace quadrel;

constexpr Value outputs[] = {Value::N};
constexpr const char* id = PLANTED == 2 ? "linear" : "test-planted";
const StageRow row{.text = {id, "surface", "stores nothing", "these tests"},
                   .inputs = nullptr,
                   .outputs = outputs,
                   .textures = nullptr,
                   .parameters = nullptr,
                   .input_count = 0,
                   .output_count = 1,
                   .texture_count = 0,
                   .parameter_count = 0,
                   .params_size = 0,
                   .uses_height_bounds = 0,
                   .needs_height_map = 0,
                   .may_miss = 0,
                   .reads_vertices = 0,
                   .runs_on_duals = 0,
                   .reads_finest_heights_only = 0,
                   .reads_first_gloss_only = 0,
                   .not_reproduced = "",
                   .lattice_steps = nullptr,
                   .set_defaults = [](void*) {},
                   .run = [](const StageCall*) {},
                   .run_double = [](const StageCall*) {},
                   .run_dual = nullptr};
const PluginRows rows{&row, 1, nullptr};
const PluginTable table{plugin_magic, stage_abi_version + (PLANTED == 1 ? 1u : 0u), "scalar", 4,
                        &rows};

}  // namespace

extern "C" __attribute__((visibility("default"))) const quadrel::PluginTable* quadrel_plugin() {
    return &table;
}

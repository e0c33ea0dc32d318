#include "cli/explain/environment.hpp"

namespace quadrel::cli {
namespace {

constexpr EnvironmentText variables[] = {
    {"QUADREL_DATA",
     "folder of `scenes`, `textures` and `meshes`, asked before `../share/quadrel` beside "
     "the program (of a Python module, `share/quadrel` in its folder and those above it) and "
     "the folder that it was built from"},
    {"QUADREL_MODULES",
     "folder of the kernels and of the reader of images other than EXR, asked before "
     "`modules` and `../lib/quadrel` beside the program (`lib/quadrel` likewise)"},
    {"QUADREL_CACHE_MIB",
     "size of the cache of baked maps, 0 switches it off; `XDG_CACHE_HOME` is where it "
     "lies"},
    {"NO_COLOR", "no colours on a terminal, as on a dumb one (`TERM=dumb`)"},
};

}  // namespace

std::span<const EnvironmentText> environment_variables() { return variables; }

}  // namespace quadrel::cli

// Everything that a source file with stages of one's own needs. Such files are built by CMake's
//
//     quadrel_add_stages(my-stages a.cpp b.cpp)
//
// once for plain floats and doubles and once for every instruction set, into a plugin that
// `quadrel --plugin my-stages.so` loads. A file holds stages (quad/stage.hpp; relief/shader.hpp for
// the shortest searches) and one line that names them: QUADREL_STAGES(MyStage, MyOtherStage);
// Included by a program of one's own the line does nothing: see register_stages in
// relief/registry.hpp.
#pragma once

#if defined(__FAST_MATH__)
#error "fast-math changes bits: build stages without it"
#endif

#include "quadrel/num/math.hpp"
#include "quadrel/num/quad.hpp"
#include "quadrel/quad/plugin_table.hpp"
#include "quadrel/relief/shader.hpp"
#include "quadrel/relief/trace/search/search.hpp"
#include "quadrel/shade/maps.hpp"

#if defined(QUADREL_PLUGIN)
#if defined(QUADREL_ISA)
#include "quadrel/num/lanes.hpp"
#define QUADREL_PLUGIN_TEXT(x) #x
#define QUADREL_PLUGIN_NAME(x) QUADREL_PLUGIN_TEXT(x)
#endif

namespace quadrel {

#if defined(QUADREL_ISA)
using PluginFloat = Lanes;
inline constexpr const char* plugin_isa = QUADREL_PLUGIN_NAME(QUADREL_ISA);
#else
using PluginFloat = Quad<float>;
inline constexpr const char* plugin_isa = "scalar";
#endif

/// Hidden: every shared object has its own, which its source files fill in as it is loaded.
inline PluginTable plugin_table{plugin_magic, stage_abi_version, plugin_isa, lanes_of<PluginFloat>,
                                nullptr};

/// Adds the stages of one source file at the end of the table.
template <class... Stages>
class PluginStages {
  public:
    PluginStages() : rows_{make_stage_row<Stages, PluginFloat>()...} {
        link_ = {rows_, sizeof...(Stages), nullptr};
        const PluginRows** end = &plugin_table.first;
        while (*end != nullptr) end = &const_cast<PluginRows*>(*end)->next;
        *end = &link_;
    }
    PluginStages(const PluginStages&) = delete;
    PluginStages& operator=(const PluginStages&) = delete;

  private:
    StageRow rows_[sizeof...(Stages)];
    PluginRows link_{};
};

}  // namespace quadrel

/// One definition for all source files of a plugin.
extern "C" inline __attribute__((used, visibility("default"))) const quadrel::PluginTable*
quadrel_plugin() {
    return &quadrel::plugin_table;
}

#define QUADREL_STAGES(...) \
    static const ::quadrel::PluginStages<__VA_ARGS__> quadrel_stages_of_this_file
#else
#define QUADREL_STAGES(...) static_assert(true)
#endif

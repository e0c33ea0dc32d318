# Instruction-set modules: the same sources compiled once per instruction set, each into a shared
# object of its own with hidden visibility. In one link the linker would keep a single copy of each
# inline function, whichever CPU it was compiled for; in a shared object nothing leaks.

set(QUADREL_MODULE_DIR ${PROJECT_BINARY_DIR}/modules)

if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(QUADREL_ISAS sse4 avx2 avx512)
  if(QUADREL_SANITIZE)
    set(QUADREL_ISAS sse4)
  endif()
elseif(CMAKE_SYSTEM_PROCESSOR MATCHES "aarch64|arm64")
  set(QUADREL_ISAS neon)
else()
  set(QUADREL_ISAS "")
endif()

# Fewer lane sets than the architecture has build faster: for development.
set(QUADREL_ONLY_ISAS "" CACHE STRING "Lane sets to build modules of; empty: all")
if(QUADREL_ONLY_ISAS)
  set(QUADREL_ISAS ${QUADREL_ONLY_ISAS})
endif()
foreach(isa IN LISTS QUADREL_ISAS)
  quadrel_isa_flags(quadrel_flags_${isa} ${isa})
endforeach()

# Groups of stages that are compiled together: name, header, list.
set(QUADREL_KERNEL_GROUPS
  "quad|quad/stages.hpp|QuadStages"
  "frame|relief/frame/stages.hpp|FrameStages"
  "offset|relief/trace/offset/stages.hpp|OffsetStages"
  "march|relief/trace/march/stages.hpp|MarchStages"
  "cone|relief/trace/cone/stages.hpp|ConeStages"
  "exact|relief/trace/exact/stages.hpp|ExactStages"
  "layer|relief/trace/layer/stages.hpp|LayerStages"
  "curved|relief/trace/curved/stages.hpp|CurvedStages"
  "tables|relief/trace/table/stages.hpp|TableStages"
  "engine|relief/trace/engine/stages.hpp|EngineStages"
  "shell|relief/shell/stages.hpp|ShellStages"
  "hit|relief/hit/stages.hpp|HitStages"
  "surface|relief/surface/stages.hpp|SurfaceStages"
  "shadow|relief/shadow/stages.hpp|ShadowStages"
  "occlusion|relief/occlusion/stages.hpp|OcclusionStages"
  "shade|shade/stages.hpp|ShadeStages")
# And those that run on plain numbers alone, whatever the lanes of a render.
set(QUADREL_PLAIN_KERNEL_GROUPS "oracle|relief/trace/oracle/stages.hpp|OracleKernels")

# Groups of chains (src/kernels/chain.hpp) that are compiled together: name of the header, list.
set(QUADREL_CHAIN_GROUPS
  "plain|PlainChains"
  "relief|ReliefChains")

# quadrel_kernel_sources(<variable> <number> <header> <function> [<group>...])
# Writes the sources of the stages on a number type: a file a group, so that they compile beside
# each other, and one with <function>(isa), which returns their table. Lists them in <variable>.
# All groups unless some are named; those for plain numbers alone if <number> is a Quad.
# Chains are for lanes: the truth runs stage by stage.
function(quadrel_kernel_sources variable number number_header function)
  set(templates ${PROJECT_SOURCE_DIR}/src/kernels)
  set(folder ${PROJECT_BINARY_DIR}/kernels/${function})
  set(declarations "")
  set(calls "")
  set(sources ${folder}/table.cpp)
  set(groups ${QUADREL_KERNEL_GROUPS})
  if(number MATCHES "^Quad<")
    list(APPEND groups ${QUADREL_PLAIN_KERNEL_GROUPS})
  endif()
  foreach(group IN LISTS groups)
    string(REPLACE "|" ";" group "${group}")
    list(GET group 0 name)
    list(GET group 1 stages_header)
    list(GET group 2 list)
    if(ARGN AND NOT name IN_LIST ARGN)
      continue()
    endif()
    string(APPEND declarations "KernelGroup ${name}_kernels(NumberTag<${number}>);\n")
    string(APPEND calls "${name}_kernels(NumberTag<${number}>()), ")
    configure_file(${templates}/group.cpp.in ${folder}/${name}.cpp @ONLY)
    list(APPEND sources ${folder}/${name}.cpp)
  endforeach()
  set(chain_calls "")
  if(number STREQUAL "Lanes")
    foreach(group IN LISTS QUADREL_CHAIN_GROUPS)
      string(REPLACE "|" ";" group "${group}")
      list(GET group 0 name)
      list(GET group 1 list)
      string(APPEND declarations "ChainGroup ${name}_chains(NumberTag<${number}>);\n")
      string(APPEND chain_calls "${name}_chains(NumberTag<${number}>()), ")
      configure_file(${templates}/chain.cpp.in ${folder}/chains_${name}.cpp @ONLY)
      list(APPEND sources ${folder}/chains_${name}.cpp)
    endforeach()
  endif()
  configure_file(${templates}/table.cpp.in ${folder}/table.cpp @ONLY)
  set(${variable} ${sources} PARENT_SCOPE)
endfunction()

# quadrel_export_only(<module> <symbol> <map>)
# Hidden visibility and the linker's version script <map>, which is written, keep all but <symbol> to
# the module; it lies where modules are looked for.
function(quadrel_export_only module symbol map)
  file(WRITE ${map} "{ global: ${symbol}; local: *; };\n")
  target_link_options(${module} PRIVATE -Wl,--version-script=${map})
  set_target_properties(${module} PROPERTIES
    PREFIX "" CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON
    LIBRARY_OUTPUT_DIRECTORY ${QUADREL_MODULE_DIR})
endfunction()

# quadrel_add_isa_modules(<prefix> EXPORTS <symbol> SOURCES <file>...)
# Builds <prefix>-<isa>.so for every instruction set of this machine's architecture. Each exports
# only <symbol>.
function(quadrel_add_isa_modules prefix)
  cmake_parse_arguments(ARG "" "EXPORTS" "SOURCES" ${ARGN})
  foreach(isa IN LISTS QUADREL_ISAS)
    string(TOUPPER ${isa} ISA)
    set(target ${prefix}-${isa})
    add_library(${target} MODULE ${ARG_SOURCES})
    target_link_libraries(${target} PRIVATE quadrel_headers quadrel_warnings)
    target_compile_options(${target} PRIVATE ${quadrel_flags_${isa}} -fno-gnu-unique)
    target_compile_definitions(${target} PRIVATE QUADREL_ISA=${isa} QUADREL_ISA_${ISA}=1
                                                 HWY_COMPILE_ONLY_STATIC)
    quadrel_export_only(${target} ${ARG_EXPORTS} ${CMAKE_CURRENT_BINARY_DIR}/${prefix}.map)
  endforeach()
endfunction()

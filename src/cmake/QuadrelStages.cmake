# Stages of one's own, built into a plugin. Included by Quadrel's build and by its installed package.

# quadrel_isa_flags(<variable> <isa>)
# What an instruction set's sources are compiled with. Highway gives 4-lane SSSE3 silently unless
# every flag of a target is present; lanes.hpp has a static_assert on the target that it got.
function(quadrel_isa_flags variable isa)
  set(sse4 -msse4.2 -maes -mpclmul)
  set(avx2 -mavx2 -mfma -mbmi -mbmi2 -mf16c -maes -mpclmul)
  set(avx512 ${avx2} -mavx512f -mavx512vl -mavx512dq -mavx512bw -mavx512cd)
  set(neon "")
  if(NOT DEFINED ${isa})
    message(FATAL_ERROR "unknown instruction set \"${isa}\": expected sse4, avx2, avx512 or neon")
  endif()
  set(${variable} ${${isa}} PARENT_SCOPE)
endfunction()

# One shared object of a plugin. Hidden visibility and the version script keep its inline functions,
# compiled for one instruction set, from other objects.
function(quadrel_add_plugin_part target map)
  add_library(${target} MODULE ${ARGN})
  target_link_libraries(${target} PRIVATE Quadrel::headers)
  target_compile_features(${target} PRIVATE cxx_std_20)
  target_compile_definitions(${target} PRIVATE QUADREL_PLUGIN HWY_COMPILE_ONLY_STATIC)
  target_compile_options(${target} PRIVATE
    $<$<CXX_COMPILER_ID:GNU>:-fno-gnu-unique> $<$<CXX_COMPILER_ID:GNU>:-Wno-psabi>)
  target_link_options(${target} PRIVATE -Wl,--version-script=${map})
  set_target_properties(${target} PROPERTIES
    PREFIX "" SUFFIX .so LINK_DEPENDS ${map}
    CXX_EXTENSIONS OFF CXX_VISIBILITY_PRESET hidden VISIBILITY_INLINES_HIDDEN ON)
endfunction()

# quadrel_add_stages(<target> <source>...)
# Builds the stages of the sources (quadrel/plugin.hpp) into a plugin: <target>.so, for plain floats
# and doubles, is what `quadrel render --plugin` is given; <target>-<isa>.so, one for every
# instruction set that Quadrel was built for, lie beside it. Building <target> builds them all.
# QUADREL_ONLY_ISAS restricts the sets.
function(quadrel_add_stages target)
  if(NOT ARGN)
    message(FATAL_ERROR "quadrel_add_stages(${target}): no sources")
  endif()
  set(map ${CMAKE_CURRENT_BINARY_DIR}/${target}.map)
  file(CONFIGURE OUTPUT ${map} CONTENT "{ global: quadrel_plugin; local: *; };\n")
  quadrel_add_plugin_part(${target} ${map} ${ARGN})
  get_target_property(isas Quadrel::headers QUADREL_ISAS)
  if(QUADREL_ONLY_ISAS)
    set(isas ${QUADREL_ONLY_ISAS})
  elseif(NOT isas)  # of an architecture without lane sets
    set(isas "")
  endif()
  foreach(isa IN LISTS isas)
    quadrel_isa_flags(flags ${isa})
    string(TOUPPER ${isa} ISA)
    quadrel_add_plugin_part(${target}-${isa} ${map} ${ARGN})
    target_compile_options(${target}-${isa} PRIVATE ${flags})
    target_compile_definitions(${target}-${isa} PRIVATE QUADREL_ISA=${isa} QUADREL_ISA_${ISA}=1)
    add_dependencies(${target} ${target}-${isa})
  endforeach()
endfunction()

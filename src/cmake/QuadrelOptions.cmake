# Compile options. `quadrel_values` carries those that protect values and is part of the public
# interface, because users instantiate the templates in their own files; `quadrel_warnings` is ours.

add_library(quadrel_values INTERFACE)
target_compile_features(quadrel_values INTERFACE cxx_std_20)
# A fused multiply-add rounds once where the text rounds twice: with contraction on, the same text
# gives other bits on machines with FMA than on those without.
target_compile_options(quadrel_values INTERFACE -ffp-contract=off)

add_library(quadrel_warnings INTERFACE)
target_compile_options(quadrel_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow
  # Within another project its compiler, which may be newer, must not stop that project's build.
  $<$<BOOL:${PROJECT_IS_TOP_LEVEL}>:-Werror>
  # GCC notes that the calling convention for wide vectors changed in 4.6; modules share no such
  # calls across instruction sets.
  -Wno-psabi
  # GCC 12 warns falsely about `"text" + std::string` (GCC bug 105329).
  -Wno-restrict)

# GCC would spend a twelfth of the build on collecting garbage that it has memory for.
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_compile_options("SHELL:--param ggc-min-expand=300" "SHELL:--param ggc-min-heapsize=524288")
endif()

if(QUADREL_SANITIZE)
  add_compile_options(-fsanitize=address,undefined,float-cast-overflow -fno-sanitize-recover=all
                      -fno-omit-frame-pointer
                      # GCC 12 warns falsely inside of std::regex under the sanitizers.
                      -Wno-maybe-uninitialized)
  add_link_options(-fsanitize=address,undefined,float-cast-overflow)
endif()

# quadrel_unity(<target>)
# Most of a file's time goes into parsing what it includes: a folder's sources are compiled as one.
# They are of one room and include the same things. Sources outside of the calling folder (generated
# kernels) stay alone.
function(quadrel_unity target)
  if(NOT QUADREL_UNITY)
    return()
  endif()
  get_target_property(sources ${target} SOURCES)
  foreach(source IN LISTS sources)
    cmake_path(IS_PREFIX CMAKE_CURRENT_SOURCE_DIR "${source}" is_ours)
    if(is_ours)
      cmake_path(RELATIVE_PATH source OUTPUT_VARIABLE group)
      cmake_path(GET group PARENT_PATH group)
      string(REPLACE "/" "_" group "${target}_${group}")
      set_source_files_properties("${source}" PROPERTIES UNITY_GROUP "${group}")
    endif()
  endforeach()
  set_target_properties(${target} PROPERTIES UNITY_BUILD ON UNITY_BUILD_MODE GROUP)
endfunction()

# Builds the consumer with Quadrel's sources in its build, runs it, and renders with its plugin.
#   cmake -D QUADREL=<checkout> -D PROGRAM=<quadrel> -D SOURCE=<this folder> -D WORK=<scratch>
#         -D ISA=<lane set> -D LIBRARY=ON|OFF -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../consumer/run_command.cmake)

find_program(CCACHE ccache)
if(CCACHE)
  set(launcher -D CMAKE_CXX_COMPILER_LAUNCHER=${CCACHE})
endif()
# Unoptimised: the bits are the same by promise, and it compiles in less time.
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK} -G Ninja -D FETCHCONTENT_SOURCE_DIR_QUADREL=${QUADREL}
    -D CMAKE_BUILD_TYPE=Debug -D QUADREL_ONLY_ISAS=${ISA} -D WITH_LIBRARY=${LIBRARY} ${launcher})
check_configuration("${output}")
run(${CMAKE_COMMAND} --build ${WORK})
run(${WORK}/consumer)
run(${PROGRAM} render thesis-quad --size 32x32 -o ${WORK}/quad.exr
    --plugin ${WORK}/consumer-stages.so -D material.shade=two-tones)
if(LIBRARY)
  run(${WORK}/library-consumer ${WORK}/consumer-stages.so)
  return()
endif()
file(GLOB_RECURSE built ${WORK}/_deps/*.o ${WORK}/_deps/*.a ${WORK}/_deps/*.so)
if(built)
  message(FATAL_ERROR "built what nothing needs: ${built}")
endif()

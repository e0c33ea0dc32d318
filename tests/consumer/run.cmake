# Installs the build into a folder of its own, builds the consumer against it, runs it.
#   cmake -D BUILD=<build> -D SOURCE=<this folder> -D WORK=<scratch> -P run.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output
                  ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "${ARGV}\nfailed with ${result}:\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -D CMAKE_PREFIX_PATH=${WORK}/prefix
    -D CMAKE_BUILD_TYPE=Debug)
run(${CMAKE_COMMAND} --build ${WORK}/build)
# Data and modules of the installation, not of the build.
run(${CMAKE_COMMAND} -E env QUADREL_DATA=${WORK}/prefix/share/quadrel
    QUADREL_MODULES=${WORK}/prefix/lib/quadrel ${WORK}/build/consumer)
run(${WORK}/prefix/bin/quadrel render thesis-quad --size 32x32 -o ${WORK}/quad.exr)

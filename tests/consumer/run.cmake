# Installs the build into a folder of its own, builds the consumer against it, runs it.
#   cmake -D BUILD=<build> -D SOURCE=<this folder> -D WORK=<scratch> -D ISA=<lane set>
#         -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/run_command.cmake)

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G Ninja -D CMAKE_PREFIX_PATH=${WORK}/prefix
    -D CMAKE_BUILD_TYPE=Debug -D QUADREL_ONLY_ISAS=${ISA})
check_configuration("${output}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
# Data and modules of the installation, not of the build.
run(${CMAKE_COMMAND} -E env QUADREL_DATA=${WORK}/prefix/share/quadrel
    QUADREL_MODULES=${WORK}/prefix/lib/quadrel
    ${WORK}/build/consumer ${WORK}/build/consumer-stages.so)
run(${WORK}/prefix/bin/quadrel render thesis-quad --size 32x32 -o ${WORK}/quad.exr
    --plugin ${WORK}/build/consumer-stages.so -D material.shade=two-tones)

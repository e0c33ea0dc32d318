# Makes the packages, installs them on a fresh minimal Debian 12, renders there at once by program and
# by Python, and removes them.
#   cmake -D BUILD=<build> -D CPACK=<cpack> -D WORK=<scratch> -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../consumer/run_command.cmake)

foreach(program IN ITEMS mmdebstrap dpkg-shlibdeps file)
  find_program(found_${program} ${program})
  if(NOT found_${program})
    message("skipped: ${program} is not installed")
    return()
  endif()
endforeach()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
# All that is installed has been built. What is packed for others takes longer to compress.
run(${CPACK} --config ${BUILD}/CPackConfig.cmake -G DEB -D CPACK_DEBIAN_COMPRESSION_TYPE=gzip
    -B ${WORK}/packages)

# expect_field(<package> <field> <regular expression>...)
function(expect_field package field)
  file(GLOB file ${WORK}/packages/${package}_*.deb)
  run(dpkg-deb --field ${file} ${field})
  foreach(wanted IN LISTS ARGN)
    if(NOT output MATCHES "${wanted}")
      message(FATAL_ERROR "${package}: ${field} is \"${output}\", and has no ${wanted}")
    endif()
  endforeach()
endfunction()
expect_field(quadrel Depends libopenexr libopenimageio libc6)
expect_field(quadrel Maintainer "^[^<>]+ <[^ @<>]+@[^ @<>]+>\n$")
expect_field(libquadrel-dev Depends "quadrel \\(= [0-9.]+\\)" libopenexr-dev)
file(COPY ${CMAKE_CURRENT_LIST_DIR}/try.sh DESTINATION ${WORK}/packages)
file(GLOB python ${WORK}/packages/python3-quadrel_*.deb)
if(python)
  expect_field(python3-quadrel Depends "quadrel \\(= [0-9.]+\\)" "python3 \\(>= 3\\.[0-9]+~\\)"
    "python3 \\(<< 3\\.[0-9]+~\\)" python3-numpy libopenexr)
endif()

# As root by mounts, else in a user's namespace. Nothing of it stays.
file(MAKE_DIRECTORY ${WORK}/root)
set(ENV{TMPDIR} ${WORK}/root)
execute_process(COMMAND mmdebstrap --quiet --variant=apt --format=null
    --dpkgopt=force-unsafe-io --aptopt=Acquire::Languages=none
    "--customize-hook=copy-in ${WORK}/packages /"
    "--customize-hook=chroot \"$1\" sh /packages/try.sh" bookworm /dev/null
  RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
if(output MATCHES "the packages are tried")
  if(failed OR NOT output MATCHES "the packages work")
    message(FATAL_ERROR "${output}")
  endif()
else()
  string(REGEX REPLACE "\n+$" "" reason "${output}")
  string(REGEX REPLACE "\n" " / " reason "${reason}")
  message("skipped: no Debian could be made here: ${reason}")
endif()
file(REMOVE_RECURSE ${WORK})

# Makes the package, installs it on a fresh minimal Debian 12, renders there at once, and removes it.
#   cmake -D BUILD=<build> -D CPACK=<cpack> -D WORK=<scratch> -P run.cmake
include(${CMAKE_CURRENT_LIST_DIR}/../consumer/run_command.cmake)

foreach(program IN ITEMS mmdebstrap dpkg-shlibdeps unshare)
  find_program(found_${program} ${program})
  if(NOT found_${program})
    message("skipped: ${program} is not installed")
    return()
  endif()
endforeach()
execute_process(COMMAND id -u OUTPUT_VARIABLE user OUTPUT_STRIP_TRAILING_WHITESPACE)
execute_process(COMMAND unshare --mount true RESULT_VARIABLE no_mounts ERROR_QUIET)
if(NOT user EQUAL 0 OR no_mounts)
  message("skipped: a root of its own for the package needs root's rights")
  return()
endif()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
# All that is installed has been built.
run(${CPACK} --config ${BUILD}/CPackConfig.cmake -G DEB -B ${WORK}/package)
file(GLOB package ${WORK}/package/quadrel_*.deb)
run(dpkg-deb --field ${package} Depends)
if(NOT output MATCHES "libopenexr" OR NOT output MATCHES "libc6")
  message(FATAL_ERROR "dependencies that are none: ${output}")
endif()

set(root ${WORK}/root)
execute_process(COMMAND mmdebstrap --quiet --variant=apt bookworm ${root}
  RESULT_VARIABLE failed ERROR_VARIABLE reason)
if(failed)
  message("skipped: no Debian could be fetched: ${reason}")
  return()
endif()
file(COPY ${package} DESTINATION ${root}/tmp)
get_filename_component(name ${package} NAME)
file(WRITE ${root}/tmp/try.sh "set -eu
export DEBIAN_FRONTEND=noninteractive
apt-get update -qq
apt-get install -qq -y --no-install-recommends /tmp/${name} >/tmp/install.log
cd /tmp
quadrel render thesis-teapot --size 64x64 --preview teapot.png
quadrel render bricks-png --size 16x16 -o png.exr
quadrel export --stage trace/linear | grep -q void
test -e /usr/share/man/man1/quadrel-render.1.gz -o -e /usr/share/man/man1/quadrel-render.1
test -e /usr/share/bash-completion/completions/quadrel
test -e /usr/share/fish/vendor_completions.d/quadrel.fish
quadrel completion words -- render thesis-tea | grep -q '^thesis-teapot'
apt-get purge -qq -y quadrel >/dev/null
! command -v quadrel
! find /etc /usr /opt /srv -name '*quadrel*' | grep .
echo 'the package works'
")
run(unshare --mount sh -c "mount --rbind /proc ${root}/proc && chroot ${root} sh /tmp/try.sh")
if(NOT output MATCHES "the package works")
  message(FATAL_ERROR "${output}")
endif()
file(REMOVE_RECURSE ${WORK})

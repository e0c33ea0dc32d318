# Debian's files for Imath, which OpenEXR needs, also name a Python library of another package, and
# tell in ten lines of its absence. Found quietly first, Imath is not looked for again.
function(quadrel_find_imath_quietly)
  set(CMAKE_MESSAGE_LOG_LEVEL NOTICE)
  find_package(Imath QUIET)
endfunction()
quadrel_find_imath_quietly()

# `cpack` in the build folder makes packages for Debian: quadrel (programs, modules, data, man pages,
# completion), libquadrel-dev (headers and the static library) and, where it is built,
# python3-quadrel. It needs dpkg-dev and file.
set(maintainer "Quadrel developers <quadrel@quadrel.invalid>")  # .invalid reaches nobody (RFC 2606)
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(QUADREL_MAINTAINER "${maintainer}" CACHE STRING
  "Who answers for the packages: name <address>; by default as DEBFULLNAME and DEBEMAIL say, if they do")
set(folder ${CMAKE_CURRENT_LIST_DIR}/debian)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME quadrel)
set(CPACK_PACKAGE_VENDOR Quadrel)
set(CPACK_PACKAGE_CONTACT "${QUADREL_MAINTAINER}")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
# What programs and modules are linked against, by dpkg-shlibdeps.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# What only Debian asks of a package's files.
set(CPACK_PRE_BUILD_SCRIPTS ${folder}/tidy.cmake)
set(CPACK_QUADREL_DEBIAN_FOLDER ${folder})

# A package a component of what is installed.
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_COMPONENTS_ALL program development)
set(what "Shades in 2x2 fragment quads, as a GPU does, and runs relief- and
parallax-mapping algorithms where each of their bits can be looked at. What it
writes, EXR images with every intermediate value as a channel, is the ground
truth that GPU ports are judged by.")
set(same_version "quadrel (= ${PROJECT_VERSION})")

set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME quadrel)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PROGRAM_DESCRIPTION "${PROJECT_DESCRIPTION}\n${what}")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libquadrel-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION "${PROJECT_DESCRIPTION} (headers and library)
${what}
.
This package has what programs are compiled with that render by themselves, or
bring algorithms of their own.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "${same_version}, libglm-dev, libhwy-dev, libopenexr-dev,\
 libtbb-dev, libfmt-dev, libssl-dev, libpng-dev, zlib1g-dev, libdeflate-dev, libgmp-dev")

get_property(minor GLOBAL PROPERTY QUADREL_PYTHON_MINOR)
if(minor)
  list(APPEND CPACK_COMPONENTS_ALL debian_python)
  math(EXPR next_minor "${minor} + 1")
  set(CPACK_DEBIAN_DEBIAN_PYTHON_PACKAGE_NAME python3-quadrel)
  set(CPACK_DEBIAN_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_DEBIAN_PYTHON_DESCRIPTION "${PROJECT_DESCRIPTION} (Python module)
${what}
.
This package has the module quadrel: renders, probes and comparisons as arrays
of numpy.")
  # Python names a module's file by its minor version.
  set(CPACK_DEBIAN_DEBIAN_PYTHON_PACKAGE_DEPENDS "${same_version},\
 python3 (>= 3.${minor}~), python3 (<< 3.${next_minor}~), python3-numpy")
  set(CPACK_DEBIAN_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${folder}/postinst ${folder}/prerm)
endif()
include(CPack)

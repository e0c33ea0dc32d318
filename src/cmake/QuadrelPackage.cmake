# `cpack` in the build folder makes a package for Debian of what is installed.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME quadrel)
set(CPACK_PACKAGE_VENDOR Quadrel)
set(CPACK_PACKAGE_CONTACT "Quadrel <quadrel@localhost>")  # a package has to name somebody
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_PACKAGE_DESCRIPTION "Shades in 2x2 fragment quads, as a GPU does, and runs relief- and
parallax-mapping algorithms where each of their bits can be looked at. What it writes, EXR images with
every intermediate value as a channel, is the ground truth that GPU ports are judged by.")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd)
# What programs and modules are linked against, by dpkg-shlibdeps.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# Headers and the static library are part of it; programs of one's own need these as well.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS
  "cmake, g++, libglm-dev, libhwy-dev, libopenexr-dev, libtbb-dev, libfmt-dev, libssl-dev, libpng-dev, zlib1g-dev, libdeflate-dev, libgmp-dev")
include(CPack)

# The installed package: library, headers, modules, the command line, and what find_package reads.
include(CMakePackageConfigHelpers)
set(config_dir ${CMAKE_INSTALL_LIBDIR}/cmake/Quadrel)
list(TRANSFORM QUADREL_ISAS PREPEND quadrel-kernels- OUTPUT_VARIABLE kernel_modules)
install(TARGETS ${kernel_modules} quadrel-oiio quadrel-ranges quadrel-shaders
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}/quadrel)
install(TARGETS quadrel quadrel_headers quadrel_values EXPORT QuadrelTargets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
install(EXPORT QuadrelTargets NAMESPACE Quadrel:: DESTINATION ${config_dir}
  COMPONENT development)
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/QuadrelConfig.cmake.in QuadrelConfig.cmake
  INSTALL_DESTINATION ${config_dir})
write_basic_package_version_file(QuadrelConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/QuadrelConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/QuadrelConfigVersion.cmake
  ${CMAKE_CURRENT_LIST_DIR}/QuadrelStages.cmake ${CMAKE_CURRENT_LIST_DIR}/QuadrelImath.cmake
  DESTINATION ${config_dir} COMPONENT development)

# What Debian's policy asks of the files of a package, in the folder of each before it is packed:
# compressed man pages, a changelog and a copyright file, zsh's completion in one place.
file(GLOB packages ${CPACK_TEMPORARY_DIRECTORY}/*)
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where that is set
foreach(root IN LISTS packages)
  if(NOT IS_DIRECTORY ${root}/usr)
    continue()
  endif()
  cmake_path(GET root FILENAME component)
  string(TOUPPER ${component} component)
  set(package ${CPACK_DEBIAN_${component}_PACKAGE_NAME})
  set(documents ${root}/usr/share/doc/${package})
  file(COPY ${CPACK_QUADREL_DEBIAN_FOLDER}/copyright DESTINATION ${documents}
    FILE_PERMISSIONS OWNER_READ OWNER_WRITE GROUP_READ WORLD_READ)
  file(WRITE ${documents}/changelog "quadrel (${CPACK_PACKAGE_VERSION}) bookworm; urgency=medium

  * Packed by cpack.

 -- ${CPACK_PACKAGE_CONTACT}  ${now}
")
  file(GLOB_RECURSE pages ${root}/usr/share/man/*)
  execute_process(COMMAND gzip -9nf ${documents}/changelog ${pages} COMMAND_ERROR_IS_FATAL ANY)
  file(REMOVE_RECURSE ${root}/usr/share/zsh/site-functions)
endforeach()

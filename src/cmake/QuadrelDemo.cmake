# The demonstration: the thesis' scenes as EXR ground truth, and one contact sheet.
set(demo_directory ${CMAKE_BINARY_DIR}/demo)
set(demo_scenes thesis-quad thesis-quad-published thesis-sphere thesis-torus thesis-teapot
    bricks-45 dunes-70 city-night)
set(demo_files "")
foreach(scene IN LISTS demo_scenes)
  list(APPEND demo_files ${scene}.exr)
endforeach()
add_custom_target(demo
  COMMAND ${CMAKE_COMMAND} -E make_directory ${demo_directory}
  COMMAND ${CMAKE_COMMAND} -E chdir ${demo_directory} ${CMAKE_COMMAND} -E echo
          "Rendering the demonstration to ${demo_directory}"
  VERBATIM)
foreach(scene IN LISTS demo_scenes)
  add_custom_command(TARGET demo POST_BUILD
    COMMAND $<TARGET_FILE:quadrel-cli> render ${scene} -o ${scene}.exr --preview ${scene}.png
    WORKING_DIRECTORY ${demo_directory} VERBATIM)
endforeach()
add_custom_command(TARGET demo POST_BUILD
  COMMAND $<TARGET_FILE:quadrel-cli> sheet ${demo_files} -o contact-sheet.png
  WORKING_DIRECTORY ${demo_directory} VERBATIM)
add_dependencies(demo quadrel-cli)

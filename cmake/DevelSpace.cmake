# After find_package(catkin): the devel space of a standalone build looks like an install space, with links to the
# source tree.
#
# Debian's rosrun leaves out whatever lies in PACKAGE_FOLDER/build, which is where a standalone build puts its programs
# when the package's folder is the source tree; and it finds those of other build folders there, sanitized ones included.
# With a package folder of its own, BUILD_DIR/devel/share/stereo_nav, only this build's programs are found. In a catkin
# workspace the build is elsewhere.
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR)
  set(package_folder ${CATKIN_DEVEL_PREFIX}/share/${PROJECT_NAME})
  file(MAKE_DIRECTORY ${package_folder})
  foreach(entry bags config launch msg nodelet_plugins.xml package.xml scripts srv test)
    if(EXISTS "${PROJECT_SOURCE_DIR}/${entry}")
      execute_process(COMMAND ${CMAKE_COMMAND} -E create_symlink ${PROJECT_SOURCE_DIR}/${entry} ${package_folder}/${entry})
    endif()
  endforeach()
  # An empty marker says that packages are in share/ rather than in a source space.
  file(WRITE ${CATKIN_DEVEL_PREFIX}/.catkin "")
endif()

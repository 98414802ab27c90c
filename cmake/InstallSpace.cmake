# Before find_package(catkin): the setup files of a standalone install.
#
# catkin installs them under the prefix of the configuration (/usr/local unless told), even where
# `cmake --install BUILD_DIR --prefix PREFIX` names another; these follow the prefix. In a catkin workspace the
# workspace provides them; a Debian package has none.
if(CMAKE_SOURCE_DIR STREQUAL PROJECT_SOURCE_DIR AND NOT CATKIN_BUILD_BINARY_PACKAGE
   AND NOT CMAKE_INSTALL_PREFIX STREQUAL "/usr")
  set(CATKIN_INSTALL_INTO_PREFIX_ROOT FALSE)
  if(NOT DEFINED CATKIN_DEVEL_PREFIX)
    set(CATKIN_DEVEL_PREFIX ${CMAKE_BINARY_DIR}/devel)  # catkin's own default, which it sets later
  endif()
  set(setup_files_dir ${CMAKE_BINARY_DIR}/catkin_generated/installspace)
  set(setup_files ${CATKIN_DEVEL_PREFIX}/_setup_util.py)  # the same in both spaces
  foreach(file .catkin env.sh setup.bash setup.sh setup.zsh local_setup.bash local_setup.sh local_setup.zsh)
    list(APPEND setup_files ${setup_files_dir}/${file})
  endforeach()
  file(WRITE ${setup_files_dir}/.catkin "")  # makes the prefix a catkin workspace
  foreach(file ${setup_files})
    install(CODE "file(INSTALL \"${file}\" DESTINATION \"\${CMAKE_INSTALL_PREFIX}\" USE_SOURCE_PERMISSIONS)")
  endforeach()
endif()

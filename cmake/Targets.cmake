# Which parts are built, and one way to declare a library, a program and a test.

option(STEREO_NAV_EXPERIMENTS "Build what only the experiments need: imu_drift, true_disparity, the workflow's tests" ON)
option(STEREO_NAV_NAVIGATION "Build path planning and what drives the robot" ON)
option(STEREO_NAV_MAPPING "Build what recognises places, makes maps and follows a single camera" ON)

# stereo_nav_private_headers(<name>): lets a target of this package include "ROOM/header.h" from src/. Only in quotes, so
# that <ros/...> stays ROS's own.
function(stereo_nav_private_headers name)
  target_compile_options(${name} PRIVATE "SHELL:-iquote ${PROJECT_SOURCE_DIR}/src")
endfunction()

# stereo_nav_library(<name> SOURCES ... LINK ...): shared library lib<name>.so. Public headers are in
# include/stereo_nav, all others beside their sources: "ROOM/header.h".
function(stereo_nav_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_library(${name} ${ARG_SOURCES})
  target_include_directories(${name} PUBLIC ${PROJECT_SOURCE_DIR}/include)
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${STEREO_NAV_UNITY})
  stereo_nav_private_headers(${name})
  # Third-party headers are not held to our warnings.
  target_include_directories(${name} SYSTEM PUBLIC ${catkin_INCLUDE_DIRS} ${OpenCV_INCLUDE_DIRS})
  target_link_libraries(${name} PUBLIC ${ARG_LINK})
  install(TARGETS ${name}
    ARCHIVE DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    LIBRARY DESTINATION ${CATKIN_PACKAGE_LIB_DESTINATION}
    RUNTIME DESTINATION ${CATKIN_GLOBAL_BIN_DESTINATION})
endfunction()

# stereo_nav_program(<name> SOURCES ... LINK ...): a program that rosrun finds.
function(stereo_nav_program name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LINK" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${STEREO_NAV_UNITY})
  stereo_nav_private_headers(${name})
  target_include_directories(${name} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS} ${OpenCV_INCLUDE_DIRS})
  target_link_libraries(${name} PRIVATE ${ARG_LINK})
  install(TARGETS ${name} RUNTIME DESTINATION ${CATKIN_PACKAGE_BIN_DESTINATION})
endfunction()

# stereo_nav_unit_test(<name> SOURCES ... LINK ... [TIMEOUT seconds] [LABELS ...] [PARTS <suite>...]): the GoogleTest
# program of a room's unit tests. ctest runs it as one test; each suite of PARTS, such as one that takes long, is a test
# <name>_<suite> beside it, with a result file of its own, so that several cores share the work of one program. The label
# "tsan" has scripts/test.sh --tsan run the program under ThreadSanitizer, too: where the room has threads. The targets
# stereo_nav_unit_tests and stereo_nav_tsan_tests build all programs and those with the label.
function(stereo_nav_unit_test name)
  if(NOT CATKIN_ENABLE_TESTING)
    return()
  endif()
  cmake_parse_arguments(ARG "" "TIMEOUT" "SOURCES;LINK;LABELS;PARTS" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT 120)
  endif()
  if(STEREO_NAV_SANITIZE)
    math(EXPR ARG_TIMEOUT "5 * ${ARG_TIMEOUT}")
  endif()
  catkin_add_executable_with_gtest(${name} ${ARG_SOURCES} EXCLUDE_FROM_ALL)
  add_dependencies(tests ${name})
  set_target_properties(${name} PROPERTIES UNITY_BUILD ${STEREO_NAV_UNITY})
  foreach(label unit ${ARG_LABELS})
    if(NOT TARGET stereo_nav_${label}_tests)
      add_custom_target(stereo_nav_${label}_tests)
    endif()
    add_dependencies(stereo_nav_${label}_tests ${name})
  endforeach()
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/test)
  target_include_directories(${name} SYSTEM PRIVATE ${catkin_INCLUDE_DIRS} ${OpenCV_INCLUDE_DIRS})
  target_link_libraries(${name} ${ARG_LINK} gtest_main Threads::Threads)
  target_compile_definitions(${name} PRIVATE STEREO_NAV_SOURCE_DIR="${PROJECT_SOURCE_DIR}")

  set(suites_of_parts "")
  foreach(suite IN LISTS ARG_PARTS)
    set(suites "${suite}.*:*/${suite}.*")  # with a prefix when it has parameters
    string(APPEND suites_of_parts ":${suites}")
    add_custom_target(${name}_${suite} DEPENDS ${name})  # builds the program, as the target of any other test does
    stereo_nav_add_unit_test(${name}_${suite} ${name} "${suites}")
  endforeach()
  if(ARG_PARTS)
    stereo_nav_add_unit_test(${name} ${name} "-${suites_of_parts}")
  else()
    stereo_nav_add_unit_test(${name} ${name} "*")
  endif()
endfunction()

# For stereo_nav_unit_test, with its arguments: the tests of the program that the filter of GoogleTest lets through.
function(stereo_nav_add_unit_test test program filter)
  set(results gtest-${test}.xml)
  catkin_run_tests_target("gtest" ${test} ${results} DEPENDENCIES ${program}
    COMMAND "$<TARGET_FILE:${program}> '--gtest_filter=${filter}' --gtest_output=xml:${CATKIN_TEST_RESULTS_DIR}/${PROJECT_NAME}/${results}")
  set_tests_properties(_ctest_${PROJECT_NAME}_gtest_${test} PROPERTIES TIMEOUT ${ARG_TIMEOUT} LABELS "unit;${ARG_LABELS}")
endfunction()

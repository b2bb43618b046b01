# SPDX-License-Identifier: BSD-3-Clause
# The program as its users call it, on short rendered sequences: cli_NAME.sh EDGEVO SCENES (see cli_common.sh). Tests that measure
# seconds run alone (RUN_SERIAL).
set(cli_scenes ${CMAKE_CURRENT_BINARY_DIR}/cli_scenes)

function(edgevo_add_cli_test name)
  add_test(NAME integration.cli_${name} COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli_${name}.sh $<TARGET_FILE:edgevo> ${cli_scenes})
  set_tests_properties(integration.cli_${name} PROPERTIES LABELS integration TIMEOUT 600 SKIP_RETURN_CODE 77 ${ARGN})
endfunction()

edgevo_add_cli_test(render FIXTURES_SETUP cli_scenes)
foreach(name IN ITEMS simulate relight overlay study run_eval reproducible blackout bad_arguments bad_input bad_files broken_source disk_full
    output_folder killed degenerate realtime calibrate bench workflow report compare servo edges eval_hints mount lenses forget trace corpus mcap kept_map join)
  edgevo_add_cli_test(${name} FIXTURES_REQUIRED cli_scenes)
endforeach()
if(TARGET edgevo_py AND NOT EDGEVO_SANITIZE)
  edgevo_add_cli_test(python FIXTURES_REQUIRED cli_scenes)
endif()
foreach(name IN ITEMS symphony table)
  edgevo_add_cli_test(${name} FIXTURES_REQUIRED cli_scenes)
endforeach()
# Windows, and the plug-in in other programs: GTK and Mesa leak, and those programs are built without sanitizers.
if(NOT EDGEVO_SANITIZE)
  foreach(name IN ITEMS view windows grabber)
    edgevo_add_cli_test(${name} FIXTURES_REQUIRED cli_scenes)
  endforeach()
endif()
edgevo_add_cli_test(help)
if(NOT BUILD_SHARED_LIBS AND NOT EDGEVO_SANITIZE)
  edgevo_add_cli_test(packages)
endif()
edgevo_add_cli_test(interrupt FIXTURES_REQUIRED cli_scenes RUN_SERIAL TRUE)

# Tests in C++ on the same sequences, one process each, since their test cases share the set-up.
function(edgevo_add_scene_test name)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  add_executable(test_${name} ${CMAKE_CURRENT_LIST_DIR}/${name}_test.cpp)
  target_link_libraries(test_${name} PRIVATE edgevo::datasets edgevo::mrpt_bridge ${ARG_LINKS} GTest::gmock GTest::gtest_main)
  target_include_directories(test_${name} PRIVATE ${PROJECT_SOURCE_DIR}/tests)
  target_compile_definitions(test_${name} PRIVATE EDGEVO_TEST_SCENES="${cli_scenes}")
  add_test(NAME integration.${name} COMMAND test_${name})
  set_tests_properties(integration.${name} PROPERTIES LABELS integration FIXTURES_REQUIRED cli_scenes)
endfunction()

# The mount of the camera, from the observation to the poses of the vehicle.
edgevo_add_scene_test(mount LINKS edgevo::results edgevo::evaluation)
# The plug-in for MRPT's programs, loaded as they load it.
find_package(MRPT REQUIRED COMPONENTS hwdrivers maps)
find_package(octomap REQUIRED)
edgevo_add_scene_test(plugin LINKS edgevo::edges edgevo::simulation mrpt::hwdrivers mrpt::maps octomap octomath opencv_imgcodecs opencv_videoio
  ${CMAKE_DL_LIBS})
target_compile_definitions(test_plugin PRIVATE EDGEVO_PLUGIN="$<TARGET_FILE:edgevo_plugin>")
add_dependencies(test_plugin edgevo_plugin)

# Times that go back, repeat or are missing. A clock that is set back under rawlog-grabber needs a program without sanitizers.
add_executable(damage_times ${CMAKE_CURRENT_LIST_DIR}/damage_times.cpp)
target_link_libraries(damage_times PRIVATE edgevo::mrpt_bridge)
add_library(set_back_clock MODULE ${CMAKE_CURRENT_LIST_DIR}/set_back_clock.cpp)
target_link_libraries(set_back_clock PRIVATE ${CMAKE_DL_LIBS})
set(clock_arguments)
if(NOT EDGEVO_SANITIZE)
  set(clock_arguments $<TARGET_FILE:set_back_clock>)
endif()
add_test(NAME integration.cli_times
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli_times.sh $<TARGET_FILE:edgevo> ${cli_scenes} $<TARGET_FILE:damage_times> ${clock_arguments})
set_tests_properties(integration.cli_times PROPERTIES LABELS integration TIMEOUT 600 FIXTURES_REQUIRED cli_scenes)

# Every source of scale: a test program adds the vehicle's sensors to the rawlog.
add_executable(add_vehicle_sensors ${CMAKE_CURRENT_LIST_DIR}/add_vehicle_sensors.cpp)
target_link_libraries(add_vehicle_sensors PRIVATE edgevo::mrpt_bridge edgevo::evaluation)
add_test(NAME integration.cli_scale
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli_scale.sh $<TARGET_FILE:edgevo> ${cli_scenes} $<TARGET_FILE:add_vehicle_sensors>)
set_tests_properties(integration.cli_scale PROPERTIES LABELS integration TIMEOUT 600 FIXTURES_REQUIRED cli_scenes)

# Recordings of ROS, written by a test program from a rendered sequence.
add_executable(write_recording ${CMAKE_CURRENT_LIST_DIR}/write_recording.cpp)
target_link_libraries(write_recording PRIVATE edgevo::datasets edgevo::mrpt_bridge edgevo::evaluation bz2 lz4 zstd sqlite3 z)
target_include_directories(write_recording PRIVATE ${PROJECT_SOURCE_DIR}/tests)
add_test(NAME integration.cli_recordings
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli_recordings.sh $<TARGET_FILE:edgevo> ${cli_scenes} $<TARGET_FILE:write_recording>)
set_tests_properties(integration.cli_recordings PROPERTIES LABELS integration TIMEOUT 600 FIXTURES_REQUIRED cli_scenes)
add_executable(list_messages ${CMAKE_CURRENT_LIST_DIR}/list_messages.cpp)
target_link_libraries(list_messages PRIVATE edgevo::recordings z)
add_executable(compare_frames ${CMAKE_CURRENT_LIST_DIR}/compare_frames.cpp)
target_link_libraries(compare_frames PRIVATE edgevo::datasets)
add_test(NAME integration.cli_recording_table
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli_recording_table.sh $<TARGET_FILE:edgevo> ${cli_scenes} $<TARGET_FILE:write_recording> $<TARGET_FILE:compare_frames>)
set_tests_properties(integration.cli_recording_table PROPERTIES LABELS integration TIMEOUT 600 FIXTURES_REQUIRED cli_scenes)

# The program as its users call it, on short rendered sequences: cli_NAME.sh EDGEVO SCENES (see cli_common.sh). They are not
# run at the same time as others where they measure seconds (RUN_SERIAL).
set(cli_scenes ${CMAKE_CURRENT_BINARY_DIR}/cli_scenes)

function(edgevo_add_cli_test name)
  add_test(NAME integration.cli_${name} COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli_${name}.sh $<TARGET_FILE:edgevo> ${cli_scenes})
  set_tests_properties(integration.cli_${name} PROPERTIES LABELS integration TIMEOUT 600 SKIP_RETURN_CODE 77 ${ARGN})
endfunction()

edgevo_add_cli_test(render FIXTURES_SETUP cli_scenes)
foreach(name IN ITEMS simulate relight study run_eval reproducible blackout bad_arguments broken_source disk_full degenerate realtime calibrate bench)
  edgevo_add_cli_test(${name} FIXTURES_REQUIRED cli_scenes)
endforeach()
edgevo_add_cli_test(interrupt FIXTURES_REQUIRED cli_scenes RUN_SERIAL TRUE)

# Every source of scale: the vehicle's sensors are put into the rawlog by a program of the tests.
add_executable(add_vehicle_sensors ${CMAKE_CURRENT_LIST_DIR}/add_vehicle_sensors.cpp)
target_link_libraries(add_vehicle_sensors PRIVATE edgevo::mrpt_bridge edgevo::evaluation)
add_test(NAME integration.cli_scale
  COMMAND ${CMAKE_CURRENT_LIST_DIR}/cli_scale.sh $<TARGET_FILE:edgevo> ${cli_scenes} $<TARGET_FILE:add_vehicle_sensors>)
set_tests_properties(integration.cli_scale PROPERTIES LABELS integration TIMEOUT 600 FIXTURES_REQUIRED cli_scenes)

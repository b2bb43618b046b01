# What a run writes is read again: by our tests, and by the stock tools of MRPT and OctoMap.
find_package(mrpt-containers REQUIRED)
add_executable(test_run_outputs ${CMAKE_CURRENT_LIST_DIR}/run_outputs_test.cpp)
target_link_libraries(test_run_outputs PRIVATE edgevo::results edgevo::drive mrpt::containers GTest::gmock GTest::gtest_main)
target_include_directories(test_run_outputs PRIVATE ${PROJECT_SOURCE_DIR}/tests)
gtest_discover_tests(test_run_outputs TEST_PREFIX integration. DISCOVERY_TIMEOUT 60 PROPERTIES LABELS integration)

add_executable(make_outputs ${CMAKE_CURRENT_LIST_DIR}/make_outputs.cpp)
target_link_libraries(make_outputs PRIVATE edgevo::results)
set(outputs_folder ${CMAKE_CURRENT_BINARY_DIR}/stock_tools_out)
add_test(NAME integration.make_outputs COMMAND make_outputs ${outputs_folder})
set_tests_properties(integration.make_outputs PROPERTIES LABELS integration FIXTURES_SETUP synthetic_outputs)
add_test(NAME integration.stock_tools COMMAND ${CMAKE_CURRENT_LIST_DIR}/stock_tools.sh ${outputs_folder})
set_tests_properties(integration.stock_tools PROPERTIES LABELS integration FIXTURES_REQUIRED synthetic_outputs)

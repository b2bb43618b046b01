# SPDX-License-Identifier: BSD-3-Clause
# The stock tools of MRPT and OctoMap read the outputs of a run (for our own readers see tests/unit/results).
add_executable(make_outputs ${CMAKE_CURRENT_LIST_DIR}/make_outputs.cpp)
target_link_libraries(make_outputs PRIVATE edgevo::results)
target_include_directories(make_outputs PRIVATE ${PROJECT_SOURCE_DIR}/tests)
set(outputs_folder ${CMAKE_CURRENT_BINARY_DIR}/stock_tools_out)
add_test(NAME integration.make_outputs COMMAND make_outputs ${outputs_folder})
set_tests_properties(integration.make_outputs PROPERTIES LABELS integration FIXTURES_SETUP synthetic_outputs)
add_test(NAME integration.stock_tools COMMAND ${CMAKE_CURRENT_LIST_DIR}/stock_tools.sh ${outputs_folder})
set_tests_properties(integration.stock_tools PROPERTIES LABELS integration FIXTURES_REQUIRED synthetic_outputs)

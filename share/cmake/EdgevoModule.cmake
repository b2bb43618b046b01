# SPDX-License-Identifier: BSD-3-Clause
# edgevo_add_module(NAME [GPL] [PUBLIC targets...] [PRIVATE targets...])
# Adds the library edgevo::NAME from modules/NAME/{include,src}, including subfolders of src; PUBLIC and PRIVATE list what it links.
# Installed, it is a component of find_package(edgevo) (EdgevoComponents.cmake).
# GPL: the module links ViSP and is packaged separately from those under the BSD licence.
function(edgevo_add_module name)
  cmake_parse_arguments(ARG "GPL" "" "PUBLIC;PRIVATE" ${ARGN})
  set(component devel)
  if(ARG_GPL)
    set(component visp_devel)
  endif()
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/src/*.cpp)
  if(NOT sources)
    return()
  endif()
  set(target edgevo_${name})
  add_library(${target} ${sources})
  add_library(edgevo::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} VERSION ${PROJECT_VERSION} SOVERSION 0)
  target_compile_features(${target} PUBLIC cxx_std_17)
  target_include_directories(${target}
    PUBLIC $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>
    PRIVATE ${CMAKE_CURRENT_SOURCE_DIR}/src)
  target_link_libraries(${target} PUBLIC ${ARG_PUBLIC} PRIVATE ${ARG_PRIVATE})
  edgevo_add_component(${name} ${component} ${ARG_PUBLIC} ${ARG_PRIVATE})
  install(TARGETS ${target} EXPORT edgevo_${name} COMPONENT ${component}
    ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR})
  install(DIRECTORY include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT ${component})
endfunction()

# edgevo_add_tests(MODULE [LINKS targets...])
# Adds the GoogleTest program test_MODULE from tests/unit/MODULE/*.cpp.
function(edgevo_add_tests module)
  cmake_parse_arguments(ARG "" "" "LINKS" ${ARGN})
  file(GLOB sources CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/unit/${module}/*.cpp)
  if(NOT sources)
    return()
  endif()
  add_executable(test_${module} ${sources})
  target_link_libraries(test_${module} PRIVATE edgevo::${module} ${ARG_LINKS} GTest::gmock GTest::gtest_main)
  # Tests of a module may include its private headers, to test internals directly.
  target_include_directories(test_${module} PRIVATE ${CMAKE_CURRENT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/modules/${module}/src)
  target_compile_definitions(test_${module} PRIVATE EDGEVO_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # The tested code is fully optimised; the tests themselves compile a third faster with -O1.
  target_compile_options(test_${module} PRIVATE $<$<CONFIG:Release>:-O1>)
  # Saves a third of the compile time of the tests. Modules are compiled without: their headers must be self-contained.
  target_precompile_headers(test_${module} PRIVATE <gtest/gtest.h> <Eigen/Dense>)
  # One process per module: its tests share what they render, and starting a program (hundreds of shared libraries) takes longer than
  # most tests. test_MODULE --gtest_filter=SUITE.* runs a part of them.
  if(EDGEVO_TESTS_ONE_BY_ONE)
    gtest_discover_tests(test_${module} TEST_PREFIX ${module}. DISCOVERY_TIMEOUT 60 PROPERTIES LABELS unit)
  else()
    add_test(NAME unit.${module} COMMAND test_${module})
    set_tests_properties(unit.${module} PROPERTIES LABELS unit TIMEOUT ${long_test_s})
  endif()
endfunction()

# SPDX-License-Identifier: BSD-3-Clause
# Build-wide settings: one place for the language level, warnings, sanitizers and the default build type.
option(EDGEVO_BUILD_TESTS "Build the unit and integration tests" ON)
option(EDGEVO_BUILD_BENCHMARKS "Build the Google Benchmark programs" ON)
option(EDGEVO_WARNINGS_AS_ERRORS "Warnings are errors (our own CI)" OFF)
option(EDGEVO_WITH_VISP "Build visp_bridge; programs that link ViSP are distributed under the GPL" ON)
option(EDGEVO_COVERAGE "Measure test coverage (gcov; tests/coverage.sh)" OFF)
set(EDGEVO_SANITIZE "" CACHE STRING "Sanitizers, comma separated: address,undefined or thread")

if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()
message(STATUS "edgevo ${PROJECT_VERSION}: build type ${CMAKE_BUILD_TYPE}")

set(CMAKE_CXX_STANDARD 17)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
include(GNUInstallDirs)

add_compile_options(-Wall -Wextra)
# With contraction to fused multiply-add, results would depend on the target chosen by the compiler.
add_compile_options(-ffp-contract=off)
if(EDGEVO_WARNINGS_AS_ERRORS)
  add_compile_options(-Werror)
endif()
if(EDGEVO_SANITIZE)
  add_compile_options(-fsanitize=${EDGEVO_SANITIZE} -fno-omit-frame-pointer)
  # With its checks in between, GCC 12 takes members of std::regex for uninitialised.
  add_compile_options(-Wno-maybe-uninitialized)
  if(EDGEVO_SANITIZE MATCHES undefined)
    # A check at every pointer makes Eigen's templates five times slower to compile; AddressSanitizer catches invalid pointers on access.
    add_compile_options(-fno-sanitize=null,alignment,object-size,pointer-overflow,vptr)
  endif()
  add_link_options(-fsanitize=${EDGEVO_SANITIZE})
endif()
if(EDGEVO_COVERAGE)
  # Counters must be correct with threads.
  add_compile_options(--coverage -fprofile-update=atomic)
  add_link_options(--coverage)
endif()

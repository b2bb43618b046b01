# SPDX-License-Identifier: BSD-3-Clause
# Writes edgevo_build_info.h (versions for summary.yaml) and gives it to targets: edgevo_use_build_info(TARGET).
# The git hash is that at configure time, or "unknown" for sources without their own git history (a tarball).
set(EDGEVO_GIT_HASH unknown)
find_package(Git QUIET)
if(GIT_FOUND)
  execute_process(COMMAND ${GIT_EXECUTABLE} rev-parse --show-toplevel WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
    OUTPUT_VARIABLE git_toplevel OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  # A tarball unpacked inside another repository must not show the hash of that repository.
  if(git_toplevel AND git_toplevel STREQUAL PROJECT_SOURCE_DIR)
    execute_process(COMMAND ${GIT_EXECUTABLE} describe --always --dirty --abbrev=12 --exclude=* WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
      OUTPUT_VARIABLE EDGEVO_GIT_HASH OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  endif()
endif()

# Sets EDGEVO_VERSION_<PACKAGE>; "none" if the package is not installed.
function(edgevo_package_version package)
  find_package(${package} QUIET ${ARGN})
  set(version none)
  foreach(name IN ITEMS ${package}_VERSION ${package}_VERSION_STRING)
    if(${name})
      set(version ${${name}})
      break()
    endif()
  endforeach()
  string(TOUPPER ${package} upper)
  set(EDGEVO_VERSION_${upper} ${version} PARENT_SCOPE)
endfunction()
edgevo_package_version(mrpt-core)
set(EDGEVO_VERSION_MRPT ${EDGEVO_VERSION_MRPT-CORE})
edgevo_package_version(OpenCV COMPONENTS core)
edgevo_package_version(Ceres)
edgevo_package_version(octomap)
edgevo_package_version(Eigen3 NO_MODULE)

configure_file(${CMAKE_CURRENT_LIST_DIR}/edgevo_build_info.h.in ${PROJECT_BINARY_DIR}/build_info/edgevo_build_info.h @ONLY)

function(edgevo_use_build_info target)
  target_include_directories(${target} PRIVATE ${PROJECT_BINARY_DIR}/build_info)
endfunction()

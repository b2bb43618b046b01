# SPDX-License-Identifier: BSD-3-Clause
# -DEDGEVO_BUILD_MODULES="odometry;scale" builds these modules and their dependencies as libraries, without programs and tests. This
# allows building the core without MRPT, OctoMap, ViSP or X11.
set(EDGEVO_BUILD_MODULES "" CACHE STRING "Modules to build, with their dependencies; empty: everything, with programs and tests")

# Sets RESULT to the modules named in the CMakeLists.txt of a module.
function(edgevo_needs_of module result)
  file(READ ${PROJECT_SOURCE_DIR}/modules/${module}/CMakeLists.txt text)
  string(REGEX MATCHALL "edgevo::[a-z_]+" needs "${text}")
  list(TRANSFORM needs REPLACE "edgevo::" "")
  set(${result} ${needs} PARENT_SCOPE)
endfunction()

# edgevo_chosen(RESULT MODULE...): selects the modules to build from MODULE..., which are listed bottom to top, in the same order.
function(edgevo_chosen result)
  foreach(module IN LISTS EDGEVO_BUILD_MODULES)
    if(NOT module IN_LIST ARGN)
      list(JOIN ARGN " " known)
      message(FATAL_ERROR "EDGEVO_BUILD_MODULES: there is no module '${module}'; give some of: ${known}")
    endif()
  endforeach()
  set(wanted ${EDGEVO_BUILD_MODULES})
  set(chosen)
  list(REVERSE ARGN)
  foreach(module IN LISTS ARGN)
    if(module IN_LIST wanted)
      edgevo_needs_of(${module} needs)
      list(APPEND wanted ${needs})
      list(PREPEND chosen ${module})
    endif()
  endforeach()
  set(${result} ${chosen} PARENT_SCOPE)
endfunction()

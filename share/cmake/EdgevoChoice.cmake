# -DEDGEVO_BUILD_MODULES="odometry;scale": these modules and those that they need, as libraries, and nothing else: no programs, no tests.
# So the core is built where neither MRPT nor OctoMap, ViSP or X11 is installed.
set(EDGEVO_BUILD_MODULES "" CACHE STRING "Modules to build, those that they need come along; empty: all, programs and tests")

# The other modules that a module's CMakeLists.txt names.
function(edgevo_needs_of module result)
  file(READ ${PROJECT_SOURCE_DIR}/modules/${module}/CMakeLists.txt text)
  string(REGEX MATCHALL "edgevo::[a-z_]+" needs "${text}")
  list(TRANSFORM needs REPLACE "edgevo::" "")
  set(${result} ${needs} PARENT_SCOPE)
endfunction()

# edgevo_chosen(RESULT MODULE...): of these, bottom to top, those that are to be built, in the same order.
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

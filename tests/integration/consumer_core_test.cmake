# SPDX-License-Identifier: BSD-3-Clause
# The core without MRPT, ViSP, OctoMap and X11: it configures where they are not installed, and an external program that links
# edgevo::facade only builds, loads none of them, links no reader of data sets and tracks a rendered sequence.
# cmake -DROOT=SOURCES -DPREFIX=INSTALLATION -DWORK=... -DSOURCE=... -DSEQUENCE=... -DGENERATOR=... [-DFLAGS=...] -P consumer_core_test.cmake
set(hidden)
foreach(package IN ITEMS MRPT mrpt-core mrpt-obs VISP octomap X11)
  list(APPEND hidden -DCMAKE_DISABLE_FIND_PACKAGE_${package}=ON)
endforeach()
set(configure_consumer ${CMAKE_COMMAND} -S ${SOURCE} -G ${GENERATOR} -DCMAKE_PREFIX_PATH=${PREFIX} "-DCMAKE_CXX_FLAGS=${FLAGS}" ${hidden})

# run(OUTPUT COMMAND...)
function(run result)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT code EQUAL 0)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "failed (${code}): ${command}\n${output}")
  endif()
  set(${result} "${output}" PARENT_SCOPE)
endfunction()

# refused(COMPONENT PATTERN): find_package(edgevo) fails with that message.
function(refused component pattern)
  execute_process(COMMAND ${configure_consumer} -B ${WORK}/refused -DEDGEVO_CONSUMER_COMPONENTS=${component} RESULT_VARIABLE code
    OUTPUT_VARIABLE output ERROR_VARIABLE output)
  string(REGEX REPLACE "[ \n]+" " " output "${output}")
  if(code EQUAL 0 OR NOT output MATCHES "${pattern}")
    message(FATAL_ERROR "component ${component}: code ${code}, no '${pattern}' in:\n${output}")
  endif()
  message(STATUS "component ${component}: ${CMAKE_MATCH_0}")
endfunction()

file(REMOVE_RECURSE ${WORK})
run(ignored ${CMAKE_COMMAND} -S ${ROOT} -B ${WORK}/core -G ${GENERATOR} "-DEDGEVO_BUILD_MODULES=facade\;scale" ${hidden})
# The small build has the facade, and no module that reads data sets (MRPT, FFmpeg, SQLite, libexif).
file(STRINGS ${WORK}/core/edgevoConfig.cmake modules REGEX "^set._edgevo_modules ")
if(NOT modules MATCHES " facade" OR modules MATCHES " (datasets|mrpt_bridge|visp_bridge|occupancy)")
  message(FATAL_ERROR "the small build has other modules than it should: ${modules}")
endif()
refused(viewer "edgevo::[a-z_]+ needs (MRPT|X11), which was not found; install it")
refused(occupancy "edgevo::occupancy needs octomap, which was not found; install it")
refused(odometri "there is no component odometri; this edgevo has: core ")

run(ignored ${configure_consumer} -B ${WORK}/build)
run(ignored ${CMAKE_COMMAND} --build ${WORK}/build)
# For X11, only direct dependencies count: Debian's OpenCV loads the library through OpenGL.
run(loaded ldd ${WORK}/build/consumer_core)
run(direct objdump -p ${WORK}/build/consumer_core)
string(REGEX MATCHALL "lib(mrpt|visp|octomap|octomath)[^ \n]*" unwanted "${loaded}")
string(REGEX MATCHALL "NEEDED +lib(X11|mrpt|visp|octo|av|sqlite3|exif|xml2)[^ \n]*" more "${direct}")
if(unwanted OR more)
  message(FATAL_ERROR "the facade brings ${unwanted} ${more}")
endif()
run(said ${WORK}/build/consumer_core ${SEQUENCE})
message(STATUS "${said}")

# SPDX-License-Identifier: BSD-3-Clause
# Installs the project into a fresh prefix, then configures, builds and runs the consumer against it.
# cmake -DBUILD=... -DWORK=... -DSOURCE=... -DGENERATOR=... -DLINKS=... [-DFLAGS=...] -P consumer_test.cmake
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT result EQUAL 0)
    string(JOIN " " command ${ARGV})
    message(FATAL_ERROR "failed (${result}): ${command}\n${output}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${WORK}/prefix)
run(${CMAKE_COMMAND} -S ${SOURCE} -B ${WORK}/build -G ${GENERATOR} -DCMAKE_BUILD_TYPE=Release
  -DCMAKE_PREFIX_PATH=${WORK}/prefix "-DEDGEVO_CONSUMER_LINKS=${LINKS}" "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/consumer)
run(${WORK}/prefix/bin/edgevo --version)
foreach(file IN ITEMS share/edgevo/params share/edgevo/datasets share/doc/edgevo/README.md share/doc/edgevo/LICENSE)
  if(NOT EXISTS ${WORK}/prefix/${file})
    message(FATAL_ERROR "not installed: ${file}")
  endif()
endforeach()

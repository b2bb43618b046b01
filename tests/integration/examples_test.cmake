# SPDX-License-Identifier: BSD-3-Clause
# Builds the installed share/examples against the installed package and runs both loops on a rendered sequence.
# cmake -DPREFIX=... -DWORK=... -DSEQUENCE=... -DGENERATOR=... [-DFLAGS=...] -P examples_test.cmake
function(run)
  cmake_parse_arguments(ARG "" "OUTPUT" "COMMAND" ${ARGN})
  execute_process(COMMAND ${ARG_COMMAND} RESULT_VARIABLE result OUTPUT_VARIABLE output ERROR_VARIABLE output WORKING_DIRECTORY ${WORK})
  if(NOT result EQUAL 0)
    string(JOIN " " command ${ARG_COMMAND})
    message(FATAL_ERROR "failed (${result}): ${command}\n${output}")
  endif()
  if(ARG_OUTPUT)
    set(${ARG_OUTPUT} "${output}" PARENT_SCOPE)
  endif()
endfunction()

function(expect text pattern)
  if(NOT text MATCHES "${pattern}")
    message(FATAL_ERROR "no '${pattern}' in:\n${text}")
  endif()
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(COMMAND ${CMAKE_COMMAND} -S ${PREFIX}/share/edgevo/examples -B ${WORK}/build -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${PREFIX} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build)

# MRPT: as many poses as the odometry has, in MRPT's own file.
run(COMMAND ${PREFIX}/bin/edgevo import ${SEQUENCE} ${WORK}/seq.rawlog)
run(COMMAND ${WORK}/build/mrpt_loop ${WORK}/seq.rawlog ${WORK}/path.txt ${WORK}/loop OUTPUT said)
file(STRINGS ${SEQUENCE}/times.txt times)
list(LENGTH times frames)
expect("${said}" "^${frames} images, [1-9][0-9]+ poses")
file(STRINGS ${WORK}/path.txt path)
list(LENGTH path poses)
expect("${said}" ", ${poses} poses")
if(poses LESS 40)
  message(FATAL_ERROR "only ${poses} of ${frames} frames have a pose")
endif()

# Its folder has the files that `edgevo run` writes.
run(COMMAND ${PREFIX}/bin/edgevo run ${WORK}/seq.rawlog -o ${WORK}/run --quiet)
foreach(file IN ITEMS trajectory_tum.txt trajectory_live_tum.txt trajectory_kitti.txt)
  run(COMMAND ${CMAKE_COMMAND} -E compare_files ${WORK}/run/${file} ${WORK}/loop/${file})
endforeach()
foreach(file IN ITEMS edges.ply edges.bt playback.rawlog report.html summary.yaml)
  if(NOT EXISTS ${WORK}/loop/${file})
    message(FATAL_ERROR "mrpt_loop wrote no ${file}")
  endif()
endforeach()

# The facade: images in, poses out, the error at the end.
run(COMMAND ${CMAKE_COMMAND} -S ${PREFIX}/share/edgevo/examples/poses -B ${WORK}/build_poses -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${PREFIX} "-DCMAKE_CXX_FLAGS=${FLAGS}")
run(COMMAND ${CMAKE_COMMAND} --build ${WORK}/build_poses)
run(COMMAND ${WORK}/build_poses/poses ${SEQUENCE} OUTPUT said)
expect("${said}" "\n[0-9]+ keyframes\n")
expect("${said}" "ATE")

# An invalid rawlog gives a one-line error.
foreach(source IN ITEMS nothere path.txt)
  execute_process(COMMAND ${WORK}/build/mrpt_loop ${WORK}/${source} ${WORK}/x.txt RESULT_VARIABLE result ERROR_VARIABLE error)
  string(REGEX MATCHALL "\n" lines "${error}")
  list(LENGTH lines count)
  if(NOT result EQUAL 2 OR NOT count EQUAL 1 OR NOT error MATCHES "^mrpt_loop: ")
    message(FATAL_ERROR "mrpt_loop on ${source}: code ${result}, '${error}'")
  endif()
endforeach()

# ViSP: goal taught, commands sent, and stopped when the images end.
if(EXISTS ${WORK}/build/visp_loop)
  run(COMMAND ${WORK}/build/visp_loop ${SEQUENCE} 0.4 OUTPUT said)
  expect("${said}" "stop  no image has been processed yet\n")
  if(NOT FLAGS MATCHES sanitize)  # with sanitizers it cannot keep up with the images
    expect("${said}" "taught at image [0-9]+; scale: none\n")
    expect("${said}" "move +-?[0-9.]+ ")
  endif()
  expect("${said}" "stop  stale: the newest pose is")
  expect("${said}" "[0-9]+ images processed")
  execute_process(COMMAND ${WORK}/build/visp_loop ${WORK}/nowhere RESULT_VARIABLE result ERROR_VARIABLE error)
  if(NOT result EQUAL 2 OR NOT error MATCHES "nowhere")
    message(FATAL_ERROR "a wrong source: code ${result}, '${error}'")
  endif()
endif()

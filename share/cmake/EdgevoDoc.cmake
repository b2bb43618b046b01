# SPDX-License-Identifier: BSD-3-Clause
# The documentation as a web site: cmake --build BUILD --target doc, then open BUILD/doc/html/index.html. Needs doxygen and graphviz, but
# no build of edgevo. The test doxygen_clean builds it with warnings as errors.
set(EDGEVO_DOC_DIR ${PROJECT_BINARY_DIR}/doc)
set(doc_input ${PROJECT_SOURCE_DIR}/README.md ${PROJECT_SOURCE_DIR}/share/doc)
foreach(module IN LISTS EDGEVO_MODULES)
  list(APPEND doc_input ${PROJECT_SOURCE_DIR}/modules/${module}/README.md)
  if(EXISTS ${PROJECT_SOURCE_DIR}/modules/${module}/include)
    list(APPEND doc_input ${PROJECT_SOURCE_DIR}/modules/${module}/include)
    list(APPEND doc_includes ${PROJECT_SOURCE_DIR}/modules/${module}/include)
  endif()
  if(EXISTS ${PROJECT_SOURCE_DIR}/modules/${module}/figures)
    list(APPEND doc_pictures ${PROJECT_SOURCE_DIR}/modules/${module}/figures)
  endif()
endforeach()
list(JOIN doc_input " " EDGEVO_DOC_INPUT)
list(JOIN doc_includes " " EDGEVO_DOC_INCLUDE_DIRS)
list(JOIN doc_pictures " " EDGEVO_DOC_PICTURE_DIRS)
set(EDGEVO_DOC_WARN_AS_ERROR FAIL_ON_WARNINGS)
configure_file(${PROJECT_SOURCE_DIR}/share/doc/site/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)

find_program(EDGEVO_DOXYGEN doxygen)
if(NOT EDGEVO_DOXYGEN)
  message(STATUS "edgevo: no target doc (needs doxygen and graphviz)")
  return()
endif()
add_custom_target(doc COMMAND ${CMAKE_COMMAND} -E make_directory ${EDGEVO_DOC_DIR}
  COMMAND ${EDGEVO_DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile COMMENT "Documentation: ${EDGEVO_DOC_DIR}/html/index.html" VERBATIM)

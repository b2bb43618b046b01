# SPDX-License-Identifier: BSD-3-Clause
# Data for find_package(edgevo COMPONENTS ...): the modules and packages that each module needs, derived from what it links, so that no
# list has to be maintained.

set(EDGEVO_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/edgevo)

# edgevo_package_of(LINK PACKAGE COMPONENT): sets the package that provides a linked library and, for packages with components (MRPT), its
# component; empty if there is no package to find.
function(edgevo_package_of link package component)
  set(found)
  set(part)
  if(link MATCHES "^opencv_")
    set(found OpenCV)
  elseif(link MATCHES "^mrpt::(.+)")
    set(found MRPT)
    set(part ${CMAKE_MATCH_1})
  elseif(link MATCHES "^octo(map|math)$")
    set(found octomap)
  elseif(link MATCHES "^visp_")
    set(found VISP)
  elseif(link MATCHES "^([A-Za-z0-9]+)::")
    set(found ${CMAKE_MATCH_1})
  endif()
  set(${package} ${found} PARENT_SCOPE)
  set(${component} ${part} PARENT_SCOPE)
endfunction()

# edgevo_add_component(MODULE INSTALL_COMPONENT LINK...): records them and exports the target of the module in its own file.
function(edgevo_add_component module install_component)
  set(needs)
  set(packages)
  set(mrpt)
  foreach(link IN LISTS ARGN)
    edgevo_package_of(${link} package part)
    if(link MATCHES "^edgevo::(.+)")
      list(APPEND needs ${CMAKE_MATCH_1})
    elseif(package)
      list(APPEND packages ${package})
      list(APPEND mrpt ${part})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES packages)
  foreach(kind IN ITEMS needs packages mrpt)
    string(REPLACE ";" " " values "${${kind}}")
    set_property(GLOBAL APPEND_STRING PROPERTY EDGEVO_COMPONENT_TABLE "set(_edgevo_${kind}_${module} ${values})\n")
  endforeach()
  set_property(GLOBAL APPEND PROPERTY EDGEVO_COMPONENTS ${module})
  install(EXPORT edgevo_${module} FILE edgevo-${module}.cmake NAMESPACE edgevo:: DESTINATION ${EDGEVO_PACKAGE_DIR}
    COMPONENT ${install_component})
endfunction()

# edgevo_component_table(RESULT): the table as text for edgevoConfig.cmake, with the modules bottom to top.
function(edgevo_component_table result)
  get_property(modules GLOBAL PROPERTY EDGEVO_COMPONENTS)
  get_property(table GLOBAL PROPERTY EDGEVO_COMPONENT_TABLE)
  list(JOIN modules " " modules)
  set(${result} "set(_edgevo_modules ${modules})\n${table}" PARENT_SCOPE)
endfunction()

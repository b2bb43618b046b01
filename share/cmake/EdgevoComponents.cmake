# What find_package(edgevo COMPONENTS ...) has to know: of each module which others it needs, and whose packages. It follows from what
# the module links, so that no list has to be kept.

set(EDGEVO_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/edgevo)

# edgevo_package_of(LINK PACKAGE COMPONENT): the package that a link is of, and its component where the package is asked for by those
# (MRPT); empty where there is none to look for.
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

# edgevo_add_component(MODULE INSTALL_COMPONENT LINK...): remembers them, and exports the module's target in a file of its own.
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

# edgevo_component_table(RESULT): as text for edgevoConfig.cmake; the modules bottom to top.
function(edgevo_component_table result)
  get_property(modules GLOBAL PROPERTY EDGEVO_COMPONENTS)
  get_property(table GLOBAL PROPERTY EDGEVO_COMPONENT_TABLE)
  list(JOIN modules " " modules)
  set(${result} "set(_edgevo_modules ${modules})\n${table}" PARENT_SCOPE)
endfunction()

# SPDX-License-Identifier: BSD-3-Clause
# Install rules: the exported CMake package, parameters and other data files. Components are those of EdgevoPackages.cmake.
include(CMakePackageConfigHelpers)
edgevo_component_table(EDGEVO_COMPONENT_TABLE)
configure_package_config_file(${PROJECT_SOURCE_DIR}/share/cmake/edgevoConfig.cmake.in
  ${PROJECT_BINARY_DIR}/edgevoConfig.cmake INSTALL_DESTINATION ${EDGEVO_PACKAGE_DIR} NO_CHECK_REQUIRED_COMPONENTS_MACRO)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/edgevoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/edgevoConfig.cmake ${PROJECT_BINARY_DIR}/edgevoConfigVersion.cmake
  DESTINATION ${EDGEVO_PACKAGE_DIR} COMPONENT devel)
install(DIRECTORY share/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/edgevo COMPONENT devel PATTERN python EXCLUDE)

set(EDGEVO_DATA_DIR ${CMAKE_INSTALL_DATADIR}/edgevo)
# Python scripts are not installed: the package needs no Python.
install(DIRECTORY params datasets share/bench share/workflow DESTINATION ${EDGEVO_DATA_DIR} COMPONENT program USE_SOURCE_PERMISSIONS
  PATTERN *.py EXCLUDE)
install(PROGRAMS share/install_dependencies.sh DESTINATION ${EDGEVO_DATA_DIR} COMPONENT devel)
file(GLOB EDGEVO_INI_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/share/*.ini)
install(FILES ${EDGEVO_INI_FILES} DESTINATION ${EDGEVO_DATA_DIR} COMPONENT program)

# The pages are installed with the layout of the source tree, so that their links work.
install(FILES LICENSE README.md CONTRIBUTING.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc)
install(DIRECTORY share/doc share/lab share/bench share/workflow DESTINATION ${CMAKE_INSTALL_DOCDIR}/share COMPONENT doc
  FILES_MATCHING PATTERN *.md PATTERN *.gif PATTERN *.png)
install(DIRECTORY modules params datasets DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT doc
  FILES_MATCHING PATTERN README.md PATTERN *.svg PATTERN src EXCLUDE PATTERN include EXCLUDE PATTERN scenes EXCLUDE)
file(GLOB EDGEVO_PAGES RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS
  ${PROJECT_SOURCE_DIR}/tests/README.md ${PROJECT_SOURCE_DIR}/tests/*/README.md
  ${PROJECT_SOURCE_DIR}/share/packages/README.md ${PROJECT_SOURCE_DIR}/share/examples/README.md
  ${PROJECT_SOURCE_DIR}/share/training/README.md ${PROJECT_SOURCE_DIR}/share/models/MODEL_CARD.md)
foreach(page IN LISTS EDGEVO_PAGES)
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder} COMPONENT doc)
endforeach()

# Models of detectors, located relative to the program (files/share_folder.h): installed, and linked into the build folder.
set(EDGEVO_MODELS ${PROJECT_SOURCE_DIR}/share/models)
if(EXISTS ${EDGEVO_MODELS})
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/share/edgevo)
  file(CREATE_LINK ${EDGEVO_MODELS} ${PROJECT_BINARY_DIR}/share/edgevo/models SYMBOLIC)
  install(DIRECTORY share/models DESTINATION ${EDGEVO_DATA_DIR} COMPONENT program)
endif()

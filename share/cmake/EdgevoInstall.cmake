# Install rules: the exported CMake package, parameters and what else stands beside the binaries.
include(CMakePackageConfigHelpers)
set(EDGEVO_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/edgevo)
set(EDGEVO_MRPT_COMPONENTS containers obs maps opengl poses img io gui)  # of all modules together
install(EXPORT edgevoTargets NAMESPACE edgevo:: DESTINATION ${EDGEVO_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/share/cmake/edgevoConfig.cmake.in
  ${PROJECT_BINARY_DIR}/edgevoConfig.cmake INSTALL_DESTINATION ${EDGEVO_PACKAGE_DIR})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/edgevoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/edgevoConfig.cmake ${PROJECT_BINARY_DIR}/edgevoConfigVersion.cmake
  DESTINATION ${EDGEVO_PACKAGE_DIR})
install(DIRECTORY params datasets share/bench share/examples DESTINATION ${CMAKE_INSTALL_DATADIR}/edgevo)
install(PROGRAMS share/install_dependencies.sh DESTINATION ${CMAKE_INSTALL_DATADIR}/edgevo)
file(GLOB EDGEVO_INI_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/share/*.ini)
install(FILES ${EDGEVO_INI_FILES} DESTINATION ${CMAKE_INSTALL_DATADIR}/edgevo)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

# Install rules: the exported CMake package, parameters and what else stands beside the binaries.
include(CMakePackageConfigHelpers)
install(EXPORT edgevoTargets NAMESPACE edgevo:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/edgevo)
configure_package_config_file(${PROJECT_SOURCE_DIR}/share/cmake/edgevoConfig.cmake.in
  ${PROJECT_BINARY_DIR}/edgevoConfig.cmake INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/edgevo)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/edgevoConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/edgevoConfig.cmake ${PROJECT_BINARY_DIR}/edgevoConfigVersion.cmake
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/edgevo)
install(DIRECTORY params datasets DESTINATION ${CMAKE_INSTALL_DATADIR}/edgevo)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

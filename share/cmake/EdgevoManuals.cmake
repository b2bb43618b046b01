# SPDX-License-Identifier: BSD-3-Clause
# Manual pages and bash completion, generated from --help, so that they are always up to date.
find_program(EDGEVO_HELP2MAN help2man)
if(NOT EDGEVO_HELP2MAN OR EDGEVO_SANITIZE)
  message(STATUS "edgevo: no manual pages (they need help2man and a build without sanitizers)")
  return()
endif()
set(manuals ${PROJECT_BINARY_DIR}/manuals)
set(script ${PROJECT_SOURCE_DIR}/share/packages/manuals.sh)
set(programs edgevo edgevo-commands)
if(TARGET edgevo-servo)
  list(APPEND programs edgevo-servo)
endif()
add_custom_command(OUTPUT ${manuals}/stamp DEPENDS ${programs} ${script} ${PROJECT_SOURCE_DIR}/share/packages/edgevo.h2m
  COMMAND ${script} $<TARGET_FILE:edgevo> ${manuals} COMMAND ${CMAKE_COMMAND} -E touch ${manuals}/stamp
  COMMENT "Manual pages and bash completion" VERBATIM)
add_custom_target(manuals ALL DEPENDS ${manuals}/stamp)

set(servo_page ${manuals}/man1/edgevo-servo.1.gz)
install(DIRECTORY ${manuals}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT program OPTIONAL PATTERN edgevo-servo* EXCLUDE)
install(FILES ${servo_page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT servo OPTIONAL)
install(FILES ${manuals}/completions/edgevo DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT program OPTIONAL)

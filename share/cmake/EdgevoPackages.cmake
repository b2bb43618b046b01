# SPDX-License-Identifier: BSD-3-Clause
# Debian packages, by CPack: share/packages/make.sh, or `cpack` in a build folder. Contents of the packages and
# reasons: share/packages/README.md. dpkg-shlibdeps finds the dependencies of programs; those of libraries are listed here.
set(release 1)
set(version "${PROJECT_VERSION}-${release}")

# Debian's environment variables for the maintainer of a package.
if("$ENV{DEBFULLNAME}" STREQUAL "" OR "$ENV{DEBEMAIL}" STREQUAL "")
  set(maintainer "The edgevo authors <edgevo@localhost>")
else()
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH, if it is set

# The licence as the indented text of a copyright file: everything above the note on ViSP.
file(READ ${PROJECT_SOURCE_DIR}/LICENSE licence)
string(REGEX REPLACE "\n---+\n.*" "" licence "${licence}")
string(REGEX REPLACE "^[^\n]*\n\n[^\n]*\n\n" "" licence "${licence}")  # title and holders have fields of their own
string(REGEX REPLACE "\n\n" "\n.\n" licence "${licence}")
string(STRIP "${licence}" licence)
string(REGEX REPLACE "\n" "\n " licence "${licence}")

set(packaging ${PROJECT_BINARY_DIR}/packaging)
configure_file(${PROJECT_SOURCE_DIR}/share/packages/copyright.in ${packaging}/copyright @ONLY)
configure_file(${PROJECT_SOURCE_DIR}/share/packages/copyright_visp.in ${packaging}/copyright_visp @ONLY)

# edgevo_package(COMPONENT NAME SUMMARY TEXT [GPL] [SECTION s] [DEPENDS d] [RECOMMENDS r] [SUGGESTS s])
# Adds a package with its copyright file and changelog, which a plain installation does not have.
macro(edgevo_package component name summary text)
  cmake_parse_arguments(ARG "GPL" "SECTION;DEPENDS;RECOMMENDS;SUGGESTS;ARCHITECTURE" "" ${ARGN})
  string(TOUPPER ${component} upper)
  list(APPEND CPACK_COMPONENTS_ALL ${component})
  set(CPACK_DEBIAN_${upper}_PACKAGE_NAME ${name})
  set(CPACK_DEBIAN_${upper}_DESCRIPTION "${summary}\n${text}")
  set(CPACK_DEBIAN_${upper}_PACKAGE_SECTION ${ARG_SECTION})
  foreach(relation IN ITEMS DEPENDS RECOMMENDS SUGGESTS)
    if(ARG_${relation})
      set(CPACK_DEBIAN_${upper}_PACKAGE_${relation} "${ARG_${relation}}")
    endif()
  endforeach()
  if(ARG_ARCHITECTURE)
    set(CPACK_DEBIAN_${upper}_PACKAGE_ARCHITECTURE ${ARG_ARCHITECTURE})
  endif()
  set(package ${name})
  configure_file(${PROJECT_SOURCE_DIR}/share/packages/changelog.in ${packaging}/${name}/changelog.Debian @ONLY)
  execute_process(COMMAND gzip -9nf ${packaging}/${name}/changelog.Debian)
  install(FILES ${packaging}/${name}/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name}
    COMPONENT ${component} EXCLUDE_FROM_ALL)
  set(copyright ${packaging}/copyright)
  if(ARG_GPL)
    set(copyright ${packaging}/copyright_visp)
  endif()
  install(FILES ${copyright} DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME copyright
    COMPONENT ${component} EXCLUDE_FROM_ALL)
  set(overrides ${PROJECT_SOURCE_DIR}/share/packages/${name}.lintian-overrides)
  if(EXISTS ${overrides})
    install(FILES ${overrides} DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides RENAME ${name}
      COMPONENT ${component} EXCLUDE_FROM_ALL)
  endif()
endmacro()

set(CPACK_COMPONENTS_ALL)
edgevo_package(program edgevo "monocular edge visual odometry"
  "From the images of one moving camera to its trajectory and a 3D map of the
edges that it saw, on a CPU. Reads MRPT rawlogs, bags of ROS, videos and the
folders of KITTI, TUM and EuRoC; writes trajectories, rawlogs, simplemaps, OctoMaps and
scenes that the stock tools open, and a report."
  SECTION science RECOMMENDS "edgevo-view, gnuplot-nox | gnuplot"
  SUGGESTS "snakemake, edgevo-mrpt-plugin, edgevo-servo, edgevo-doc, mrpt-apps, octovis, octomap-tools")
edgevo_package(view edgevo-view "edge visual odometry: a window on its runs"
  "The program behind `edgevo run --view`, which shows the newest frame with its
edges, the map and the path. Separate from edgevo, which needs no libraries
of a desktop on a robot without a screen."
  SECTION science DEPENDS "edgevo (= ${version})")
edgevo_package(plugin edgevo-mrpt-plugin "edge visual odometry in MRPT's own programs"
  "A plug-in for rawlog-grabber (-p edgevo_mrpt_plugin.so), which then records
the image, the pose and the 3D edges of a camera as they come; and an OctoMap
class made for edges, for the programs of MRPT that build maps."
  SECTION science DEPENDS "edgevo (= ${version})" RECOMMENDS "mrpt-apps")
if(TARGET edgevo_py)
  string(REGEX REPLACE "^3\\." "" python_minor ${EDGEVO_PYTHON_VERSION})
  math(EXPR next_minor "${python_minor} + 1")
  edgevo_package(python python3-edgevo "edge visual odometry: import edgevo"
    "A package for Python: images in as arrays of numpy, poses, points and maps out;
typed, with examples. For the version of Python of this system."
    SECTION python DEPENDS "edgevo (= ${version}), python3 (>= ${EDGEVO_PYTHON_VERSION}), python3 (<< 3.${next_minor}), python3-numpy"
    SUGGESTS "python3-opencv, edgevo-doc")
endif()
if(TARGET edgevo-servo)
  edgevo_package(servo edgevo-servo "visual servoing on edge visual odometry, in a simulator"
    "The program behind `edgevo servo`: ViSP's control laws close a loop around a
rendered camera, with the odometry as their only sensor. Separate from
edgevo, since it links ViSP and is therefore under the GPL."
    GPL SECTION science DEPENDS "edgevo (= ${version})")
  edgevo_package(visp_devel libedgevo-visp-dev "edge visual odometry: bridge to ViSP"
    "Static libraries, headers and CMake targets edgevo::visp_bridge and
edgevo::servo, which feed ViSP's control laws from the odometry. Separate
from libedgevo-dev, since programs that link ViSP are under the GPL."
    GPL SECTION libdevel DEPENDS "libedgevo-dev (= ${version}), libvisp-dev")
endif()
# Components of find_package(edgevo) search for the packages that they link: those of the odometry are dependencies, the others
# recommendations.
set(libraries "libeigen3-dev, libopencv-dev, libceres-dev, zlib1g-dev")
set(more_libraries "liboctomap-dev, libmrpt-maps-dev, libmrpt-gui-dev, libx11-dev, libexif-dev, libsqlite3-dev, libxml2-dev, libdeflate-dev, libbz2-dev, liblz4-dev, libzstd-dev")
edgevo_package(devel libedgevo-dev "edge visual odometry: libraries for C++"
  "Static libraries, headers, a CMake package (find_package(edgevo), targets
edgevo::odometry, edgevo::datasets and others) and examples, in
/usr/share/edgevo/examples."
  SECTION libdevel DEPENDS "${libraries}" RECOMMENDS "${more_libraries}" SUGGESTS "libedgevo-visp-dev")
edgevo_package(doc edgevo-doc "edge visual odometry: documentation"
  "Handbook, architecture, the page of each module, tables of accuracy and
what measurements taught, as Markdown in /usr/share/doc/edgevo."
  SECTION doc ARCHITECTURE all)

# Runs ldconfig for the plug-in.
set(CPACK_DEBIAN_PLUGIN_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/share/packages/triggers)
set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package has its own
set(CPACK_DEBIAN_PACKAGE_RELEASE ${release})
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "${maintainer}")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
include(CPack)

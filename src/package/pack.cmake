# SPDX-License-Identifier: BSD-3-Clause
add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DBUILD=${PROJECT_BINARY_DIR}
                                    -P ${CMAKE_CURRENT_LIST_DIR}/uninstall.cmake VERBATIM)

# Of the commit, not of the files as they are.
find_program(GIT git)
set(DELAM_DIST delam-${PROJECT_VERSION})
if(GIT AND EXISTS ${PROJECT_SOURCE_DIR}/.git)
  add_custom_target(dist COMMAND ${GIT} archive --format=tar.gz --prefix=${DELAM_DIST}/
                                 --output=${PROJECT_BINARY_DIR}/${DELAM_DIST}.tar.gz HEAD
                         WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} VERBATIM)
endif()

set(CPACK_PACKAGE_NAME delam)
# Whoever hands packages on puts an address of theirs here.
set(DELAM_PACKAGER "libdelam maintainers <maintainers@libdelam.invalid>" CACHE STRING "maintainer of the packages")
set(CPACK_PACKAGE_CONTACT ${DELAM_PACKAGER})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL runtime development cli fortran cpp)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING ONE_PER_GROUP)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
# The program's own library is in another of these packages.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS "libdelam${DELAM_ABI} (= ${PROJECT_VERSION})")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME libdelam${DELAM_ABI})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_HEADERS_PACKAGE_NAME libdelam-dev)
set(CPACK_DEBIAN_HEADERS_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_HEADERS_PACKAGE_DEPENDS "libdelam${DELAM_ABI} (= ${PROJECT_VERSION})")
# What the archive is linked with comes with it, as Debian's users expect.
if(DELAM_STATIC)
  string(APPEND CPACK_DEBIAN_HEADERS_PACKAGE_DEPENDS ", libsuitesparse-dev, libmetis-dev, libopenblas-dev")
endif()
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME delam)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3, python3-numpy, python3-matplotlib, python3-h5py")
include(CPack)
cpack_add_component(runtime GROUP library)
cpack_add_component(development GROUP headers)
cpack_add_component(fortran GROUP headers)
cpack_add_component(cpp GROUP headers)
cpack_add_component(cli GROUP program)

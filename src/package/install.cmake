# SPDX-License-Identifier: BSD-3-Clause
# The library itself; the bindings install their own parts.
set(DELAM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/delam)
install(TARGETS delam EXPORT delam LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT runtime
                                           NAMELINK_COMPONENT development)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT runtime)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/delam DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development
        FILES_MATCHING PATTERN "*.h" PATTERN petsc.h EXCLUDE)
# The contract, the documents that the header names, under the paths that it gives, and what these documents link.
install(FILES ${PROJECT_SOURCE_DIR}/include/GLOSSARY.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/include
        COMPONENT development)
foreach(document capi/CONTRACT.md reduction/README.md reduction/NOTES.md reduction/condensed/README.md
                 reduction/dense/README.md reduction/feti/README.md reduction/sparse/engine/README.md
                 reduction/sparse/iterated/README.md reduction/sparse/iterated/NOTES.md evolution/README.md
                 evolution/NOTES.md evolution/increment/README.md evolution/step/README.md)
  get_filename_component(folder src/${document} DIRECTORY)
  install(FILES ${PROJECT_SOURCE_DIR}/src/${document} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder}
          COMPONENT development)
endforeach()
install(EXPORT delam NAMESPACE delam:: FILE delam-targets.cmake DESTINATION ${DELAM_CMAKE_DIR} COMPONENT development)
# Before 1.0 a minor version may change the interface.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/delam-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_LIST_DIR}/delam-config.cmake ${PROJECT_BINARY_DIR}/delam-config-version.cmake
        DESTINATION ${DELAM_CMAKE_DIR} COMPONENT development)
# Whoever compiles the Fortran modules needs their order.
include(${PROJECT_SOURCE_DIR}/bindings/fortran/sources.cmake)
list(TRANSFORM DELAM_FORTRAN_MODULES REPLACE "(.+)" "\${fortrandir}/\\1.f90" OUTPUT_VARIABLE DELAM_PC_FORTRAN)
list(JOIN DELAM_PC_FORTRAN " " DELAM_PC_FORTRAN)
# Relative to the file itself, so that an installed tree may be moved.
file(RELATIVE_PATH DELAM_PC_PREFIX ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig ${CMAKE_INSTALL_PREFIX})
set(DELAM_PC_FILES delam)
set(DELAM_PC_LINKS "Libs: -L\${libdir} -ldelam")
if(DELAM_STATIC)
  install(TARGETS delam_static EXPORT delam-static ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
  install(EXPORT delam-static NAMESPACE delam:: DESTINATION ${DELAM_CMAKE_DIR} COMPONENT development)
  # `pkg-config --static` adds to what it says without, and a linker takes the first library that has a name: the shared
  # one comes from a file of its own, behind the archive, and is dropped where nothing is left for it.
  list(APPEND DELAM_PC_FILES delam-shared)
  list(TRANSFORM DELAM_STATIC_LINKS REPLACE "^([^/-].*)$" "-l\\1" OUTPUT_VARIABLE DELAM_PC_LINKS)
  list(JOIN DELAM_PC_LINKS " " DELAM_PC_LINKS)
  set(DELAM_PC_LINKS "Requires: delam-shared\nLibs.private: \${libdir}/libdelam.a ${DELAM_PC_LINKS}")
endif()
# delam_install_pc(FILE COMPONENT)
function(delam_install_pc file component)
  configure_file(${CMAKE_CURRENT_FUNCTION_LIST_DIR}/${file}.pc.in ${PROJECT_BINARY_DIR}/${file}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/${file}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT ${component})
endfunction()
foreach(file IN LISTS DELAM_PC_FILES)
  delam_install_pc(${file} development)
endforeach()
# libdelam-petsc: in components of its own, so that the others need no MPI.
if(TARGET delam_petsc)
  install(TARGETS delam_petsc EXPORT delam-petsc LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT petsc
                                                         NAMELINK_COMPONENT petsc_development)
  install(FILES ${PROJECT_SOURCE_DIR}/include/delam/petsc.h DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/delam
          COMPONENT petsc_development)
  install(EXPORT delam-petsc NAMESPACE delam:: DESTINATION ${DELAM_CMAKE_DIR} COMPONENT petsc_development)
  delam_install_pc(delam-petsc petsc_development)
endif()

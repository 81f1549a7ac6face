# SPDX-License-Identifier: BSD-3-Clause
# delam_lgpl: the library for binaries that must not be under the GPL, such as the Python wheel. It is libdelam with
# DELAM_CHOLMOD_SIMPLICIAL, linked with libdelam-cholmod.so, which has the LGPL modules of Debian's CHOLMOD and none of
# its GPL modules. One file of ours is compiled again; the others are those of delam.
get_filename_component(folder "${CHOLMOD_LIBRARY}" DIRECTORY)
set(archives)
foreach(name cholmod amd camd colamd ccolamd suitesparseconfig)
  if(EXISTS ${folder}/lib${name}.a)
    list(APPEND archives ${folder}/lib${name}.a)
  endif()
endforeach()
list(LENGTH archives count)
if(NOT count EQUAL 6 OR NOT CMAKE_AR OR NOT CMAKE_LINKER OR NOT CMAKE_OBJCOPY)
  message(STATUS "delam_lgpl is left out: it needs the archives of SuiteSparse beside ${CHOLMOD_LIBRARY}, and binutils")
  return()
endif()
set(object ${PROJECT_BINARY_DIR}/lgpl/cholmod.o)
add_custom_command(OUTPUT ${object}
  COMMAND ${CMAKE_COMMAND} "-DARCHIVES=${archives}" -DOBJECT=${object} -DAR=${CMAKE_AR} -DLD=${CMAKE_LINKER}
          -DOBJCOPY=${CMAKE_OBJCOPY} -P ${CMAKE_CURRENT_LIST_DIR}/lgpl_object.cmake
  DEPENDS ${archives} ${CMAKE_CURRENT_LIST_DIR}/lgpl_object.cmake VERBATIM)
set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
set(map ${CMAKE_CURRENT_LIST_DIR}/lgpl.map)
add_library(delam_cholmod_lgpl SHARED ${CMAKE_CURRENT_LIST_DIR}/lgpl.c ${object})
target_include_directories(delam_cholmod_lgpl SYSTEM PRIVATE ${CHOLMOD_INCLUDE_DIR})
target_link_libraries(delam_cholmod_lgpl PRIVATE ${METIS_LIBRARY} m)
target_link_options(delam_cholmod_lgpl PRIVATE LINKER:--version-script=${map} LINKER:-z,defs)
set_target_properties(delam_cholmod_lgpl PROPERTIES OUTPUT_NAME delam-cholmod LINK_DEPENDS ${map}
                                                    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lgpl)

add_library(delam_cholesky_lgpl OBJECT ${DELAM_CHOLESKY})
delam_part(delam_cholesky_lgpl)
target_compile_definitions(delam_cholesky_lgpl PRIVATE DELAM_CHOLMOD_SIMPLICIAL)
add_library(delam_lgpl SHARED $<TARGET_OBJECTS:delam_inner> $<TARGET_OBJECTS:delam_facade>
                              $<TARGET_OBJECTS:delam_cholesky_lgpl>)
target_link_libraries(delam_lgpl PRIVATE delam_cholmod_lgpl ${METIS_LIBRARY} LAPACK::LAPACK Threads::Threads)
target_link_options(delam_lgpl PRIVATE LINKER:--version-script=${DELAM_MAP} LINKER:-z,defs)
set_target_properties(delam_lgpl PROPERTIES OUTPUT_NAME delam VERSION ${PROJECT_VERSION} SOVERSION ${DELAM_ABI}
                                            LINK_DEPENDS ${DELAM_MAP}
                                            LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/lgpl)

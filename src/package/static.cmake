# SPDX-License-Identifier: BSD-3-Clause
# libdelam.a: the objects as one, in which the public names alone are global (one_object.cmake). What the objects need
# of other libraries is told to hosts by name: as link interface of delam::delam_static, and in delam.pc.
if(CMAKE_INTERPROCEDURAL_OPTIMIZATION OR "${CMAKE_CXX_FLAGS}" MATCHES "-flto")
  message(FATAL_ERROR "DELAM_STATIC cannot pack objects of link-time optimisation: leave one of the two out")
endif()
set(DELAM_LD)
foreach(linker ${CMAKE_LINKER} ld.bfd)
  execute_process(COMMAND ${linker} --help OUTPUT_VARIABLE help ERROR_QUIET RESULT_VARIABLE status)
  if(NOT DELAM_LD AND status EQUAL 0 AND help MATCHES "--force-group-allocation")
    set(DELAM_LD ${linker})
  endif()
endforeach()
if(NOT DELAM_LD OR NOT CMAKE_OBJCOPY OR NOT CMAKE_NM)
  message(FATAL_ERROR "DELAM_STATIC needs GNU ld with --force-group-allocation, objcopy and nm (Debian: binutils)")
endif()
set(strip OFF)
if(CMAKE_BUILD_TYPE MATCHES "^(Release|MinSizeRel)$")
  set(strip ON)
endif()
set(object ${PROJECT_BINARY_DIR}/static/libdelam.o)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/static)
add_custom_command(OUTPUT ${object}
  COMMAND ${CMAKE_COMMAND} -DARCHIVE=$<TARGET_FILE:delam_core> -DOBJECT=${object} -DSTRIP=${strip} -DLD=${DELAM_LD}
          -DNM=${CMAKE_NM} -DOBJCOPY=${CMAKE_OBJCOPY} -P ${CMAKE_CURRENT_LIST_DIR}/one_object.cmake
  DEPENDS delam_core ${CMAKE_CURRENT_LIST_DIR}/one_object.cmake VERBATIM)
set_source_files_properties(${object} PROPERTIES EXTERNAL_OBJECT ON GENERATED ON)
add_library(delam_static STATIC ${object})
add_library(delam::delam_static ALIAS delam_static)
set_target_properties(delam_static PROPERTIES OUTPUT_NAME delam LINKER_LANGUAGE C
                                              ARCHIVE_OUTPUT_DIRECTORY ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
target_include_directories(delam_static INTERFACE $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/include>
                                                  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

# Libraries that every linker finds go by their names, others by their places; those of C++ behind them, since the
# linker may be that of C.
set(DELAM_STATIC_LINKS)
foreach(library IN LISTS CHOLMOD_LIBRARY METIS_LIBRARY LAPACK_LIBRARIES CMAKE_THREAD_LIBS_INIT)
  get_filename_component(folder "${library}" DIRECTORY)
  get_filename_component(name "${library}" NAME)
  if(library MATCHES "^-l(.+)$")
    list(APPEND DELAM_STATIC_LINKS ${CMAKE_MATCH_1})
  elseif(folder IN_LIST CMAKE_C_IMPLICIT_LINK_DIRECTORIES AND name MATCHES "^lib(.+)\\.(so|a)$")
    list(APPEND DELAM_STATIC_LINKS ${CMAKE_MATCH_1})
  else()
    list(APPEND DELAM_STATIC_LINKS ${library})
  endif()
endforeach()
set(runtime ${CMAKE_CXX_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM runtime ${CMAKE_C_IMPLICIT_LINK_LIBRARIES})
list(REMOVE_ITEM DELAM_STATIC_LINKS ${runtime})
list(APPEND DELAM_STATIC_LINKS ${runtime})
list(REMOVE_DUPLICATES DELAM_STATIC_LINKS)
target_link_libraries(delam_static INTERFACE ${DELAM_STATIC_LINKS})

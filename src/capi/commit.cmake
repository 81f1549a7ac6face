# SPDX-License-Identifier: BSD-3-Clause
# Writes the commit of SOURCE into HEADER, "unknown" outside git and its archives; "+" marks uncommitted changes.
cmake_minimum_required(VERSION 3.25)
set(COMMIT unknown)
# In an archive git has put the commit here.
file(READ ${SOURCE}/src/capi/archive_commit.txt ARCHIVED)
if(ARCHIVED MATCHES "^([0-9a-f]+)")
  string(SUBSTRING ${CMAKE_MATCH_1} 0 12 COMMIT)
endif()
find_program(GIT git)
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} rev-parse --short=12 HEAD WORKING_DIRECTORY ${SOURCE}
                  OUTPUT_VARIABLE HEAD RESULT_VARIABLE FAILED OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
  if(NOT FAILED)
    set(COMMIT ${HEAD})
    execute_process(COMMAND ${GIT} diff --quiet HEAD WORKING_DIRECTORY ${SOURCE} RESULT_VARIABLE CHANGED ERROR_QUIET)
    if(CHANGED)
      string(APPEND COMMIT "+")
    endif()
  endif()
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "#define DELAM_COMMIT_TEXT \"@COMMIT@\"\n" @ONLY)

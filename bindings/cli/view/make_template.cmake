# SPDX-License-Identifier: BSD-3-Clause
# cmake -DSOURCES= -DWORK= -DTEMPLATE= -DNPM= -DNODE= -DREQUIRED= -P make_template.cmake: fetches the packages that
# package-lock.json pins into WORK, and bundles the page into TEMPLATE, if its sources are not those of the last time.
cmake_minimum_required(VERSION 3.25)
file(GLOB sources ${SOURCES}/*.mjs ${SOURCES}/*.html ${SOURCES}/*.css ${SOURCES}/src/*.js ${SOURCES}/package-lock.json)
list(SORT sources)
set(state "")
foreach(source IN LISTS sources)
  file(SHA256 ${source} hash)
  get_filename_component(name ${source} NAME)
  string(APPEND state "${name} ${hash}\n")
endforeach()
set(stamp ${WORK}/template.stamp)
if(EXISTS ${TEMPLATE} AND EXISTS ${stamp})
  file(READ ${stamp} before)
  if(before STREQUAL state)
    return()
  endif()
endif()

# left_out(WHY): the program says the same when it misses the template.
function(left_out why)
  if(REQUIRED STREQUAL "AUTO")
    message("The template of `delam view` is left out: ${why}\n"
            "All else is built. Build again when the registry answers.")
  else()
    message(FATAL_ERROR "The template of `delam view` was not built: ${why}")
  endif()
endfunction()

# The packages stay until others are pinned.
file(SHA256 ${SOURCES}/package-lock.json lock)
set(fetched "")
if(EXISTS ${WORK}/packages.stamp)
  file(READ ${WORK}/packages.stamp fetched)
endif()
if(NOT fetched STREQUAL lock)
  file(MAKE_DIRECTORY ${WORK})
  file(REMOVE ${WORK}/packages.stamp)
  file(COPY ${SOURCES}/package.json ${SOURCES}/package-lock.json DESTINATION ${WORK})
  execute_process(COMMAND ${NPM} ci --ignore-scripts --omit=peer --no-audit --no-fund
                          --fetch-retries=1 --fetch-timeout=60000
                  WORKING_DIRECTORY ${WORK} RESULT_VARIABLE status OUTPUT_QUIET ERROR_VARIABLE error TIMEOUT 300)
  if(NOT status EQUAL 0)
    # What comes but is not what was pinned is no absence.
    if(error MATCHES "EINTEGRITY")
      message(FATAL_ERROR "npm: the packages are not those of package-lock.json:\n${error}")
    endif()
    string(REGEX MATCH "npm (ERR!|error)[^\n]*" first "${error}")
    left_out("npm could not fetch its packages: ${first}")
    return()
  endif()
  file(WRITE ${WORK}/packages.stamp ${lock})
endif()

get_filename_component(folder ${TEMPLATE} DIRECTORY)
file(MAKE_DIRECTORY ${folder})
execute_process(COMMAND ${NODE} ${SOURCES}/bundle.mjs ${WORK} ${TEMPLATE}.new RESULT_VARIABLE status)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "The template of `delam view` could not be bundled (see above)")
endif()
file(RENAME ${TEMPLATE}.new ${TEMPLATE})
file(WRITE ${stamp} "${state}")

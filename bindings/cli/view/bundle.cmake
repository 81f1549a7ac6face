# SPDX-License-Identifier: BSD-3-Clause
# The template of the pages of `delam view`: the target delam_view makes it with npm, in the build tree.
set(DELAM_VIEWER AUTO CACHE STRING
    "the template of `delam view`: ON, OFF, or AUTO where npm is found and its registry answers")
set_property(CACHE DELAM_VIEWER PROPERTY STRINGS AUTO ON OFF)

set(DELAM_VIEW_SOURCES ${CMAKE_CURRENT_LIST_DIR})
set(DELAM_VIEW_WORK ${CMAKE_CURRENT_BINARY_DIR}/view)
# Where the program of the build tree looks for it.
if(NOT CMAKE_RUNTIME_OUTPUT_DIRECTORY)
  set(DELAM_VIEW_TEMPLATE ${CMAKE_CURRENT_BINARY_DIR}/../share/delam/view.html)
else()
  set(DELAM_VIEW_TEMPLATE ${CMAKE_RUNTIME_OUTPUT_DIRECTORY}/../share/delam/view.html)
endif()
get_filename_component(DELAM_VIEW_TEMPLATE ${DELAM_VIEW_TEMPLATE} ABSOLUTE)
find_program(DELAM_NPM npm)
find_program(DELAM_NODE NAMES node nodejs)

set(DELAM_VIEWER_WANTED ${DELAM_VIEWER})
if(DELAM_VIEWER STREQUAL "AUTO")
  set(DELAM_VIEWER_WANTED ON)
  if(DELAM_SANITIZE)
    # It is the same page.
    set(DELAM_VIEWER_WANTED OFF)
  elseif(NOT DELAM_NPM OR NOT DELAM_NODE)
    message(STATUS "The template of `delam view` is left out: npm was not found. Install Debian's nodejs and npm, "
                   "and configure again with -UDELAM_NPM -UDELAM_NODE")
    set(DELAM_VIEWER_WANTED OFF)
  endif()
elseif(DELAM_VIEWER AND (NOT DELAM_NPM OR NOT DELAM_NODE))
  message(FATAL_ERROR "DELAM_VIEWER is ON, and npm was not found: install Debian's nodejs and npm")
elseif(NOT DELAM_VIEWER)
  message(STATUS "The template of `delam view` is left out: DELAM_VIEWER is OFF")
endif()

if(DELAM_VIEWER_WANTED)
  message(STATUS "The template of `delam view` is built with ${DELAM_NPM}")
  # Up to date or not: that is decided by what the sources say. A registry that does not answer ends no build, unless
  # the template was asked for.
  add_custom_target(delam_view ALL
    COMMAND ${CMAKE_COMMAND} -DSOURCES=${DELAM_VIEW_SOURCES} -DWORK=${DELAM_VIEW_WORK} -DTEMPLATE=${DELAM_VIEW_TEMPLATE}
            -DNPM=${DELAM_NPM} -DNODE=${DELAM_NODE} -DREQUIRED=${DELAM_VIEWER}
            -P ${DELAM_VIEW_SOURCES}/make_template.cmake
    VERBATIM)
  install(FILES ${DELAM_VIEW_TEMPLATE} DESTINATION ${CMAKE_INSTALL_DATADIR}/delam COMPONENT cli OPTIONAL)
endif()

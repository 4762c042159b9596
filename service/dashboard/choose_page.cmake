# ADSTAR_BUILD_DASHBOARD (AUTO, ON, OFF) and npm, where it is: sets `builds_page` and `requires_page`.
#
# AUTO builds the page where npm is, and does without where npm is missing or its registry is out of reach. ON says
# what is missing, and fails. npm is looked for at each configuration until it is found.

set(ADSTAR_BUILD_DASHBOARD AUTO CACHE STRING "Page of adstar dashboard (npm, from its registry): AUTO, ON or OFF")
set_property(CACHE ADSTAR_BUILD_DASHBOARD PROPERTY STRINGS AUTO ON OFF)
find_program(ADSTAR_NPM npm DOC "Builds the page of adstar dashboard")

set(builds_page OFF)
set(requires_page OFF)
if(ADSTAR_BUILD_DASHBOARD STREQUAL "AUTO")
  if(ADSTAR_NPM)
    set(builds_page ON)
  else()
    message(STATUS "adstar dashboard: npm was not found, the page is left out; install nodejs and npm, and configure again")
  endif()
elseif(ADSTAR_BUILD_DASHBOARD)
  if(NOT ADSTAR_NPM)
    message(FATAL_ERROR "ADSTAR_BUILD_DASHBOARD is ON, and npm was not found: install nodejs and npm, "
      "or configure with -DADSTAR_BUILD_DASHBOARD=AUTO: the program is then built without the page.")
  endif()
  set(builds_page ON)
  set(requires_page ON)
endif()

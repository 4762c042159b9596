# ADSTAR_BUILD_PYTHON (AUTO, ON, OFF): sets `builds_python`, and Python's and pybind11's targets and variables.
#
# AUTO builds the module where Python 3.11, its headers, NumPy and pybind11 are, and does without where one is missing.
# ON says what is missing, and fails. They are looked for at each configuration.

set(ADSTAR_BUILD_PYTHON AUTO CACHE STRING "Python package adstar (pybind11, NumPy): AUTO, ON or OFF")
set_property(CACHE ADSTAR_BUILD_PYTHON PROPERTY STRINGS AUTO ON OFF)

set(builds_python OFF)
if(ADSTAR_SANITIZER OR (NOT ADSTAR_BUILD_PYTHON AND NOT ADSTAR_BUILD_PYTHON STREQUAL "AUTO"))
  return()  # an interpreter that is not instrumented does not load what is
endif()

# Debian's own, whatever else is on the path: NumPy and pybind11 are its packages.
if(NOT Python_EXECUTABLE AND NOT Python_ROOT_DIR AND EXISTS /usr/bin/python3)
  set(Python_EXECUTABLE /usr/bin/python3)
endif()
find_package(Python 3.11 QUIET COMPONENTS Interpreter Development.Module NumPy)
find_path(ADSTAR_PYBIND11 pybind11/pybind11.h DOC "Headers of pybind11")

set(missing "")
if(NOT Python_Interpreter_FOUND)
  list(APPEND missing "Python 3.11 (python3)")
endif()
if(NOT Python_Development.Module_FOUND)
  list(APPEND missing "its headers (python3-dev)")
endif()
if(NOT Python_NumPy_FOUND)
  list(APPEND missing "NumPy (python3-numpy)")
endif()
if(NOT ADSTAR_PYBIND11)
  list(APPEND missing "pybind11 (pybind11-dev)")
endif()
if(NOT missing)
  set(builds_python ON)
  return()
endif()
list(JOIN missing ", " missing)
if(ADSTAR_BUILD_PYTHON STREQUAL "AUTO")
  message(STATUS "adstar for Python: not found: ${missing}; the package is left out; install them, and configure again")
else()
  message(FATAL_ERROR "ADSTAR_BUILD_PYTHON is ON, and not found: ${missing}: install them, or configure with "
    "-DADSTAR_BUILD_PYTHON=AUTO: the package is then left out.")
endif()

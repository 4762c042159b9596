# cmake -DPYTHON=service/python -DHERE=scratch directory -P choice.cmake
# Whether the Python package is built, and what is said where it cannot be.

file(REMOVE_RECURSE ${HERE})
file(MAKE_DIRECTORY ${HERE})

# chosen(FOUND CHOICE CODE TEXT): choose_python.cmake, where find_package() finds that, ends so and says so.
function(chosen found choice expected_code expected_text)
  file(WRITE ${HERE}/choose.cmake "
    macro(find_package)
      foreach(part Interpreter Development.Module NumPy)
        list(FIND FOUND \${part} index)
        if(index GREATER -1)
          set(Python_\${part}_FOUND ON)
        endif()
      endforeach()
    endmacro()
    include(${PYTHON}/choose_python.cmake)
    message(\"builds \${builds_python}\")")
  execute_process(COMMAND ${CMAKE_COMMAND} ${choice} "-DFOUND=${found}" -DADSTAR_PYBIND11=${HERE} ${ARGN} -P ${HERE}/choose.cmake
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  string(REGEX REPLACE "[ \n]+" " " text "${text}")  # messages are wrapped
  if(NOT code EQUAL expected_code OR NOT text MATCHES "${expected_text}")
    message(SEND_ERROR "${found} ${choice} ${ARGN}: ended with ${code} and said\n${text}")
  endif()
endfunction()
set(all "Interpreter;Development.Module;NumPy")
set(auto -DADSTAR_BUILD_PYTHON=AUTO)
chosen("${all}" ${auto} 0 "^builds ON")
chosen("${all}" -DADSTAR_BUILD_PYTHON=ON 0 "^builds ON")
chosen("${all}" -DADSTAR_BUILD_PYTHON=OFF 0 "^builds OFF")
chosen("${all}" ${auto} 0 "^builds OFF" -DADSTAR_SANITIZER=address)
chosen("Interpreter;NumPy" ${auto} 0 "not found: its headers .python3-dev.; .*builds OFF")
chosen("Interpreter" -DADSTAR_BUILD_PYTHON=ON 1 "not found: its headers .python3-dev., NumPy .python3-numpy.: install")
chosen("Interpreter" -DADSTAR_BUILD_PYTHON=OFF 0 "^builds OFF")

# cmake -DDASHBOARD=service/dashboard -DHERE=scratch directory -P page_choice.cmake
# Whether the page is built, and what is said where it cannot be: with npm, without it, and with one whose registry is gone.

file(REMOVE_RECURSE ${HERE})
set(nowhere ${HERE}/nowhere)
foreach(npm good broken)
  set(code 1)
  if(npm STREQUAL "good")
    set(code 0)
  endif()
  file(WRITE ${HERE}/${npm}/npm "#!/bin/sh\nexit ${code}\n")
  file(CHMOD ${HERE}/${npm}/npm PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE)
endforeach()
file(MAKE_DIRECTORY ${nowhere})

# chosen(WHERE CHOICE CODE TEXT): choose_page.cmake with the npm of that folder alone ends so and says so.
file(WRITE ${HERE}/choose.cmake "include(${DASHBOARD}/choose_page.cmake)\nmessage(\"builds \${builds_page}, requires \${requires_page}\")\n")
function(chosen where choice expected_code expected_text)
  execute_process(COMMAND ${CMAKE_COMMAND} ${choice} -DCMAKE_PROGRAM_PATH=${where}
      -DCMAKE_FIND_USE_SYSTEM_ENVIRONMENT_PATH=OFF -DCMAKE_FIND_USE_CMAKE_SYSTEM_PATH=OFF -P ${HERE}/choose.cmake
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  string(REGEX REPLACE "[ \n]+" " " text "${text}")  # messages are wrapped
  if(NOT code EQUAL expected_code OR NOT text MATCHES "${expected_text}")
    message(SEND_ERROR "${where} ${choice}: ended with ${code} and said\n${text}")
  endif()
endfunction()
set(auto -DADSTAR_BUILD_DASHBOARD=AUTO)
chosen(${HERE}/good ${auto} 0 "builds ON, requires OFF")
chosen(${HERE}/good -DADSTAR_BUILD_DASHBOARD=ON 0 "builds ON, requires ON")
chosen(${HERE}/good -DADSTAR_BUILD_DASHBOARD=OFF 0 "builds OFF, requires OFF")
chosen(${nowhere} ${auto} 0 "install nodejs and npm.*builds OFF, requires OFF")
chosen(${nowhere} -DADSTAR_BUILD_DASHBOARD=OFF 0 "builds OFF, requires OFF")
chosen(${nowhere} -DADSTAR_BUILD_DASHBOARD=ON 1 "install nodejs and npm")

# built(REQUIRED CODE): page.cmake with an npm that fails.
function(built required expected_code)
  execute_process(COMMAND ${CMAKE_COMMAND} -DNPM=${HERE}/broken/npm -DFROM=${DASHBOARD}/page -DTO=${HERE}/${required}
      -DREQUIRED=${required} -DFILES=index.html -P ${DASHBOARD}/page.cmake
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  string(REGEX REPLACE "[ \n]+" " " text "${text}")  # messages are wrapped
  if(NOT code EQUAL expected_code OR NOT text MATCHES "npm ci failed")
    message(SEND_ERROR "page.cmake, required ${required}: ended with ${code} and said\n${text}")
  endif()
endfunction()
built(ON 1)
built(OFF 0)
file(STRINGS ${HERE}/OFF/page.cpp without REGEX "return {}")
if(NOT without OR NOT EXISTS ${HERE}/OFF/without)
  message(SEND_ERROR "page.cmake made no page.cpp that does without")
endif()

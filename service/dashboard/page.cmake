# cmake -DNPM=... -DFROM=page sources -DTO=build directory -DFILES=a|b -P page.cmake
# Copies the sources, installs what package-lock.json names, builds, and writes TO/page.cpp.

string(REPLACE "|" ";" FILES "${FILES}")
file(REMOVE_RECURSE ${TO}/src ${TO}/public ${TO}/dist)
foreach(file IN LISTS FILES)
  get_filename_component(directory ${TO}/${file} DIRECTORY)
  file(COPY ${FROM}/${file} DESTINATION ${directory})
endforeach()

function(run what remedy)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${TO}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "The page of adstar dashboard: ${what} failed.\n${text}\n"
      "${remedy}, or configure with -DADSTAR_BUILD_DASHBOARD=OFF: the program is then built without the page.")
  endif()
endfunction()

file(SHA256 ${FROM}/package-lock.json wanted)
set(installed "")
if(EXISTS ${TO}/installed)
  file(READ ${TO}/installed installed)
endif()
if(NOT installed STREQUAL wanted)
  run("npm ci" "Is the npm registry reachable?"
    ${NPM} ci --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error)
  file(WRITE ${TO}/installed ${wanted})
endif()
run("npm run build" "See above" ${NPM} run --silent build)

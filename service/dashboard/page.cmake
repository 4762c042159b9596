# cmake -DNPM=... -DFROM=page sources -DTO=build directory -DREQUIRED=ON|OFF -DFILES=a|b -P page.cmake
# Copies the sources, installs what package-lock.json names, builds, and writes TO/page.cpp. Where the install fails, and
# the page is not required, that is the one without a page, and TO/without stands beside it.

string(REPLACE "|" ";" FILES "${FILES}")
file(REMOVE_RECURSE ${TO}/src ${TO}/public ${TO}/dist)
foreach(file IN LISTS FILES)
  get_filename_component(directory ${TO}/${file} DIRECTORY)
  file(COPY ${FROM}/${file} DESTINATION ${directory})
endforeach()

file(REMOVE ${TO}/without)

# run(WHAT COMMAND...): sets `failure` to what it said, empty when it went well.
function(run what)
  execute_process(COMMAND ${ARGN} WORKING_DIRECTORY ${TO}
    RESULT_VARIABLE code OUTPUT_VARIABLE text ERROR_VARIABLE text)
  if(code EQUAL 0)
    set(failure "" PARENT_SCOPE)
  else()
    set(failure "The page of adstar dashboard: ${what} failed.\n${text}\n" PARENT_SCOPE)
  endif()
endfunction()

file(SHA256 ${FROM}/package-lock.json wanted)
set(installed "")
if(EXISTS ${TO}/installed)
  file(READ ${TO}/installed installed)
endif()
if(NOT installed STREQUAL wanted)
  run("npm ci" ${NPM} ci --ignore-scripts --prefer-offline --no-audit --no-fund --loglevel=error)
  if(failure AND REQUIRED)
    message(FATAL_ERROR "${failure}Is the npm registry reachable? With -DADSTAR_BUILD_DASHBOARD=AUTO the program is built "
      "without the page.")
  elseif(failure)
    message(WARNING "${failure}The program is built without the page. Once the npm registry is reachable, configure and "
      "build again.")
    file(COPY_FILE ${FROM}/../server/no_page.cpp ${TO}/page.cpp)
    file(TOUCH ${TO}/page.cpp ${TO}/without)
    return()
  endif()
  file(WRITE ${TO}/installed ${wanted})
endif()
run("npm run build" ${NPM} run --silent build)
if(failure)
  message(FATAL_ERROR "${failure}See above, or configure with -DADSTAR_BUILD_DASHBOARD=OFF: the program is then built "
    "without the page.")
endif()

# ctest -L style: formatting, links of pages, and Doxygen's warnings. The targets `tidy`: clang-tidy (minutes), and `doc`.

find_program(CLANG_FORMAT NAMES clang-format-14 clang-format)
if(CLANG_FORMAT)
  add_test(NAME style_formatting
    COMMAND ${CMAKE_COMMAND} -DCLANG_FORMAT=${CLANG_FORMAT} -DSOURCE=${PROJECT_SOURCE_DIR}
            -P ${PROJECT_SOURCE_DIR}/tests/support/check_format.cmake)
  set_tests_properties(style_formatting PROPERTIES LABELS style TIMEOUT 120)
endif()

add_test(NAME style_links
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -P ${PROJECT_SOURCE_DIR}/tests/support/check_links.cmake)
set_tests_properties(style_links PROPERTIES LABELS style TIMEOUT 60)

# The tests themselves are left out: their dependencies' templates take clang-tidy a minute each. bits_main.cpp
# brings in every header of the core.
find_program(RUN_CLANG_TIDY NAMES run-clang-tidy-14 run-clang-tidy)
if(RUN_CLANG_TIDY)
  add_custom_target(tidy
    COMMAND ${RUN_CLANG_TIDY} -quiet -p ${PROJECT_BINARY_DIR}
            "${PROJECT_SOURCE_DIR}/(service/.*|tests/conformance/bits_main)[.]cpp$$"
    USES_TERMINAL)
endif()

# The pages of adstar::core, below build/<preset>/doc/html; a warning fails.
find_program(DOXYGEN NAMES doxygen)
if(DOXYGEN)
  configure_file(${PROJECT_SOURCE_DIR}/include/adstar/Doxyfile.in ${PROJECT_BINARY_DIR}/Doxyfile @ONLY)
  file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/doc)
  add_custom_target(doc COMMAND ${DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile)
  add_test(NAME style_doxygen COMMAND ${DOXYGEN} ${PROJECT_BINARY_DIR}/Doxyfile)
  set_tests_properties(style_doxygen PROPERTIES LABELS style TIMEOUT 120)
endif()

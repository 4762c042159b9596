# Runs the benchmark with the commit and the processor in its JSON context.
execute_process(COMMAND git -C ${SOURCE} describe --always --dirty --abbrev=12
  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
file(STRINGS /proc/cpuinfo processor LIMIT_COUNT 1 REGEX "^model name")
string(REGEX REPLACE "^[^:]*: *" "" processor "${processor}")
execute_process(
  COMMAND ${PROGRAM} --benchmark_out=${OUTPUT} --benchmark_out_format=json
          "--benchmark_context=commit=${commit},cpu=${processor}"
  RESULT_VARIABLE status COMMAND_ECHO NONE)
if(NOT status EQUAL 0)
  message(FATAL_ERROR "${PROGRAM} ended with ${status}")
endif()
message("Written: ${OUTPUT}")

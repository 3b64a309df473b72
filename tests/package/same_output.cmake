# cmake -D FIRST=<program> -D SECOND=<program> -D ARGUMENT=<file> -P same_output.cmake
# Fails unless both programs succeed and print the same bytes, and any at all.
foreach(program IN ITEMS FIRST SECOND)
  execute_process(COMMAND "${${program}}" "${ARGUMENT}" OUTPUT_VARIABLE ${program}_output RESULT_VARIABLE status)
  if(NOT status EQUAL 0)
    message(FATAL_ERROR "${${program}} failed: ${status}")
  endif()
endforeach()
if(FIRST_output STREQUAL "")
  message(FATAL_ERROR "${FIRST} prints nothing")
endif()
if(NOT FIRST_output STREQUAL SECOND_output)
  message(FATAL_ERROR "${FIRST} and ${SECOND} differ:\n${FIRST_output}\n${SECOND_output}")
endif()

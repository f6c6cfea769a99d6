# Writes the CTest file of a GoogleTest program, one test a suite:
#   cmake -D PROGRAM=file -D NAME=component -D FIRST=suites -D SLOW=suites -D PROPERTIES=list
#         -D OUTPUT=file -P suites.cmake
# A test of its own for every case would start the programs some thousand times, and what they link
# takes longer to load than most cases.
cmake_minimum_required(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} --gtest_list_tests OUTPUT_VARIABLE listing
                COMMAND_ERROR_IS_FATAL ANY)
# Suites stand at the beginning of a line, "Suite." or "Suite.  # …"; their cases are indented.
string(REGEX MATCHALL "\n[A-Za-z0-9_/]+\\." heads "\n${listing}")
if(NOT heads)
  message(FATAL_ERROR "${PROGRAM}: no suite found")
endif()
set(script "")
foreach(head IN LISTS heads)
  string(REGEX REPLACE "\n(.*)\\." "\\1" suite "${head}")
  string(APPEND script "add_test(\"${NAME}.${suite}\" \"${PROGRAM}\" \"--gtest_filter=${suite}.*\")\n")
  set(properties ${PROPERTIES})
  if(suite IN_LIST FIRST)
    list(APPEND properties COST 1000)
    list(REMOVE_ITEM FIRST ${suite})
  endif()
  if(suite IN_LIST SLOW)
    list(APPEND properties LABELS slow)
    list(REMOVE_ITEM SLOW ${suite})
  endif()
  if(properties)
    list(JOIN properties " " properties)
    string(APPEND script "set_tests_properties(\"${NAME}.${suite}\" PROPERTIES ${properties})\n")
  endif()
endforeach()
if(FIRST OR SLOW)
  message(FATAL_ERROR "${PROGRAM}: no suite ${FIRST} ${SLOW}")
endif()
file(WRITE ${OUTPUT} "${script}")

# Script: writes OUTPUT, a file for CTest with one test for each suite of the GoogleTest PROGRAM.
#   cmake -DNAME=... -DPROGRAM=... -DOUTPUT=... -DPROPERTIES=... -P suites.cmake
# A test for each case would start the program, which sets up GiNaC and loads libraries, two thousand
# times.
execute_process(COMMAND ${PROGRAM} --gtest_list_tests
  OUTPUT_VARIABLE listed COMMAND_ERROR_IS_FATAL ANY)
string(REGEX REPLACE "#[^\n]*" "" listed "\n${listed}")  # values of parameters
string(REGEX MATCHALL "\n[^ \n]+\\." suites "${listed}")
set(text "")
foreach(suite IN LISTS suites)
  string(STRIP "${suite}" suite)
  string(REGEX REPLACE "\\.$" "" suite "${suite}")
  string(APPEND text "add_test([=[${NAME}.${suite}]=] [=[${PROGRAM}]=] [=[--gtest_filter=${suite}.*]=])\n"
    "set_tests_properties([=[${NAME}.${suite}]=] PROPERTIES ${PROPERTIES})\n")
endforeach()
file(WRITE "${OUTPUT}" "${text}")

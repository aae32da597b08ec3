# Read by CTest: adds each suite of `program`, a program of GoogleTest's, as a test. A program that is
# not there, does not start or has no test is a test that fails.
execute_process(COMMAND ${program} --gtest_list_tests OUTPUT_VARIABLE listed RESULT_VARIABLE failed
  ERROR_QUIET)
string(REGEX MATCHALL "\n[^ \n][^ \n]*\\.[ \n]" suites "\n${listed}")
if(failed OR NOT suites)
  get_filename_component(name ${program} NAME)
  add_test(${name} ${program})
  set_tests_properties(${name} PROPERTIES FAIL_REGULAR_EXPRESSION "Running 0 tests")
endif()
foreach(suite IN LISTS suites)
  string(REGEX REPLACE "[ \n]|\\.[ \n]$" "" suite "${suite}")
  add_test(${suite} ${program} --gtest_filter=${suite}.*)
  # The same properties each time; a run by hand without RC_PARAMS draws others. The timeout only
  # ends what hangs: some suites take a minute of a quiet machine.
  set_tests_properties(${suite} PROPERTIES ENVIRONMENT RC_PARAMS=seed=1 TIMEOUT 7200
    FAIL_REGULAR_EXPRESSION "Running 0 tests")
endforeach()

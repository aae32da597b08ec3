# touchstone_test(NAME room_test SOURCES a_test.cpp … LIBRARIES …): one test program, every TEST of
# which CTest knows by its name.
function(touchstone_test)
  if(NOT TOUCHSTONE_TESTS)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 0 TEST "" "NAME" "SOURCES;LIBRARIES")
  add_executable(${TEST_NAME} ${TEST_SOURCES})
  target_link_libraries(${TEST_NAME} PRIVATE ${TEST_LIBRARIES} GTest::gmock GTest::gtest_main
                                             touchstone_warnings)
  use_precompiled(${TEST_NAME} touchstone_test_headers)
  # The same properties each time; a run by hand without RC_PARAMS draws others.
  gtest_discover_tests(${TEST_NAME} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 600
                       PROPERTIES ENVIRONMENT RC_PARAMS=seed=1)
endfunction()

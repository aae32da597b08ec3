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
  target_precompile_headers(${TEST_NAME} REUSE_FROM touchstone_test_headers)
  target_compile_options(${TEST_NAME} PRIVATE ${OF_TESTS})
  gtest_discover_tests(${TEST_NAME} DISCOVERY_MODE PRE_TEST DISCOVERY_TIMEOUT 600)
endfunction()

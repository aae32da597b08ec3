# touchstone_test(NAME room_test SOURCES a_test.cpp … LIBRARIES …): one test program, each suite of
# which is a test of CTest's: one process for each TEST would cost the set a tenth of its time.
function(touchstone_test)
  if(NOT TOUCHSTONE_TESTS)
    return()
  endif()
  cmake_parse_arguments(PARSE_ARGV 0 TEST "" "NAME" "SOURCES;LIBRARIES")
  add_executable(${TEST_NAME} ${TEST_SOURCES})
  target_link_libraries(${TEST_NAME} PRIVATE ${TEST_LIBRARIES} GTest::gmock GTest::gtest_main
                                             touchstone_warnings)
  use_precompiled(${TEST_NAME} touchstone_test_headers)
  set(tests ${CMAKE_CURRENT_BINARY_DIR}/${TEST_NAME}.cmake)
  file(GENERATE OUTPUT ${tests} CONTENT
    "set(program \"$<TARGET_FILE:${TEST_NAME}>\")\ninclude(\"${CMAKE_CURRENT_FUNCTION_LIST_DIR}/suites.cmake\")\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${tests})
endfunction()

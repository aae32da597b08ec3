# Headers of other projects that most sources include, parsed once for all of them: for libraries and
# the program, and for tests. A precompiled header serves those who see the same definitions.
# Sources include what they need all the same: clang-tidy reads them without (preset lint).
add_compile_definitions($<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)

# precompiled(TARGET LIBRARIES … HEADERS …): a target whose precompiled header others can reuse.
function(precompiled target)
  cmake_parse_arguments(PARSE_ARGV 1 PRECOMPILED "" "" "LIBRARIES;HEADERS")
  set(source ${PROJECT_BINARY_DIR}/${target}.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(${target} OBJECT ${source})
  target_link_libraries(${target} PRIVATE ${PRECOMPILED_LIBRARIES})
  target_precompile_headers(${target} PRIVATE ${PRECOMPILED_HEADERS})
endfunction()

set(COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
  <memory> <numbers> <optional> <random> <set> <span> <sstream> <stdexcept> <string> <string_view>
  <tuple> <utility> <variant> <vector>
  <Eigen/Geometry> <fmt/format.h> <fmt/ranges.h> <gmpxx.h> <nlohmann/json.hpp>)
set(COMMON_LIBRARIES Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)

precompiled(touchstone_headers
  LIBRARIES ${COMMON_LIBRARIES} touchstone_warnings
  HEADERS ${COMMON_HEADERS})
if(TOUCHSTONE_TESTS)
  precompiled(touchstone_test_headers
    LIBRARIES ${COMMON_LIBRARIES} touchstone_warnings GTest::gmock
    HEADERS ${COMMON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
endif()

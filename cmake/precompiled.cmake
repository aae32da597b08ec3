# Headers of other projects that most sources include, parsed once for all of them. A precompiled header
# serves those who see the same definitions.
# Sources include what they need all the same: clang-tidy reads them without (preset lint).
#
# g++ takes the options of code generation (-O, -f, -m) from the precompiled header, too, and forgets
# those of the source without a word. So they are given to a header and to all who reuse it alike
# (precompiled_test.py looks), and a target that needs others of its own (-frounding-math) has none.
add_compile_definitions($<TARGET_PROPERTY:fmt::fmt,INTERFACE_COMPILE_DEFINITIONS>)

# precompiled(NAME OPTIONS … LIBRARIES … HEADERS …): a header for use_precompiled.
function(precompiled target)
  cmake_parse_arguments(PARSE_ARGV 1 PRECOMPILED "" "" "OPTIONS;LIBRARIES;HEADERS")
  set(source ${PROJECT_BINARY_DIR}/${target}.cpp)
  if(NOT EXISTS ${source})
    file(WRITE ${source} "")
  endif()
  add_library(${target} OBJECT ${source})
  target_link_libraries(${target} PRIVATE ${PRECOMPILED_LIBRARIES})
  target_compile_options(${target} PRIVATE ${PRECOMPILED_OPTIONS})
  target_precompile_headers(${target} PRIVATE ${PRECOMPILED_HEADERS})
  set_property(TARGET ${target} PROPERTY TOUCHSTONE_OPTIONS "${PRECOMPILED_OPTIONS}")
endfunction()

# use_precompiled(TARGET NAME): compiles TARGET with that header and its options.
function(use_precompiled target name)
  get_property(options TARGET ${name} PROPERTY TOUCHSTONE_OPTIONS)
  target_compile_options(${target} PRIVATE ${options})
  target_precompile_headers(${target} REUSE_FROM ${name})
endfunction()

set(COMMON_HEADERS
  <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <limits> <map>
  <memory> <numbers> <optional> <random> <set> <span> <sstream> <stdexcept> <string> <string_view>
  <tuple> <utility> <variant> <vector>
  <Eigen/Geometry> <fmt/format.h> <fmt/ranges.h> <gmpxx.h> <nlohmann/json.hpp>)
set(COMMON_LIBRARIES Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json)

# The same configuration must have the same bits on every machine: no fused multiply-add. GCC 12's
# superword vectoriser makes some (vfmaddsub, with -mfma) even where contraction is off.
set(SAME_BITS -ffp-contract=off -fno-tree-slp-vectorize)
# What reads, writes, prints and draws configurations takes half as long to compile at -Og, and no longer
# to run beside the truths and answers that it is run for.
set(RARELY_RUN ${SAME_BITS} $<$<CONFIG:Release,Sanitized>:-Og>)

precompiled(touchstone_writer_headers
  OPTIONS ${RARELY_RUN}
  LIBRARIES ${COMMON_LIBRARIES} touchstone_warnings
  HEADERS ${COMMON_HEADERS})
# Modules export what is marked and nothing else.
precompiled(touchstone_plugin_headers
  OPTIONS ${SAME_BITS} -fvisibility=hidden -fvisibility-inlines-hidden
  LIBRARIES Eigen3::Eigen touchstone_warnings
  HEADERS <algorithm> <array> <cmath> <limits> <memory> <optional> <string> <utility> <vector>
    <Eigen/Geometry>)
if(TOUCHSTONE_TESTS)
  precompiled(touchstone_test_headers
    OPTIONS ${RARELY_RUN}
    LIBRARIES ${COMMON_LIBRARIES} touchstone_warnings GTest::gmock
    HEADERS ${COMMON_HEADERS} <gmock/gmock.h> <gtest/gtest.h>)
endif()

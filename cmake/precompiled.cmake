# touchstone_precompile(TARGET …): headers that most sources read are parsed once, which takes about a
# quarter off a first build. Every source includes what it uses all the same: the preset `sanitizers`
# builds without this.
file(WRITE ${PROJECT_BINARY_DIR}/precompiled.cpp "")
add_library(touchstone_precompiled OBJECT ${PROJECT_BINARY_DIR}/precompiled.cpp)
set(PRECOMPILED_LIBRARIES Eigen3::Eigen fmt::fmt nlohmann_json::nlohmann_json touchstone_warnings)
target_link_libraries(touchstone_precompiled PRIVATE ${PRECOMPILED_LIBRARIES})
target_precompile_headers(touchstone_precompiled PRIVATE
  <algorithm> <array> <cmath> <filesystem> <functional> <map> <memory> <optional> <string> <variant>
  <vector> <fmt/format.h> <nlohmann/json.hpp> <Eigen/Geometry>)

function(touchstone_precompile)
  foreach(target IN LISTS ARGN)
    target_link_libraries(${target} PRIVATE ${PRECOMPILED_LIBRARIES})
    target_precompile_headers(${target} REUSE_FROM touchstone_precompiled)
  endforeach()
endfunction()

# Every target of ours links `touchstone_warnings`; headers of other projects are system headers.
add_library(touchstone_warnings INTERFACE)
target_compile_options(touchstone_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wno-sign-conversion
  $<$<BOOL:${TOUCHSTONE_WARNINGS_AS_ERRORS}>:-Werror>)
# In a unity build a name within one source may hide one of another, and a class may keep what is
# another source's alone: neither is a fault there. The build by single sources sees to them.
if(CMAKE_UNITY_BUILD)
  target_compile_options(touchstone_warnings INTERFACE -Wshadow=local $<$<COMPILE_LANGUAGE:CXX>:-Wno-subobject-linkage>)
else()
  target_compile_options(touchstone_warnings INTERFACE -Wshadow)
endif()

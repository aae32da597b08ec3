# Every target of ours links `touchstone_warnings`; headers of other projects are system headers.
add_library(touchstone_warnings INTERFACE)
target_compile_options(touchstone_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
  $<$<BOOL:${TOUCHSTONE_WARNINGS_AS_ERRORS}>:-Werror>)

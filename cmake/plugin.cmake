# touchstone_plugin(NAME SOURCES a.cpp … LIBRARIES …): a plug-in touchstone-NAME.so that exports
# touchstone_plugin and nothing else, and binds its own symbols first. HEADERS: another precompiled
# header than that of plug-ins.
function(touchstone_plugin name)
  cmake_parse_arguments(PARSE_ARGV 1 PLUGIN "" "HEADERS" "SOURCES;LIBRARIES;DEFINITIONS")
  add_library(plugin_${name} MODULE ${PLUGIN_SOURCES})
  set_target_properties(plugin_${name} PROPERTIES
    PREFIX "" OUTPUT_NAME touchstone-${name}
    LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/candidates)
  target_include_directories(plugin_${name} PRIVATE ${PROJECT_SOURCE_DIR})
  target_compile_definitions(plugin_${name} PRIVATE ${PLUGIN_DEFINITIONS})
  target_link_libraries(plugin_${name} PRIVATE ${PLUGIN_LIBRARIES} touchstone_warnings)
  if(NOT PLUGIN_HEADERS)
    set(PLUGIN_HEADERS touchstone_plugin_headers)
  endif()
  use_precompiled(plugin_${name} ${PLUGIN_HEADERS})
  target_link_options(plugin_${name} PRIVATE LINKER:-Bsymbolic LINKER:--exclude-libs,ALL)
  install(TARGETS plugin_${name} LIBRARY DESTINATION lib/touchstone)
  set_property(GLOBAL APPEND PROPERTY TOUCHSTONE_PLUGINS plugin_${name})
endfunction()

# embed_texts(OUT FILE…): a C++ source OUT with the text of each FILE as a string constant of namespace
# touchstone, named after it: page_js of page.js, bullet_template of bullet.in.
if(NOT CMAKE_SCRIPT_MODE_FILE)
  set(EMBED_SCRIPT ${CMAKE_CURRENT_LIST_FILE} CACHE INTERNAL "")
  function(embed_texts out)
    string(REPLACE ";" "," files "${ARGN}")
    add_custom_command(
      OUTPUT ${out}
      COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DFILES=${files} -P ${EMBED_SCRIPT}
      WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
      DEPENDS ${ARGN} ${EMBED_SCRIPT}
      VERBATIM)
    set_source_files_properties(${out} PROPERTIES
      SKIP_UNITY_BUILD_INCLUSION ON SKIP_PRECOMPILE_HEADERS ON)
  endfunction()
  return()
endif()

# As a script: raw strings hold up to 16000 characters each; adjacent ones are one.
string(REPLACE "," ";" FILES "${FILES}")
set(text "#include <string_view>\n\nnamespace touchstone {\n\n")
foreach(file IN LISTS FILES)
  get_filename_component(name ${file} NAME)
  string(REGEX REPLACE "\\.in$" "_template" name ${name})
  string(REPLACE "." "_" name ${name})
  file(READ ${file} content)
  string(LENGTH "${content}" length)
  string(APPEND text "extern const std::string_view ${name};\nconst std::string_view ${name} =\n")
  set(at 0)
  while(at LESS length)
    string(SUBSTRING "${content}" ${at} 16000 piece)
    string(APPEND text "R\"text~(${piece})text~\"\n")
    math(EXPR at "${at} + 16000")
  endwhile()
  string(APPEND text ";\n\n")
endforeach()
string(APPEND text "}  // namespace touchstone\n")
file(WRITE ${OUT} "${text}")

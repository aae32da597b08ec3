# embed_page(OUT FILE…): a source file OUT with the text of each FILE (see embed.cmake).
set(EMBED ${CMAKE_CURRENT_LIST_DIR}/embed.cmake CACHE INTERNAL "")
function(embed_page out)
  string(REPLACE ";" "," files "${ARGN}")
  add_custom_command(
    OUTPUT ${out}
    COMMAND ${CMAKE_COMMAND} -DOUT=${out} -DFILES=${files} -P ${EMBED}
    WORKING_DIRECTORY ${CMAKE_CURRENT_SOURCE_DIR}
    DEPENDS ${ARGN} ${EMBED}
    VERBATIM)
endfunction()

# cmake -DOUT=… -DFOLDER=… -P embed.cmake: the folder's templates as string constants.
set(text "#include <string_view>\n\nnamespace touchstone {\n\n")
foreach(name head question judgement bullet ode fcl libccd mujoco)
  file(READ ${FOLDER}/${name}.in content)
  string(APPEND text "extern const std::string_view ${name}_template;\n")
  string(APPEND text "const std::string_view ${name}_template =\nR\"in~(${content})in~\";\n\n")
endforeach()
string(APPEND text "}  // namespace touchstone\n")
file(WRITE ${OUT} "${text}")

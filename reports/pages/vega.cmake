# cmake -DOUT=… -DFOLDER=… -DCOPYRIGHT=… -P vega.cmake: Vega from the modules that Debian's libjs-vega installs, as one
# script that defines `vega`. Each is a CommonJS module too; those for maps, forces, trees and words stay out.
set(MODULES canvas dataflow encode event-selector expression format functions interpreter label loader parser
  runtime scale scenegraph selection statistics time transforms util view view-transforms)
# Its terms ask for its copyright to go with it.
file(READ ${COPYRIGHT} copyright)
string(REPLACE "\n" "\n// " copyright "${copyright}")
set(text "// ${copyright}\nconst vega = (() => {\nconst modules = {}, loaded = {};\n")
foreach(module IN LISTS MODULES)
  file(READ ${FOLDER}/vega-${module}.min.js content)
  string(REGEX REPLACE "//# sourceMappingURL=[^\n]*" "" content "${content}")
  string(APPEND text "modules['vega-${module}'] = function (exports, module) {\n${content}\n};\n")
endforeach()
string(APPEND text "function require(name) {
  if (name === 'vega-selections') name = 'vega-selection';  // Debian's name for it
  if (!loaded[name]) {
    const module = {exports: loaded[name] = {}};
    modules[name](module.exports, module);
  }
  return loaded[name];
}
const {transforms} = require('vega-dataflow');
for (const name of ['transforms', 'view-transforms', 'encode', 'label']) Object.assign(transforms, require('vega-' + name));
return {...require('vega-view'), ...require('vega-parser'), ...require('vega-interpreter')};
})();
")
file(WRITE ${OUT} "${text}")

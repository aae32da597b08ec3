# Read by cpack: there is no package of the Python module where that is not built, as after a build of
# the program alone.
if(NOT EXISTS "${CPACK_PYTHON_MODULE}")
  list(REMOVE_ITEM CPACK_COMPONENTS_ALL touchstone_python)
endif()

# cpack --config build/release/CPackConfig.cmake: a Debian package of the program, its plug-ins and
# the reference library, and one of the Python module where that is built (package_components.cmake). They depend on what their
# files are linked with, as dpkg-shlibdeps says.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME touchstone)
set(CPACK_PACKAGE_CONTACT "Touchstone maintainers")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_COMPRESSION_TYPE zstd)  # a third smaller than by gzip, in less time
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For those who compile against the library or plug-ins of their own, or check a certificate.
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, libeigen3-dev, python3")
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_PROJECT_CONFIG_FILE ${CMAKE_CURRENT_LIST_DIR}/package_components.cmake)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME touchstone)
set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-touchstone)  # python/ says what it depends on
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
include(CPack)
cpack_add_component_group(program)
cpack_add_component(Unspecified GROUP program)
cpack_add_component(touchstone_reference GROUP program)
if(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS)
  cpack_add_component_group(python)
  cpack_add_component(touchstone_python GROUP python)
endif()

install(FILES LICENSE DESTINATION share/doc/touchstone RENAME copyright)
install(FILES reference/LICENSE DESTINATION share/doc/touchstone RENAME copyright.reference)
# The pages that the program names, with those that they link to.
install(DIRECTORY docs DESTINATION share/doc/touchstone)
foreach(page README.md CONTRIBUTING.md candidates/host/protocol.md oracle/truth.md oracle/audit/README.md
             reference/README.md reference/proofs.md suite/README.md)
  get_filename_component(page_folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION share/doc/touchstone/${page_folder})
endforeach()
install(PROGRAMS oracle/check_certificate.py DESTINATION share/touchstone)
install(DIRECTORY simulation/scenes/ DESTINATION share/touchstone/scenes
  FILES_MATCHING REGEX "[.](json|urdf|sdf|config|xml|stl|dae|obj)$")

# The package as a user gets it. Without dpkg-dev there is none to be made.
find_program(DPKG_SHLIBDEPS dpkg-shlibdeps)
if(TOUCHSTONE_TESTS AND DPKG_SHLIBDEPS)
  add_test(NAME package COMMAND ${CMAKE_CURRENT_LIST_DIR}/package_test.sh ${PROJECT_BINARY_DIR})
  set_tests_properties(package PROPERTIES COST 100)
endif()

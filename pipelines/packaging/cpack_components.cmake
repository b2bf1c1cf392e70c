# Read by cpack once per generator.
if(CPACK_GENERATOR STREQUAL "DEB")
  list(FILTER CPACK_COMPONENTS_ALL EXCLUDE REGEX "_libraries$")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
else()
  set(CPACK_COMPONENT_INCLUDE_TOPLEVEL_DIRECTORY ON)  # an archive unpacks into a folder of its own
endif()

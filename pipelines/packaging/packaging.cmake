# `cmake --install` and `cpack` make two components, nightbake and nightview, so that nightview's package needs neither
# CGAL nor GDAL. A DEB takes its libraries from the system; a TGZ brings them, to run where nothing is installed.

set(packaging ${CMAKE_SOURCE_DIR}/pipelines/packaging)

# DT_RPATH, not DT_RUNPATH: only the former also serves the libraries of the libraries.
function(nightcity_install program)
  # In the build folder too: otherwise CMake reserves room for it there with empty elements, and an empty element is the
  # current folder, whose libz.so.1 would be loaded.
  set_target_properties(${program} PROPERTIES INSTALL_RPATH "$ORIGIN/../lib" BUILD_WITH_INSTALL_RPATH ON)
  target_link_options(${program} PRIVATE -Wl,--disable-new-dtags)
  install(TARGETS ${program} RUNTIME_DEPENDENCY_SET ${program}_dependencies
          RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT ${program})
  set(papers ${CMAKE_INSTALL_DATAROOTDIR}/doc/${program})
  install(FILES README.md CHANGELOG.md NOTICE LICENSE formats/SPEC.md DESTINATION ${papers} COMPONENT ${program})
  install(FILES ${packaging}/copyright.${program} DESTINATION ${papers} RENAME copyright COMPONENT ${program})

  # The program writes its own manual pages, from the declarations that --help prints.
  set(pages ${CMAKE_BINARY_DIR}/man/${program})
  add_custom_command(OUTPUT ${pages}/${program}.1
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${pages}
    COMMAND ${program} --man-pages ${pages}
    DEPENDS ${program} COMMENT "Writing the manual pages of ${program}" VERBATIM)
  add_custom_target(${program}_man_pages ALL DEPENDS ${pages}/${program}.1)
  install(DIRECTORY ${pages}/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${program}
          OPTIONAL)  # absent if only the program was built

  # The C++ runtime and the libraries of graphics drivers must be the system's: an older copy of ours would be loaded
  # into the driver. Plain `cmake --install` leaves libraries out: only the TGZ needs them.
  set(system_libraries "^ld-linux" "^lib(c|m|dl|rt|pthread|resolv|stdc\\+\\+|gcc_s)\\.so")
  if(program STREQUAL "nightview")
    list(APPEND system_libraries "^libvulkan" "^lib(z|expat|zstd|drm|X|xcb|wayland|ffi|elf|LLVM)")
  endif()
  install(RUNTIME_DEPENDENCY_SET ${program}_dependencies PRE_EXCLUDE_REGEXES ${system_libraries}
          LIBRARY DESTINATION lib COMPONENT ${program}_libraries EXCLUDE_FROM_ALL)
  install(CODE "set(libraries_of \"${program}\")\nset(library_papers \"${papers}/libraries\")"
          COMPONENT ${program}_libraries EXCLUDE_FROM_ALL)
  install(SCRIPT ${packaging}/library_papers.cmake COMPONENT ${program}_libraries EXCLUDE_FROM_ALL)
endfunction()

if(TARGET nightbake)
  nightcity_install(nightbake)
  install(DIRECTORY pipelines/ DESTINATION ${CMAKE_INSTALL_DATADIR}/nightcity/recipes COMPONENT nightbake
          FILES_MATCHING PATTERN "*.toml" PATTERN packaging EXCLUDE)
  # PROJ looks for its database beside its own library: lib/../share/proj.
  install(DIRECTORY /usr/share/proj DESTINATION share COMPONENT nightbake_libraries EXCLUDE_FROM_ALL
          FILES_MATCHING PATTERN proj.db PATTERN proj.ini)
endif()
if(TARGET nightview)
  nightcity_install(nightview)
endif()

set(CPACK_PACKAGE_NAME nightcity)
set(CPACK_PACKAGE_VENDOR "the nightcity authors")
set(CPACK_PACKAGE_CONTACT "nightcity maintainers <maintainers@nightcity.invalid>"
    CACHE STRING "Who answers for a package that is handed on")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGE_DIRECTORY ${CMAKE_BINARY_DIR}/packages)
set(CPACK_GENERATOR DEB TGZ)
set(CPACK_STRIP_FILES ON)
set(CPACK_THREADS 0)
set(CPACK_PROJECT_CONFIG_FILE ${packaging}/cpack_components.cmake)

set(CPACK_ARCHIVE_COMPONENT_INSTALL ON)
set(CPACK_ARCHIVE_NIGHTBAKE_FILE_NAME nightbake-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})
set(CPACK_ARCHIVE_NIGHTVIEW_FILE_NAME nightview-${PROJECT_VERSION}-${CMAKE_SYSTEM_NAME}-${CMAKE_SYSTEM_PROCESSOR})

set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_NIGHTBAKE_PACKAGE_NAME nightbake)
set(CPACK_DEBIAN_NIGHTBAKE_PACKAGE_SECTION science)
set(CPACK_DEBIAN_NIGHTBAKE_PACKAGE_DEPENDS proj-data)
set(CPACK_DEBIAN_NIGHTBAKE_PACKAGE_SUGGESTS nightview)
set(CPACK_DEBIAN_NIGHTVIEW_PACKAGE_NAME nightview)
set(CPACK_DEBIAN_NIGHTVIEW_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_NIGHTVIEW_PACKAGE_RECOMMENDS mesa-vulkan-drivers)
set(CPACK_DEBIAN_NIGHTVIEW_PACKAGE_SUGGESTS nightbake)

include(CPack)
cpack_add_component_group(nightbake)
cpack_add_component_group(nightview)
cpack_add_component(nightbake GROUP nightbake DESCRIPTION
  "nightbake turns CityGML and OpenStreetMap into city.glb and city.lights: buildings, terrain, and\nevery lamp with its lumens. The built program is under the GPL-3.0-or-later, through CGAL.")
cpack_add_component(nightview GROUP nightview DESCRIPTION
  "nightview renders city.glb and city.lights by ReSTIR on any Vulkan device, in cd/m2, and measures\npictures against a reference that samples every light.")
cpack_add_component(nightbake_libraries GROUP nightbake)
cpack_add_component(nightview_libraries GROUP nightview)

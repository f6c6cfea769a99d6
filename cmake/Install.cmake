# `cmake --install`: the program with its shaders, scenes, schemas, manual and licence, and the
# library libgnomon with the headers of validate/api and a find_package(Gnomon) configuration, which
# gives gnomon::gnomon.

include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Gnomon)
install(TARGETS gnomon)
install(TARGETS gnomon_api EXPORT Gnomon INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
file(GLOB headers CONFIGURE_DEPENDS validate/api/*.h)
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon)
install(DIRECTORY shaders scenes schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon)
# The errors that `gnomon rank` joins a shader's own with.
install(FILES results/suites.csv DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon/results)
foreach(suite suite-1 suite-2)
  install(FILES results/${suite}/suite.csv
          DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon/results/${suite})
endforeach()
install(DIRECTORY docs/ DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon RENAME copyright)
install(FILES CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/gnomon)

# What the program itself says of its commands and options.
add_custom_command(OUTPUT ${PROJECT_BINARY_DIR}/gnomon.1 DEPENDS gnomon
  COMMAND gnomon list manual-page > ${PROJECT_BINARY_DIR}/gnomon.1)
add_custom_target(gnomon_help ALL DEPENDS ${PROJECT_BINARY_DIR}/gnomon.1)
# Everything that is installed, without tests.
add_custom_target(gnomon_installed DEPENDS gnomon gnomon_api gnomon_openimageio gnomon_help)
install(FILES ${PROJECT_BINARY_DIR}/gnomon.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
install(EXPORT Gnomon NAMESPACE gnomon:: FILE GnomonConfig.cmake DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake DESTINATION ${package_folder})

# `cmake --install`: the program with its shaders, and the library libgnomon with the headers of
# validate/api and a find_package(Gnomon) configuration, which gives gnomon::gnomon.

include(CMakePackageConfigHelpers)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Gnomon)
install(TARGETS gnomon)
install(TARGETS gnomon_api EXPORT Gnomon INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
file(GLOB headers CONFIGURE_DEPENDS validate/api/*.h)
install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon)
install(DIRECTORY shaders DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon)
install(EXPORT Gnomon NAMESPACE gnomon:: FILE GnomonConfig.cmake DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake DESTINATION ${package_folder})

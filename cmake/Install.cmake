# `cmake --install`: the program with its shaders, and the libraries with headers and a
# find_package(Gnomon) configuration. gnomon::gnomon is the umbrella over all components.

include(CMakePackageConfigHelpers)

get_property(components GLOBAL PROPERTY GNOMON_COMPONENTS)
add_library(gnomon_umbrella INTERFACE)
add_library(gnomon::gnomon ALIAS gnomon_umbrella)
set_target_properties(gnomon_umbrella PROPERTIES EXPORT_NAME gnomon)
target_link_libraries(gnomon_umbrella INTERFACE ${components})

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/Gnomon)
install(TARGETS gnomon)
install(TARGETS ${components} gnomon_umbrella EXPORT GnomonTargets)
install(DIRECTORY validate/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gnomon
        FILES_MATCHING PATTERN "*.h")
install(DIRECTORY shaders DESTINATION ${CMAKE_INSTALL_DATADIR}/gnomon)
install(EXPORT GnomonTargets NAMESPACE gnomon:: DESTINATION ${package_folder})

configure_package_config_file(cmake/GnomonConfig.cmake.in
  ${PROJECT_BINARY_DIR}/GnomonConfig.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/GnomonConfig.cmake
  ${PROJECT_BINARY_DIR}/GnomonConfigVersion.cmake cmake/BrokenPackages.cmake
  DESTINATION ${package_folder})

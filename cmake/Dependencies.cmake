# Every outside library, found once. Packages whose own configuration is broken or absent on
# Debian 12 get an imported target here.

find_package(Threads REQUIRED)
find_package(glm REQUIRED)
find_package(fmt REQUIRED)
find_package(TBB REQUIRED)
find_package(tomlplusplus REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(CLI11 REQUIRED)
find_package(pugixml REQUIRED)
find_package(tinyobjloader REQUIRED)
find_package(glfw3 REQUIRED)
find_package(hwy REQUIRED)
find_package(PNG REQUIRED)
find_package(OpenSSL REQUIRED COMPONENTS Crypto)
include(${CMAKE_CURRENT_LIST_DIR}/BrokenPackages.cmake)
include(${CMAKE_CURRENT_LIST_DIR}/ImagePackages.cmake)

# Dear ImGui ships a pkg-config file only; only the viewer needs it, so it is not installed.
find_path(IMGUI_INCLUDE_DIR imgui.h PATH_SUFFIXES imgui REQUIRED)
find_library(IMGUI_LIBRARY imgui REQUIRED)
find_library(STB_LIBRARY stb REQUIRED)
add_library(gnomon::ImGui UNKNOWN IMPORTED)
set_target_properties(gnomon::ImGui PROPERTIES
  IMPORTED_LOCATION ${IMGUI_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES ${IMGUI_INCLUDE_DIR}
  INTERFACE_LINK_LIBRARIES "${STB_LIBRARY};${CMAKE_DL_LIBS};glfw")

if(BUILD_TESTING)
  find_package(GTest REQUIRED)
  find_package(benchmark REQUIRED)
  find_path(RAPIDCHECK_INCLUDE_DIR rapidcheck.h REQUIRED)
  find_library(RAPIDCHECK_LIBRARY rapidcheck REQUIRED)
endif()

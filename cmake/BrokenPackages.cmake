# Imported targets for libraries that a plain find_package cannot serve on Debian 12.

# gnomon_import(NAME HEADER LIBRARY [folder…]): the library as gnomon::NAME, found by a header of its
# own, which may be in one of the given folders.
function(gnomon_import name header library)
  find_path(${name}_INCLUDE_DIR ${header} PATH_SUFFIXES ${ARGN} REQUIRED)
  find_library(${name}_LIBRARY ${library} REQUIRED)
  add_library(gnomon::${name} UNKNOWN IMPORTED GLOBAL)
  set_target_properties(gnomon::${name} PROPERTIES
    IMPORTED_LOCATION ${${name}_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${${name}_INCLUDE_DIR})
endfunction()

# OpenSubdiv's package configuration names static libraries that Debian does not ship; the others
# have a file for pkg-config only, or none.
gnomon_import(OpenSubdiv opensubdiv/version.h osdCPU)
gnomon_import(Epoxy epoxy/egl.h epoxy)
gnomon_import(xxhash xxhash.h xxhash)
gnomon_import(WebP webp/encode.h webp)
gnomon_import(spng spng.h spng)
gnomon_import(utf8proc utf8proc.h utf8proc)

# Embree 4 (newer systems) or 3 (Debian 12): the CMake target is called embree in both.
find_package(embree 4 QUIET)
if(NOT embree_FOUND)
  find_package(embree 3 REQUIRED)
endif()

# OpenImageIO's package configuration insists on files of other Debian packages: its tools. Its
# headers need Imath's. Only the module of validate/image links it, and tests that read pictures back.
find_path(IMATH_INCLUDE_DIR ImathConfig.h PATH_SUFFIXES Imath REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
gnomon_import(OpenImageIO OpenImageIO/imageio.h OpenImageIO)
target_include_directories(gnomon::OpenImageIO INTERFACE ${IMATH_INCLUDE_DIR})
target_link_libraries(gnomon::OpenImageIO INTERFACE ${OPENIMAGEIO_UTIL_LIBRARY})

# Dear ImGui; only the viewer needs it.
find_library(STB_LIBRARY stb REQUIRED)
gnomon_import(ImGui imgui.h imgui imgui)
target_link_libraries(gnomon::ImGui INTERFACE ${STB_LIBRARY} ${CMAKE_DL_LIBS} glfw)

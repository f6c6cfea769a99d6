# Imported targets for libraries that a plain find_package cannot serve. Also installed, since
# a program that uses Gnomon needs the same ones.

# gnomon_import(NAME HEADER LIBRARY): the library as gnomon::NAME, found by a header of its own.
function(gnomon_import name header library)
  if(TARGET gnomon::${name})
    return()
  endif()
  find_path(${name}_INCLUDE_DIR ${header} REQUIRED)
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
if(NOT TARGET embree)
  find_package(embree 4 QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3 REQUIRED)
  endif()
endif()

# Imported targets for libraries that a plain find_package cannot serve. Also installed, since
# a program that uses Gnomon needs the same ones.

# OpenSubdiv's package configuration names static libraries that Debian does not ship.
if(NOT TARGET gnomon::OpenSubdiv)
  find_path(OPENSUBDIV_INCLUDE_DIR opensubdiv/version.h REQUIRED)
  find_library(OPENSUBDIV_CPU_LIBRARY osdCPU REQUIRED)
  add_library(gnomon::OpenSubdiv UNKNOWN IMPORTED)
  set_target_properties(gnomon::OpenSubdiv PROPERTIES
    IMPORTED_LOCATION ${OPENSUBDIV_CPU_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${OPENSUBDIV_INCLUDE_DIR})
endif()

# Embree 4 (newer systems) or 3 (Debian 12): the CMake target is called embree in both.
if(NOT TARGET embree)
  find_package(embree 4 QUIET)
  if(NOT embree_FOUND)
    find_package(embree 3 REQUIRED)
  endif()
endif()

# libepoxy ships a pkg-config file only.
if(NOT TARGET gnomon::Epoxy)
  find_path(EPOXY_INCLUDE_DIR epoxy/egl.h REQUIRED)
  find_library(EPOXY_LIBRARY epoxy REQUIRED)
  add_library(gnomon::Epoxy UNKNOWN IMPORTED)
  set_target_properties(gnomon::Epoxy PROPERTIES
    IMPORTED_LOCATION ${EPOXY_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${EPOXY_INCLUDE_DIR})
endif()

# xxHash ships a pkg-config file only.
if(NOT TARGET gnomon::xxhash)
  find_path(XXHASH_INCLUDE_DIR xxhash.h REQUIRED)
  find_library(XXHASH_LIBRARY xxhash REQUIRED)
  add_library(gnomon::xxhash UNKNOWN IMPORTED)
  set_target_properties(gnomon::xxhash PROPERTIES
    IMPORTED_LOCATION ${XXHASH_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${XXHASH_INCLUDE_DIR})
endif()

# Debian's libwebp-dev has no file for CMake.
if(NOT TARGET gnomon::WebP)
  find_path(WEBP_INCLUDE_DIR webp/encode.h REQUIRED)
  find_library(WEBP_LIBRARY webp REQUIRED)
  add_library(gnomon::WebP UNKNOWN IMPORTED)
  set_target_properties(gnomon::WebP PROPERTIES
    IMPORTED_LOCATION ${WEBP_LIBRARY}
    INTERFACE_INCLUDE_DIRECTORIES ${WEBP_INCLUDE_DIR})
endif()

# Imported targets for the libraries that only the module of image_files links, and tests that read
# its pictures back: what is installed does not need their headers.

# OpenEXR's package configuration names parts of itself that Debian keeps in other packages, and so
# does that of Imath, whose headers both need.
find_path(IMATH_INCLUDE_DIR ImathConfig.h PATH_SUFFIXES Imath REQUIRED)
find_path(OPENEXR_INCLUDE_DIR OpenEXR/ImfHeader.h REQUIRED)
find_library(OPENEXR_LIBRARY OpenEXR REQUIRED)
add_library(gnomon::OpenEXR UNKNOWN IMPORTED)
set_target_properties(gnomon::OpenEXR PROPERTIES
  IMPORTED_LOCATION ${OPENEXR_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES
    "${OPENEXR_INCLUDE_DIR};${OPENEXR_INCLUDE_DIR}/OpenEXR;${IMATH_INCLUDE_DIR}")

# OpenImageIO's insists on files of other Debian packages: its tools.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
add_library(gnomon::OpenImageIO UNKNOWN IMPORTED)
set_target_properties(gnomon::OpenImageIO PROPERTIES
  IMPORTED_LOCATION ${OPENIMAGEIO_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES "${OPENIMAGEIO_INCLUDE_DIR};${IMATH_INCLUDE_DIR}"
  INTERFACE_LINK_LIBRARIES ${OPENIMAGEIO_UTIL_LIBRARY})

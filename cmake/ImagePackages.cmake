# Imported targets for the libraries that only the module of image links, and tests that read
# its pictures back: what is installed does not need their headers.

# OpenImageIO's headers need Imath's.
find_path(IMATH_INCLUDE_DIR ImathConfig.h PATH_SUFFIXES Imath REQUIRED)

# OpenImageIO's insists on files of other Debian packages: its tools.
find_path(OPENIMAGEIO_INCLUDE_DIR OpenImageIO/imageio.h REQUIRED)
find_library(OPENIMAGEIO_LIBRARY OpenImageIO REQUIRED)
find_library(OPENIMAGEIO_UTIL_LIBRARY OpenImageIO_Util REQUIRED)
add_library(gnomon::OpenImageIO UNKNOWN IMPORTED)
set_target_properties(gnomon::OpenImageIO PROPERTIES
  IMPORTED_LOCATION ${OPENIMAGEIO_LIBRARY}
  INTERFACE_INCLUDE_DIRECTORIES "${OPENIMAGEIO_INCLUDE_DIR};${IMATH_INCLUDE_DIR}"
  INTERFACE_LINK_LIBRARIES ${OPENIMAGEIO_UTIL_LIBRARY})

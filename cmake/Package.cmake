# `cpack`, or `./gnomon package`: what is installed as a Debian package. Its dependencies are the
# libraries that the binaries name, which dpkg-shlibdeps finds, and what the program calls or loads
# by name: gnuplot, an OpenGL without a display, and the viewer's letters.

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME gnomon)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY ${PROJECT_DESCRIPTION})
set(CPACK_PACKAGE_CONTACT "The Gnomon authors <gnomon@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_DEPENDS "gnuplot-nox, libegl1, libgl1-mesa-dri, fonts-dejavu-core")
include(CPack)

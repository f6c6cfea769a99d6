# Installs into an empty folder and checks what is there:
#   cmake -D BUILD=folder -D SOURCE=folder -D PREFIX=folder -P install.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX}
                COMMAND_ERROR_IS_FATAL ANY)

# Of the headers those of validate/api and no other.
file(GLOB public RELATIVE ${SOURCE}/validate/api ${SOURCE}/validate/api/*.h)
file(GLOB_RECURSE installed RELATIVE ${PREFIX}/include/gnomon ${PREFIX}/include/*)
if(NOT public OR NOT installed STREQUAL public)
  message(FATAL_ERROR "headers installed: ${installed}; expected: ${public}")
endif()

# They include each other and the standard library alone.
foreach(header IN LISTS public)
  file(STRINGS ${PREFIX}/include/gnomon/${header} includes REGEX "^ *# *include")
  foreach(line IN LISTS includes)
    if(NOT line MATCHES "^#include (\"gnomon/[a-z_]+\\.h\"|<[a-z_]+>)$")
      message(FATAL_ERROR "${header}: ${line}")
    endif()
  endforeach()
endforeach()

# One library, which others find without anything else.
file(GLOB_RECURSE libraries RELATIVE ${PREFIX} ${PREFIX}/*.so ${PREFIX}/*.a)
list(TRANSFORM libraries REPLACE ".*/" "")
if(NOT libraries STREQUAL "libgnomon_openimageio.so;libgnomon.so" AND
   NOT libraries STREQUAL "libgnomon.so;libgnomon_openimageio.so")
  message(FATAL_ERROR "libraries installed: ${libraries}")
endif()

# What a package needs besides.
file(GLOB manual RELATIVE ${SOURCE}/docs ${SOURCE}/docs/*.md)
list(TRANSFORM manual PREPEND share/doc/gnomon/)
foreach(file IN ITEMS ${manual} share/doc/gnomon/copyright share/doc/gnomon/CHANGELOG.md
        share/man/man1/gnomon.1
        share/gnomon/scenes/figure8.toml share/gnomon/schemas/gnomon.schema.json
        share/gnomon/scenes/starter/.github/workflows/shadows.yml)
  if(NOT EXISTS ${PREFIX}/${file})
    message(FATAL_ERROR "${file} is not installed")
  endif()
endforeach()

# Nothing says where it was built.
include(${CMAKE_CURRENT_LIST_DIR}/own_path.cmake)
find_own_path(${SOURCE} ${BUILD} ${PREFIX} found)
if(found)
  message(FATAL_ERROR "the build's own path is in:\n${found}")
endif()

# The page that shows the example shows its very text.
file(READ ${SOURCE}/docs/api.md page)
file(READ ${SOURCE}/docs/example.cpp example)
string(FIND "${page}" "```cpp\n${example}```" place)
if(place EQUAL -1)
  message(FATAL_ERROR "docs/api.md does not hold docs/example.cpp as it is")
endif()

# A method that the sources do not have: who finds it has looked into the installed folder.
set(methods ${PREFIX}/share/gnomon/shaders/methods)
configure_file(${methods}/max-forsyth.glsl ${methods}/installed.glsl COPYONLY)

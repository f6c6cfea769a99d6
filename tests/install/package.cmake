# Builds the Debian package and checks what it says and holds:
#   cmake -D CPACK=program -D BUILD=folder -D SOURCE=folder -D OUT=folder -P package.cmake
cmake_minimum_required(VERSION 3.25)
file(REMOVE_RECURSE ${OUT})
execute_process(COMMAND ${CPACK} -G DEB -B ${OUT} WORKING_DIRECTORY ${BUILD}
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(GLOB package ${OUT}/gnomon_*.deb)

# What only the binaries know, and what they load or call by name.
execute_process(COMMAND dpkg-deb --field ${package} Depends
                OUTPUT_VARIABLE depends COMMAND_ERROR_IS_FATAL ANY)
foreach(name libosdcpu libembree libopenimageio libtbb libepoxy gnuplot-nox libegl1 libgl1-mesa-dri)
  string(FIND "${depends}" ${name} place)
  if(place EQUAL -1)
    message(FATAL_ERROR "${name} is not in: ${depends}")
  endif()
endforeach()

# Nothing below another folder than /usr, and nothing that says where it was built.
execute_process(COMMAND dpkg-deb --extract ${package} ${OUT}/root COMMAND_ERROR_IS_FATAL ANY)
file(GLOB folders RELATIVE ${OUT}/root ${OUT}/root/*)
if(NOT folders STREQUAL usr)
  message(FATAL_ERROR "folders in the package: ${folders}")
endif()
include(${CMAKE_CURRENT_LIST_DIR}/own_path.cmake)
find_own_path(${SOURCE} ${BUILD} ${OUT}/root found)
if(found)
  message(FATAL_ERROR "the build's own path is in:\n${found}")
endif()

# It runs where it was unpacked, with its own shaders and scenes.
execute_process(COMMAND ${OUT}/root/usr/bin/gnomon init ${OUT}/starter --action somebody/gnomon@v0.1.0
                OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
file(REMOVE_RECURSE ${OUT}/root)

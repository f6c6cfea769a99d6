# What every target of the project shares, and the one way to declare a component.

set(GNOMON_SANITIZE "" CACHE STRING "Sanitizers to build with, as -fsanitize takes them")

add_library(gnomon_options INTERFACE)
target_compile_features(gnomon_options INTERFACE cxx_std_20)
# No contraction: a result must not depend on whether the processor can fuse a multiply and an add.
target_compile_options(gnomon_options INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -ffp-contract=off)
if(GNOMON_SANITIZE)
  target_compile_options(gnomon_options INTERFACE
    -fsanitize=${GNOMON_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  target_link_options(gnomon_options INTERFACE -fsanitize=${GNOMON_SANITIZE})
  target_compile_definitions(gnomon_options INTERFACE GNOMON_SANITIZED)
endif()

# Tests spend their time in the libraries: -O3 for themselves only lengthens the build by a third.
add_library(gnomon_test_options INTERFACE)
target_compile_options(gnomon_test_options INTERFACE $<$<CONFIG:Release>:-O1>)

# gnomon_component(NAME SOURCES file… [PUBLIC lib…] [PRIVATE lib…])
# A folder of validate/ as a library that links only what it is told: the build enforces
# which component may know which.
function(gnomon_component name)
  cmake_parse_arguments(arg "" "" "SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target gnomon_${name})
  add_library(${target} STATIC ${arg_SOURCES})
  add_library(gnomon::${name} ALIAS ${target})
  set_target_properties(${target} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_include_directories(${target} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/validate>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gnomon>)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC}
    PRIVATE ${arg_PRIVATE} $<BUILD_INTERFACE:gnomon_options>)
  target_precompile_headers(${target} REUSE_FROM gnomon_precompiled)
  set_property(GLOBAL APPEND PROPERTY GNOMON_COMPONENTS ${target})
endfunction()

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

# gnomon_headers(DIRECTORY [AS prefix] FOLDER…): fills a folder of the build with links to the
# headers of the given folders of validate/, under the paths by which they are included: those of the
# folders, or the prefix.
function(gnomon_headers directory)
  cmake_parse_arguments(PARSE_ARGV 1 arg "" "AS" "")
  file(REMOVE_RECURSE ${directory})
  foreach(folder IN LISTS arg_UNPARSED_ARGUMENTS)
    file(GLOB headers CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/validate/${folder}/*.h)
    if(arg_AS)
      set(folder ${arg_AS})
    endif()
    file(MAKE_DIRECTORY ${directory}/${folder})
    foreach(header IN LISTS headers)
      cmake_path(GET header FILENAME name)
      file(CREATE_LINK ${header} ${directory}/${folder}/${name} SYMBOLIC)
    endforeach()
  endforeach()
endfunction()

# gnomon_component(NAME FOLDER folder [AS prefix] [SHARED] [LIGHT] [PARTS subfolder…] [INNER subfolder…]
#                  [HEADERS subfolder…] [SOURCES file…] [PUBLIC lib…] [PRIVATE lib…])
# A folder of validate/ as the library gnomon::NAME: all its sources, those of its PARTS, whose
# headers others may include, and those of its INNER folders, whose headers only it and its tests
# (by gnomon::NAME_inner) may. Of the folders HEADERS it has the headers alone. SOURCES are generated.
# Its own headers are included as FOLDER/x.h, or as prefix/x.h. A LIGHT library computes little: it is
# optimised by -O1, which takes two thirds of the time of -O3 to compile. A SHARED library holds the static ones
# that it links and exports only what its headers mark.
# A library finds no header but its own and those of the libraries that it links, so the build
# enforces which component knows which.
function(gnomon_component name)
  cmake_parse_arguments(arg "SHARED;LIGHT" "FOLDER;AS" "PARTS;INNER;HEADERS;SOURCES;PUBLIC;PRIVATE" ${ARGN})
  set(target gnomon_${name})
  list(TRANSFORM arg_PARTS PREPEND ${arg_FOLDER}/)
  list(TRANSFORM arg_INNER PREPEND ${arg_FOLDER}/)
  list(TRANSFORM arg_HEADERS PREPEND ${arg_FOLDER}/)
  set(patterns ${arg_FOLDER} ${arg_PARTS} ${arg_INNER})
  list(TRANSFORM patterns REPLACE "(.+)" "${PROJECT_SOURCE_DIR}/validate/\\1/*.cpp")
  file(GLOB sources CONFIGURE_DEPENDS ${patterns})
  if(arg_SHARED)
    add_library(${target} SHARED ${sources} ${arg_SOURCES})
    target_compile_options(${target} PRIVATE -fvisibility=hidden)
    target_link_options(${target} PRIVATE -Wl,--exclude-libs,ALL)
  else()
    add_library(${target} STATIC ${sources} ${arg_SOURCES})
  endif()
  add_library(gnomon::${name} ALIAS ${target})

  set(headers ${PROJECT_BINARY_DIR}/include/${name})
  set(prefix "")
  if(arg_AS)
    set(prefix AS ${arg_AS})
  endif()
  gnomon_headers(${headers} ${prefix} ${arg_FOLDER} ${arg_PARTS})
  target_include_directories(${target} PUBLIC $<BUILD_INTERFACE:${headers}>)
  if(arg_INNER OR arg_HEADERS)
    gnomon_headers(${headers}_inner ${arg_INNER} ${arg_HEADERS})
    add_library(${target}_inner INTERFACE)
    add_library(gnomon::${name}_inner ALIAS ${target}_inner)
    target_include_directories(${target}_inner INTERFACE ${headers}_inner)
    target_link_libraries(${target} PRIVATE ${target}_inner)
  endif()

  if(arg_LIGHT)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endif()
  set_target_properties(${target} PROPERTIES POSITION_INDEPENDENT_CODE ON)
  target_compile_features(${target} PUBLIC cxx_std_20)
  target_link_libraries(${target} PUBLIC ${arg_PUBLIC}
    PRIVATE ${arg_PRIVATE} gnomon_options)
  target_precompile_headers(${target} REUSE_FROM gnomon_precompiled)
endfunction()

# Headers of others that most files include, compiled once for the libraries and once for the tests:
# a third of what a build takes was to read them anew in every file. A file still includes all that
# it uses; the preset `debug`, which builds without them, shows where one does not.

set(precompiled_source ${PROJECT_BINARY_DIR}/precompiled.cpp)
file(CONFIGURE OUTPUT ${precompiled_source}
     CONTENT "// Of its target only the precompiled headers are used.\n")
set(precompiled_headers
  <algorithm> <array> <cmath> <cstddef> <cstdint> <filesystem> <functional> <limits> <map> <memory>
  <optional> <span> <stdexcept> <string> <string_view> <thread> <utility> <variant> <vector>
  <fmt/core.h> <fmt/ranges.h> <glm/glm.hpp> <tbb/blocked_range.h> <tbb/parallel_for.h>)

# `target_precompile_headers(TARGET REUSE_FROM …)` demands the options of the one that it reuses.
add_library(gnomon_precompiled OBJECT ${precompiled_source})
set_target_properties(gnomon_precompiled PROPERTIES POSITION_INDEPENDENT_CODE ON)
target_link_libraries(gnomon_precompiled PRIVATE gnomon_options fmt::fmt glm::glm TBB::tbb)
target_precompile_headers(gnomon_precompiled PRIVATE ${precompiled_headers})

if(BUILD_TESTING)
  add_library(gnomon_precompiled_tests OBJECT ${precompiled_source})
  target_link_libraries(gnomon_precompiled_tests PRIVATE
    gnomon_options gnomon_test_options fmt::fmt glm::glm TBB::tbb GTest::gtest)
  target_precompile_headers(gnomon_precompiled_tests PRIVATE
    ${precompiled_headers} <gmock/gmock.h> <gtest/gtest.h>)
endif()

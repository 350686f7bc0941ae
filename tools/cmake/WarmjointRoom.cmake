# what nearly every source file includes, parsed once for each target
set(WARMJOINT_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional>
  <string> <string_view> <utility> <vector> <Eigen/Cholesky> <Eigen/Core> <Eigen/QR> <fmt/format.h> <fmt/ranges.h>
  <nlohmann/json.hpp>)

# warmjoint_precompile(TARGET [header]...): the common headers and those given, where WARMJOINT_PCH is on
function(warmjoint_precompile target)
  if(WARMJOINT_PCH)
    target_precompile_headers(${target} PRIVATE ${WARMJOINT_COMMON_HEADERS} ${ARGN})
  endif()
endfunction()

# warmjoint_room(NAME FOLDERS folder... LINKS target...)
# A static library of every .cc file directly in the given folders (relative to the caller), also called
# warmjoint::... as in the installed package.
function(warmjoint_room name)
  cmake_parse_arguments(ROOM "" "" "FOLDERS;LINKS" ${ARGN})
  set(sources)
  foreach(folder ${ROOM_FOLDERS})
    file(GLOB found CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/${folder}/*.cc)
    list(APPEND sources ${found})
  endforeach()
  add_library(${name} STATIC ${sources})
  string(REPLACE "warmjoint_" "warmjoint::" alias ${name})
  add_library(${alias} ALIAS ${name})
  target_compile_features(${name} PUBLIC cxx_std_20)
  target_link_libraries(${name} PUBLIC ${ROOM_LINKS} PRIVATE $<BUILD_INTERFACE:warmjoint_settings>)
  warmjoint_precompile(${name})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>)
endfunction()

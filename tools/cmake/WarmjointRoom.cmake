# what nearly every source file includes, parsed once for all targets with the same flags
set(WARMJOINT_COMMON_HEADERS <algorithm> <array> <cmath> <cstdint> <filesystem> <functional> <map> <memory> <optional>
  <string> <string_view> <utility> <vector> <Eigen/Cholesky> <Eigen/Core> <Eigen/QR> <fmt/format.h> <fmt/ranges.h>
  <nlohmann/json.hpp>)

# warmjoint_precompile(TARGET [header]...): the common headers and those given, where WARMJOINT_PCH is on
function(warmjoint_precompile target)
  if(WARMJOINT_PCH)
    target_precompile_headers(${target} PRIVATE ${WARMJOINT_COMMON_HEADERS} ${ARGN})
  endif()
endfunction()

# warmjoint_precompile_as(TARGET OTHER): what the other target has precompiled, which is compiled with the same flags
function(warmjoint_precompile_as target other)
  if(WARMJOINT_PCH)
    target_precompile_headers(${target} REUSE_FROM ${other})
  endif()
endfunction()

# warmjoint_room(NAME [OWN_HEADERS] FOLDERS folder... LINKS target...)
# A static library of every .cc file directly in the given folders (relative to the caller), also called
# warmjoint::... as in the installed package. OWN_HEADERS: it precompiles the common headers by itself, where other rooms
# take those of warmjoint_models: warmjoint_models, and a room that is compiled with other flags.
function(warmjoint_room name)
  cmake_parse_arguments(ROOM "OWN_HEADERS" "" "FOLDERS;LINKS" ${ARGN})
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
  if(ROOM_OWN_HEADERS)
    warmjoint_precompile(${name})
  else()
    warmjoint_precompile_as(${name} warmjoint_models)
  endif()
  warmjoint_unity(${name})
  target_include_directories(${name} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<BUILD_INTERFACE:${CMAKE_CURRENT_SOURCE_DIR}/include>)
endfunction()

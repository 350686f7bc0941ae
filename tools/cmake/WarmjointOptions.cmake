# Build type, warnings, sanitizers: the settings that every target shares.
if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Debug, Release or RelWithDebInfo" FORCE)
endif()

option(WARMJOINT_TESTS "build the tests" ON)
option(WARMJOINT_WERROR "treat warnings as errors" ON)
option(WARMJOINT_PCH "precompile the headers that nearly every file includes" ON)
set(WARMJOINT_SANITIZE "" CACHE STRING "sanitizers, for example address,undefined or thread")
set(WARMJOINT_ARCH "" CACHE STRING "value for -march; empty builds for any CPU of the platform")
set(WARMJOINT_SHARED "${PROJECT_SOURCE_DIR}/../shared" CACHE PATH
  "real recordings and robots that some tests read; those tests skip where it is absent")

# what was compiled once is taken from the cache; sloppiness lets it work with precompiled headers
find_program(WARMJOINT_CCACHE ccache)
if(WARMJOINT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_SLOPPINESS=pch_defines,time_macros,include_file_mtime,include_file_ctime
    CCACHE_BASEDIR=${PROJECT_SOURCE_DIR} CCACHE_NOHASHDIR=1 ${WARMJOINT_CCACHE})
endif()

set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_POSITION_INDEPENDENT_CODE ON)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_CXX_FLAGS_RELEASE "-O3 -DNDEBUG")

# the program and the plugin are found at the top of the build folder
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})

add_library(warmjoint_settings INTERFACE)
target_include_directories(warmjoint_settings INTERFACE ${PROJECT_SOURCE_DIR})
# no contraction: the same source gives the same bits on every x86-64, with or without FMA
target_compile_options(warmjoint_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
# GCC 12 sees writes out of bounds in its own std::string and std::vector at -O3 (GCC bugs 105329, 105651)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(warmjoint_settings INTERFACE -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict)
endif()
if(WARMJOINT_WERROR)
  target_compile_options(warmjoint_settings INTERFACE -Werror)
endif()
if(WARMJOINT_ARCH)
  add_compile_options(-march=${WARMJOINT_ARCH})
endif()
if(WARMJOINT_SANITIZE)
  add_compile_options(-fsanitize=${WARMJOINT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -g)
  add_link_options(-fsanitize=${WARMJOINT_SANITIZE})
  # what sanitizers add to the code makes GCC 12 suspect the standard library's regular expressions
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(warmjoint_settings INTERFACE -Wno-maybe-uninitialized)
  endif()
endif()

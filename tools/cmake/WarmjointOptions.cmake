# Warnings, sanitizers and what is built. Inside another project warmjoint is its libraries and its plugin, and leaves
# build type, output folders and flags to that project.
option(WARMJOINT_PROGRAM "build the command line program" ${PROJECT_IS_TOP_LEVEL})
option(WARMJOINT_INSTALL "install program, plugin, libraries and the CMake package" ${PROJECT_IS_TOP_LEVEL})
option(WARMJOINT_TESTS "build the tests" ${PROJECT_IS_TOP_LEVEL})
option(WARMJOINT_PYTHON "build the Python package's modules; needs nanobind and Python's headers" OFF)

# pip builds with what is there: say at once what lacks. The package holds a plugin for each version of MuJoCo
if(SKBUILD)
  set(WARMJOINT_PLUGIN_MUJOCOS 3.11.0 3.12.0 3.13.0 3.14.0 3.15.0 3.16.0 3.17.0)
  set(setup ${PROJECT_SOURCE_DIR}/tools/setup)
  foreach(command "packages;--no-install;--without-tests" "fetch;${PROJECT_BINARY_DIR}/deps;${WARMJOINT_PLUGIN_MUJOCOS}")
    # the system's own pip, which the one that builds hides
    execute_process(COMMAND ${CMAKE_COMMAND} -E env --unset=PYTHONPATH ${setup}/${command} RESULT_VARIABLE failed ERROR_VARIABLE words)
    if(failed)
      message(FATAL_ERROR "${words}")
    endif()
  endforeach()
endif()

# on with the compiler that the tests are run with; a newer one may warn of what this one does not
set(warnings_are_known OFF)
if(PROJECT_IS_TOP_LEVEL AND CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION MATCHES "^12\\.")
  set(warnings_are_known ON)
endif()
option(WARMJOINT_WERROR "treat warnings as errors" ${warnings_are_known})
option(WARMJOINT_PCH "precompile the headers that nearly every file includes" ON)
set(WARMJOINT_SANITIZE "" CACHE STRING "sanitizers, for example address,undefined or thread")
option(WARMJOINT_FUZZ "build the targets of tests/fuzz as libFuzzer programs; needs Clang 16 or later" OFF)
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
if(PROJECT_IS_TOP_LEVEL)
  # the program and the plugin are found at the top of the build folder
  set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
  set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})
else()
  # who links the libraries sees what they link
  set(CMAKE_FIND_PACKAGE_TARGETS_GLOBAL ON)
endif()

add_library(warmjoint_settings INTERFACE)
target_include_directories(warmjoint_settings INTERFACE ${PROJECT_SOURCE_DIR})
# a library takes of its parts what it uses, and calls within it are direct
target_compile_options(warmjoint_settings INTERFACE -ffunction-sections -fdata-sections -fno-semantic-interposition)
# no contraction: the same source gives the same bits on every x86-64, with or without FMA
target_compile_options(warmjoint_settings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion -ffp-contract=off)
# GCC 12 sees writes out of bounds in its own std::string and std::vector at -O3 (GCC bugs 105329, 105651), and takes
# Eigen vectors inside initialiser lists for uninitialised
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU AND CMAKE_CXX_COMPILER_VERSION VERSION_LESS 13)
  target_compile_options(warmjoint_settings INTERFACE 
    -Wno-array-bounds -Wno-stringop-overflow -Wno-restrict -Wno-maybe-uninitialized)
endif()
if(WARMJOINT_WERROR)
  target_compile_options(warmjoint_settings INTERFACE -Werror)
endif()
if(WARMJOINT_ARCH)
  add_compile_options(-march=${WARMJOINT_ARCH})
endif()
# sanitizers at -O3 take twice as long to compile; assertions are on, since this is where they are to fail
if(PROJECT_IS_TOP_LEVEL AND (WARMJOINT_SANITIZE OR WARMJOINT_FUZZ))
  set(CMAKE_CXX_FLAGS_RELEASE "-O1")
  set(CMAKE_C_FLAGS_RELEASE "-O1")
endif()
if(WARMJOINT_FUZZ)
  add_compile_options(-fsanitize=fuzzer-no-link)
  # counters of lines, in the readers' sources alone (tests/fuzz/CMakeLists.txt)
  add_link_options(-fprofile-instr-generate)
endif()
if(WARMJOINT_SANITIZE)
  add_compile_options(-fsanitize=${WARMJOINT_SANITIZE} -fno-omit-frame-pointer -fno-sanitize-recover=all -g1)
  add_link_options(-fsanitize=${WARMJOINT_SANITIZE})
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    # Eigen takes another allocator under AddressSanitizer: the same for tests, which are not instrumented
    add_compile_definitions(EIGEN_MALLOC_ALREADY_ALIGNED=0)
  endif()
endif()

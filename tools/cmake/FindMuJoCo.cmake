# Finds MuJoCo's library and headers under MUJOCO_ROOT: the folder of an unpacked PyPI wheel
# (mujoco/include, mujoco/libmujoco.so.X.Y.Z) or a release archive (include, lib).
# Defines the imported target mujoco::mujoco, MuJoCo_VERSION and MuJoCo_LIBRARY_DIR.
set(MUJOCO_ROOT "${PROJECT_BINARY_DIR}/deps/mujoco" CACHE PATH "unpacked wheel or release archive of MuJoCo")

# pip unpacks the wheel into a prefix of its own
set(roots ${MUJOCO_ROOT} ${CMAKE_PREFIX_PATH})
find_path(MuJoCo_INCLUDE_DIR mujoco/mujoco.h PATHS ${roots} PATH_SUFFIXES include mujoco/include NO_DEFAULT_PATH)
set(MuJoCo_LIBRARY)
foreach(root IN LISTS roots)
  file(GLOB found ${root}/lib/libmujoco.so.* ${root}/lib/*/libmujoco.so.* ${root}/mujoco/libmujoco.so.* ${root}/libmujoco.so.*)
  list(APPEND MuJoCo_LIBRARY ${found})
endforeach()
if(MuJoCo_LIBRARY)
  list(GET MuJoCo_LIBRARY 0 MuJoCo_LIBRARY)
  get_filename_component(MuJoCo_LIBRARY_DIR ${MuJoCo_LIBRARY} DIRECTORY)
  string(REGEX MATCH "[0-9]+\\.[0-9]+\\.[0-9]+$" MuJoCo_VERSION ${MuJoCo_LIBRARY})
endif()

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(MuJoCo REQUIRED_VARS MuJoCo_LIBRARY MuJoCo_INCLUDE_DIR VERSION_VAR MuJoCo_VERSION
  REASON_FAILURE_MESSAGE "run tools/build, which fetches it, or pass -DMUJOCO_ROOT=<folder of a 4.0.0 release archive>")

if(MuJoCo_FOUND AND NOT TARGET mujoco::mujoco)
  add_library(mujoco::mujoco SHARED IMPORTED)
  set_target_properties(mujoco::mujoco PROPERTIES IMPORTED_LOCATION ${MuJoCo_LIBRARY})
  target_include_directories(mujoco::mujoco SYSTEM INTERFACE ${MuJoCo_INCLUDE_DIR})
endif()

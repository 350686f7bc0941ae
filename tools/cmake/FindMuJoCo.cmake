# Finds MuJoCo's library and headers under MUJOCO_ROOT: the folder of an unpacked PyPI wheel
# (mujoco/include, mujoco/libmujoco.so.X.Y.Z) or a release archive (include, lib).
# Defines the imported target mujoco::mujoco, MuJoCo_VERSION and MuJoCo_LIBRARY_DIR.
set(MUJOCO_ROOT "${PROJECT_BINARY_DIR}/deps/mujoco" CACHE PATH "unpacked wheel or release archive of MuJoCo")

find_path(MuJoCo_INCLUDE_DIR mujoco/mujoco.h
  PATHS ${MUJOCO_ROOT} PATH_SUFFIXES include mujoco/include NO_DEFAULT_PATH)
file(GLOB MuJoCo_LIBRARY ${MUJOCO_ROOT}/lib/libmujoco.so.* ${MUJOCO_ROOT}/lib/*/libmujoco.so.* ${MUJOCO_ROOT}/mujoco/libmujoco.so.* ${MUJOCO_ROOT}/libmujoco.so.*)
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

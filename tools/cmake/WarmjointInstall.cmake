# cmake --install: program, plugin, the library with its public headers, robots and suites, MuJoCo's library, and a CMake
# package for find_package(warmjoint). The prefix stands alone: it may be moved, and the build folder may go.
# Component `program` is what users of the command line need, and what `tools/build` makes: tools/install installs it.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/warmjoint)

# the rooms, whose public headers lie together
set(rooms models recording robots scenarios truth plugin attach sim identification score store terminal board identify design design_motion compensate actions robot_log rigid robot_joints shown robot)
foreach(room ${rooms})
  set_target_properties(warmjoint_${room} PROPERTIES EXPORT_NAME ${room})
  install(TARGETS warmjoint_${room} EXPORT warmjointTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
endforeach()
foreach(folder models scenarios sim identification tools)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
    FILES_MATCHING PATTERN "*.h")
endforeach()

# warmjoint::warmjoint is all of them
set_target_properties(warmjoint_library PROPERTIES EXPORT_NAME warmjoint)
install(TARGETS warmjoint_library EXPORT warmjointTargets INCLUDES DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# program and plugin find MuJoCo beside them
if(WARMJOINT_PROGRAM)
  set_target_properties(warmjoint PROPERTIES INSTALL_RPATH "$ORIGIN/../${CMAKE_INSTALL_LIBDIR}")
  install(TARGETS warmjoint RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT program)
  # completion, where bash looks for it
  install(FILES ${PROJECT_SOURCE_DIR}/tools/cli/completion.bash RENAME warmjoint
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT program)
endif()
set_target_properties(warmjoint_friction PROPERTIES INSTALL_RPATH "$ORIGIN")
install(TARGETS warmjoint_friction LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
install(FILES ${MuJoCo_LIBRARY} DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT program)
install(DIRECTORY ${MuJoCo_INCLUDE_DIR}/mujoco DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

# robots and suites, where the program looks for them
install(DIRECTORY ${PROJECT_SOURCE_DIR}/models/robots ${PROJECT_SOURCE_DIR}/models/library DESTINATION ${CMAKE_INSTALL_DATADIR}/warmjoint/models
  COMPONENT program
  FILES_MATCHING PATTERN "*.xml" PATTERN "*.urdf" PATTERN "*.json" PATTERN "README.md")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenarios/suites ${PROJECT_SOURCE_DIR}/scenarios/templates
  ${PROJECT_SOURCE_DIR}/scenarios/certified
  DESTINATION ${CMAKE_INSTALL_DATADIR}/warmjoint/scenarios
  COMPONENT program)
# what draws pictures and fills pages
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/python/warmjoint DESTINATION ${CMAKE_INSTALL_DATADIR}/warmjoint/tools/python
  COMPONENT program FILES_MATCHING PATTERN "figures/*" PATTERN "templates/*" PATTERN "formats/*.py" PATTERN "fmu.py")
install(DIRECTORY ${PROJECT_SOURCE_DIR}/tools/docs/schemas DESTINATION ${CMAKE_INSTALL_DATADIR}/warmjoint COMPONENT program)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/warmjoint COMPONENT program)

# the package
configure_package_config_file(${PROJECT_SOURCE_DIR}/tools/cmake/warmjointConfig.cmake.in
  ${PROJECT_BINARY_DIR}/warmjointConfig.cmake INSTALL_DESTINATION ${package}
  PATH_VARS CMAKE_INSTALL_LIBDIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/warmjointConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(EXPORT warmjointTargets NAMESPACE warmjoint:: DESTINATION ${package})
install(FILES ${PROJECT_BINARY_DIR}/warmjointConfig.cmake ${PROJECT_BINARY_DIR}/warmjointConfigVersion.cmake
  ${PROJECT_SOURCE_DIR}/tools/cmake/FindMuJoCo.cmake DESTINATION ${package})

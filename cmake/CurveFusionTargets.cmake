# Compile settings of every target of this project.
# -ffp-contract=off and no -march: the same bits on every machine and for every thread count.
add_library(curvefusion_build_flags INTERFACE)
target_compile_features(curvefusion_build_flags INTERFACE cxx_std_20)
target_compile_options(curvefusion_build_flags INTERFACE -ffp-contract=off)

add_library(curvefusion_warnings INTERFACE)
target_compile_options(curvefusion_warnings INTERFACE
  -Wall -Wextra -Wpedantic -Wshadow -Wnon-virtual-dtor -Woverloaded-virtual
  $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>  # false alarms inside Eigen under gcc 12
  -Wno-missing-field-initializers  # designated initialisers leave the rest at its defaults
  $<$<BOOL:${CURVEFUSION_WARNINGS_AS_ERRORS}>:-Werror>)

# curvefusion_add_library(NAME SOURCES... ) makes the folder's library and its alias curvefusion::NAME.
function(curvefusion_add_library name)
  add_library(curvefusion_${name} ${ARGN})
  add_library(curvefusion::${name} ALIAS curvefusion_${name})
  target_link_libraries(curvefusion_${name}
    PUBLIC curvefusion_build_flags
    PRIVATE $<BUILD_INTERFACE:curvefusion_warnings>)
  target_include_directories(curvefusion_${name} PUBLIC
    "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>"
    "$<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/curvefusion/detail>")
  set_target_properties(curvefusion_${name} PROPERTIES EXPORT_NAME ${name} POSITION_INDEPENDENT_CODE ON)
endfunction()

# curvefusion_add_test(NAME SOURCES... LIBRARIES...) : one GoogleTest program per folder.
function(curvefusion_add_test name)
  cmake_parse_arguments(arg "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE ${arg_LIBRARIES} curvefusion_warnings curvefusion_test_flags
                                        curvefusion_source_folder GTest::gtest_main)
  target_include_directories(${name} PRIVATE "${PROJECT_SOURCE_DIR}")
  target_precompile_headers(${name} REUSE_FROM curvefusion_source_folder)
  gtest_discover_tests(${name} DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600)
endfunction()

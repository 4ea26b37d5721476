# SuiteSparse 5 ships neither a CMake config nor a pkg-config file.
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse)
find_library(CHOLMOD_LIBRARY cholmod)
find_library(SUITESPARSE_CONFIG_LIBRARY suitesparseconfig)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(CHOLMOD REQUIRED_VARS CHOLMOD_LIBRARY SUITESPARSE_CONFIG_LIBRARY
                                  CHOLMOD_INCLUDE_DIR)
if(CHOLMOD_FOUND AND NOT TARGET CHOLMOD::CHOLMOD)
  add_library(CHOLMOD::CHOLMOD INTERFACE IMPORTED)
  target_include_directories(CHOLMOD::CHOLMOD SYSTEM INTERFACE "${CHOLMOD_INCLUDE_DIR}")
  target_link_libraries(CHOLMOD::CHOLMOD INTERFACE "${CHOLMOD_LIBRARY}"
                                                   "${SUITESPARSE_CONFIG_LIBRARY}")
endif()

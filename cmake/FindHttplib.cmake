# Debian's cpp-httplib is a library with a pkg-config file only. It was built with the macros in
# Httplib_DEFINITIONS, which change the classes in its header: every source that includes it needs them.
find_path(HTTPLIB_INCLUDE_DIR httplib.h)
find_library(HTTPLIB_LIBRARY cpp-httplib)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(Httplib REQUIRED_VARS HTTPLIB_LIBRARY HTTPLIB_INCLUDE_DIR
  REASON_FAILURE_MESSAGE "install libcpp-httplib-dev (./run build installs what is missing)")
set(Httplib_DEFINITIONS CPPHTTPLIB_OPENSSL_SUPPORT CPPHTTPLIB_ZLIB_SUPPORT
    CPPHTTPLIB_BROTLI_SUPPORT)
if(Httplib_FOUND AND NOT TARGET Httplib::Httplib)
  add_library(Httplib::Httplib INTERFACE IMPORTED)
  target_include_directories(Httplib::Httplib SYSTEM INTERFACE "${HTTPLIB_INCLUDE_DIR}")
  target_link_libraries(Httplib::Httplib INTERFACE "${HTTPLIB_LIBRARY}")
endif()

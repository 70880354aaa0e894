# A Crazyradio that is not there, the simulated vehicle behind it.
swiftlet_add_library(swiftlet_emulated_radio
  SOURCES emulated_crazyradio.cpp emulated_receiver.cpp emulated_usb.cpp
  LINK swiftlet_simulation)
swiftlet_add_folder_tests(support_tests LINK swiftlet_emulated_radio)

# The same behind the kernel's USB interface, for the real libusb.
find_package(PkgConfig REQUIRED)
pkg_check_modules(UMOCKDEV REQUIRED IMPORTED_TARGET umockdev-1.0)
swiftlet_add_library(swiftlet_umockdev_dongle
  SOURCES umockdev_dongle.cpp
  LINK swiftlet_emulated_radio
  LINK_PRIVATE PkgConfig::UMOCKDEV)
# Its class has members of types of the file's own, of which GCC warns in a file that is included.
set_target_properties(swiftlet_umockdev_dongle PROPERTIES UNITY_BUILD OFF)

# Listens to a link with the least a client must do.
swiftlet_add_library(swiftlet_log_listener SOURCES log_listener.cpp LINK swiftlet_sensing LINK_PRIVATE GTest::gtest)

# Another program at a shared link.
swiftlet_add_library(swiftlet_flight_client SOURCES flight_client.cpp LINK swiftlet_link)

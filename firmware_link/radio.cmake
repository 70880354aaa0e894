# Live links over USB devices: the Crazyradio, the vehicle's own cable.
swiftlet_add_library(swiftlet_radio
  SOURCES crazyradio.cpp link_condition.cpp radio_link.cpp radio_scan.cpp usb_cable_link.cpp
  LINK swiftlet_sensing)

# The USB devices of this machine: the only library that knows libusb.
find_package(PkgConfig REQUIRED)
pkg_check_modules(LIBUSB REQUIRED IMPORTED_TARGET libusb-1.0)
swiftlet_add_library(swiftlet_libusb
  SOURCES libusb_bus.cpp
  LINK swiftlet_sensing
  LINK_PRIVATE PkgConfig::LIBUSB)

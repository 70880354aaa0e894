# Live links over USB devices: the Crazyradio, the vehicle's own cable.
swiftlet_add_library(swiftlet_radio
  SOURCES crazyradio.cpp link_condition.cpp radio_link.cpp
  LINK swiftlet_sensing)

# The live link on an emulated Crazyradio, in simulated time...
swiftlet_add_test(emulated_radio_test LINK swiftlet_link swiftlet_emulated_radio swiftlet_log_listener)
swiftlet_add_test(emulated_samples_test LINK swiftlet_firmware_link swiftlet_link swiftlet_emulated_radio)
swiftlet_add_test(shared_radio_test LINK
  swiftlet_firmware_link swiftlet_link swiftlet_emulated_radio swiftlet_flight_client)
swiftlet_add_test(shared_flight_test TOGETHER LINK
  swiftlet_workers swiftlet_link swiftlet_emulated_radio swiftlet_flight_client)

# ...and by the real libusb in real time. A sanitizer's library must be loaded before all others, which the
# wrapper's stands in the way of, and the wrapper is the building machine's: without it the tests skip themselves.
add_executable(emulated_dongle_test emulated_dongle_test.cpp)
target_link_libraries(emulated_dongle_test PRIVATE swiftlet_firmware_link swiftlet_link swiftlet_libusb swiftlet_umockdev_dongle
  swiftlet_test_support GTest::gtest_main GTest::gmock swiftlet_compile_options)
if(NOT SWIFTLET_SANITIZE AND NOT CMAKE_CROSSCOMPILING)
  find_program(UMOCKDEV_WRAPPER umockdev-wrapper REQUIRED)
  set_target_properties(emulated_dongle_test PROPERTIES CROSSCOMPILING_EMULATOR ${UMOCKDEV_WRAPPER})
endif()
gtest_discover_tests(emulated_dongle_test DISCOVERY_TIMEOUT 60 PROPERTIES TIMEOUT 600 LABELS integration COST 60)

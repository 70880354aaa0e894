foreach(test crazyradio link_condition radio_link radio_scan reopen_schedule request_queue safelink usb_cable_link)
  swiftlet_add_test(${test}_test LINK swiftlet_radio)
endforeach()
target_link_libraries(radio_link_test PRIVATE swiftlet_allocation_counter)

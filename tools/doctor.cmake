# The checks of `swiftlet doctor`.
swiftlet_add_library(swiftlet_doctor
  SOURCES
    doctor_command.cpp
    doctor/device_holder.cpp
    doctor/examination.cpp
    doctor/lcm_checks.cpp
    doctor/network.cpp
    doctor/real_time_checks.cpp
    doctor/report.cpp
    doctor/storage_checks.cpp
    doctor/system_files.cpp
    doctor/usb_checks.cpp
    doctor/vehicle_checks.cpp
    doctor/vehicle_interview.cpp
  LINK swiftlet_firmware_link swiftlet_lcm_transport
  LINK_PRIVATE swiftlet_libusb swiftlet_link swiftlet_recording nlohmann_json::nlohmann_json)
# GCC 12 sees copies beyond short strings in std::string where operator+ appends, and there are none.
set_source_files_properties(doctor/usb_checks.cpp PROPERTIES COMPILE_OPTIONS "$<$<CXX_COMPILER_ID:GNU>:-Wno-array-bounds;-Wno-stringop-overread;-Wno-stringop-overflow;-Wno-restrict>")

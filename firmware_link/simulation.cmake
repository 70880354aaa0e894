# The simulated vehicle behind sim://WORLD?seed=N.
swiftlet_add_library(swiftlet_simulation
  SOURCES simulated_battery.cpp simulated_console.cpp simulated_flight.cpp simulated_flight_schedule.cpp
    simulated_floor_plans.cpp simulated_link.cpp simulated_log.cpp simulated_log_table.cpp simulated_memories.cpp
    simulated_odometry.cpp simulated_param_table.cpp simulated_params.cpp simulated_platform.cpp
    simulated_ranger.cpp simulated_udp_server.cpp simulated_vehicle.cpp simulated_world.cpp
  LINK swiftlet_sensing Boost::boost)

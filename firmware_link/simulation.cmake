# The simulated vehicle behind sim://WORLD?seed=N.
swiftlet_add_library(swiftlet_simulation
  SOURCES simulated_world.cpp simulated_floor_plans.cpp simulated_flight.cpp simulated_odometry.cpp
    simulated_ranger.cpp simulated_log_table.cpp simulated_log.cpp simulated_vehicle.cpp simulated_link.cpp
  LINK swiftlet_sensing Boost::boost)

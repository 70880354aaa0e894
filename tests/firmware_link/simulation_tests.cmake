foreach(test
    battery console flight flight_schedule floor_plans link log log_table members memories odometry param_table
    params platform random ranger udp_server vehicle world)
  swiftlet_add_test(simulated_${test}_test LINK swiftlet_simulation)
endforeach()

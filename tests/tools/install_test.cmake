# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors

# Installs BUILD into the empty PREFIX: everything must be in its place and the programs must run from there.
cmake_minimum_required(VERSION 3.24)
file(REMOVE_RECURSE ${PREFIX})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${PREFIX} OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)

foreach(file
    bin/swiftlet
    bin/swiftletd
    lib/systemd/system/swiftletd.service
    lib/udev/rules.d/70-swiftlet-crazyflie.rules
    share/swiftlet/60-swiftlet-lcm.conf
    share/swiftlet/foxglove_layout.json
    share/swiftlet/swiftletd.toml
    include/swiftlet/pose_t.hpp
    share/bash-completion/completions/swiftlet
    share/bash-completion/completions/swiftletd
    share/man/man1/swiftlet.1.gz
    share/man/man8/swiftletd.8.gz
    share/zsh/vendor-completions/_swiftlet
    share/zsh/vendor-completions/_swiftletd
    share/cmake/swiftlet_messages/swiftlet_messages-config.cmake
    share/swiftlet/lcm/README.md
    share/swiftlet/lcm/pose_t.lcm
    share/doc/swiftlet/README.md
    share/doc/swiftlet/docs/flying.md
    share/doc/swiftlet/docs/images/office.png
    share/doc/swiftlet/docs/images/view_1600_light.png)
  if(NOT EXISTS ${PREFIX}/${file})
    message(SEND_ERROR "not installed: ${file}")
  endif()
endforeach()
file(GLOB modules ${BUILD}/python/swiftlet/_native.*.so)
if(modules)  # the build found pybind11
  execute_process(COMMAND ${CMAKE_COMMAND} -E env PYTHONPATH=${PREFIX}/lib/python3/dist-packages PYTHONDONTWRITEBYTECODE=1
    /usr/bin/python3 -c "import swiftlet; swiftlet.listen('memq://').receive(0)" COMMAND_ERROR_IS_FATAL ANY)
  foreach(file py.typed _native.pyi)
    if(NOT EXISTS ${PREFIX}/lib/python3/dist-packages/swiftlet/${file})
      message(SEND_ERROR "not installed: ${file}")
    endif()
  endforeach()
endif()
foreach(program swiftlet swiftletd)
  execute_process(COMMAND ${PREFIX}/bin/${program} --help OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)
endforeach()
file(REMOVE_RECURSE ${PREFIX})

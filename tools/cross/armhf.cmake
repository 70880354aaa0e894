# SPDX-License-Identifier: MIT
# SPDX-FileCopyrightText: 2026 The swiftlet authors
set(arch armhf)
set(processor armv7l)
set(triplet arm-linux-gnueabihf)
set(emulator qemu-arm-static)
# The note that GCC 7 changed the ABI of templates; nothing here is older.
set(CMAKE_CXX_FLAGS_INIT -Wno-psabi)
include(${CMAKE_CURRENT_LIST_DIR}/debian.cmake)

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/result.hpp"
#include "daemon/publish/lcm_transport.hpp"

namespace swiftlet {

/// What `swiftlet doctor` was asked to do.
struct DoctorCommand {
  std::string input = "radio://0/80/2M/E7E7E7E7E7";  ///< a live input, see InputUri
  std::string lcm_url = kDefaultLcmUrl;
  bool json = false;  ///< for programs
};

/// Looks at everything that a flight needs and prints what it finds to stdout. True: nothing stops a flight.
/// Errors: kInvalidInput: one of the URIs is none.
[[nodiscard]] Result<bool> run_doctor_command(const DoctorCommand& command);

}  // namespace swiftlet

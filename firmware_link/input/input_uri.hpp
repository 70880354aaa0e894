// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <any>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

#include "core/base/result.hpp"
#include "firmware_link/capture/capture_format.hpp"

namespace swiftlet {

struct LinkInput;

enum class InputNature : std::uint8_t {
  kVehicle,     ///< live: runs in real time and has no end
  kSimulation,  ///< flown in this process, as fast as it is read
  kFile,        ///< a recording or a laser log
  kFollowed,    ///< a recording that another program is still writing
};

/// A kind of input: one row of the table in input_kinds.cpp, from which all else about it derives.
struct InputKind {
  InputNature nature{};
  std::string_view scheme;   ///< "radio://"
  std::string_view form;     ///< what follows the scheme, for help: "DONGLE/CHANNEL/RATE/ADDRESS"
  std::string_view example;  ///< a whole URI
  /// Makes `address` of what follows the scheme. Error: kInvalidInput: what is wrong with it.
  Status (*parse)(std::string_view text, std::any& address) = nullptr;
  /// Opens a link to what parse() made. A vehicle's device need not be there yet: the link waits for it.
  /// Errors: kNotFound: a name that does not resolve. kInvalidInput: the machine offers no USB or no sockets.
  /// nullptr for what is read.
  Result<LinkInput> (*open)(const std::any& address) = nullptr;
  /// The vehicle that a recording of this input is attributed to. nullptr for what is read.
  CaptureVehicle (*recorded_vehicle)(const std::any& address) = nullptr;
};

/// In the order in which help lists them.
[[nodiscard]] std::span<const InputKind> input_kinds();
/// How inputs of these natures are written: "usb://N, udp://HOST:PORT or sim://WORLD".
[[nodiscard]] std::string input_forms(std::initializer_list<InputNature> natures);

/// A path, as a plain path, by replay:FILE or by follow:FILE.
struct InputFile {
  std::string path;
};
/// A vehicle on a USB cable.
struct UsbCableAddress {
  int index = 0;  ///< which of them, from 0
};

/// What an input's URI names.
struct InputUri {
  const InputKind* kind = nullptr;  ///< of input_kinds(); never null where parse_input_uri() succeeds
  std::any address;                 ///< InputFile, RadioAddress, ...: what the kind's parse() makes

  /// nullptr when the address is of another type.
  template <typename Address>
  [[nodiscard]] const Address* as() const {
    return std::any_cast<Address>(&address);
  }
  [[nodiscard]] bool is(InputNature nature) const { return kind->nature == nature; }
};

/// A URI of one of the kinds, or a plain path. Errors: kInvalidInput, with a line for the user that shows how
/// to write it.
[[nodiscard]] Result<InputUri> parse_input_uri(const std::string& uri);
/// The path of an input that is a file; empty: it is none.
[[nodiscard]] std::string file_of_input(const std::string& uri);

}  // namespace swiftlet

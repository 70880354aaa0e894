// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#pragma once

#include <string>

#include "core/base/result.hpp"
#include "core/mapping/picture/painter.hpp"

namespace swiftlet {

/// The bytes of a PNG file, 8 bits RGB. kOutOfSpace: libpng could not.
[[nodiscard]] Result<std::string> encode_png(const RgbImage& image);

}  // namespace swiftlet

// SPDX-License-Identifier: MIT
// SPDX-FileCopyrightText: 2026 The swiftlet authors
#include "core/frontend/chi_square.hpp"

#include <boost/math/distributions/chi_squared.hpp>
#include <boost/math/distributions/normal.hpp>
#include <cmath>

#include "core/base/check.hpp"

namespace swiftlet {

ChiSquareTable::ChiSquareTable(double confidence) {
  SWIFTLET_CHECK(confidence > 0.0 && confidence < 1.0, "a confidence lies between 0 and 1");
  normal_quantile_ = boost::math::quantile(boost::math::normal(), confidence);
  for (std::size_t n = 1; n <= kMaxDegrees; ++n)
    quantile_[n] = boost::math::quantile(boost::math::chi_squared(static_cast<double>(n)), confidence);
}

double ChiSquareTable::quantile(std::size_t degrees_of_freedom) const {
  if (degrees_of_freedom <= kMaxDegrees) return quantile_[degrees_of_freedom];
  const double n = static_cast<double>(degrees_of_freedom);
  const double root = 1.0 - 2.0 / (9.0 * n) + normal_quantile_ * std::sqrt(2.0 / (9.0 * n));
  return n * root * root * root;
}

}  // namespace swiftlet

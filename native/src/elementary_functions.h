// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

/// Functions whose results are the same bytes on every machine. Those of the C library are not: they differ by system, by its
/// version, and by what the processor can do. No other code calls them; only functions that IEEE 754 defines exactly, such as
/// std::sqrt, std::floor, std::round, are the same everywhere.
namespace mrc::elementary {

double sin(double x);
double cos(double x);
double atan2(double y, double x);
double exp(double x);
double pow(double x, double y);

}  // namespace mrc::elementary

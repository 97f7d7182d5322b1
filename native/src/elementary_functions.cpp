// SPDX-License-Identifier: GPL-3.0-or-later
#include "elementary_functions.h"

#include <musl/libm.h>

#include <limits>

static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0, "the same bytes need plain IEEE 754 doubles");

// The files of musl, in C, are compiled as parts of this one, so that no name of theirs is seen anywhere else.
namespace mrc::elementary {
namespace musl {
namespace {

// The order matters.
// clang-format off
#include <musl/scalbn.c>

#include <musl/atan.c>
#include <musl/atan2.c>

double __cos(double x, double y);
double __sin(double x, double y, int iy);
int __rem_pio2(double x, double* y);
int __rem_pio2_large(double* x, double* y, int e0, int nx, int prec);
#include <musl/__cos.c>
#include <musl/__rem_pio2.c>
#include <musl/__rem_pio2_large.c>
#include <musl/__sin.c>
#include <musl/cos.c>
#include <musl/sin.c>

#include <musl/__math_invalid.c>
#include <musl/__math_xflow.c>
#include <musl/__math_oflow.c>
#include <musl/__math_uflow.c>
#include <musl/exp_data.c>
#include <musl/exp.c>
#undef N
#undef T

namespace power {
#include <musl/pow_data.c>
#undef N
#include <musl/pow.c>
}  // namespace power
// clang-format on

}  // namespace
}  // namespace musl

double sin(double x) { return musl::sin(x); }
double cos(double x) { return musl::cos(x); }
double atan2(double y, double x) { return musl::atan2(y, x); }
double exp(double x) { return musl::exp(x); }
double pow(double x, double y) { return musl::power::pow(x, y); }

}  // namespace mrc::elementary

// SPDX-License-Identifier: GPL-3.0-or-later
#include "elementary_functions.h"
#include "libm.h"

#include <limits>

static_assert(std::numeric_limits<double>::is_iec559 && FLT_EVAL_METHOD == 0, "the same bytes need plain IEEE 754 doubles");

namespace mrc::elementary {

// The files are compiled as part of this one, so that nothing else sees their names; in the order in which they need each other.
namespace musl {
namespace {

#include "scalbn.c"

#include "atan.c"
#include "atan2.c"

double __cos(double x, double y);
double __sin(double x, double y, int iy);
int __rem_pio2(double x, double* y);
int __rem_pio2_large(double* x, double* y, int e0, int nx, int prec);
#include "__cos.c"
#include "__rem_pio2.c"
#include "__rem_pio2_large.c"
#include "__sin.c"
#include "cos.c"
#include "sin.c"

#include "__math_invalid.c"
#include "__math_xflow.c"
#include "__math_oflow.c"
#include "__math_uflow.c"
#include "exp_data.c"
#include "exp.c"
#undef N
#undef T

// pow.c has helpers of the same names as those of exp.c.
namespace power {
#include "pow_data.c"
#undef N
#include "pow.c"
}  // namespace power

}  // namespace
}  // namespace musl

double sin(double x) { return musl::sin(x); }
double cos(double x) { return musl::cos(x); }
double atan2(double y, double x) { return musl::atan2(y, x); }
double exp(double x) { return musl::exp(x); }
double pow(double x, double y) { return musl::power::pow(x, y); }

}  // namespace mrc::elementary

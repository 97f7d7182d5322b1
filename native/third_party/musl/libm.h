// SPDX-License-Identifier: GPL-3.0-or-later
// In place of musl's own internal header: what the files here need of it, for any C++ compiler.
#pragma once

#include <float.h>
#include <math.h>
#include <stdint.h>

#include <bit>

// Plain double arithmetic everywhere: the same operations in the same order give the same bits.
#define double_t double
#undef __FP_FAST_FMA
#define TOINT_INTRINSICS 0

#define WANT_ROUNDING 1
#define FORCE_EVAL(x)  // floating-point exceptions are not looked at
#define fp_force_eval(x)
#define fp_barrier(x) (x)
#define eval_as_double(x) (x)
#define issignaling_inline(x) 0
#define predict_false(x) (x)
#define hidden

#define asuint64(x) std::bit_cast<uint64_t, double>(x)
#define asdouble(i) std::bit_cast<double, uint64_t>(i)
#define GET_HIGH_WORD(hi, d) (hi) = static_cast<uint32_t>(asuint64(d) >> 32)
#define GET_LOW_WORD(lo, d) (lo) = static_cast<uint32_t>(asuint64(d))
#define EXTRACT_WORDS(hi, lo, d) GET_HIGH_WORD(hi, d), GET_LOW_WORD(lo, d)
#define SET_LOW_WORD(d, lo) (d) = asdouble((asuint64(d) & ~uint64_t{0xffffffff}) | static_cast<uint32_t>(lo))

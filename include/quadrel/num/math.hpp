// The transcendental functions, for every number type: one text each, made of + - * / sqrt,
// rounding and comparisons only, so that the bits do not depend on the instruction set, the
// compiler or a mathematical library. On double they are computed in double.
//
// Largest errors in units in the last place (ulp), asserted by tests/num/ulp_test.cpp against MPFR
// and measured for float by tests/num/ulp_exhaustive.cpp:
//
//   function     bound   measured, float   measured, double   arguments
//   exp2, exp    1       0.76              0.60               all; above 0.60 only for denormals
//   log2, log    0.51    0.501             0.500              all, denormals included
//   pow          1       0.68              0.63               normal results
//   sin, cos     0.85    0.80              0.74               |x| <= 4194304; double |x| <= 2^30
//   tan          2.5     2.16              1.85               as sin
//   atan2, atan  0.85    0.66              0.60               all
//   asin, acos   2       1.68              1.68               all
//
// Rules for signed zeros, infinities, NaN and arguments out of range stand with each function; they
// are asserted by tests/num/special_values_test.cpp.
#pragma once

#include "quadrel/num/exp.hpp"
#include "quadrel/num/inverse_trig.hpp"
#include "quadrel/num/log.hpp"
#include "quadrel/num/pow.hpp"
#include "quadrel/num/trig.hpp"

// The transcendental functions, for every number type: one text each, made of + - * / sqrt,
// rounding and comparisons only, so that the bits do not depend on the instruction set, the
// compiler or a mathematical library. On double they are computed in double.
#pragma once

#include "quadrel/num/exp.hpp"
#include "quadrel/num/inverse_trig.hpp"
#include "quadrel/num/log.hpp"
#include "quadrel/num/pow.hpp"
#include "quadrel/num/trig.hpp"

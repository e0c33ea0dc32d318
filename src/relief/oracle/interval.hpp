// The intervals of num/, by the names that the judge's texts use.
#pragma once

#include "quadrel/num/range/interval.hpp"

namespace quadrel::oracle {

using quadrel::hull;
using Interval = RealInterval;

inline double up(double x) { return next_up(x); }
inline double down(double x) { return next_down(x); }

}  // namespace quadrel::oracle

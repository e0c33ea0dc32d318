// The table of built-ins: one overload set for every number type, with every order of operations
// written down. "Bit for bit a listing" means the listing over this table (and, where it calls
// exp2, pow, sin and the like, over math.hpp).
#pragma once

#include "quadrel/num/common.hpp"
#include "quadrel/num/componentwise.hpp"
#include "quadrel/num/geometric.hpp"
#include "quadrel/num/loop.hpp"
#include "quadrel/num/matrix.hpp"
#include "quadrel/num/mixed.hpp"

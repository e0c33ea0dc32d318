// The lists of stages, room by room. A new algorithm is one header, and one line in its room's
// list.
#pragma once

#include "quadrel/quad/stages.hpp"
#include "quadrel/relief/frame/stages.hpp"
#include "quadrel/relief/hit/stages.hpp"
#include "quadrel/relief/occlusion/stages.hpp"
#include "quadrel/relief/shadow/stages.hpp"
#include "quadrel/relief/shell/stages.hpp"
#include "quadrel/relief/surface/stages.hpp"
#include "quadrel/relief/trace/cone/stages.hpp"
#include "quadrel/relief/trace/curved/stages.hpp"
#include "quadrel/relief/trace/engine/stages.hpp"
#include "quadrel/relief/trace/exact/stages.hpp"
#include "quadrel/relief/trace/layer/stages.hpp"
#include "quadrel/relief/trace/march/stages.hpp"
#include "quadrel/relief/trace/offset/stages.hpp"
#include "quadrel/relief/trace/oracle/stages.hpp"
#include "quadrel/relief/trace/table/stages.hpp"

// Results as lines, from one process to another and in a log.
#pragma once

#include <string>

#include "stress/checks.hpp"

namespace quadrel::stress {

std::string to_line(const SceneResult& result);
SceneResult from_line(const std::string& line);

}  // namespace quadrel::stress

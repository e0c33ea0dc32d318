// Stages that the command line put in the place of a file's.
#pragma once

#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel {

/// Where -D chose another stage than the file, parameters that only the file's stage takes are
/// removed from the document, those that -D sets itself excepted. `before`: the file's own root.
/// Returns a line for each stage that lost some.
std::vector<std::string> drop_replaced_parameters(const Json& before, SceneDocument& document);

}  // namespace quadrel

// What every report on two images says of how they were prepared.
#pragma once

#include <nlohmann/json.hpp>

#include "quadrel/compare.hpp"

namespace quadrel {

std::string preparation_text(const Preparation& preparation);
nlohmann::ordered_json preparation_json(const Preparation& preparation);

/// JSON has no NaN and no infinity: such values are the strings that fmt gives.
nlohmann::ordered_json number_json(double value);
nlohmann::ordered_json number_json(float value);

/// A channel's value, by its bits.
nlohmann::ordered_json value_json(ChannelType type, std::uint32_t bits);

}  // namespace quadrel

#include "stages.hpp"

QUADREL_STAGES(plugin_tests::Tilt, plugin_tests::Stripes);

#include "stages.hpp"

QUADREL_STAGES(plugin_tests::Waves);

#include "plugin/stages/stages.hpp"

QUADREL_STAGES(plugin_tests::Waves);

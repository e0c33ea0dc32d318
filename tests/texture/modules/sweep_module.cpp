#include "texture/modules/sweep.hpp"

#include "quadrel/num/lanes.hpp"

extern "C" __attribute__((visibility("default"))) void quadrel_texture_sweep(
    quadrel::test::SweepRequest* request) {
    quadrel::test::sweep<quadrel::Lanes>(*request);
}

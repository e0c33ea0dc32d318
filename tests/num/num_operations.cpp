// The operations on the lanes of one instruction set.
#include "quadrel/num/lanes.hpp"

#include "num/operations.hpp"

extern "C" __attribute__((visibility("default"))) quadrel::num_tests::OperationTable
quadrel_num_operations(int packets_only) {
    using namespace quadrel::num_tests;
    constexpr int lanes = quadrel::lanes_of<quadrel::Lanes>;
    if (packets_only != 0)
        return {packet_rows<quadrel::Lanes>.data(), packet_rows<quadrel::Lanes>.size(), lanes};
    return {common_rows<quadrel::Lanes>.data(), common_rows<quadrel::Lanes>.size(), lanes};
}

// View-dependent displacement maps over curved bases, as a Markdown table: by how many curvatures
// the map has, how many rays it clips that meet the relief, or lets meet what they pass, and how
// far off the others are. The truth is the bilinear field met by the bent ray in double.
#pragma once

namespace quadrel::bench {

void print_curved_table();

}  // namespace quadrel::bench

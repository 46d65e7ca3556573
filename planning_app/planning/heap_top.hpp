// How high a heap in a bed stands after a dump: over what stands higher than the truck zone's ceiling the kernel lets nothing pass, not even the bucket on its way back.
#pragma once

#include "planning/bed_map.hpp"

namespace berm::app {

// How the soil lies in this truck, as far as it was weighed and seen.
struct HeapedSoil {
  double density = BedMap::loose_density;  // kg/m3
  double slope = BedMap::repose;           // rise over run
};

// Hidden cells are higher or lower than by the books by as much as what is seen near them is: a heap's hidden top by what is seen of that heap, not by how full the
// bed's rims are. All are known afterwards.
BedGrid filled_nearby(const BedGrid& seen, const BedGrid& noted);

// seen: of the bed map; heights: the same, the hidden cells filled.
HeapedSoil heaped_soil(const BedGrid& seen, const BedGrid& heights, double load_kg);

// How high a dump about the point heaps up, m over the floor; heights all known. It lies as a blunt cone on what is there: its top as large as half of what a bucket
// covers each way, its sides at the soil's slope.
double top_after(const BedGrid& heights, const BedPoint& at, double kg, const HeapedSoil& soil, const ImplementScale& scale);

}  // namespace berm::app

// PCL's fastest way: the sweep as an organised cloud, normals from integral images, connected components of like planes.
#pragma once

#include "planes_parties.hpp"

namespace berm::bench {

std::vector<PlaneParty> pcl_image_parties(const SweepPoints& sweep, bool every_setting);

}  // namespace berm::bench

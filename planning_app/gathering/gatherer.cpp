#include "gathering/gatherer.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace berm::app {
namespace {

// For a beam of which no scan plane is known: any plane that holds it.
Eigen::Isometry3d frame_of_beam(const Eigen::Vector3d& origin, const Eigen::Vector3d& ray) {
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  const Eigen::Vector3d x = ray.normalized();
  const Eigen::Vector3d z = (std::abs(x.z()) < 0.9 ? x.cross(Eigen::Vector3d::UnitZ()) : x.cross(Eigen::Vector3d::UnitX())).normalized();
  frame.linear() << x, z.cross(x), z;
  frame.translation() = origin;
  return frame;
}

}  // namespace

PointCloudGatherer::PointCloudGatherer(const GatheringOptions& options) : options_(options), store_(options.voxel_m, options.capacity) {}

std::size_t PointCloudGatherer::add_scanner(const ScannerDeviations& deviations, KinematicChain chain) {
  const std::size_t number = scanners_.size();
  scanners_.push_back({number, deviations, std::move(chain), EpochCounter(options_.epoch), 0, false, Eigen::Isometry3d::Identity(), {}});
  contributors_.add_scanner();
  return number;
}

void PointCloudGatherer::clear() {
  store_ = CloudStore(options_.voxel_m, options_.capacity);
  contributors_.clear();
  for (Scanner& scanner : scanners_) scanner.has_scan = false;
  widest_m_ = 0.0;
}

void PointCloudGatherer::add_scan(std::size_t scanner, std::span<const double> joint_values, std::span<const PolarReturn> returns, double time_s) {
  add_scan(scanner, scanners_.at(scanner).chain.pose(joint_values), returns, time_s);
}

// One count for all scanners: of two points the higher epoch is the one that began later, whoever's it is.
void PointCloudGatherer::begin_epoch(Scanner& scanner) {
  scanner.epoch = ++epoch_;
  contributors_.begin_epoch(scanner.number, times_.newest());
}

void PointCloudGatherer::take_valid(std::span<const PolarReturn> returns) {
  valid_.clear();
  double last = -1e9;
  for (const PolarReturn& p : returns) {
    const bool usable = std::isfinite(p.angle_rad) && p.angle_rad > last && std::abs(p.angle_rad) <= std::numbers::pi && p.range_m > 1e-3 && p.range_m <= options_.range_limit_m;
    if (!usable) {
      ++counts_.ignored;
      continue;
    }
    valid_.push_back(p);
    last = p.angle_rad;
  }
}

void PointCloudGatherer::add_scan(std::size_t number, const Eigen::Isometry3d& frame, std::span<const PolarReturn> returns, double time_s) {
  Scanner& scanner = scanners_.at(number);
  ++counts_.scans;
  counts_.points_in += returns.size();
  times_.begin_scan(time_s, store_);
  if (scanner.epochs.begins_with(frame.linear())) begin_epoch(scanner);
  take_valid(returns);
  if (scanner.has_scan) {
    const ScannerDeviations& d = scanner.deviations;
    const DeletionRule rule{options_.shrink_m, options_.quantile, d.range_m, d.along_rad, d.across_rad, options_.max_gap_rad, options_.max_turn_rad};
    volume_.build(scanner.frame, scanner.returns, frame, valid_, rule);
    if (!volume_.empty()) delete_passed();
  }
  for (const PolarReturn& p : valid_) insert(scanner, frame, p);
  scanner.has_scan = true;
  scanner.frame = frame;
  scanner.returns.swap(valid_);
}

void PointCloudGatherer::add_points(std::size_t number, const Eigen::Isometry3d& mount, const Eigen::Vector3d& origin,
                                    std::span<const ScanPoint> points, double time_s) {
  Scanner& scanner = scanners_.at(number);
  ++counts_.scans;
  counts_.points_in += points.size();
  times_.begin_scan(time_s, store_);
  if (scanner.epoch == 0) begin_epoch(scanner);
  for (const ScanPoint& p : points) {
    const Eigen::Vector3d place(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z));
    const Eigen::Vector3d ray = mount.linear() * (place - origin);
    const double range = ray.norm();
    if (range > 1e-3 && range <= options_.range_limit_m)
      insert(scanner, frame_of_beam(mount * origin, ray), {0.0, range});
    else
      ++counts_.ignored;
  }
  scanner.has_scan = false;
}

void PointCloudGatherer::delete_in_block(const CloudStore::Block& block) {
  for (std::uint64_t left = block.occupied; left != 0; left &= left - 1)
    for (std::uint32_t index = block.first[static_cast<std::size_t>(std::countr_zero(left))]; index != CloudStore::kNone;
         index = store_[index].next) {
      const GatheredPoint& p = store_[index];
      if (volume_.contains(static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z))) passed_.push_back(index);
    }
}

// The volume is a thin slab: block columns along the axis nearest its normal, and of each the few blocks within the slab.
void PointCloudGatherer::delete_passed() {
  passed_.clear();
  const double edge = store_.block_m();
  const Eigen::Vector3d &normal = volume_.normal(), &origin = volume_.origin();
  int c = 0;
  normal.cwiseAbs().maxCoeff(&c);
  const int a = (c + 1) % 3, b = (c + 2) % 3;
  const Eigen::Vector3d low = volume_.box().min() / edge, high = volume_.box().max() / edge;
  const auto cell = [](double v) { return static_cast<std::int32_t>(std::floor(v)); };
  const double columns = (std::floor(high[a]) - std::floor(low[a]) + 1.0) * (std::floor(high[b]) - std::floor(low[b]) + 1.0);
  const double half_block = 0.5 * edge * normal.cwiseAbs().sum(), corner = 0.866025403784439 * edge;
  if (columns * 3.0 > static_cast<double>(store_.blocks().size())) {
    for (const CloudStore::Block& block : store_.blocks()) {
      const Eigen::Vector3d middle = edge * Eigen::Vector3d(block.key[0] + 0.5, block.key[1] + 0.5, block.key[2] + 0.5) - origin;
      if (std::abs(normal.dot(middle)) <= volume_.slab_half_width(middle.norm() + corner) + half_block) delete_in_block(block);
    }
  } else {
    std::int32_t key[3];
    for (key[a] = cell(low[a]); key[a] <= cell(high[a]); ++key[a])
      for (key[b] = cell(low[b]); key[b] <= cell(high[b]); ++key[b]) {
        const double da = edge * (key[a] + 0.5) - origin[a], db = edge * (key[b] + 0.5) - origin[b];
        const double middle = -(normal[a] * da + normal[b] * db) / normal[c];
        const double range = std::sqrt(da * da + db * db + middle * middle) + corner;
        // A block farther along c than the middle is farther from the scanner: the slab is followed outward until it is wider than the step.
        const double half = (volume_.slab_half_width(range) + half_block) / std::abs(normal[c]);
        const double grown = (volume_.slab_half_width(range + half) + half_block) / std::abs(normal[c]) + 0.5 * edge;
        const std::int32_t first = std::max(cell((origin[c] + middle - grown) / edge), cell(low[c]));
        const std::int32_t last = std::min(cell((origin[c] + middle + grown) / edge), cell(high[c]));
        for (key[c] = first; key[c] <= last; ++key[c])
          if (const CloudStore::Block* block = store_.block(key[0], key[1], key[2])) delete_in_block(*block);
      }
  }
  for (const std::uint32_t index : passed_) store_.remove(index);
  counts_.deleted += passed_.size();
}

void PointCloudGatherer::insert(const Scanner& scanner, const Eigen::Isometry3d& frame, const PolarReturn& p) {
  const Eigen::Vector3d direction = std::cos(p.angle_rad) * frame.linear().col(0) + std::sin(p.angle_rad) * frame.linear().col(1);
  const Eigen::Vector3d place = frame.translation() + p.range_m * direction, across = frame.linear().col(2);
  if (!(place.cwiseAbs().maxCoeff() < 1e6)) {
    ++counts_.ignored;
    return;
  }
  GatheredPoint fresh{static_cast<float>(place[0]),
                      static_cast<float>(place[1]),
                      static_cast<float>(place[2]),
                      point_covariance(scanner.deviations, p.range_m, {direction[0], direction[1], direction[2]}, {across[0], across[1], across[2]}),
                      times_.newest(),
                      CloudStore::kNone};
  const double quantile = options_.quantile;
  const auto sd = [](float variance) { return std::sqrt(static_cast<double>(variance)); };
  const Vector3 half{quantile * sd(fresh.covariance.xx), quantile * sd(fresh.covariance.yy), quantile * sd(fresh.covariance.zz)};
  widest_m_ = std::max(widest_m_, largest_half_width(fresh.covariance, 1.0));
  std::uint32_t best = CloudStore::kNone;
  double best_separation = 1.0;
  Vector3 best_between{};
  store_.for_each_near({place[0], place[1], place[2]}, half, quantile, widest_m_, [&](std::uint32_t index) {
    const GatheredPoint& old = store_[index];
    if (contributors_.has(index, scanner.number, old.scan)) return;
    const Vector3 between{static_cast<double>(fresh.x - old.x), static_cast<double>(fresh.y - old.y), static_cast<double>(fresh.z - old.z)};
    if (std::abs(between[0]) > half[0] + quantile * sd(old.covariance.xx) || std::abs(between[1]) > half[1] + quantile * sd(old.covariance.yy) ||
        std::abs(between[2]) > half[2] + quantile * sd(old.covariance.zz))
      return;
    const double separation = ellipsoid_separation(old.covariance, fresh.covariance, between, options_.quantile);
    if (separation > best_separation || !ellipsoids_overlap(old.covariance, fresh.covariance, between, options_.quantile)) return;
    best = index;
    best_separation = separation;
    best_between = between;
  });
  if (best == CloudStore::kNone) {
    contributors_.began(store_.insert(fresh, scanner.epoch), scanner.number);
    return;
  }
  const GatheredPoint& old = store_[best];
  const FusedPoint fused = fuse_points(old.covariance, fresh.covariance, best_between, options_.least_m);
  const GatheredPoint merged{old.x + static_cast<float>(fused.shift[0]),
                             old.y + static_cast<float>(fused.shift[1]),
                             old.z + static_cast<float>(fused.shift[2]),
                             fused.covariance,
                             fresh.scan,
                             CloudStore::kNone};
  contributors_.joined(best, scanner.number, old.scan);
  store_.move(best, merged, std::max(store_.epoch(best), scanner.epoch));
  ++counts_.merged;
}

GatheringCounts PointCloudGatherer::counts() const {
  GatheringCounts out = counts_;
  out.overflowed = store_.overflowed();
  return out;
}

std::size_t PointCloudGatherer::bytes() const { return store_.bytes() + contributors_.bytes() + times_.bytes(); }

std::vector<ScanPoint> PointCloudGatherer::points() const {
  std::vector<ScanPoint> out;
  out.reserve(store_.size());
  for (std::uint32_t index = 0; index < store_.places(); ++index) {
    if (!store_.used(index)) continue;
    const GatheredPoint& p = store_[index];
    out.push_back({p.x, p.y, p.z, p.scan, times_.of(p.scan)});
  }
  std::sort(out.begin(), out.end(), [](const ScanPoint& p, const ScanPoint& q) { return p.scanline < q.scanline; });
  return out;
}

}  // namespace berm::app

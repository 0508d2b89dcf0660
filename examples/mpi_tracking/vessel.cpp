// See vessel.h. Sums and products are written out: what is computed here decides where particles go, and has to have
// the same bits on all machines, whatever order their Eigen adds in.
#include "mpi_tracking/vessel.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tracking {

namespace {

Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y() * b.z() - a.z() * b.y(), a.z() * b.x() - a.x() * b.z(), a.x() * b.y() - a.y() * b.x()};
}

double dot(const Vec3& a, const Vec3& b) { return a.x() * b.x() + a.y() * b.y() + a.z() * b.z(); }

}  // namespace

Vessel::Vessel(pierce::TriangleSoup<double> soup) : soup_(std::move(soup)) {
    Eigen::AlignedBox3d box;
    for (const Vec3& position : soup_.positions) box.extend(position);
    const Vec3 center = 0.5 * (box.min() + box.max());
    double area = 0;
    areas_.reserve(soup_.triangles.size());
    for (const pierce::IndexTriple& triangle : soup_.triangles) {
        const Vec3 normal = normal_of(triangle);
        area += std::sqrt(squared_length(normal));
        areas_.push_back(area);
        volume_ += dot(soup_.positions[triangle[0]] - center, normal);
    }
    const int exponent = std::ilogb(std::sqrt(squared_length(box.diagonal())));
    hair_ = std::ldexp(volume_ > 0 ? 1.0 : -1.0, exponent - 32);
    length_unit_ = std::ldexp(1.0, exponent - 16);
}

Vec3 Vessel::normal_of(const pierce::IndexTriple& triangle) const {
    const Vec3& a = soup_.positions[triangle[0]];
    return cross(soup_.positions[triangle[1]] - a, soup_.positions[triangle[2]] - a);
}

bool Vessel::has_inside() const {
    return !areas_.empty() && areas_.back() > 0 && std::abs(volume_) > 0 && std::isfinite(areas_.back() + volume_);
}

Hash Vessel::hash() const {
    Hash hash;
    for (const Vec3& position : soup_.positions)
        for (int k = 0; k < 3; ++k) hash.add(position[k]);
    for (const pierce::IndexTriple& triangle : soup_.triangles)
        for (const std::uint32_t corner : triangle) hash.add(std::uint64_t{corner});
    for (const std::uint32_t face : soup_.faces) hash.add(std::uint64_t{face});
    return hash;
}

double Vessel::mean_chord() const { return 4 * (std::abs(volume_) / 6) / (areas_.back() / 2); }

Vessel::Place Vessel::place(const Words& words) const {
    const double fraction = (words[0] + words[1] * 0x1p-32) * 0x1p-32;  // below 1: what is below 2^53 is not rounded up
    const auto found = std::upper_bound(areas_.begin(), areas_.end(), fraction * areas_.back());
    const auto last = static_cast<std::ptrdiff_t>(areas_.size()) - 1;
    const pierce::IndexTriple& triangle =
        soup_.triangles[static_cast<std::size_t>(std::min(found - areas_.begin(), last))];
    double u = words[2] * 0x1p-32, v = words[3] * 0x1p-32;
    if (u + v > 1) {  // the other half of the parallelogram
        u = 1 - u;
        v = 1 - v;
    }
    const Vec3& a = soup_.positions[triangle[0]];
    const Vec3 edges = u * (soup_.positions[triangle[1]] - a) + v * (soup_.positions[triangle[2]] - a);
    const Vec3 outwards = normal_of(triangle);
    const Vec3 normal = outwards / std::sqrt(squared_length(outwards));
    return {a + edges - hair_ * normal, volume_ > 0 ? Vec3(-normal) : normal};
}

}  // namespace tracking

#include "sim/robot/urdf_spec.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <mujoco/mujoco.h>
#include <urdf_model/model.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/excerpt.h"
#include "models/robots/robot_folder.h"

namespace warmjoint {
namespace {

constexpr double kLeastMass = 1e-6;  // kg; why: no motion of a robot shows a milligram
/// Least moment of inertia of a body, as a share of its mass (m^2). Why: that of a body of 1 mm.
constexpr double kLeastInertia = 1e-6;

Eigen::Matrix3d RotationOf(const urdf::Rotation& r) {
  return Eigen::Quaterniond(r.w, r.x, r.y, r.z).normalized().toRotationMatrix();
}

/// Moments of inertia, ascending, as the nearest that a body can have: positive, and none larger than the sum of the others.
bool MendMoments(double mass, Eigen::Vector3d& moments) {
  const Eigen::Vector3d given = moments;
  moments = moments.cwiseMax(kLeastInertia * mass);
  moments[2] = std::min(moments[2], moments[0] + moments[1]);
  // what the rounding of a file leaves of a flat body is no fault
  return (moments - given).cwiseAbs().maxCoeff() > 1e-3 * moments[2];
}

/// Puts a URDF together, body by body.
class Builder {
 public:
  Builder(const urdf::ModelInterface& robot, const Place& place) : robot_(robot), place_(place) {}

  SpecPtr Build(std::vector<std::string>& notices) {
    spec_->compiler.degree = 0;
    Add(*robot_.getRoot(), mjs_findBody(spec_.get(), "world"), nullptr, 0);
    const auto say = [&](const std::vector<std::string>& names, const char* what) {
      if (!names.empty()) notices.push_back(fmt::format("{}: {}", what, ExcerptOfList(names)));
    };
    say(mended_, "inertia that no body can have, taken as the nearest that one can");
    say(massless_, "links that move without a mass of their own, taken as massless");
    say(turned_, "joints whose lower limit is above the upper one, taken as unlimited");
    say(odd_, "joints that float or slide in a plane, taken to stand still");
    return std::move(spec_);
  }

 private:
  void Add(const urdf::Link& link, mjsBody* parent, const urdf::Joint* joint, int depth) {
    constexpr int deepest = 500;  // why: no robot has as many links in a row, and a loop has
    if (depth > deepest) Refuse(place_, "joins more than {} links in a row", deepest);
    mjsBody* body = mjs_addBody(parent, nullptr);
    mjs_setName(body->element, link.name.c_str());
    if (joint) AddJoint(*joint, *body);
    AddInertial(link, joint != nullptr, *body);
    for (const auto& child : link.child_links) {
      Add(*child, body, child->parent_joint.get(), depth + 1);
    }
  }

  void AddJoint(const urdf::Joint& joint, mjsBody& body) {
    // where the link stands in its parent
    const urdf::Pose& pose = joint.parent_to_joint_origin_transform;
    const urdf::Rotation& r = pose.rotation;
    std::ranges::copy(std::array{pose.position.x, pose.position.y, pose.position.z}, body.pos);
    std::ranges::copy(std::array{r.w, r.x, r.y, r.z}, body.quat);

    const bool slides = joint.type == urdf::Joint::PRISMATIC;
    const bool turns = joint.type == urdf::Joint::REVOLUTE || joint.type == urdf::Joint::CONTINUOUS;
    if (!slides && !turns) {
      if (joint.type != urdf::Joint::FIXED) odd_.push_back(joint.name);
      return;
    }
    mjsJoint* made = mjs_addJoint(&body, nullptr);
    mjs_setName(made->element, joint.name.c_str());
    made->type = slides ? mjJNT_SLIDE : mjJNT_HINGE;
    std::ranges::copy(std::array{joint.axis.x, joint.axis.y, joint.axis.z}, made->axis);
    made->limited = mjLIMITED_FALSE;
    if (joint.type == urdf::Joint::CONTINUOUS || !joint.limits) return;
    const auto& [lower, upper] = std::pair(joint.limits->lower, joint.limits->upper);
    if (lower > upper) turned_.push_back(joint.name);
    // no range at all, or one without an end, bounds nothing
    if (!(lower < upper) || !std::isfinite(lower) || !std::isfinite(upper)) return;
    made->limited = mjLIMITED_TRUE;
    made->range[0] = lower;
    made->range[1] = upper;
  }

  void AddInertial(const urdf::Link& link, bool moves, mjsBody& body) {
    const urdf::Inertial* given = link.inertial.get();
    const double mass = given ? given->mass : 0;
    body.explicitinertial = 1;
    if (!(mass > kLeastMass)) {
      body.mass = moves ? kLeastMass : 0;
      if (moves) std::ranges::fill(body.inertia, kLeastInertia * kLeastMass);
      // a frame that is fixed to a link has none by right
      const bool fixed = !link.parent_joint || link.parent_joint->type == urdf::Joint::FIXED;
      if (!fixed) massless_.push_back(link.name);
      return;
    }
    Eigen::Matrix3d inertia;
    inertia << given->ixx, given->ixy, given->ixz, given->ixy, given->iyy, given->iyz, given->ixz,
        given->iyz, given->izz;
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(inertia);
    Eigen::Vector3d moments = solver.eigenvalues();
    if (!moments.allFinite()) Refuse(place_, "the inertia of link '{}' is no number", link.name);
    if (MendMoments(mass, moments)) mended_.push_back(link.name);

    // principal axes in those of the link, right-handed
    Eigen::Matrix3d axes = RotationOf(given->origin.rotation) * solver.eigenvectors();
    if (axes.determinant() < 0) axes.col(0) *= -1;
    const Eigen::Quaterniond q(axes);
    const urdf::Vector3& at = given->origin.position;
    body.mass = mass;
    std::ranges::copy(std::array{at.x, at.y, at.z}, body.ipos);
    std::ranges::copy(std::array{q.w(), q.x(), q.y(), q.z()}, body.iquat);
    std::copy_n(moments.data(), 3, body.inertia);
  }

  const urdf::ModelInterface& robot_;
  const Place& place_;
  SpecPtr spec_{mj_makeSpec()};
  std::vector<std::string> mended_, massless_, turned_, odd_;
};

}  // namespace

SpecPtr SpecOfUrdf(const std::filesystem::path& file, std::vector<std::string>& notices) {
  const urdf::ModelInterfaceSharedPtr robot = ReadUrdf(file);
  const Place place{file.string()};
  if (!robot->getRoot()) Refuse(place, "has no link to begin with");
  return Builder(*robot, place).Build(notices);
}

}  // namespace warmjoint

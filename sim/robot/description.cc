#include "sim/robot/description.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "models/foundation/bad_input.h"
#include "models/foundation/description_text.h"
#include "models/foundation/excerpt.h"
#include "models/foundation/names.h"
#include "models/foundation/xml_tags.h"
#include "sim/model/load_model.h"
#include "sim/robot/urdf_spec.h"

namespace warmjoint {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using RowMatrix3d = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>;

/// Takes out the shapes, which no torque needs: their files are often elsewhere.
void DeleteMeshes(mjSpec& spec) {
  for (mjsElement* geom : SpecElements(spec, mjOBJ_GEOM)) {
    if (mjs_asGeom(geom)->type == mjGEOM_MESH) mjs_delete(&spec, geom);
  }
  for (const mjtObj kind : {mjOBJ_MESH, mjOBJ_SKIN, mjOBJ_MATERIAL, mjOBJ_TEXTURE}) {
    for (mjsElement* element : SpecElements(spec, kind)) mjs_delete(&spec, element);
  }
}

ModelPtr CompileMjcf(const std::filesystem::path& file, std::vector<std::string>& notices) {
  ParsedModel parsed = ParseModel(file);
  std::ranges::move(parsed.notices, std::back_inserter(notices));
  try {
    return CompileModel(*parsed.spec, {file.string()});
  } catch (const BadInput&) {
    // with what is only to be seen gone; what is wrong besides is refused again
    parsed = ParseModel(file);
    DeleteMeshes(*parsed.spec);
    ModelPtr model = CompileModel(*parsed.spec, {file.string()});
    notices.emplace_back("meshes that cannot be read are left out; masses count as written");
    return model;
  }
}

ModelPtr LoadCompiled(const std::filesystem::path& file) {
  const Place place{file.string()};
  if (!std::filesystem::is_regular_file(file)) Refuse(place, "is no regular file; give one");
  ModelPtr model(mj_loadModel(file.c_str(), nullptr));
  if (!model) Refuse(place, "is no compiled model of MuJoCo {}", mj_versionString());
  for (const mjtObj kind : {mjOBJ_BODY, mjOBJ_JOINT}) {
    const int count = static_cast<int>(kind == mjOBJ_BODY ? model->nbody : model->njnt);
    for (int i = 0; i < count; ++i) {
      const char* const name = mj_id2name(model.get(), kind, i);
      if (name) RequireName("the name of a link or joint", name, place);
    }
  }
  return model;
}

std::string JointName(const mjModel& model, int joint) {
  const char* const name = mj_id2name(&model, mjOBJ_JOINT, joint);
  return name && *name ? std::string(name) : fmt::format("joint{}", joint);
}

bool IsHingeOrSlide(const mjModel& model, int joint) {
  return model.jnt_type[joint] == mjJNT_HINGE || model.jnt_type[joint] == mjJNT_SLIDE;
}

/// Sets what is not inertia or gravity to 0, and says what there was.
void TakeOut(mjModel& m, std::vector<std::string>& notices) {
  std::vector<std::string> taken;
  const auto clear = [&](mjtNum* values, std::ptrdiff_t count, const char* name) {
    if (!std::any_of(values, values + count, [](mjtNum one) { return one != 0; })) return;
    std::fill(values, values + count, 0);
    taken.emplace_back(name);
  };
  clear(m.dof_damping, m.nv, "damping");
  clear(m.dof_frictionloss, m.nv, "frictionloss");
  clear(m.dof_armature, m.nv, "armature");
  clear(m.jnt_stiffness, m.njnt, "springs");
  clear(m.tendon_stiffness, m.ntendon, "springs of tendons");
  clear(m.tendon_damping, m.ntendon, "damping of tendons");
  clear(m.body_gravcomp, m.nbody, "gravity compensation");
  m.opt.density = m.opt.viscosity = 0;
  // what the engine made of the armature goes, too
  const DataPtr data(mj_makeData(&m));
  mj_setConst(&m, data.get());
  m.opt.disableflags |= mjDSBL_CONSTRAINT | mjDSBL_CONTACT | mjDSBL_ACTUATION;
  if (taken.empty()) return;
  notices.push_back(fmt::format("{} of the description {} taken out: the log tells them anew",
                                fmt::join(taken, ", "), taken.size() == 1 ? "is" : "are"));
}

/// The body with a logged joint that carries `body`; 0 where none does.
int CarrierOf(const mjModel& m, const std::vector<ModelJoint>& joints, int body) {
  for (; body > 0; body = m.body_parentid[body]) {
    const bool logged = std::ranges::any_of(
        joints, [&](const ModelJoint& one) { return m.dof_bodyid[one.dof] == body; });
    if (logged) return body;
  }
  return 0;
}

/// Mass, first and second moments of a body in the axes of its carrier, where the joints between stand.
InertialParameters ParametersIn(const mjModel& m, const mjData& d, int body, int carrier) {
  const Matrix3d to = Eigen::Map<const RowMatrix3d>(d.xmat + 9 * carrier).transpose();
  const Matrix3d axes = to * Eigen::Map<const RowMatrix3d>(d.ximat + 9 * body);
  const Vector3d c = to * (Eigen::Map<const Vector3d>(d.xipos + 3 * body) -
                           Eigen::Map<const Vector3d>(d.xpos + 3 * carrier));
  const double mass = m.body_mass[body];
  const Vector3d moments = Eigen::Map<const Vector3d>(m.body_inertia + 3 * body);
  const Matrix3d inertia = axes * moments.asDiagonal() * axes.transpose() +
                           mass * (c.squaredNorm() * Matrix3d::Identity() - c * c.transpose());
  InertialParameters p;
  p << mass, mass * c, inertia(0, 0), inertia(1, 1), inertia(2, 2), inertia(0, 1), inertia(0, 2),
      inertia(1, 2);
  return p;
}

/// Of mass, its place by the size of the link, inertia by both.
InertialParameters SpreadOf(const InertialParameters& p) {
  const double mass = std::max(p[0], 1e-9);
  const Vector3d centre = p.segment<3>(1) / mass;
  // half the trace about the centre: the mean moment, 3/2 of it
  const double about_origin = (p[4] + p[5] + p[6]) / 2;
  const double inertia = std::max(about_origin - mass * centre.squaredNorm(), 0.0);
  const double size = std::max(centre.norm(), std::sqrt(inertia / mass));
  InertialParameters spread;
  spread << mass, Vector3d::Constant(mass * size),
      Eigen::Matrix<double, 6, 1>::Constant(inertia + mass * size * size);
  return spread.array() + 1e-9;
}

/// rest: [nq] where all joints stand
std::vector<RobotLink> LinksOf(const mjModel& m, const std::vector<ModelJoint>& joints,
                               const std::vector<double>& rest) {
  const DataPtr data(mj_makeData(&m));
  std::ranges::copy(rest, data->qpos);
  mj_kinematics(&m, data.get());
  std::vector<RobotLink> links;
  for (int body = 1; body < m.nbody; ++body) {
    const int carrier = CarrierOf(m, joints, body);
    if (carrier == 0) continue;
    // a carrier comes before what it carries
    if (carrier == body) {
      const char* const name = mj_id2name(&m, mjOBJ_BODY, body);
      links.push_back({body, name ? name : fmt::format("body {}", body), InertialParameters::Zero(),
                       InertialParameters::Zero()});
    }
    const auto link = std::ranges::find(links, carrier, &RobotLink::body);
    link->parameters += ParametersIn(m, *data, body, carrier);
  }
  for (RobotLink& link : links) link.spread = SpreadOf(link.parameters);
  return links;
}

ModelJoint FindModelJoint(const ReadModel& read, const std::string& name) {
  const mjModel& m = *read.model;
  for (int joint = 0; joint < m.njnt; ++joint) {
    if (JointName(m, joint) != name || !IsHingeOrSlide(m, joint)) continue;
    ModelJoint found{
        .name = name,
        .kind = m.jnt_type[joint] == mjJNT_SLIDE ? JointKind::linear : JointKind::rotary,
        .dof = m.jnt_dofadr[joint],
        .qpos = m.jnt_qposadr[joint],
        .range = {}};
    if (m.jnt_limited[joint]) {
      found.range = {{m.jnt_range[2 * joint], m.jnt_range[2 * joint + 1]}};
    }
    return found;
  }
  Refuse({read.name}, "has no hinge or slide '{}'{}", Excerpt(name), Suggestion(name, read.joints));
}

}  // namespace

bool RobotDescription::Moves(const ModelJoint& joint, const RobotLink& link) const {
  const int own = model->dof_bodyid[joint.dof];
  int body = link.body;
  while (body > 0 && body != own) body = model->body_parentid[body];
  return body == own;
}

Eigen::VectorXd RobotDescription::Parameters() const {
  Eigen::VectorXd all(10 * std::ssize(links));
  for (std::size_t i = 0; i < links.size(); ++i) {
    all.segment<10>(10 * static_cast<Eigen::Index>(i)) = links[i].parameters;
  }
  return all;
}

Eigen::VectorXd RobotDescription::Spreads() const {
  Eigen::VectorXd all(10 * std::ssize(links));
  for (std::size_t i = 0; i < links.size(); ++i) {
    all.segment<10>(10 * static_cast<Eigen::Index>(i)) = links[i].spread;
  }
  return all;
}

ReadModel ReadRobotModel(const std::filesystem::path& file) {
  ReadModel read{file.string(), nullptr, {}, {}};
  if (file.extension() == ".mjb") {
    read.model = LoadCompiled(file);
  } else if (IsUrdf(ReadDescription(file).text)) {
    const SpecPtr spec = SpecOfUrdf(file, read.notices);
    read.model = CompileModel(*spec, {file.string()});
  } else {
    read.model = CompileMjcf(file, read.notices);
  }
  TakeOut(*read.model, read.notices);
  for (int joint = 0; joint < read.model->njnt; ++joint) {
    if (IsHingeOrSlide(*read.model, joint)) read.joints.push_back(JointName(*read.model, joint));
  }
  if (read.joints.empty()) Refuse({file.string()}, "has no hinge or slide joint");
  return read;
}

RobotDescription DescribeRobot(ReadModel read, const std::vector<std::string>& joints,
                               const std::map<std::string, double>& at) {
  RobotDescription robot{.name = read.name, .notices = read.notices};
  std::vector<std::string> still = read.joints;
  for (const std::string& name : joints) {
    robot.joints.push_back(FindModelJoint(read, name));
    std::erase(still, name);
  }
  robot.rest.assign(read.model->qpos0, read.model->qpos0 + read.model->nq);
  for (const auto& [name, place] : at) {
    const ModelJoint joint = FindModelJoint(read, name);
    if (std::erase(still, name) == 0) {
      Refuse({"--at"}, "'{}' is in the log, which says where it stands; leave it out",
             Excerpt(name));
    }
    robot.rest[static_cast<std::size_t>(joint.qpos)] = place;
  }
  if (!still.empty()) {
    robot.notices.push_back(
        fmt::format("joints that the log does not hold, taken to stand still at 0: {} (--at {}=.5 "
                    "says where one stands, rad or m)",
                    ExcerptOfList(still), still.front()));
  }
  robot.links = LinksOf(*read.model, robot.joints, robot.rest);
  robot.model = std::move(read.model);
  return robot;
}

}  // namespace warmjoint

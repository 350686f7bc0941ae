#include "tools/python/compensators.h"

#include <nanobind/ndarray.h>
#include <nanobind/stl/array.h>
#include <nanobind/stl/string.h>

#include <array>
#include <memory>
#include <string>

#include "identification/estimate.h"
#include "models/friction/friction_json.h"
#include "tools/compensate/compensate_log.h"
#include "tools/python/logs.h"
#include "tools/python/trees.h"

namespace warmjoint::python {
namespace {

namespace nb = nanobind;

/// An estimate has an identifier; anything else is a friction by itself.
JointToCompensate JointOf(nb::handle given) {
  const Node node(ToTree(given, "estimate"), "estimate");
  if (node.IsMap() && node.Find("identifier")) return ToCompensate(EstimateFrom(node), "estimate");
  JointToCompensate joint;
  joint.stored.identifier = "friction";
  joint.stored.model.friction =
      Completed(FieldsFromPython<Friction>(given, "friction"), {"friction"});
  return joint;
}

/// A joint with its compensator.
struct Held {
  std::shared_ptr<const JointToCompensate> joint;
  Compensator compensator;
};

/// doubt: numbers in place of those of the estimate; settings: CompensatorSettings, without a dead band that of DeadBandOf.
Held MakeHeld(nb::handle given, const nb::dict& doubt, const nb::dict& settings) {
  auto joint = std::make_shared<JointToCompensate>(JointOf(given));
  Tree known = WriteFields(joint->doubt);
  known.update(ToTree(doubt, "compensator"));
  joint->doubt = ReadAs<FrictionDoubt>(Node(known, "compensator"));
  auto asked = FieldsFromPython<CompensatorSettings>(settings, "compensator");
  if (!settings.contains("dead_band")) asked.dead_band = DeadBandOf(*joint);
  Compensator made(joint->stored.model.friction, joint->doubt, asked);
  return {std::move(joint), std::move(made)};
}

/// place: position, motor_position, load, ambient_rise, reference.
double Step(Held& held, double velocity, double torque, double dt,
            const std::array<double, 5>& place) {
  wj_joint& joint = held.compensator.joint();
  joint.at = {place[0], place[1], place[2], place[3], place[4]};
  return wj_step(&joint, velocity, torque, dt);
}

/// {column: [N]} of a log.
nb::object RunAlong(Held& held, const Log& log) {
  const CompensatedLog found = CompensateLog(held.joint->stored, log.prepared, held.compensator);
  nb::dict columns;
  for (FileColumn& column : ColumnsOf(found).columns) {
    columns[column.name.c_str()] = ToPython(std::move(column.values));
  }
  return columns;
}

nb::dict FoundOf(const Held& held) {
  const wj_found& found = held.compensator.joint().found;
  nb::dict dict;
  dict["friction"] = found.friction;
  dict["residual"] = found.residual;
  dict["energy"] = found.energy;
  dict["std"] = found.std;
  dict["loss"] = found.loss;
  dict["contact"] = found.contact != 0;
  return dict;
}

/// seconds: without power; NaN: nobody knows.
void Restore(Held& held, nb::handle state, double seconds) {
  const auto kept = FieldsFromPython<KeptState>(state, "state");
  const wj_state numbers{kept.energy, kept.second_energy, kept.correction, kept.variance};
  wj_restore(&held.compensator.joint(), &numbers, seconds);
}

}  // namespace

void AddCompensators(nb::module_& module) {
  nb::class_<Held>(module, "Compensator")
      .def(
          "__init__",
          [](Held* self, nb::handle given, const nb::dict& doubt, const nb::dict& settings) {
            new (self) Held(MakeHeld(given, doubt, settings));
          },
          nb::sig("def __init__(self, given: dict[str, typing.Any], doubt: dict[str, float], "
                  "settings: dict[str, typing.Any]) -> None"))
      .def("step", &Step,
           nb::sig("def step(self, velocity: float, torque: float, dt: float, place: "
                   "tuple[float, float, float, float, float]) -> float"))
      .def("run", &RunAlong,
           nb::sig("def run(self, log: Log) -> dict[str, "
                   "numpy.typing.NDArray[numpy.float64]]"))
      .def("found", &FoundOf, nb::sig("def found(self) -> dict[str, typing.Any]"))
      .def(
          "state", [](const Held& held) { return FieldsToPython(StateOf(held.compensator, 0)); },
          nb::sig("def state(self) -> dict[str, float]"))
      .def("restore", &Restore,
           nb::sig("def restore(self, state: dict[str, float], seconds: float) -> None"))
      .def(
          "rest", [](Held& held, double seconds) { wj_rest(&held.compensator.joint(), seconds); },
          nb::sig("def rest(self, seconds: float) -> None"))
      .def(
          "memory", [](const Held& held) { return held.compensator.Memory(); },
          nb::sig("def memory(self) -> list[float]"))
      .def(
          "remember",
          [](Held& held, const std::array<double, Compensator::kMemory>& memory) {
            held.compensator.Remember(memory);
          },
          nb::sig("def remember(self, memory: list[float]) -> None"));
}

}  // namespace warmjoint::python

// consumer LOG.csv FRICTION.xml: identifies a log, says what it found,
// and writes a MuJoCo model with that friction.
#include <warmjoint/attach.h>
#include <warmjoint/errors.h>
#include <warmjoint/identify.h>

#include <cstdio>
#include <fstream>

int main(int, char** arguments) try {
  using namespace warmjoint;
  const PreparedLog log = Prepare(ReadRecordings({{arguments[1]}, {}, {}}));
  const Estimate estimate = Identify(log);
  std::printf("%s. %s\n", NameOf(estimate.status).data(), estimate.message.c_str());
  if (estimate.status != Status::ok) return 3;
  for (const EstimatedParameter& one : estimate.parameters) {
    std::printf("%s %g %s\n", one.name.c_str(), one.value, one.unit.c_str());
  }
  std::ofstream(arguments[2]) << MinimalModel(*estimate.friction, log.raw().measurements.joint);
} catch (const warmjoint::BadInput& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}

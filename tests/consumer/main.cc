// consumer LOG.csv FRICTION.xml: identifies a log, says what it found, and writes a MuJoCo model with that friction.
#include <warmjoint/attach.h>
#include <warmjoint/identify.h>

#include <cstdio>

int main(int, char** arguments) try {
  using namespace warmjoint::api;
  const Recording recording = ReadRecording(arguments[1]);
  const PreparedLog log(recording);
  const Estimate estimate = Identify(log);
  std::printf("%s. %s\n", StatusName(estimate.status).c_str(), estimate.message.c_str());
  if (estimate.status != Status::ok) return 3;
  for (const Parameter& one : estimate.parameters) {
    std::printf("%s %g %s\n", one.name.c_str(), one.value, one.unit.c_str());
  }
  WriteMinimalModel(*estimate.friction, recording.joint, arguments[2]);
} catch (const warmjoint::api::BadInput& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return 2;
}

/* An FMU 3.0 for co-simulation of the joints in friction.h: the same code as on a controller, wj_step of <warmjoint/compensate.h>, once a
   communication step. The functions and types are those of the FMI standard 3.0.2 (https://fmi-standard.org/docs/3.0.2/);
   what is not co-simulation, and types without variables, return fmi3Error. */
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <warmjoint/compensate.h>

/* A joint between two communication points: what is set, and what is got. */
typedef struct {
  wj_joint joint;
  wj_friction friction;
  double velocity, torque, position, load, ambient_rise;
  double share, dead_band, initial_energy;
  double compensation, residual;
  bool torque_is_measured, is_corrected, contact;
} wj_simulated;

#include "friction.h"

#if defined _WIN32
#define WJ_EXPORT __declspec(dllexport)
#else
#define WJ_EXPORT __attribute__((visibility("default")))
#endif

typedef enum { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal } fmi3Status;
typedef uint32_t fmi3ValueReference;
typedef void (*fmi3LogMessageCallback)(void*, fmi3Status, const char*, const char*);

typedef struct {
  double time;
  wj_simulated joints[WJ_JOINTS];
} wj_fmu;

/* ---- variables: 0 is the time, then those of each joint, its numbers first ---- */

enum {
  WJ_NUMBER_COUNT = sizeof((double*[]){WJ_NUMBERS((wj_simulated*)0)}) / sizeof(double*),
  WJ_SWITCH_COUNT = sizeof((bool*[]){WJ_SWITCHES((wj_simulated*)0)}) / sizeof(bool*),
  WJ_VARIABLES = WJ_NUMBER_COUNT + WJ_SWITCH_COUNT
};

/* NULL where there is no such number. */
static double* wj_number_of(wj_fmu* fmu, fmi3ValueReference reference) {
  if (reference == 0) return &fmu->time;
  const fmi3ValueReference joint = (reference - 1) / WJ_VARIABLES;
  const fmi3ValueReference which = (reference - 1) % WJ_VARIABLES;
  if (joint >= WJ_JOINTS || which >= WJ_NUMBER_COUNT) return NULL;
  wj_simulated* one = &fmu->joints[joint];
  double* const numbers[] = {WJ_NUMBERS(one)};
  return numbers[which];
}

static bool* wj_switch_of(wj_fmu* fmu, fmi3ValueReference reference) {
  if (reference == 0) return NULL;
  const fmi3ValueReference joint = (reference - 1) / WJ_VARIABLES;
  const fmi3ValueReference which = (reference - 1) % WJ_VARIABLES;
  if (joint >= WJ_JOINTS || which < WJ_NUMBER_COUNT) return NULL;
  wj_simulated* one = &fmu->joints[joint];
  bool* const switches[] = {WJ_SWITCHES(one)};
  return switches[which - WJ_NUMBER_COUNT];
}

/* ---- a joint ---- */

static void wj_start(wj_simulated* one, const wj_friction* friction) {
  memset(one, 0, sizeof *one);
  one->friction = *friction;
  wj_begin(&one->joint, friction);
  one->share = one->joint.settings.share;
}

/* The inputs as a sample, `step` s after the last one; 0: the same again. */
static void wj_sample(wj_simulated* one, double step) {
  wj_joint* joint = &one->joint;
  joint->at.position = one->position;
  joint->at.load = one->load;
  joint->at.ambient_rise = one->ambient_rise;
  one->compensation =
      wj_step(joint, one->velocity, one->torque_is_measured ? one->torque : NAN, step);
  one->residual = wj_number(joint->found.residual, 0);
  one->contact = joint->found.contact != 0;
}

/* With the parameters that were set. */
static void wj_initialise(wj_simulated* one) {
  wj_begin(&one->joint, &one->friction);
  one->joint.settings.share = one->share;
  one->joint.settings.dead_band = one->dead_band;
  one->joint.settings.correct = one->is_corrected ? WJ_CORRECTED : WJ_OPEN_LOOP;
  one->joint.state.energy = one->initial_energy;
  wj_sample(one, 0);
}

/* ---- life of an instance ---- */

WJ_EXPORT const char* fmi3GetVersion(void) { return "3.0"; }

WJ_EXPORT fmi3Status fmi3Reset(void* instance) {
  wj_fmu* fmu = (wj_fmu*)instance;
  fmu->time = 0;
  for (int i = 0; i < WJ_JOINTS; ++i) wj_start(&fmu->joints[i], wj_frictions[i]);
  return fmi3OK;
}

WJ_EXPORT void* fmi3InstantiateCoSimulation(const char* name, const char* token,
                                            const char* resources, bool visible, bool logging,
                                            bool events, bool early,
                                            const fmi3ValueReference* intermediate, size_t count,
                                            void* environment, fmi3LogMessageCallback log,
                                            void* update) {
  (void)name, (void)resources, (void)visible, (void)events, (void)early, (void)intermediate;
  (void)count, (void)update;
  if (token == NULL || strcmp(token, WJ_TOKEN) != 0) {
    if (logging && log != NULL) {
      log(environment, fmi3Error, "logStatusError",
          "the instantiation token is that of another model description");
    }
    return NULL;
  }
  wj_fmu* fmu = (wj_fmu*)calloc(1, sizeof *fmu);
  if (fmu != NULL) fmi3Reset(fmu);
  return fmu;
}

WJ_EXPORT void fmi3FreeInstance(void* instance) { free(instance); }

WJ_EXPORT fmi3Status fmi3EnterInitializationMode(void* instance, bool has_tolerance,
                                                 double tolerance, double start, bool has_stop,
                                                 double stop) {
  (void)has_tolerance, (void)tolerance, (void)has_stop, (void)stop;
  ((wj_fmu*)instance)->time = start;
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3ExitInitializationMode(void* instance) {
  wj_fmu* fmu = (wj_fmu*)instance;
  for (int i = 0; i < WJ_JOINTS; ++i) wj_initialise(&fmu->joints[i]);
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3DoStep(void* instance, double time, double step, bool no_return,
                                bool* event, bool* terminate, bool* early, double* last) {
  (void)no_return;
  wj_fmu* fmu = (wj_fmu*)instance;
  *event = *terminate = *early = false;
  *last = time;
  if (!(step > 0) || !wj_is_number(time)) return fmi3Error;
  for (int i = 0; i < WJ_JOINTS; ++i) wj_sample(&fmu->joints[i], step);
  *last = fmu->time = time + step;
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3Terminate(void* instance) { return (void)instance, fmi3OK; }

WJ_EXPORT fmi3Status fmi3SetDebugLogging(void* instance, bool on, size_t count,
                                         const char* const* categories) {
  return (void)instance, (void)on, (void)count, (void)categories, fmi3OK;
}

/* ---- values ---- */

WJ_EXPORT fmi3Status fmi3GetFloat64(void* instance, const fmi3ValueReference* references,
                                    size_t count, double* values, size_t value_count) {
  if (count != value_count) return fmi3Error;
  for (size_t i = 0; i < count; ++i) {
    const double* number = wj_number_of((wj_fmu*)instance, references[i]);
    if (number == NULL) return fmi3Error;
    values[i] = *number;
  }
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3SetFloat64(void* instance, const fmi3ValueReference* references,
                                    size_t count, const double* values, size_t value_count) {
  if (count != value_count) return fmi3Error;
  for (size_t i = 0; i < count; ++i) {
    double* number = wj_number_of((wj_fmu*)instance, references[i]);
    if (number == NULL || references[i] == 0) return fmi3Error;
    *number = values[i];
  }
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3GetBoolean(void* instance, const fmi3ValueReference* references,
                                    size_t count, bool* values, size_t value_count) {
  if (count != value_count) return fmi3Error;
  for (size_t i = 0; i < count; ++i) {
    const bool* one = wj_switch_of((wj_fmu*)instance, references[i]);
    if (one == NULL) return fmi3Error;
    values[i] = *one;
  }
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3SetBoolean(void* instance, const fmi3ValueReference* references,
                                    size_t count, const bool* values, size_t value_count) {
  if (count != value_count) return fmi3Error;
  for (size_t i = 0; i < count; ++i) {
    bool* one = wj_switch_of((wj_fmu*)instance, references[i]);
    if (one == NULL) return fmi3Error;
    *one = values[i];
  }
  return fmi3OK;
}

/* ---- the whole state, which holds addresses of this library's maps and is for one process ---- */

WJ_EXPORT fmi3Status fmi3GetFMUState(void* instance, void** state) {
  if (*state == NULL) *state = malloc(sizeof(wj_fmu));
  if (*state == NULL) return fmi3Error;
  memcpy(*state, instance, sizeof(wj_fmu));
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3SetFMUState(void* instance, void* state) {
  if (state == NULL) return fmi3Error;
  memcpy(instance, state, sizeof(wj_fmu));
  return fmi3OK;
}

WJ_EXPORT fmi3Status fmi3FreeFMUState(void* instance, void** state) {
  (void)instance;
  free(*state);
  *state = NULL;
  return fmi3OK;
}

/* ---- what the standard names besides; their arguments are not looked at ---- */

#define WJ_NOTHING(name) \
  WJ_EXPORT fmi3Status name(void) { return fmi3Error; }
#define WJ_NO_INSTANCE(name) \
  WJ_EXPORT void* name(void) { return NULL; }
#define WJ_NO_VALUES(type)  \
  WJ_NOTHING(fmi3Get##type) \
  WJ_NOTHING(fmi3Set##type)

WJ_NO_INSTANCE(fmi3InstantiateModelExchange)
WJ_NO_INSTANCE(fmi3InstantiateScheduledExecution)
WJ_NO_VALUES(Float32)
WJ_NO_VALUES(Int8)
WJ_NO_VALUES(UInt8)
WJ_NO_VALUES(Int16)
WJ_NO_VALUES(UInt16)
WJ_NO_VALUES(Int32)
WJ_NO_VALUES(UInt32)
WJ_NO_VALUES(Int64)
WJ_NO_VALUES(UInt64)
WJ_NO_VALUES(String)
WJ_NO_VALUES(Binary)
WJ_NO_VALUES(Clock)
WJ_NO_VALUES(IntervalDecimal)
WJ_NO_VALUES(IntervalFraction)
WJ_NO_VALUES(ShiftDecimal)
WJ_NO_VALUES(ShiftFraction)
WJ_NOTHING(fmi3GetNumberOfVariableDependencies)
WJ_NOTHING(fmi3GetVariableDependencies)
WJ_NOTHING(fmi3SerializedFMUStateSize)
WJ_NOTHING(fmi3SerializeFMUState)
WJ_NOTHING(fmi3DeserializeFMUState)
WJ_NOTHING(fmi3GetDirectionalDerivative)
WJ_NOTHING(fmi3GetAdjointDerivative)
WJ_NOTHING(fmi3EnterConfigurationMode)
WJ_NOTHING(fmi3ExitConfigurationMode)
WJ_NOTHING(fmi3EnterEventMode)
WJ_NOTHING(fmi3EnterStepMode)
WJ_NOTHING(fmi3EnterContinuousTimeMode)
WJ_NOTHING(fmi3EvaluateDiscreteStates)
WJ_NOTHING(fmi3UpdateDiscreteStates)
WJ_NOTHING(fmi3CompletedIntegratorStep)
WJ_NOTHING(fmi3SetTime)
WJ_NOTHING(fmi3SetContinuousStates)
WJ_NOTHING(fmi3GetContinuousStates)
WJ_NOTHING(fmi3GetContinuousStateDerivatives)
WJ_NOTHING(fmi3GetNominalsOfContinuousStates)
WJ_NOTHING(fmi3GetEventIndicators)
WJ_NOTHING(fmi3GetNumberOfEventIndicators)
WJ_NOTHING(fmi3GetNumberOfContinuousStates)
WJ_NOTHING(fmi3GetOutputDerivatives)
WJ_NOTHING(fmi3ActivateModelPartition)

"""An exported FMU against the compensator of the package: by its C functions, by FMPy where that is, and as the program packs it."""

import ctypes
import io
import math
import platform
import shutil
import xml.etree.ElementTree
import zipfile

import numpy as np
import pytest
import warmjoint as wj
from warmjoint import fmu as packing
from warmjoint.export import export_frictions

STEP = 0.01  # s
SAMPLES = 500
MAP = {"axes": [{"quantity": "position", "centres": [-1, 0, 1], "width": 0.8}], "weights": [0.5, -0.5, 0.7], "factor": "direction"}
ELBOW = {"law": "asymmetric_stribeck",
         "parameters": {"viscous": 5, "coulomb_positive": 15, "coulomb_negative": 12, "static_rise": 3, "stribeck_velocity": 0.2,
                        "stribeck_exponent": 1.4},
         "thermal": {"thermal_gain": -0.75, "thermal_time_constant": 20}, "load_gain": 0.1, "maps": [MAP]}
INPUTS = ("velocity", "torque", "position", "load", "ambient_rise")
OUTPUTS = ("compensation", "friction", "residual", "energy", "std")

needs_compiler = pytest.mark.skipif(not shutil.which("cc") or platform.system() != "Linux", reason="no C compiler cc on Linux")


def samples():
    """Of the inputs, [SAMPLES]."""
    time = STEP * np.arange(SAMPLES)
    velocity = 0.8 * np.sin(2 * time)
    return {"velocity": velocity, "torque": 17 * np.sign(velocity) + 4 * velocity + 0.3 * np.sin(37 * time), "position": np.cos(time),
            "load": 10 * np.sin(time), "ambient_rise": 0 * time}


def expected(corrected):
    """The package's outputs, each of a sample that counts from the communication point before."""
    compensator = wj.Compensator(ELBOW, dead_band=0, correct=corrected)
    given, found = samples(), {name: [] for name in OUTPUTS}
    first = {name: float(given[name][0]) for name in ("position", "load", "ambient_rise")}
    compensator.step(given["velocity"][0], given["torque"][0] if corrected else math.nan, 0, **first)
    for i in range(SAMPLES):
        place = {name: float(given[name][i]) for name in ("position", "load", "ambient_rise")}
        torque = given["torque"][i] if corrected else math.nan
        found["compensation"].append(compensator.step(given["velocity"][i], torque, STEP, **place))
        found["friction"].append(compensator.friction)
        found["residual"].append(0 if math.isnan(compensator.residual) else compensator.residual)
        found["energy"].append(compensator.energy)
        found["std"].append(compensator.std)
    return found


@pytest.fixture(scope="module")
def archive(tmp_path_factory):
    path = tmp_path_factory.mktemp("fmu") / "elbow.fmu"
    export_frictions(ELBOW, "fmu", warm=0, speed=None, joint="elbow").save(path)
    return path


def references(archive):
    """{name: value reference}, and the token."""
    root = xml.etree.ElementTree.fromstring(zipfile.ZipFile(archive).read("modelDescription.xml"))
    return {one.get("name"): int(one.get("valueReference")) for one in root.find("ModelVariables")}, root.get("instantiationToken")


class Instance:
    """One of the library's, called as an importer does."""

    def __init__(self, archive, folder):
        with zipfile.ZipFile(archive) as packed:
            name = next(one for one in packed.namelist() if one.startswith("binaries/"))
            self.library = ctypes.CDLL(packed.extract(name, folder))
        self.names, token = references(archive)
        self.library.fmi3InstantiateCoSimulation.restype = ctypes.c_void_p
        make = self.library.fmi3InstantiateCoSimulation
        nothing = (False, False, False, False, None, ctypes.c_size_t(0), None, None, None)
        assert make(b"elbow", b"another", None, *nothing) is None
        self.instance = ctypes.c_void_p(make(b"elbow", token.encode(), None, *nothing))
        assert self.instance

    def call(self, function, *arguments):
        return getattr(self.library, function)(self.instance, *arguments)

    def _values(self, function, kind, names, values):
        count = ctypes.c_size_t(len(names))
        which = (ctypes.c_uint32 * len(names))(*(self.names[name] for name in names))
        held = (kind * len(names))(*values)
        assert self.call(function, which, count, held, count) == 0
        return list(held)

    def set(self, **numbers):
        self._values("fmi3SetFloat64", ctypes.c_double, list(numbers), list(numbers.values()))

    def switch(self, **switches):
        self._values("fmi3SetBoolean", ctypes.c_bool, list(switches), list(switches.values()))

    def get(self, names):
        return dict(zip(names, self._values("fmi3GetFloat64", ctypes.c_double, names, [0] * len(names)), strict=True))

    def begin(self):
        assert self.call("fmi3EnterInitializationMode", False, ctypes.c_double(0), ctypes.c_double(0), False, ctypes.c_double(0)) == 0

    def step(self, time, step=STEP):
        flags = [ctypes.c_bool() for _ in range(3)]
        last = ctypes.c_double()
        status = self.call("fmi3DoStep", ctypes.c_double(time), ctypes.c_double(step), True, *map(ctypes.byref, flags), ctypes.byref(last))
        return status, last.value


@needs_compiler
@pytest.mark.parametrize("corrected", [False, True])
def test_it_steps_as_the_compensator_does(archive, tmp_path, corrected):
    one, given, outputs = Instance(archive, tmp_path), samples(), {name: [] for name in OUTPUTS}
    one.begin()
    one.switch(torque_is_measured=corrected, is_corrected=corrected)
    one.set(**{name: given[name][0] for name in INPUTS})
    assert one.call("fmi3ExitInitializationMode") == 0
    for i in range(SAMPLES):
        one.set(**{name: given[name][i] for name in INPUTS})
        assert one.step(i * STEP) == (0, pytest.approx((i + 1) * STEP))
        for name, value in one.get(OUTPUTS).items():
            outputs[name].append(value)
    for name, values in expected(corrected).items():
        np.testing.assert_allclose(outputs[name], values, rtol=1e-12, atol=1e-12, err_msg=name)
    assert abs(outputs["energy"][-1]) > 0.1  # it did warm up


@needs_compiler
def test_its_state_and_its_refusals(archive, tmp_path):
    one = Instance(archive, tmp_path)
    one.begin()
    one.set(share=0.5, coulomb_positive=20.0, initial_energy=-2.0, velocity=0.5)
    assert one.call("fmi3ExitInitializationMode") == 0
    start = one.get(["friction", "compensation", "energy"])
    assert start["energy"] == -2
    assert start["compensation"] == pytest.approx(start["friction"] / 2)
    assert start["friction"] == pytest.approx(wj.Compensator(ELBOW, dead_band=0).step(0.5, dt=0) / 0.9 + 5 - 2)

    # back to a state that was kept
    state = ctypes.c_void_p()
    assert one.call("fmi3GetFMUState", ctypes.byref(state)) == 0
    one.step(0)
    after = one.get(OUTPUTS)
    assert one.call("fmi3SetFMUState", state) == 0
    one.step(0)
    assert one.get(OUTPUTS) == after
    assert one.call("fmi3FreeFMUState", ctypes.byref(state)) == 0
    assert one.step(1, 0)[0] == one.step(1, math.nan)[0] == 3
    unknown, count = (ctypes.c_uint32 * 1)(9999), ctypes.c_size_t(1)
    assert one.call("fmi3GetFloat64", unknown, count, (ctypes.c_double * 1)(), count) == 3
    one.call("fmi3FreeInstance")


@needs_compiler
def test_fmpy_checks_and_simulates_it(archive):
    """FMPy: the schema and the rules of FMI 3.0, then a simulation."""
    pytest.importorskip("fmpy", reason="FMPy is not there: pip install fmpy")
    import fmpy
    from fmpy.validation import validate_fmu

    assert validate_fmu(str(archive)) == []
    given = samples()
    rows = np.array([(STEP * i, *(float(given[name][i]) for name in INPUTS)) for i in range(SAMPLES)], dtype=[(name, float) for name in ("time", *INPUTS)])
    result = fmpy.simulate_fmu(str(archive), stop_time=STEP * (SAMPLES - 1), step_size=STEP, output_interval=STEP, input=rows, output=list(OUTPUTS),
                               start_values={"torque_is_measured": True, "is_corrected": True})
    # the importer sets inputs at each communication point, and interpolates them in time
    for name, values in expected(True).items():
        np.testing.assert_allclose(result[name][1:], values[: SAMPLES - 1], rtol=1e-6, atol=1e-6, err_msg=name)


def test_a_robot_has_its_joints_by_their_names(archive, recording):
    one = wj.identify(recording, "energy-ml").data
    robot = wj.RobotEstimate({"joints": {"elbow": one, "wrist": one}, "notices": [], "log": [], "robot": "", "summary": {}})
    export = robot.export("fmu")
    assert export.model == "robot_friction"
    alone = set(references(archive)[0]) - {"time"}
    told = {one.get("name") for one in xml.etree.ElementTree.fromstring(export.text).find("ModelVariables")}
    assert told == {"time"} | {f"{joint}.{name}" for joint in ("elbow", "wrist") for name in alone}


def test_without_a_compiler_it_holds_its_sources(monkeypatch, tmp_path):
    monkeypatch.setenv("CC", "no-such-compiler")
    export = export_frictions(ELBOW, "fmu", warm=0, speed=None, joint="elbow")
    with pytest.warns(UserWarning, match="sources alone"):
        export.save(tmp_path / "elbow.fmu")
    names = zipfile.ZipFile(tmp_path / "elbow.fmu").namelist()
    assert {"modelDescription.xml", "sources/warmjoint_fmu.c", "sources/warmjoint/compensate.h", "sources/friction.h"} <= set(names)
    assert not [name for name in names if name.startswith("binaries/")]


@needs_compiler
def test_the_program_packs_the_same(program):
    friction = wj.Friction("viscous_coulomb", viscous=5, coulomb=15)
    (program.folder / "friction.json").write_text(friction.to_json())
    program("export", "friction.json", "--to", "fmu", "--joint", "elbow", "-o", "elbow.fmu")
    export = export_frictions(friction.data, "fmu", warm=0, speed=None, joint="elbow")
    with zipfile.ZipFile(program.folder / "elbow.fmu") as packed:
        assert {name: packed.read(name).decode() for name in export.files} == export.files
        assert len(packed.namelist()) == len(export.files) + 1
    program("export", "friction.json", "--to", "fmu", status=2)
    # the same files make the same archive
    assert packing.pack(export.model, {"a": "b"})[0] == packing.pack(export.model, {"a": "b"})[0]
    assert zipfile.ZipFile(io.BytesIO(packing.pack("x", {"a": "b"})[0])).read("a") == b"b"

"""Whatever Python holds columns in is read with the units in its names, or refused by the name of its argument."""

import datetime
import decimal
import types

import numpy as np
import pytest
import warmjoint as wj

NAMES = {"time": "t_ms", "position": "q [deg]", "velocity": "qd_deg_s", "torque": "tau (mNm)"}


@pytest.fixture(scope="module")
def si():
    """Columns in SI: viscous 0.8, Coulomb 4.5."""
    t = np.arange(0, 120, 0.05)
    v = np.where(t // 5 % 2, -1.0, 1.0) * (1 + t // 10 % 3)
    q = np.concatenate([[0], np.cumsum(0.05 * v[:-1])])
    noise = 0.1 * np.random.default_rng(1).standard_normal(len(t))
    return {"time": t, "position": q, "velocity": v, "torque": 4.5 * np.sign(v) + 0.8 * v + noise}


@pytest.fixture(scope="module")
def foreign(si):
    """The same in units that the names tell."""
    return {"t_ms": 1e3 * si["time"], "q [deg]": np.degrees(si["position"]), "qd_deg_s": np.degrees(si["velocity"]),
            "tau (mNm)": 1e3 * si["torque"]}


def same(log, si):
    """Whether a log has the columns in SI."""
    assert len(log) == len(si["time"])
    np.testing.assert_allclose(log.time - log.time[0], si["time"], atol=1e-6)
    for name in ("position", "velocity", "torque"):
        np.testing.assert_allclose(getattr(log, name), si[name], rtol=1e-12, atol=1e-12)


def tables(foreign):
    """A table of each kind that is installed, by its library."""
    yield "a dict", dict(foreign)
    kinds = [(name, float) for name in foreign]
    records = np.zeros(len(foreign["t_ms"]), kinds)
    for name, values in foreign.items():
        records[name] = values
    yield "a structured array", records
    yield "lists", {name: values.tolist() for name, values in foreign.items()}
    yield "decimals", {name: [decimal.Decimal(value) for value in values] for name, values in foreign.items()}


def frames(foreign):
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(foreign)
    yield frame
    yield frame.convert_dtypes()
    yield frame.astype(str)
    yield frame.astype("category")
    yield frame.assign(note="text").set_index("t_ms")
    yield frame.set_index(["t_ms", "q [deg]"])
    yield pandas.concat([frame, frame[["tau (mNm)"]].rename(columns=lambda _: "other"), frame[["qd_deg_s"]].rename(columns=lambda _: "other")],
                        axis=1)


def test_tables_of_numpy_are_read_with_the_units_in_their_names(foreign, si):
    for _, table in tables(foreign):
        same(wj.Log.from_frame(table, **NAMES), si)


def test_frames_of_pandas_are_read_with_the_units_in_their_names(foreign, si):
    for frame in frames(foreign):
        same(wj.Log.from_frame(frame, **NAMES), si)
        same(wj.Log.from_pandas(frame, **NAMES), si)
    # series have the names of their columns, and arrays none
    pandas = pytest.importorskip("pandas")
    frame = pandas.DataFrame(foreign)
    same(wj.Log(**{ours: frame[theirs] for ours, theirs in NAMES.items()}), si)
    same(wj.Log(**{ours: frame[theirs].to_numpy() for ours, theirs in NAMES.items()},
                unit={"time": "ms", "position": "deg", "velocity": "deg/s", "torque": "mNm"}), si)


def test_arrow_columns_are_read(foreign, si):
    pandas, pyarrow = pytest.importorskip("pandas"), pytest.importorskip("pyarrow")
    same(wj.Log.from_frame(pyarrow.table(foreign), **NAMES), si)
    same(wj.Log.from_frame(pandas.DataFrame(foreign).convert_dtypes(dtype_backend="pyarrow"), **NAMES), si)
    same(wj.Log.from_frame(pandas.DataFrame(foreign).astype("double[pyarrow]"), **NAMES), si)
    table = pyarrow.table({**foreign, "t_ms": pyarrow.array((1e6 * si["time"]).round().astype(int), pyarrow.timestamp("us", "UTC"))})
    same(wj.Log.from_frame(table.rename_columns(["stamp", *table.column_names[1:]]), **{**NAMES, "time": "stamp"}), si)


def test_frames_of_polars_are_read(foreign, si):
    polars = pytest.importorskip("polars")
    frame = polars.DataFrame(foreign)
    same(wj.Log.from_frame(frame, **NAMES), si)
    same(wj.Log.from_frame(frame.lazy(), **NAMES), si)
    same(wj.Log(**{ours: frame[theirs] for ours, theirs in NAMES.items()}), si)
    dates = frame.with_columns(stamp=polars.from_epoch((1e3 * polars.col("t_ms")).round().cast(polars.Int64), "us"))
    same(wj.Log.from_frame(dates, **{**NAMES, "time": "stamp"}), si)


def test_data_sets_of_xarray_are_read_with_their_units(si):
    xarray = pytest.importorskip("xarray")
    data = xarray.Dataset({"q": ("time", np.degrees(si["position"]), {"units": "deg"}), "qd": ("time", si["velocity"], {"units": "rad/s"}),
                           "tau": ("time", si["torque"], {"units": "N*m"})}, coords={"time": ("time", 1e3 * si["time"], {"units": "ms"})})
    same(wj.Log.from_frame(data, position="q", velocity="qd", torque="tau"), si)
    same(wj.Log(time=data["time"], position=data["q"], velocity=data["qd"], torque=data["tau"]), si)


def test_quantities_keep_their_units(si):
    pint = pytest.importorskip("pint")
    registry = pint.UnitRegistry()
    same(wj.Log(time=(1e3 * si["time"]) * registry.ms, position=np.degrees(si["position"]) * registry.degree,
                velocity=si["velocity"] * registry.radian / registry.second, torque=si["torque"] * registry.newton * registry.meter), si)
    with pytest.raises(wj.BadInput, match="velocity cannot be in"):
        wj.Log(time=si["time"], position=si["position"], velocity=si["velocity"] * registry.kelvin, torque=si["torque"])


def test_dates_are_seconds_from_the_first(si):
    pandas = pytest.importorskip("pandas")
    rest = {name: values for name, values in si.items() if name != "time"}
    stamps = pandas.Timestamp("2024-03-31 00:30") + pandas.to_timedelta(si["time"], unit="s")
    of_python = [datetime.datetime(2024, 3, 1) + datetime.timedelta(seconds=float(t)) for t in si["time"]]
    for time in (stamps, stamps.tz_localize("UTC"), stamps.tz_localize("UTC").tz_convert("Europe/Berlin"), stamps.to_series().reset_index(drop=True),
                 stamps.to_numpy(), stamps.astype(str), of_python, [one - of_python[0] for one in of_python], stamps - stamps[0],
                 np.array(of_python, "M8[us]"), pandas.Series(stamps.tz_localize("UTC"))):
        same(wj.Log(time=time, **rest), si)
    # in the index, of any zone
    frame = pandas.DataFrame(rest, index=stamps.tz_localize("UTC"))
    same(wj.Log.from_frame(frame), si)
    same(wj.Log.from_frame(frame.rename_axis("clock"), time="clock"), si)
    # what was filtered out leaves whole numbers in the index, which are no time
    with pytest.raises(wj.BadInput, match="no column 'time'"):
        wj.Log.from_frame(pandas.DataFrame(rest)[::2])
    with pytest.raises(wj.BadInput, match="time tells its unit itself"):
        wj.Log(time=stamps, **rest, unit={"time": "ms"})


def test_what_is_hidden_or_missing_is_left_out(si):
    hidden = np.abs(si["torque"]) < np.quantile(np.abs(si["torque"]), 0.1)
    spoilt = np.where(hidden, 1e6, si["torque"])
    pandas = pytest.importorskip("pandas")
    nothing = pandas.array(spoilt, dtype="Float64")
    nothing[hidden] = pandas.NA
    for torque in (np.ma.masked_array(spoilt, hidden), np.where(hidden, np.nan, spoilt), nothing, [None if h else x for h, x in zip(hidden, spoilt)],
                   np.ma.masked_array(spoilt.astype(object), hidden)):
        log = wj.Log(**{**si, "torque": torque})
        assert len(log) == np.count_nonzero(~hidden)
        np.testing.assert_array_equal(log.torque, spoilt[~hidden])


def test_shapes_and_types_of_numpy(si):
    for change in (lambda x: x[:, None], lambda x: x[None, :], lambda x: np.ma.masked_array(x), lambda x: x.astype(">f8"), lambda x: memoryview(x.copy()),
                   lambda x: np.repeat(x, 2)[::2], lambda x: x.astype(np.longdouble), tuple, lambda x: (one for one in x)):
        same(wj.Log(**{name: change(values) for name, values in si.items()}), si)


@pytest.mark.parametrize(("column", "values", "words"), [
    ("torque", lambda x: x > 0, "torque: holds booleans"),
    ("torque", lambda x: x + 0j, "torque: holds complex numbers"),
    ("torque", lambda x: ["16,250"] * len(x), "torque: sample 1 is '16,250', which is not a number"),
    ("time", lambda x: ["03/04/2024 10:00"] * len(x), "time: sample 1 is '03/04/2024 10:00'"),
    ("position", lambda x: np.zeros((len(x), 2)), r"position: has the shape \(2400, 2\)"),
    ("velocity", lambda x: np.zeros(len(x), "M8[s]"), "velocity: holds dates"),
    ("velocity", lambda x: [object()] * len(x), "velocity: sample 1 is <object"),
    ("torque", lambda x: [True] * len(x), "torque: holds booleans"),
    ("torque", lambda x: [[1], [1, 2]], "torque: cannot be read as an array"),
    ("torque", lambda x: "torque", "torque: is a value of the type str"),
    ("torque", lambda x: {"a": 1}, "torque: is a value of the type dict"),
    ("torque", lambda x: [10**400] * len(x), "torque: sample 1 is"),
    ("torque", lambda x: types.SimpleNamespace(), "torque: "),
])
def test_what_is_no_column_is_refused_by_its_name(si, column, values, words):
    with pytest.raises(wj.BadInput, match=words):
        wj.Log(**{**si, column: values(si[column])})


@pytest.mark.parametrize(("call", "words"), [
    (lambda log, friction: log.between("early", 5), "^begin: "),
    (lambda log, friction: log.between(0, None), "^end: is None"),
    (lambda log, friction: wj.Log.from_frame({}, map=True), "^map: is a value of the type bool"),
    (lambda log, friction: wj.laws(["linear"]), "^joint: .*give 'rotary' or 'linear'"),
    (lambda log, friction: wj.score("estimate.json", {}), "^estimate: is a value of the type str; give a warmjoint.Estimate"),
    (lambda log, friction: wj.identify(log, force=np.zeros(3)), "^force: .*give True or False"),
    (lambda log, friction: friction.changed(np.zeros((9, 9)), 1), "^array"),
    (lambda log, friction: wj.Compensator(np.zeros(1, "M8[s]")), "^friction: is a value of the type ndarray"),
    (lambda log, friction: wj.Compensator(friction).step(1.0, load="heavy"), "^load: "),
    (lambda log, friction: wj.Compensator(friction).restore("cold"), "^state: "),
])
def test_wrong_calls_are_refused_by_the_name_of_the_argument_in_one_line(si, call, words):
    with pytest.raises(wj.BadInput, match=words) as refused:
        call(wj.Log(**si), wj.Friction(viscous=1, coulomb=2))
    assert len(str(refused.value).splitlines()) == 1


def test_a_refusal_holds_nothing_that_a_terminal_acts_on():
    assert str(wj.BadInput("a\x1b[31mb\n\u202ec\udcff\xe9")) == "a\\x1B[31mb\\x0A\\u202Ec\\udcff\xe9"
    assert str(wj.BadInput()) == ""


def test_files_and_frames_are_read_by_one_rule(foreign, tmp_path):
    """The same names and numbers from a file and from a frame give the same log, the same notes and the same doubts."""
    pandas = pytest.importorskip("pandas")
    names = [{}, {"t_ms": "time [ms]", "q [deg]": "Position_deg", "qd_deg_s": "velocity", "tau (mNm)": "Torque"}, {"t_ms": "t", "q [deg]": "q"}]
    for renamed in names:
        frame = pandas.DataFrame(foreign).rename(columns=renamed)
        frame.to_csv(tmp_path / "log.csv", index=False)
        given = {"map": {ours: renamed.get(theirs, theirs) for ours, theirs in NAMES.items()}}
        answers = []
        for make in (lambda g=given: wj.read(tmp_path / "log.csv", **g), lambda f=frame, g=given: wj.Log.from_frame(f, **g)):
            try:
                log = make()
                answers.append([log.time.tolist(), log.position.tolist(), log.torque.tolist(), log.torque_unit, log.notes])
            except wj.BadInput as refusal:
                answers.append(str(refusal).split(": ", 1)[1])
        assert answers[0] == answers[1], renamed


def test_a_doubt_on_a_unit_is_a_warning_of_the_estimate(si):
    doubtful = wj.identify(wj.Log(**{**si, "position": np.degrees(si["position"]), "velocity": np.degrees(si["velocity"])}), "nominal-ls")
    assert any('unit={"position": "deg"' in one for one in doubtful.warnings)
    assert not any("unit=" in one for one in wj.identify(wj.Log(**si), "nominal-ls").warnings)


def test_a_path_or_a_frame_in_place_of_a_log(si, tmp_path):
    log = wj.Log(**si)
    log.save(tmp_path / "log.csv")
    expected = wj.identify(log, "nominal-ls")["coulomb"]
    for given in (tmp_path / "log.csv", str(tmp_path / "log.csv"), si, [log], [si], (tmp_path / "log.csv",)):
        assert wj.identify(given, "nominal-ls")["coulomb"] == expected
    turned = wj.identify(tmp_path / "log.csv", "nominal-ls", scale={"torque": -1})
    assert turned.status == "bad_data"
    assert wj.identify(log, "nominal-ls", holdout=si).holdout == wj.identify(log, "nominal-ls", holdout=log).holdout
    assert wj.check(si).text == wj.check(wj.Log(**si, name="frame")).text
    with pytest.raises(wj.BadInput, match="scale: says how a file or a frame is read"):
        wj.identify(log, scale={"torque": -1})
    for nothing in (5, None, object(), [], [5]):
        with pytest.raises(wj.BadInput, match=r"^log: "):
            wj.identify(nothing)

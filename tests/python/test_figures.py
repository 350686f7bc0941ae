"""What figures show, as data: series, limits and words of each. Made-up views stand for those of C++ (shown.py)."""

import numpy as np
import pytest

pytest.importorskip("matplotlib")
import shown
from warmjoint.figures import along_log, families, fit_page, friction, motor, residuals, robots, runs, speeds, steps
from warmjoint.figures.numerals import hue_of, plain_number, range_text, significant, to_digits_of, unit_text
from warmjoint.figures.sheet import Sheet, TooLarge, TooSmall, encode, math_text, page_size
from warmjoint.figures.sheet import dots as draw_dots
from warmjoint.figures.sheet import finish as finish_panel
from warmjoint.figures.sheet import line as draw_line
from warmjoint.figures.style import use
from warmjoint.figures.view import View, binned_median, unpacked


@pytest.fixture(autouse=True)
def screen():
    with use("screen"):
        yield


def one(sheet, label, panel=""):
    """The only series of that label, in the panel of that title where one is given."""
    found = [series for series in sheet.drawn if series.label == label and panel in series.ax.get_title(loc="left").replace("\n", " ")]
    assert len(found) == 1, f"{label}: {len(found)} of {[series.label for series in sheet.drawn]}"
    return found[0]


def titles_of(sheet):
    return [ax.get_title(loc="left").replace("\n", " ") for ax in sheet.axes]


def look(sheet):
    """What holds for any figure: words say what one sees, panels have data within their axes, and a file can be written."""
    assert sheet.finding.endswith(".") and sheet.name
    for ax in {series.ax for series in sheet.drawn}:
        low, high = sorted(ax.get_ylim())
        own = [series for series in sheet.drawn if series.ax is ax]
        values = np.concatenate([series.columns[key] for series in own for key in ("y", "lower", "upper") if key in series.columns])
        assert np.any((values >= low) & (values <= high)), f"{sheet.name}: '{ax.get_title(loc='left')}' shows no data"
    assert encode(sheet, dpi=40)[1:4] == b"PNG"
    return sheet


def all_of(source):
    return {name: look(sheet) for name, (make, _) in source.figures().items() if (sheet := make()) is not None}


def source_of(facts, **more):
    return families.Source({"kind": "estimate", "place": "warm.json", "fit": facts, "answer": facts, "held_out": None, "guess": None, **more})


def test_every_figure_of_an_estimate_is_named_as_its_file():
    facts = {**shown.mapped_facts(), "trace": shown.trace_of(8)}
    band = {"quantities": ["position"], "points": [[0.0], [1.0]], "value": [5.0, 6.0], "interval95": [[4.0, 6.0], [5.0, 7.0]]}
    places = {"friction": {"maps": [{"factor": "direction"}, {"factor": "one"}]}, "bands": [band, band]}
    made = all_of(source_of(facts, held_out=shown.warm_facts(), guess=shown.guess_facts(), places=places))
    assert made.keys() == source_of(facts).figures().keys()
    assert all(sheet.name == name for name, sheet in made.items())


def test_without_its_recording_an_estimate_has_its_trace():
    facts = shown.answer(trace=shown.trace_of(3))
    assert all_of(families.Source({"kind": "estimate", "place": "", "fit": None, "answer": facts})).keys() == {"trace"}


def test_without_a_friction_the_recording_is_shown():
    facts = shown.warm_facts(has_fit=False, warms=False, parameters=[], shown=[], curves=[], at_speed=None, metrics=None, status="bad_data")
    for name in ("fitted", "energy", "energy_std"):
        del facts["columns"][name]
    assert all_of(source_of(facts)).keys() == {"fit", "log", "hysteresis"}


def test_a_figure_is_chosen_by_name_or_the_papers_number_and_refused_with_what_it_needs():
    source = source_of(shown.warm_facts(trace=shown.trace_of(8)))
    assert [sheet.name for sheet in families.chosen(source, ["8", "log", "log"])] == ["log", "trace"]
    for wanted, why in (("motor_map", "motor_map needs a map over the motor's angle; this source gives: fit, log"),
                        ("7", r"figure 7 of the paper \(motor_angle\) needs an estimate"), ("fitt", "there is no figure 'fitt'")):
        with pytest.raises(families.Refusal, match=why):
            list(families.chosen(source, [wanted]))
    assert "motor_map, motor_fit (need a map over the motor's angle)" in families.left_out(source, ["motor_map", "motor_fit"])


def test_the_page_of_a_fit_tells_its_story():
    sheet = look(fit_page.fit(shown.warm_view()))
    assert sheet.finding == "energy-ml: the numbers can be used; fit 93.0 %, RMSE 0.500 N·m."
    assert len(sheet.axes) == 12
    assert one(sheet, "fit", "Level of friction").hue == "blue"
    assert one(sheet, "measured", "Level of friction").columns["x"].max() == pytest.approx(20, abs=0.1)  # minutes
    # friction at 0.5 rad/s falls from 17.5 by E
    falling = one(sheet, "fit", "Warm-up").columns["y"]
    assert falling[0] == pytest.approx(17.5) and falling[-1] == pytest.approx(17.5 - 12 * (1 - np.exp(-1199 / 300)))
    words = [text.get_text() for text in sheet.axes[1].texts]
    assert "viscous, k$_{v}$" in words and "4.880 … 5.120" in words


def test_the_page_explains_why_there_is_no_fit():
    facts = shown.warm_facts(has_fit=False, warms=False, status="not_identifiable", message="one speed alone", parameters=[], shown=[], metrics=None)
    text = " ".join(words for words, _, _ in fit_page.verdict_words(View(facts)))
    assert "there are no numbers to use. One speed alone." in text
    look(fit_page.fit(View(facts)))


def test_a_void_fit_is_dashed_and_names_the_panel_that_decided():
    tests = [shown.test_of("direction", "velocity"), shown.test_of("drift", "time", effect=1.0)]
    sheet = look(fit_page.fit(shown.warm_view(status="inadequate_model", tests=tests)))
    titles = titles_of(sheet)
    assert "Residuals over velocity: decided by direction" in titles and "Residuals over time, with their median: shows drift" in titles
    framed = [title for ax, title in zip(sheet.axes, titles) if ax.spines["top"].get_visible()]
    assert framed == ["Residuals over velocity: decided by direction"]
    assert one(sheet, "fit (void)", "Level of friction").columns["x"].size == 1200


def test_residuals_with_a_memory_are_a_warning():
    facts = shown.warm_facts()
    assert fit_page.warnings_of(View(facts)) == []
    time = facts["columns"]["time"]
    facts["columns"]["torque"] = facts["columns"]["fitted"] + np.sin(time / 10)
    assert "alike from one sample to the next" in fit_page.warnings_of(View(facts))[0]
    assert residuals.correlation(View(facts), 1) == pytest.approx(np.cos(0.1), abs=0.01)


def test_one_outlier_leaves_the_axis_of_residuals_alone():
    facts = shown.warm_facts()
    facts["columns"]["torque"][600] += 1000
    sheet = look(residuals.panels_of(View(facts)))
    for ax in sheet.axes[:3]:
        assert ax.get_ylim()[1] < 5  # noise of 0.5, three deviations and a half


def test_the_log_shows_what_is_kept():
    facts = shown.warm_facts(has_fit=False)
    facts["columns"]["keep"][:600] = 0
    sheet = look(along_log.log(View(facts)))
    assert len(sheet.axes) == 3
    kept = one(sheet, "kept for the fit").columns
    assert kept["x"][np.isfinite(kept["y"])].min() == 10  # minutes
    assert sheet.finding == "Of 1200 samples 50 % are kept for the fit, in 60 segments of constant speed."


def test_predicted_torque_lies_on_the_diagonal_of_one_scale():
    sheet = look(residuals.predicted(shown.warm_view()))
    assert sheet.axes[0].get_xlim() == sheet.axes[0].get_ylim()
    assert sheet.finding.startswith("Measured and predicted torque differ by 0.4") or sheet.finding.startswith("Measured and predicted torque differ by 0.5")
    assert residuals.predicted(shown.warm_view(has_fit=False)) is None


def test_friction_over_velocity_has_three_heats_with_bands_and_dots_by_heat():
    view = shown.warm_view()
    sheet = look(friction.friction_curve(view))
    assert [series.kind for series in sheet.drawn].count("band") == 6
    cold, half, warm = (next(series for series in sheet.drawn if series.label == f"fit, {name}") for name in ("cold", "half as warm", "warmest"))
    assert np.all(cold.columns["y"] > half.columns["y"]) and np.all(half.columns["y"] > warm.columns["y"])
    # samples of the last quarter are within a quarter of the warmest
    assert one(sheet, "measured, warmest").columns["x"].size > one(sheet, "measured, cold").columns["x"].size
    assert sum(one(sheet, f"measured, {name}").columns["x"].size for name in ("cold", "half as warm", "warmest")) == 1200


def test_friction_with_maps_is_a_mean_at_each_speed_without_a_band():
    sheet = look(friction.friction_curve(View(shown.mapped_facts())))
    assert "band" not in [series.kind for series in sheet.drawn]
    mean = next(series for series in sheet.drawn if series.label == "fit, cold").columns
    np.testing.assert_allclose(mean["x"], [0.2, 0.5, 0.9])
    np.testing.assert_allclose(mean["y"], [16, 17.5, 19.5])


def test_warm_up_is_friction_at_a_speed_with_its_band_and_the_cold_model():
    sheet = look(friction.warm_up(shown.warm_view()))
    assert one(sheet, "cold model, without heat").columns["y"] == 17.5
    band = one(sheet, "95 % interval, ± 0.20 N·m at most").columns
    np.testing.assert_allclose(band["upper"] - band["lower"], 2 * 1.96 * 0.1, rtol=1e-3)
    dots = one(sheet, "measured, brought to that speed").columns
    assert np.std(dots["y"] - one(sheet, "fit").columns["y"]) == pytest.approx(0.5, abs=0.05)
    assert sheet.finding.startswith("Friction at 0.50 rad/s goes from 17.5 to 5.72 N·m after ")
    assert friction.warm_up(shown.warm_view(warms=False)) is None
    mapped = look(friction.warm_up(View(shown.mapped_facts())))
    assert one(mapped, "E").columns["y"][0] == 0


def test_a_band_lies_over_the_dots_and_below_its_line():
    ax = look(friction.warm_up(shown.warm_view())).axes[0]
    fit, = (line for line in ax.lines if line.get_label() == "fit")
    dots = max(line.get_zorder() for line in ax.lines if line.get_marker() not in ("", "None") and np.size(line.get_xdata()))
    assert dots < ax.collections[0].get_zorder() < fit.get_zorder()
    # 0.39 N.m of interval are wider than the line
    pixels = abs(np.diff(ax.transData.transform([(0, 0), (0, 0.39)])[:, 1])[0])
    assert fit.get_linewidth() * ax.figure.dpi / 72 < pixels


def test_torque_over_position_is_two_loops_at_either_end():
    for facts in (shown.warm_facts(), {**shown.warm_facts(), "segments": np.zeros((0, 3))}):
        sheet = look(along_log.hysteresis(View(facts)))
        assert titles_of(sheet) == ["The beginning", "The end"]
        for panel in titles_of(sheet):
            # four holds of 20 s
            assert one(sheet, "measured", panel).columns["x"].size == 80


def test_several_estimates_share_a_picture():
    assert friction.estimates([("a", shown.warm_view())]) is None
    sheet = look(friction.estimates([("a", shown.warm_view()), ("b", shown.warm_view())]))
    assert {series.label for series in sheet.drawn} == {"measured", "a", "b", ""}


def test_a_trace_has_a_panel_for_each_parameter_and_none_that_is_empty():
    facts = shown.answer(trace=shown.trace_of(8))
    sheet = look(steps.trace(families.Answer(facts), "warm.csv"))
    assert len(sheet.axes) == 5 and all(ax.lines for ax in sheet.axes)
    gain = one(sheet, "final 95 % interval", "thermal_gain, k").columns
    assert (gain["lower"][0], gain["upper"][0]) == (-3.1, -2.9)
    values = next(series for series in sheet.drawn if series.ax.get_title(loc="left") == "thermal_gain, k" and series.kind == "line")
    assert values.columns["y"][0] == -6 and values.hue == hue_of("energy-ml")  # twice the truth at first
    assert "viscous 10.0 to 5.04" in sheet.finding
    assert steps.trace(families.Answer(shown.answer())) is None


def test_the_envelope_shows_where_the_guess_is_read_and_doubts_it():
    view = shown.warm_view()
    sheet = look(steps.envelope(view, shown.guess_facts()))
    assert one(sheet, "cold").columns["y"] == 15
    assert one(sheet, "63 % of the way").columns["x"].max() == 5  # minutes
    assert "the fit says k = −3.00 N·m/W, τ = 600 s" in sheet.subtitle and "is off" not in sheet.subtitle
    assert "the guess is off" in steps.envelope(view, shown.guess_facts(time_constant=1134.0)).subtitle
    truth = shown.guess_facts(truth={"gain": -3.0, "time_constant": 600.0})
    assert "truth: k = −3.00 N·m/W, τ = 600 s" in steps.envelope(view, truth, "warm").subtitle
    assert steps.envelope(view, None) is None


def test_kernels_are_drawn_in_their_colours():
    t = np.linspace(-4, 4, 81)
    kernels = np.exp(-((t[:, np.newaxis] - np.linspace(-2, 2, 6)) ** 2))
    facts = {"t": t, "truth": 0.3 * t**2 - 0.5, "seen": t[20:60], "values": t[20:60], "reach": 2, "fits": {"plain": 0 * t, "normalised": 0.7 + 0 * t},
             "kernels": {"plain": kernels, "normalised": kernels}}
    sheet = look(steps.kernels(facts))
    assert one(sheet, "plain kernels").hue == "orange"
    assert [series.ax.get_title(loc="left") for series in sheet.drawn].count("Plain kernels") == 6
    assert "at the edge of the data the function is 0.70" in sheet.finding


def test_torque_over_motor_angle_shows_the_ripple_of_each_speed():
    sheet = look(motor.motor_angle(View(shown.mapped_facts())))
    # 15 + 5 v, a wave of 2 about it, and 0.1 of noise: a bin misses the crest by 2 % of the wave, its mean of 8 samples or more by 0.1
    slow = one(sheet, "0.2 rad/s", "Forwards").columns["y"]
    assert np.nanmin(slow) == pytest.approx(16 - 2, abs=0.2) and np.nanmax(slow) == pytest.approx(16 + 2, abs=0.2)
    fast = one(sheet, "0.9 rad/s", "Backwards").columns["y"]
    assert np.nanmin(fast) == pytest.approx(-19.5 - 2, abs=0.2)
    for make in (motor.motor_angle, motor.motor_map, motor.motor_fit, motor.friction_map):
        assert make(shown.warm_view()) is None


def test_the_motors_map_is_drawn_at_the_samples_that_it_explains():
    facts = shown.mapped_facts()
    sheet = look(motor.motor_map(View(facts)))
    line = one(sheet, "map at 0.5 rad/s", "Forwards").columns
    assert np.nanmax(line["y"]) == pytest.approx(2, abs=0.1) and np.nanmin(line["y"]) == pytest.approx(-2, abs=0.1)
    # an RMS of 2/sqrt(2) without the map, of the noise with it
    assert sheet.finding.startswith("The map over motor angle takes the RMSE from 1.4") and "to 0.1" in sheet.finding
    # where the joint never was, the map says nothing
    hole = (facts["columns"]["motor_angle"] > np.pi / 2) & (facts["columns"]["motor_angle"] < np.pi) & (facts["columns"]["velocity"] > 0)
    facts["columns"]["keep"][hole] = 0
    line = one(motor.motor_map(View(facts)), "map at 0.5 rad/s", "Forwards").columns
    assert not np.isfinite(line["y"][(line["x"] > 1.8) & (line["x"] < 2.9)]).any()


def test_the_fit_follows_the_motors_wave_in_time():
    sheet = look(motor.motor_fit(View(shown.mapped_facts())))
    swing = {label: np.ptp(one(sheet, label, "Cold").columns["y"]) for label in ("measured", "with it", "fit without the map")}
    assert swing["with it"] == pytest.approx(swing["measured"], abs=0.8)
    assert swing["fit without the map"] < 0.5 * swing["with it"]


def test_a_friction_map_is_blank_where_the_joint_never_was():
    facts = shown.mapped_facts()
    sheet = look(motor.friction_map(View(facts)))
    cold = next(series for series in sheet.drawn if series.kind == "cell").columns

    def at(angle, speed):
        return cold["value"][np.argmin((cold["x"] - angle) ** 2 + (cold["y"] - speed) ** 2)]

    # a cell of the axes changes friction by 0.2 of some 18
    assert at(np.pi / 2, 0.5) == pytest.approx(15 + 2.5 + 2, abs=0.3) and at(3 * np.pi / 2, 0.5) == pytest.approx(15 + 2.5 - 2, abs=0.3)
    assert np.isnan(at(np.pi, 0.05)) and np.isnan(at(np.pi, 0.7))  # never so slow; between two speeds that were held
    assert [ax.get_title(loc="left") for ax in sheet.axes if ax.get_title(loc="left")][:2] == ["Forwards, cold", "Forwards, warmest: E = −11.8 N·m"]


def test_speeds_are_grouped_where_they_are_few_and_binned_where_they_are_many():
    groups = speeds.groups_of(View(shown.mapped_facts()), 1)
    assert [label for _, label, _ in groups] == ["0.2 rad/s", "0.5 rad/s", "0.9 rad/s"]
    many = speeds.groups_of(shown.warm_view(), 1)
    assert len(many) == 3 and sum(own.size for _, _, own in many) == 600


def test_a_robots_joint_is_drawn_with_what_is_left():
    time = np.linspace(0, 100, 500)
    speed = np.sin(time)
    facts = {"joint": "elbow", "file": "elbow", "status": "ok", "message": "fine", "torque_unit": "N.m", "rms_held_out": 0.12, "time": time,
             "velocity": speed, "measured": 2 * np.sign(speed) + 0.1, "fitted": 2 * np.sign(speed), "energy": np.zeros(0),
             "keep": (np.abs(speed) > 0.1).astype(float)}
    sheet = robots.joint(facts)
    left = sheet.drawn[-1].columns["y"]
    np.testing.assert_allclose(left[np.isfinite(left)], 0.1)
    assert sheet.subtitle == "ok, held-out residual 0.12 N·m" and len(sheet.axes) == 3


def test_a_warm_robot_stands_above_the_friction_that_its_heat_changes():
    view = shown.warm_view(identifier="")
    picture = {"pixels": np.full((64, 88), 0xFF8000), "axis": [[10, 10], [70, 50]], "arc": [[10 + i, 20] for i in range(10)]}
    scene = {"robot": "arm", "joint": "joint_2", "colours": ["#ffeeaa", "#880000"],
             "pictures": [{**picture, "time": 0.0, "energy": -9.1e-5}, {**picture, "time": 1199.0, "energy": float(view.energy[-1])}]}
    sheet = look(robots.warm_robot(view, scene, "warm arm"))
    titles = titles_of(sheet)
    assert titles[:2] == ["After 0 min: cold", "After 20 min: E = −12 N·m"]
    assert tuple(sheet.axes[0].images[0].get_array()[0, 0]) == (255, 128, 0)
    cold = one(sheet, "the mean if it had stayed cold").columns["y"]
    assert np.nanmin(cold) > 15 and np.nanmax(cold) < 20
    assert "by −11.8 N·m at most" in sheet.finding


def test_every_figure_of_a_run_is_named_as_its_file():
    source = source_of(shown.warm_facts())
    source.kind, source.run = "run", shown.example_run()
    assert set(all_of(source)) == set(source.figures())
    source.run.rows = []
    assert all_of(source) == {}


def test_boxes_put_no_variants_together_and_give_each_its_bound():
    run = shown.example_run()
    sheet = look(runs.npe_boxes(run))
    assert titles_of(sheet) == ["noise.torque 0.1 N·m", "noise.torque 1 N·m"]
    assert [one(sheet, "Cramér-Rao bound (rms)", title).columns["y"][0] for title in (" 0.1 N·m", " 1 N·m")] == [1, 10]
    assert "bound is" not in sheet.finding


def test_boxes_write_failures_out_and_compare_root_mean_squares():
    run = shown.example_run(ladder=False)
    sheet = look(runs.npe_boxes(run))
    means = one(sheet, "root mean square").columns["y"]
    assert means[0] == pytest.approx(100 * np.sqrt(np.mean(run.rows[0].npe ** 2)))
    highest = [series.columns["y"].max() for series in sheet.drawn if series.kind == "outlier"]
    assert highest[0] == pytest.approx(100 * run.rows[0].npe.max())
    assert one(sheet, "Cramér-Rao bound (rms)").columns["y"] == 1.2
    assert "12 of 40 not converged" in sheet.axes[0].get_xticklabels()[1].get_text()
    assert "with 12 of 40 failed" in sheet.finding


def test_a_ladder_is_climbed_by_root_mean_squares_beside_the_bound():
    run = shown.example_run()
    sheet = look(runs.ladder(run))
    ml = one(sheet, "energy-ml").columns
    halves = run.rows[0].npe.reshape(2, -1)
    np.testing.assert_allclose(ml["y"], 100 * np.sqrt((halves**2).mean(axis=1)))
    np.testing.assert_allclose(one(sheet, "Cramér-Rao bound (rms)").columns["y"], np.sqrt(14))  # 1, 2 and 3 %
    assert sheet.axes[0].get_xlabel() == "torque noise (N·m)"
    assert runs.ladder(shown.example_run(ladder=False)) is None


def test_errors_fall_by_iteration_with_bands_of_quartiles():
    run = shown.example_run(ladder=False)
    run.covariance = np.array([[(1.2 / 0.6745) ** 2]])  # the median of |x| of a normal x is 0.6745 standard deviations
    sheet = look(runs.error_by_iteration(run))
    assert one(sheet, "median at the Cramér-Rao bound").columns["y"] == pytest.approx(1.2, abs=0.04)
    falling = one(sheet, "energy-als, 50 iterations", "Normalised parameter error").columns
    np.testing.assert_allclose(falling["y"], 100 * np.exp(-0.05 * np.arange(1, 201)), rtol=1e-9)
    band = next(series for series in sheet.drawn if series.kind == "band" and series.hue == hue_of("energy-als")).columns
    np.testing.assert_allclose(band["upper"] / band["lower"], 1.25 / 0.75, rtol=1e-9)
    assert one(sheet, "energy-ml", "Normalised parameter error").columns["x"].tolist() == [1, 200]  # a level
    assert one(sheet, "noise").columns["y"] == 0.5


def test_parameters_by_iteration_run_to_the_truth():
    run = shown.example_run()
    sheet = look(runs.parameters_by_iteration(run))
    assert len(sheet.axes) == 1  # thermal_pole is no parameter of the continuous truth
    wide = one(sheet, "middle 80 %").columns
    assert wide["upper"][0] == pytest.approx(5 * (1 + 1.4 * np.exp(-0.05)), abs=0.02)
    assert one(sheet, "truth").columns["y"] == 5
    # few have a line each, one has no median
    trace = run.rows[1].trace
    trace.values = {name: values[:3] for name, values in trace.values.items()}
    assert np.isfinite(one(runs.parameters_by_iteration(run), "realizations").columns["y"]).sum() == 600
    trace.values = {name: values[:1] for name, values in trace.values.items()}
    alone = runs.parameters_by_iteration(run)
    assert "median" not in {series.label for series in alone.drawn} and alone.finding.startswith("Values after")


def test_bars_are_medians_of_the_right_numbers():
    assert [ax.get_title(loc="left") for ax in look(runs.agreement(shown.example_run())).axes] == [
        "noise.torque 0.1 N·m: Fit", "noise.torque 0.1 N·m: Root mean square error", "noise.torque 1 N·m: Fit",
        "noise.torque 1 N·m: Root mean square error"]
    run = shown.example_run(ladder=False)
    sheet = look(runs.agreement(run))
    bars = [series.columns["y"][0] for series in sheet.drawn if series.kind == "bar"]
    np.testing.assert_allclose(bars[::2], [np.median(values) for values in (run.rows[0].fit, run.rows[0].fpe, run.rows[0].rmse, run.rows[0].mae)])
    assert "bars are medians" in sheet.subtitle and sheet.finding.startswith("Medians:")


def test_of_one_realization_nothing_is_called_a_median():
    run = shown.example_run(ladder=False)
    run.finished = 1
    for row in run.rows:
        for name in ("npe", "rmse", "fit", "fpe", "mae"):
            setattr(row, name, getattr(row, name)[-1:])
        row.variant = row.variant[-1:]
    sheet = look(runs.agreement(run))
    assert "edian" not in sheet.subtitle + sheet.finding and "quartile" not in sheet.subtitle
    assert "line" not in [series.kind for series in sheet.drawn]


def test_coverage_is_in_per_cent_and_ends_at_100():
    sheet = look(runs.coverage(shown.example_run()))
    np.testing.assert_allclose(one(sheet, "energy-ml").columns["y"], 95)  # 38 of 40
    assert sheet.axes[0].get_ylim()[1] == 100
    assert "τ" in [text.get_text() for text in sheet.axes[0].get_xticklabels()]


def test_pairs_of_errors_hold_their_ellipses_and_that_of_the_bound():
    sheet = look(runs.parameter_pairs(shown.example_run()))
    assert len(sheet.axes) == 3
    bound = one(sheet, "Cramér-Rao bound").columns  # viscous, coulomb: deviations of 1 and 2 per cent
    # sqrt(chi^2 of 2 degrees at 95 %) = 2.4477; 121 points miss the tip by 1 - cos(1.5 deg) at most
    assert bound["x"].max() == pytest.approx(2.4477, abs=0.001) and bound["y"].max() == pytest.approx(2 * 2.4477, abs=0.002)
    # 40 draws: their deviation is known to 11 %, three times that here
    assert one(sheet, "their 95 % ellipse").columns["x"].max() == pytest.approx(2.4477, abs=0.9)


def test_series_are_written_as_csv_with_all_their_digits():
    sheet = Sheet("name", "title")
    ax = sheet.panels((200, [1]))[0]
    draw_line(ax, [0, 1], [1 / 3, np.nan], "a, b")
    draw_dots(ax, [2.0], [1e-9])
    finish_panel(ax, "time (s)", "torque (N·m)")
    assert sheet.csv() == ("# panel 1: x is time (s); y is torque (N·m)\npanel,series,kind,x,y,lower,upper,value\n"
                           "panel 1,\"a, b\",line,0,0.3333333333333333,,,\npanel 1,\"a, b\",line,1,,,,\npanel 1,series 2,dot,2,1e-09,,,\n")


def test_a_crowd_is_thinned_and_its_strays_are_kept():
    rng = np.random.default_rng(4)
    x, y = 0.1 * rng.standard_normal((2, 200_000))
    x[:20] = np.linspace(3, 5, 20)
    sheet = Sheet("crowd", "")
    ax = sheet.panels((200, [1]))[0]
    draw_dots(ax, x, y)
    shown_x = ax.lines[0].get_xdata()
    assert shown_x.size < 60_000 and np.count_nonzero(shown_x > 2) == 20
    assert sheet.drawn[0].columns["x"].size == 200_000  # all of them in the data


def test_what_has_no_room_is_too_small():
    with page_size({"width": 20, "height": 20}), pytest.raises(TooSmall, match="'log' is too small"):
        along_log.log(shown.warm_view())


def test_panels_that_would_be_too_narrow_stand_below_each_other():
    with use("paper"), page_size({"width": 88}):
        sheet = look(residuals.predicted(shown.warm_view()))
    boxes = [ax.get_position() for ax in sheet.axes]
    assert boxes[1].y1 < boxes[0].y0
    assert sheet.get_size_inches()[0] == pytest.approx(88 / 25.4)


def test_numbers_are_rounded_as_people_do():
    for value, digits, text in ((15.0412, 3, "15.0"), (-3.0, 3, "−3.00"), (603.2, 3, "603"), (-5.4e-5, 2, "−5.4·10⁻⁵"), (0, 3, "0"),
                                (0.09999, 2, "0.10"), (9.999e-5, 2, "1.0·10⁻⁴"), (float("nan"), 3, "–"), (None, 3, "–")):
        assert significant(value, digits) == text
    assert to_digits_of(5.00321, 0.06) == "5.003" and to_digits_of(600.7, 12) == "601" and to_digits_of(0.0035, None) == "0.003500"
    assert plain_number(0.003498, 4) == "0.003498" and plain_number(7.318e-4, 4) == "0.0007318" and plain_number(93.3, 4) == "93.30"
    assert unit_text("N.m.s^2/rad") == "N·m·s²/rad"
    assert range_text(1.2e-18, [0, 0.41]) == "0 to 0.41" and range_text(-2, (-2, -1)) == "−2.0 to −1.0"
    assert range_text(0.2, [0, 0.41]) is None and range_text(0.2, None) is None


def test_medians_in_bins_have_gaps_where_samples_are_few():
    x, y = binned_median(np.r_[np.zeros(10), np.ones(7), 2 * np.ones(10)], np.arange(27.0), 3)
    np.testing.assert_allclose(x, [1 / 3, 1, 5 / 3])
    assert y[0] == 4.5 and np.isnan(y[1]) and y[2] == 21.5


def test_arrays_take_the_places_of_their_marks():
    facts = {"a": {"array": 0, "shape": [2, 2]}, "b": [{"c": 1}]}
    made = unpacked(facts, [np.arange(4.0)])
    assert made["a"].tolist() == [[0, 1], [2, 3]] and made["b"] == [{"c": 1}]


def test_texts_from_outside_are_printable_and_no_mathematics():
    made = unpacked({"joint\x1b": ["a\x07b", "c\u202ed", "e\ufffe", "two\nlines"]}, [])
    assert made == {"joint\\x1B": ["a\\x07b", "c\\u202Ed", "e\\uFFFE", "two\nlines"]}
    assert math_text("k_{c+} of a_{\\frac} $x$") == "k$_{c+}$ of a_{\\frac} \\$x\\$"


def test_numbers_that_no_axis_holds_are_named():
    sheet = Sheet("one", "title")
    (ax,) = sheet.panels((200, [1]))
    with pytest.raises(TooLarge, match="'one': force reaches 1e\\+200; at most 1e\\+100"):
        draw_line(ax, [0, 1], [1, -1e200], "force")
    draw_line(ax, [0, 1], [np.nan, np.inf], "force")

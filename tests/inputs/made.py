"""Inputs of the table that are made here, each by the few lines that a report of it would have."""

import json

import numpy as np


def write_csv(path, **columns):
    """A recording, one column a name."""
    np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", comments="", fmt="%.9g",
               header=",".join(columns))


def holds(seed, inertia=0, tails=False, breakaway=0):
    """100 s at 50 Hz of a joint with viscous 0.8 and Coulomb 4.5 N.m, two speeds forwards and backwards for 3 s each, with short ramps."""
    rng = np.random.default_rng(seed)
    time = np.arange(5000) * 0.02
    speeds = np.repeat(rng.uniform(0.05, 1, 17), 2) * np.tile([1, -1], 17)
    velocity = np.convolve(np.repeat(speeds, 150)[:5000], np.ones(6) / 6, "same")
    noise = rng.standard_t(3, 5000) if tails else 0.1 * rng.standard_normal(5000)
    torque = (0.8 * velocity + (4.5 + breakaway * np.exp(-np.abs(velocity) / 0.05)) * np.sign(velocity)
              + inertia * np.gradient(velocity, time) + noise)
    return {"time": time, "position": np.cumsum(velocity) * 0.02 - 0.01 * velocity, "velocity": velocity, "torque": torque}


def moving(seed):
    """The same joint with 0.3 kg.m^2, which never holds a speed: 60 s at 100 Hz."""
    rng = np.random.default_rng(seed)
    time = np.arange(6000) * 0.01
    phases = 2 * np.pi * np.outer(np.arange(1, 6), time) / 10
    sines, cosines = rng.standard_normal((2, 5)) / 4
    velocity = sines @ np.sin(phases) + cosines @ np.cos(phases)
    rates = 2 * np.pi * np.arange(1, 6) / 10
    position = -(sines / rates) @ np.cos(phases) + (cosines / rates) @ np.sin(phases)
    acceleration = (sines * rates) @ np.cos(phases) - (cosines * rates) @ np.sin(phases)
    torque = 0.8 * velocity + 4.5 * np.sign(velocity) + 0.3 * acceleration + 0.1 * rng.standard_normal(6000)
    return {"time": time, "position": position, "velocity": velocity, "torque": torque}


def make_columns(folder):
    """A log without holds; the same with a velocity that is 0.08 s late; one in degrees for a while."""
    log = moving(1)
    write_csv(folder / "moving.csv", **log)
    late = {name: column[8:] for name, column in log.items()}
    write_csv(folder / "moving_late.csv", **{**late, "velocity": log["velocity"][:-8]})
    log["velocity"][2000:3500] *= 57.29578
    write_csv(folder / "part_in_degrees.csv", **log)


def make_torque_signs(folder):
    """A torque whose sign was lost, and one that has one sign since the joint bears a weight."""
    log = holds(2)
    write_csv(folder / "lost_torque_sign.csv", **{**log, "torque": np.abs(log["torque"])})
    weight = 12 * np.cos(0.3 * log["position"])
    write_csv(folder / "weight.csv", **{**log, "position": 0.3 * log["position"], "velocity": 0.3 * log["velocity"],
                                        "torque": log["torque"] - 0.56 * log["velocity"] + weight})


def make_absurd(folder):
    """A quarter of a log that is absurd, one sample in a hundred, and clean logs with large torques."""
    log = holds(3)
    torque = log["torque"].copy()
    torque[1500:2750] = 500
    write_csv(folder / "absurd_quarter.csv", **{**log, "torque": torque})
    torque = log["torque"].copy()
    torque[::100] *= 1e4
    write_csv(folder / "absurd_scattered.csv", **{**log, "torque": torque})
    write_csv(folder / "heavy_tails.csv", **holds(4, tails=True))
    write_csv(folder / "breakaway.csv", **holds(5, breakaway=20))
    write_csv(folder / "inertia.csv", **holds(6, inertia=5))


def speeds_in_turn(speeds=(0.1, 0.3, 0.6, 1), seconds=2, repeats=4):
    """time, position, velocity at 50 Hz: each speed forwards and backwards, again and again."""
    one = np.repeat([s * side for s in speeds for side in (1, -1)], 50 * seconds)
    velocity = np.tile(one, repeats)
    return 0.02 * np.arange(len(velocity)), 0.02 * np.cumsum(velocity), velocity


def make_degenerate(folder):
    """Logs that tell nothing, or too much, of friction: each identifier owes a status and a sentence."""
    t, q, v = speeds_in_turn()
    exact = 0.8 * v + 4.5 * np.sign(v)
    noisy = exact + 0.1 * np.random.default_rng(1).standard_normal(len(t))
    for name, (position, velocity, torque) in {
            "constant": (q, v, 3 + 0 * v), "one_value_each_way": (q, v, 4.5 * np.sign(v)), "zeros": (q, v, 0 * v),
            "at_rest": (0 * q, 0 * v, noisy), "exact": (q, v, exact), "unsigned": (q, abs(v), noisy),
            "both_unsigned": (q, abs(v), abs(noisy)), "huge": (q, v, 1e150 * noisy), "tiny": (q, v, 1e-200 * noisy),
            "slow": (1e-150 * q, 1e-150 * v, noisy), "one_way": (0.02 * np.cumsum(abs(v)), abs(v), abs(exact)),
            "steps": (q, v, np.round(exact))}.items():
        write_csv(folder / f"degenerate_{name}.csv", time=t, position=position, velocity=velocity, torque=torque)
    write_csv(folder / "degenerate_two_samples.csv", time=t[:2], position=q[:2], velocity=v[:2], torque=noisy[:2])


def make_coarse(folder):
    """A torque without noise in coarse steps."""
    t, q, v = speeds_in_turn((0.1, 0.5, 0.9, 1.4, 2))
    for step in 0.25, 0.4:
        torque = step * np.round((0.8 * v + 4.5 * np.sign(v)) / step)
        write_csv(folder / f"coarse_{step}.csv", time=t, position=q, velocity=v, torque=torque)


def make_cool_down(folder):
    """Ends with as long a rest as it moved."""
    t, q, v = speeds_in_turn()
    rest = 0 * t
    torque = 0.8 * v + 4.5 * np.sign(v) + 0.1 * np.random.default_rng(2).standard_normal(len(t))
    write_csv(folder / "cool_down.csv", time=0.02 * np.arange(2 * len(t)), position=np.r_[q, q[-1] + rest],
              velocity=np.r_[v, rest], torque=np.r_[torque, rest])


def make_ripple(folder):
    """Friction 0.06 v + 0.55 forwards, 0.48 backwards, and a ripple that evens out over a turn; motor ripple with a gear of 7."""
    speeds = np.tile(np.repeat([0.3, -0.3, 1.2, -1.2], [1047, 1047, 262, 262]), 8)
    t, q = 0.02 * np.arange(len(speeds)), 0.02 * np.cumsum(speeds)
    level = np.where(speeds > 0, 0.55, 0.48) + 0.08 * np.sin(q)
    noise = 0.05 * np.random.default_rng(3).standard_normal(len(t))
    torque = 0.06 * speeds + np.sign(speeds) * level + noise
    write_csv(folder / "ripple.csv", time=t, position=q, velocity=speeds, torque=torque)
    write_csv(folder / "motor_ripple.csv", time=t, position=q, velocity=speeds,
              torque=torque + np.sign(speeds) * 0.2 * np.sin(7 * q))


def make_truths(folder):
    """The friction of `holds`, and one that warms besides."""
    cold = {"law": "viscous_coulomb", "parameters": {"viscous": 0.8, "coulomb": 4.5}}
    (folder / "truth.json").write_text(json.dumps(cold))
    (folder / "warm_truth.json").write_text(json.dumps({**cold, "thermal": {"thermal_gain": -1, "thermal_time_constant": 600}}))
    write_csv(folder / "holds.csv", **holds(9))


def make_velocity_alone(folder):
    """Logs without positions: that hold speeds, that never do, of which the velocity lost its sign, and of other names."""
    for name, log in {"holds": holds(7), "moving": moving(7)}.items():
        velocity, torque = log["velocity"], log["torque"]
        write_csv(folder / f"{name}_no_position.csv", time=log["time"], velocity=velocity, torque=torque)
    log = holds(8)
    write_csv(folder / "unsigned_no_position.csv", time=log["time"], velocity=abs(log["velocity"]), torque=log["torque"])
    write_csv(folder / "other_position.csv", time=log["time"], q1=log["position"], velocity=log["velocity"], torque=log["torque"])


def make_containers(folder):
    """HDF5 and MATLAB files with groups, links, structs, matrices either way round, and what is no matrix."""
    try:
        import h5py
        import scipy.io
    except ImportError:
        return
    place = folder / "containers"
    place.mkdir()
    log = holds(9)
    time, others = log["time"], ("position", "velocity", "torque")
    with h5py.File(place / "wide.h5", "w") as file:  # k x N, in single precision and whole numbers, big-endian, compressed
        file["time"] = np.round(1000 * time).astype(">i4")
        for name in others:
            file.create_dataset(name, data=np.stack([0 * time, log[name]]).astype(">f4"), compression="gzip", chunks=True)
    with h5py.File(place / "robot.h5", "w") as file:  # one clock, two joints, units, a camera
        file["time"] = time
        for joint in "elbow", "wrist":
            for name in others:
                file[f"{joint}/{name}"] = log[name][:, None]
            file[f"{joint}/position"][...] *= 180 / np.pi
            file[f"{joint}/position"].attrs["unit"] = "deg"
        file["camera"] = np.zeros((len(time), 2, 2), "u1")
    with h5py.File(place / "links.h5", "w") as file:  # a group in itself, links that lead nowhere, and one that leads to the log
        for name, values in log.items():
            file[f"data/{name}"] = values
        file["data/again"] = file["data"]
        file["data/gone"] = h5py.SoftLink("/nothing")
    with h5py.File(place / "itself.h5", "w") as file:  # a group that holds itself by ten names
        for name, values in log.items():
            file[f"data/{name}"] = values
        for k in range(10):
            file[f"data/again{k}"] = file["data"]
    with h5py.File(place / "other_file.h5", "w") as file:  # a log, and a link to another file
        for name, values in log.items():
            file[f"data/{name}"] = values
        file["far"] = h5py.ExternalLink("nowhere.h5", "/data")
    with h5py.File(place / "literal.h5", "w") as file:  # names that look like columns of a matrix
        for name, values in log.items():
            file[f"{name}[3]"] = values
    with h5py.File(place / "lengths.h5", "w") as file:
        file["time"], file["position"], file["torque"] = time[:-9], np.ones((len(time), 4)), log["torque"]
    struct = {"t": time, "arm": {"q": np.stack([0 * time, log["position"]], axis=1), "dq": np.stack([0 * time, log["velocity"]]),
                                 "tau": log["torque"]}, "pid": [1.0, 2, 3], "load": [], "name": "elbow"}
    scipy.io.savemat(place / "struct.mat", {"rec": struct, "version": 3})
    cells = np.empty((1, 2), object)
    cells[0, :] = log["position"], log["torque"]
    scipy.io.savemat(place / "cells.mat", {"time": time, "q": cells, "s": [struct, struct]}, do_compression=True)


def make_tables(folder):
    """One log as text in many forms: 20 s at 50 Hz, 1 rad there and back at 0.5 rad/s, viscous 0.8, Coulomb 4.5."""
    place = folder / "tables"
    place.mkdir()
    n = np.arange(1000)
    v = np.where(n // 100 % 2, -.5, .5)
    torque = .8 * v + 4.5 * np.sign(v) + .1 * np.random.default_rng(7).standard_normal(1000)
    t, q, v, torque = ([f"{x:.4f}" for x in column] for column in (n * .02, np.cumsum(v) * .02, v, torque))
    head = "time,position,velocity,torque"

    def text(*columns, head=head, separator=",", mark=".", end=""):
        rows = [separator.join(x.replace(".", mark) for x in row) for row in zip(*columns)]
        return (end + "\n").join([*([head.replace(",", separator)] if head else []), *rows]) + end + "\n"

    def degrees(column, factor=180 / np.pi):
        return ["%.6f" % (float(x) * factor) for x in column]

    def stamps(form, times=n * .02):
        return [form.format(d=int(x // 86400), h=int(x // 3600) % 24, m=int(x // 60) % 60, s=x % 60, ms=round(x % 1 * 1000), ns=round(x % 1 * 1e9),
                            sec=int(x), x=x) for x in np.round(times, 4)]

    plain = text(t, q, v, torque)
    lines = plain.splitlines()
    six = [[f"{x:.4f}" for x in np.repeat(np.array(c, float), 6)] for c in (t, v, torque)]
    forms = {
        "bom": b"\xef\xbb\xbf" + plain.encode(), "utf16": plain.encode("utf-16"), "utf16be": plain.encode("utf-16-be"),
        "sep": "sep=;\r\n" + text(t, q, v, torque, separator=";", mark=",", end="\r"),
        "trailing": text(t, q, v, torque, separator=";", end=";"), "trailing_rows": plain.replace("\n", ",\n").replace("torque,", "torque"),
        "repeated": "\n".join([*lines[:500], head, *lines[500:]]) + "\n", "cut": plain + "20.0000,0.5",
        "zeros": plain.encode() + bytes(4096), "footer": plain + "End of log\n",
        "groups": text(t, q, v, torque, head="/robot/elbow/time,/robot/elbow/position,/robot/elbow/velocity,/robot/elbow/torque"),
        "comment": "# of 2024\n# " + text(t, q, v, torque, separator=" "), "savetxt": "# " + head + "\n" + text(t, q, v, torque, head="", separator=" "),
        "percent": "%" + text(t, q, v, torque, separator="\t"), "blanks": text(t, q, v, torque, separator="   "),
        "blanks_comma": text(t, q, v, torque, separator=" ", mark=","), "tabs_comma": text(t, q, v, torque, separator="\t", mark=","),
        "preamble": "Gain,1.0,2.0\nOffset,0.5,0\n\n" + plain, "keys": "Name\tRun 3\nRate\t50\n\n" + text(t, q, v, torque, separator="\t"),
        "names": text(t, q, v, torque, head='"Time, s","Angle (joint 1)",velocity,"Torque, filtered"'),
        "numbers": text(t, q, v, torque, head="time,1,2,3"), "headless": text(t, q, v, torque, head=""),
        "no_clock": text(q, v, torque, head=""), "no_time": text(q, v, torque, head="position,velocity,torque"),
        "iso": text(stamps("2024-03-01T10:{m:02}:{s:06.3f}+01:00"), q, v, torque), "hms": text(stamps("12:{m:02}:{s:06.3f}"), q, v, torque),
        "iso_comma": text(stamps("2024-03-01 10:{m:02}:{s:06.3f}"), q, v, torque, separator=";", mark=","),
        "hms_ms": text(stamps("12:00:{sec:02}:{ms:03}"), q, v, torque), "afternoon": text(stamps("1:{m:02}:{s:06.3f} PM"), q, v, torque),
        "midnight": text(stamps("{h:02}:{m:02}:{s:06.3f}", 86390 + n * .02), q, v, torque),
        "german_date": text(stamps("01.03.2024 10:00:{s:06.3f}"), q, v, torque),
        "date_and_time": text(["2024-03-01"] * 1000, stamps("10:00:{s:06.3f}"), q, v, torque, head="date,clock,position,velocity,torque"),
        "seconds": text(stamps("{x:.2f} sec"), q, v, torque), "milliseconds": text(stamps("{x:.2f}", n * 20.0), q, v, torque, head="time_ms" + head[4:]),
        "timedelta": text(stamps("0 days 00:00:{s:09.6f}"), q, v, torque),
        "secs": text(stamps("17000000{sec:02}"), stamps("{ns}"), q, v, torque, head="secs,nsecs,position,velocity,torque"),
        **{f"epoch_{unit}": text([str(17 * 10**(8 + power) + k * 2 * 10**(power - 2)) for k in n], q, v, torque)
           for unit, power in (("ms", 3), ("us", 6), ("ns", 9))},
        "ticks": text(stamps("{sec}", .37 + n * .02), q, v, torque),
        "ticks_velocity": text(stamps("{sec}", .37 + n * .02), [f"{np.sin(k * np.pi / 25):.4f}" for k in n], torque, head="time,velocity,torque"),
        "german": text(["%g" % (20 * k) for k in n], degrees(q), degrees(v), degrees(torque, 1000),
                       head="Zeit_ms,Winkel_deg,Drehzahl_deg/s,Moment_mNm"),
        "ampere": text(t, degrees(q), degrees(v), torque, head="Time [s],Position [deg],Velocity [deg/s],i_A"),
        "capitals": text(t, degrees(q), degrees(v, 30 / np.pi), torque, head="TIME_S,POSITION_DEG,VELOCITY_RPM,TORQUE_NM"),
        "units": text(t, degrees(q), degrees(v), degrees(torque, 1000), head=head + "\n\n(s),(°),(°/s),(mN·m)"),
        "empty_velocity": text(t, q, [""] * 1000, torque), "words": text(t, [*q[:500], "null", *q[501:]], v, ["", *torque[1:]]),
        "thousands": text(*([f"{1000 + k:,}" for k in n + 10 * i] for i in range(4)), separator=";"),
        "decimal_comma": text(t, q, v, torque, mark=","), "rows_of_joints": text(six[0], np.tile([str(k) for k in range(6)], 1000), six[1], six[2]),
        "month": text(stamps("03/04/2024 10:00:{s:06.3f}"), q, v, torque), "from_boot": text([str(36 * 10**11 + k * 20_000_000) for k in n], q, v, torque),
        "wrong_quantity": text(t, q, v, torque, head="time,position,v_deg,torque"), "millimetres": text(t, q, v, torque, head=head + "\ns,mm,mm/s,N"),
        **{f"clocks_{unit}_{other}": text([f"{float(x) * k:.4f}" for x in t], q, [f"{(float(x) + .003) * other_k:.4f}" for x in t], torque,
                                          head=f"t_{unit},position,t_{other},torque") for unit, k, other, other_k in (("ms", 1e3, "s", 1), ("s", 1, "ms", 1e3))},
        "own_clocks": head + "\n" + "".join(f"{a},{b},,\n{float(a) + .001},,{c},\n{float(a) + .002},,,{d}\n" for a, b, c, d in zip(t, q, v, torque)),
    }
    for name, form in forms.items():
        (place / name).write_bytes(form if isinstance(form, bytes) else form.encode())


def write(folder):
    """All of them, into a folder."""
    for name, make in list(globals().items()):
        if name.startswith("make_"):
            make(folder)


def make_robots(folder):
    """Robots for `attach`: URDFs with meshes, massless links or a bad inertia, servos too stiff for the step, and a friction."""
    place = folder / "robots"
    (place / "meshes").mkdir(parents=True)
    (place / "meshes/link.obj").write_text(
        "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 1 4 3\n")
    (place / "friction.json").write_text('{"law": "coulomb", "parameters": {"coulomb": 2}}')

    def urdf(name, link, rest="", inertia=1):
        inertial = f'<inertial><mass value="2"/><inertia ixx=".1" iyy=".1" izz="{inertia}" ixy="0" ixz="0" iyz="0"/></inertial>'
        (place / name).write_text(
            f'<!-- of <mujoco> {name} --><robot name="r"><link name="base"/><link name="a">{link or inertial}</link>'
            '<joint name="j" type="revolute"><parent link="base"/><child link="a"/><axis xyz="0 0 1"/>'
            f'<limit lower="-1" upper="1" effort="10" velocity="1"/></joint>{rest}</robot>')

    def mesh(file):
        return ('<inertial><mass value="2"/><inertia ixx=".1" iyy=".1" izz=".1" ixy="0" ixz="0" iyz="0"/></inertial>'
                f'<collision><geometry><mesh filename="{file}"/></geometry></collision>')

    urdf("file.urdf", mesh(f"file://{place}/meshes/link.obj"))
    urdf("package.urdf", mesh("package://arm/meshes/link.obj"))
    urdf("expanded.urdf", mesh(f"{place}/meshes/link.obj"), "<!-- <xacro:macro/> ${x} -->")
    urdf("massless.urdf", " ")
    urdf("bounded.urdf", " ", '<mujoco><compiler boundmass="0.01" boundinertia="0.001"/></mujoco>')
    urdf("inertia.urdf", "")

    def servo(name, stiffness, options="", servo='biasprm="0 -{0} 0"'):
        (place / name).write_text(
            f'<mujoco><option timestep="0.002" {options}/><worldbody><body><joint name="j" armature="0.001"/>'
            '<inertial pos="0 0 0" mass="1e-4" diaginertia="1e-9 1e-9 1e-9"/></body></worldbody><actuator>'
            f'<general name="s" joint="j" biastype="affine" gainprm="{stiffness}" {servo.format(stiffness)}/>'
            '</actuator></mujoco>')

    servo("servo2.xml", 500)  # kp h^2 / M = 2
    servo("servo5.xml", 1250)
    servo("damped5.xml", 50, servo='biasprm="0 -50 -1.25"')  # 2 kv h / M = 5
    (place / "ratio.xml").write_text(
        '<mujoco><worldbody><body><joint name="j"/><geom size=".1"/></body></worldbody><actuator>'
        '<position name="s" joint="j" kp="5" dampratio="1"/></actuator></mujoco>')
    (place / "nameless.xml").write_text(
        '<mujoco><worldbody><body><joint/><geom size=".1"/></body></worldbody></mujoco>')


def make_rests(folder):
    """Two seconds of motion, and then a rest of .2, 1.4 or 3 s whose velocity a drive logs as zeros: viscous 1.5, Coulomb .5, inertia .2."""
    rng, dt = np.random.default_rng(1), .008
    t = np.arange(0, 60, dt)
    for rest in (.2, 1.4, 3):
        phase, turn = np.mod(t, 2 + rest), (t // (2 + rest)).astype(int)
        moves, x = phase < 2, np.clip(phase / 2, 0, 1)
        top = np.where(turn % 2, -1, 1) * (.2 + .3 * (turn * 7 % 5) / 4)
        v = top * np.sin(np.pi * x)**2 * (1 + .5 * np.sin(6 * np.pi * x))
        # its derivative: differences over two samples lack .2 % of it
        by_x = np.pi * np.sin(2 * np.pi * x) * (1 + .5 * np.sin(6 * np.pi * x)) + 3 * np.pi * np.sin(np.pi * x)**2 * np.cos(6 * np.pi * x)
        acceleration = np.where(moves, top * by_x / 2, 0)
        noise = .03 * rng.standard_normal(len(t))
        write_csv(folder / f"rests_{rest}.csv", time=t, position=np.cumsum(v) * dt,
                  velocity=np.where(moves, v + 1e-3 * rng.standard_normal(len(t)), 0),
                  torque=1.5 * v + .5 * np.sign(v) + .2 * acceleration + noise)


def make_rounded(folder):
    """Positions alone, in degrees, rounded as people export them: 75 holds of 4 s. viscous .35, Coulomb 1.4"""
    rng = np.random.default_rng(2)
    turn = np.arange(15000) // 200
    v = np.where(turn % 2, -1, 1) * np.array([.1, .3, .6, 1, 1.5])[turn * 7 // 2 % 5]
    v = np.convolve(v, np.ones(10) / 10, "same")
    torque = .35 * v + 1.4 * np.sign(v) + .02 * rng.standard_normal(len(v))
    for step in (.001, .01):
        q = np.round(np.rad2deg(np.cumsum(v) * .02) / step) * step
        write_csv(folder / f"rounded_{step}.csv", time=np.arange(len(v)) * .02, position=q, torque=torque)


def make_ringing(folder):
    """20 holds of 10 s at 20 Hz, each of which starts with samples that ring by some per cent, and more in the torque. viscous 5, Coulomb 15"""
    rng = np.random.default_rng(3)
    speeds = np.where(np.arange(20) % 2, -1, 1) * rng.uniform(.1, 1, 20)
    v = np.repeat(speeds, 200)
    torque = 5 * v + 15 * np.sign(v) + .1 * rng.standard_normal(len(v))
    for begin in range(200, len(v), 200):
        v[begin - 2:begin + 1] = np.linspace(v[begin - 3], v[begin], 5)[1:-1]
        v[begin + 1:begin + 5] *= (.969, .991, .983, 1.005)
        torque[begin - 2:begin + 4] += np.sign(v[begin + 4]) * np.array([-10, 5, 12, 5.8, -1.4, .8])
    write_csv(folder / "ringing.csv", time=np.arange(len(v)) * .05, position=np.cumsum(v) * .05, velocity=v, torque=torque)


def make_names(folder):
    """A torque in a column `load`, one direction with an offset of the sensor, dates with years of two digits over midnight, and factors below the header."""
    place = folder / "names"
    place.mkdir()
    log = holds(10)
    write_csv(place / "load.csv", time=log["time"], position=log["position"], velocity=log["velocity"], load=log["torque"])
    speed = np.repeat([.2, .5, 1, .3, .8, .1], 500)
    time, noise = .02 * np.arange(len(speed)), .1 * np.random.default_rng(11).standard_normal(len(speed))
    columns = {"position": np.cumsum(speed) * .02, "velocity": speed, "torque": .8 * speed + 4.5 + .5 + noise}
    write_csv(place / "one_way.csv", time=time, **columns)
    rows = (place / "one_way.csv").read_text().splitlines()
    (place / "factors.csv").write_text("\n".join([rows[0], "1700000000,0.001,0.01,0.1", *rows[1:]]) + "\n")
    for name, form in {"dmy": "{:02}/04/24 ", "mdy": "04/{:02}/24 "}.items():
        stamps = [form.format(3 + (k >= 500)) + ("23:59:%05.2f" % (50 + .02 * k) if k < 500 else "00:00:%05.2f" % (.02 * (k - 500))) for k in range(1000)]
        body = [",".join([stamp, *row.split(",")[1:]]) for stamp, row in zip(stamps, rows[1:])]
        (place / f"dates_{name}.csv").write_text("\n".join([rows[0], *body]) + "\n")


def by_hand(seed, rate, minutes=2):
    """Time, position, velocity and acceleration of moves by hand between -1 and 1 rad, with pauses."""
    rng = np.random.default_rng(seed)
    t = np.arange(int(60 * minutes * rate)) / rate
    q, k, here = np.zeros_like(t), 0, 0.0
    while k < len(t):
        to = rng.uniform(-1, 1)
        n = int(max(.4, abs(to - here) * rng.uniform(.8, 2)) * rate)
        s = np.arange(n) / n
        q[k:k + n] = (here + (to - here) * (10 * s**3 - 15 * s**4 + 6 * s**5))[:len(t) - k]
        k, here = k + n, to
        p = int(rng.uniform(.2, 1.5) * rate)
        q[k:k + p] = here
        k += p
    v = np.gradient(q, t)
    return t, q, v, np.gradient(v, t)


def make_by_hand(folder):
    """The joint of `moving`, moved by hand: in time; with a torque that is late; with a velocity that is filtered or has an offset; with
    stamps of arrival; at one sample in ten; for 40 s, with a lag that looks like warming."""
    rng = np.random.default_rng(4)
    t, q, v, a = by_hand(5, 100)
    torque = .8 * v + 4.5 * np.sign(v) * (np.abs(v) > 1e-3) + .3 * a + .1 * rng.standard_normal(len(t))
    write_csv(folder / "hand.csv", time=t, position=q, velocity=v, torque=torque)
    for steps in (1, 2, 5):
        late = np.r_[np.full(steps, torque[0]), torque[:-steps]]
        write_csv(folder / f"hand_late_{steps}.csv", time=t, position=q, velocity=v, torque=late)
    write_csv(folder / "hand_early.csv", time=t, position=q, velocity=v, torque=np.r_[torque[3:], [0] * 3])
    for steps in (1, 3):
        w, share = np.zeros_like(v), 1 - np.exp(-1 / steps)
        for i in range(1, len(v)):
            w[i] = w[i - 1] + share * (v[i] - w[i - 1])
        write_csv(folder / f"hand_filtered_{steps}.csv", time=t, position=q, velocity=w, torque=torque)
    write_csv(folder / "hand_offset.csv", time=t, position=q, velocity=v + .02, torque=torque)
    for counts in (0, 4096):
        for late in (.2, .5, 2):
            step = 2 * np.pi / counts if counts else 1e-9
            write_csv(folder / f"hand_stamps_{counts}_{late}.csv", time=t + 1e-3 * late * np.abs(rng.standard_normal(len(t))),
                      position=np.round(q / step) * step, torque=torque)


def make_tops(folder):
    """Moves of one top speed between rests, with ramps and no holds: viscous .2, Coulomb .307, inertia .06."""
    rng, dt = np.random.default_rng(7), .01
    shape = np.r_[np.linspace(0, 1, 55), np.ones(35), np.linspace(1, 0, 55), np.zeros(20)]
    v = np.concatenate([(1, -1)[k % 2] * .48 * (1 - .02 * rng.random()) * (.5 - .5 * np.cos(np.pi * shape)) for k in range(40)])
    t = np.arange(len(v)) * dt
    write_csv(folder / "tops.csv", time=t, position=np.cumsum(v) * dt, velocity=v + 2e-3 * rng.standard_normal(len(v)),
              torque=.2 * v + .307 * np.sign(v) * (abs(v) > 1e-9) + .06 * np.gradient(v, dt) + .04 * rng.standard_normal(len(v)))

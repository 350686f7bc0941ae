"""The kernel of warmjoint.warp: one thread steps one kinematic tree of one world. Formulas: reference.py.

In arrays that hold both, friction's joints are [worlds x J] and degrees of freedom [worlds x nv]; parameters have one row for all worlds, or one for each.
"""

import warp as wp

from warmjoint.warp_projection import Tree, nearest

# nobody differentiates through a step
wp.set_module_options({"enable_backward": False})

# columns of `law`
POSITIVE, NEGATIVE, RISE, STATIC, VELOCITY, EXPONENT, BREAKS, LOAD_GAIN, PER_ENERGY = range(9)
# of `heat`: what a loss adds to each stage and what stays, what a rise of the ambient adds
GAIN, POLE, SECOND_GAIN, SECOND_POLE, AMBIENT = range(5)
# of `shape`: inertia m, A and B, gear
INERTIA, STIFFNESS, DAMPING, GEAR = range(4)
# of `axis_int` and `axis_float`, for each axis of a table
QUANTITY, COUNT, CIRCLE = range(3)
FIRST, PER_STEP = range(2)


@wp.struct
class Joints:
    """What does not change: friction's joints and their maps."""

    of_dof: wp.array(dtype=int)  # [nv] place in J, -1 where there is no friction
    position: wp.array(dtype=int)  # [J] in qpos
    shape: wp.array2d(dtype=float)  # [J x 4]
    law: wp.array3d(dtype=float)  # [1 or worlds x J x 9]
    heat: wp.array3d(dtype=wp.float64)  # [1 or worlds x J x 5]
    map_begin: wp.array(dtype=int)  # [J + 1]
    map_factor: wp.array(dtype=int)  # [maps]
    map_offset: wp.array(dtype=int)  # [maps]
    axis_int: wp.array3d(dtype=int)  # [maps x 2 x 3]
    axis_float: wp.array3d(dtype=float)  # [maps x 2 x 2]
    values: wp.array(dtype=float)


@wp.struct
class States:
    """What a step begins with (twice: at its begin and, of the last computation, at its end), and what it tells."""

    time: wp.array2d(dtype=float)  # [worlds x trees] of the last computation, s; -inf none
    stretch: wp.array2d(dtype=float)  # z [worlds x nv], rad or m
    next_stretch: wp.array2d(dtype=float)
    energy: wp.array3d(dtype=wp.float64)  # [worlds x J x 2]
    next_energy: wp.array3d(dtype=wp.float64)
    slip: wp.array2d(dtype=float)  # [worlds x J]
    next_slip: wp.array2d(dtype=float)
    status: wp.array2d(dtype=int)  # [worlds x nv] the active set of the spring's projection
    ambient: wp.array(dtype=float)  # [worlds] rise, K
    force: wp.array2d(dtype=float)  # [worlds x J]
    loss: wp.array2d(dtype=float)
    held: wp.array2d(dtype=bool)
    total: wp.array2d(dtype=wp.float64)  # E [worlds x J]
    start_energy: wp.array3d(dtype=wp.float64)  # [worlds x J x 2] at a reset by time
    turns: wp.array2d(dtype=int)  # [worlds x trees]


@wp.struct
class Scratch:
    factor: wp.array2d(dtype=float)  # [worlds x nM]
    taken: wp.array2d(dtype=int)  # [worlds x nv]
    status: wp.array2d(dtype=int)
    lower: wp.array2d(dtype=float)
    upper: wp.array2d(dtype=float)
    base: wp.array2d(dtype=float)
    aim: wp.array2d(dtype=float)
    result: wp.array2d(dtype=float)
    force: wp.array2d(dtype=float)
    sum: wp.array2d(dtype=wp.float64)


@wp.func
def cubic(t: float, k: int) -> float:
    """The weight of the k-th of four points at -1, 0, 1, 2."""
    if k == 0:
        return -t * (t - 1.0) * (t - 2.0) / 6.0
    if k == 1:
        return (t + 1.0) * (t - 1.0) * (t - 2.0) * 0.5
    if k == 2:
        return -(t + 1.0) * t * (t - 2.0) * 0.5
    return (t + 1.0) * t * (t - 1.0) / 6.0


@wp.func
def place_on(j: Joints, i: int, axis: int, x: float) -> float:
    """How far along a table's axis, in steps."""
    at = (x - j.axis_float[i, axis, FIRST]) * j.axis_float[i, axis, PER_STEP]
    count = j.axis_int[i, axis, COUNT]
    if j.axis_int[i, axis, CIRCLE] != 0:
        return at - float(count) * wp.floor(at / float(count))
    return wp.clamp(at, 0.0, float(count - 1))


@wp.func
def point_of(j: Joints, i: int, axis: int, base: int, k: int) -> int:
    count = j.axis_int[i, axis, COUNT]
    place = base - 1 + k
    if j.axis_int[i, axis, CIRCLE] != 0:
        return (place + count) % count
    return wp.clamp(place, 0, count - 1)


@wp.func
def base_of(j: Joints, i: int, axis: int, at: float) -> int:
    """The point before, so that four points lie around."""
    base = int(at)
    if j.axis_int[i, axis, CIRCLE] != 0:
        return base
    return wp.clamp(base, 1, wp.max(1, j.axis_int[i, axis, COUNT] - 3))


@wp.func
def quantity_at(which: int, position: float, motor: float, speed: float, energy: float, load: float) -> float:
    if which == 0:
        return position
    if which == 1:
        return motor
    if which == 2:
        return speed
    if which == 3:
        return energy
    return load


@wp.func
def map_level(j: Joints, i: int, side: float, position: float, motor: float, speed: float, energy: float, load: float) -> float:
    """What a map adds to the level of one side."""
    a = place_on(j, i, 0, quantity_at(j.axis_int[i, 0, QUANTITY], position, motor, speed, energy, load))
    na = j.axis_int[i, 0, COUNT]
    nb = j.axis_int[i, 1, COUNT]
    ia = base_of(j, i, 0, a)
    offset = j.map_offset[i]
    if side < 0.0:
        offset = offset + na * nb
    total = float(0.0)
    if nb == 1:
        for k in range(4):
            total += cubic(a - float(ia), k) * j.values[offset + point_of(j, i, 0, ia, k)]
    else:
        b = place_on(j, i, 1, quantity_at(j.axis_int[i, 1, QUANTITY], position, motor, speed, energy, load))
        ib = base_of(j, i, 1, b)
        for k in range(4):
            row = offset + nb * point_of(j, i, 0, ia, k)
            sum = float(0.0)
            for n in range(4):
                sum += cubic(b - float(ib), n) * j.values[row + point_of(j, i, 1, ib, n)]
            total += cubic(a - float(ia), k) * sum
    if j.map_factor[i] == 0:
        return side * total
    if j.map_factor[i] == 2:
        return speed * total
    return total


@wp.func
def level_at(j: Joints, w: int, k: int, side: float, v: float, slip: float, energy: float, position: float, load: float) -> float:
    row = w % j.law.shape[0]
    coulomb = wp.where(side > 0.0, j.law[row, k, POSITIVE], j.law[row, k, NEGATIVE])
    speed = wp.abs(v)
    level = coulomb
    if j.law[row, k, BREAKS] != 0.0:
        if not (side * v > 0.0 and side * slip > 0.5):
            level = j.law[row, k, STATIC]
    elif j.law[row, k, RISE] != 0.0:
        ratio = speed / j.law[row, k, VELOCITY]
        if j.law[row, k, EXPONENT] == 2.0:
            level += j.law[row, k, RISE] * wp.exp(-ratio * ratio)
        else:
            level += j.law[row, k, RISE] * wp.exp(-wp.pow(ratio, j.law[row, k, EXPONENT]))
    level += energy + j.law[row, k, LOAD_GAIN] * wp.abs(load)
    motor = j.shape[k, GEAR] * position
    for i in range(j.map_begin[k], j.map_begin[k + 1]):
        level += map_level(j, i, side, position, motor, speed, energy, load)
    return level


@wp.func
def finite(x: float) -> float:
    """What is no finite number counts as 0."""
    return wp.where(wp.isfinite(x), x, 0.0)


@wp.func
def finite_heat(x: wp.float64) -> wp.float64:
    return wp.where(wp.isfinite(x), x, wp.float64(0.0))


@wp.func
def begin(w: int, tree: int, i0: int, n: int, time: float, h: float, j: Joints, st: States):
    """The step before is over where the time has gone on, or where a step is too short to move it in single precision, in which every computation
    then is a step; where it went back the world was reset."""
    last = st.time[w, tree]
    over = time > last or (time == last and time + h == time)
    for a in range(n):
        i = i0 + a
        k = j.of_dof[i]
        if k >= 0:
            if over:
                st.stretch[w, i] = st.next_stretch[w, i]
                st.slip[w, k] = st.next_slip[w, k]
                st.energy[w, k, 0] = st.next_energy[w, k, 0]
                st.energy[w, k, 1] = st.next_energy[w, k, 1]
            elif time < last:
                st.stretch[w, i] = 0.0
                st.slip[w, k] = 0.0
                st.energy[w, k, 0] = st.start_energy[w, k, 0]
                st.energy[w, k, 1] = st.start_energy[w, k, 1]
                st.status[w, i] = 0
            st.stretch[w, i] = finite(st.stretch[w, i])
            st.slip[w, k] = finite(st.slip[w, k])
            st.energy[w, k, 0] = finite_heat(st.energy[w, k, 0])
            st.energy[w, k, 1] = finite_heat(st.energy[w, k, 1])
            st.next_stretch[w, i] = st.stretch[w, i]
            st.next_slip[w, k] = st.slip[w, k]
            st.next_energy[w, k, 0] = st.energy[w, k, 0]
            st.next_energy[w, k, 1] = st.energy[w, k, 1]
    if wp.isfinite(time):
        st.time[w, tree] = time


@wp.kernel
def settle(time: wp.array(dtype=float), tree_begin: wp.array(dtype=int), tree_size: wp.array(dtype=int), h: float, j: Joints, st: States):
    """Brings the states to where the next step begins."""
    w, tree = wp.tid()
    begin(w, tree, tree_begin[tree], tree_size[tree], time[w], h, j, st)


@wp.kernel
def put(
    chosen: wp.array(dtype=bool),
    dofs: wp.array(dtype=int),
    stretch: wp.array2d(dtype=float),
    energy: wp.array3d(dtype=wp.float64),
    slip: wp.array2d(dtype=float),
    status: wp.array2d(dtype=int),
    turns: wp.array2d(dtype=int),
    st: States,
):
    """With what the next step of the chosen worlds begins, [worlds x J] threads; the time of their last computation is none."""
    w, k = wp.tid()
    if not chosen[w]:
        return
    i = dofs[k]
    st.stretch[w, i] = stretch[w, k]
    st.next_stretch[w, i] = stretch[w, k]
    st.slip[w, k] = slip[w, k]
    st.next_slip[w, k] = slip[w, k]
    for stage in range(2):
        st.energy[w, k, stage] = energy[w, k, stage]
        st.next_energy[w, k, stage] = energy[w, k, stage]
    st.total[w, k] = energy[w, k, 0] + energy[w, k, 1]
    st.status[w, i] = status[w, k]
    for tree in range(st.time.shape[1]):
        st.time[w, tree] = -wp.inf
        st.turns[w, tree] = turns[w, tree]


@wp.kernel
def take(
    dofs: wp.array(dtype=int),
    per_load: wp.array(dtype=float),
    st: States,
    stretch: wp.array2d(dtype=float),
    load: wp.array2d(dtype=float),
    status: wp.array2d(dtype=int),
):
    """Of all degrees of freedom those with friction, [worlds x J] threads. per_load: h^2 / (A m) [J]."""
    w, k = wp.tid()
    stretch[w, k] = st.stretch[w, dofs[k]]
    load[w, k] = st.stretch[w, dofs[k]] / per_load[k]
    status[w, k] = st.status[w, dofs[k]]


@wp.func
def finish(w: int, i: int, k: int, v: float, kv: float, f: float, own: float, status: int, j: Joints, st: States):
    """Force, loss and heat of one joint. own: the level on the side of its motion, N.m or N. A speed or a load that is no finite number acts
    with no force, and leaves the state as it was. Returns nothing."""
    row = w % j.law.shape[0]
    heat = w % j.heat.shape[0]
    energy = float(st.energy[w, k, 0] + st.energy[w, k, 1])
    viscous = wp.max(0.0, kv + j.law[row, k, PER_ENERGY] * energy) * v
    sliding = (status == 1 and v > 0.0) or (status == -1 and v < 0.0)
    force = viscous + f
    loss = viscous * v
    if sliding:
        loss += wp.abs(f * v)
    # a level below 0 takes from the viscous force, at most all of it
    if f == 0.0 and v != 0.0 and own < 0.0:
        force = wp.sign(v) * wp.max(0.0, wp.abs(force) + own)
        loss = wp.abs(force * v)
    st.held[w, k] = not sliding
    st.total[w, k] = st.energy[w, k, 0] + st.energy[w, k, 1]
    if not wp.isfinite(force + loss + st.next_stretch[w, i]):
        st.force[w, k] = 0.0
        st.loss[w, k] = 0.0
        st.next_stretch[w, i] = st.stretch[w, i]
        return
    st.force[w, k] = force
    st.loss[w, k] = loss
    st.next_slip[w, k] = wp.where(sliding, wp.sign(v), 0.0)
    lost = wp.float64(loss)
    st.next_energy[w, k, 0] = (
        j.heat[heat, k, POLE] * st.energy[w, k, 0] + j.heat[heat, k, GAIN] * lost + j.heat[heat, k, AMBIENT] * wp.float64(finite(st.ambient[w]))
    )
    st.next_energy[w, k, 1] = j.heat[heat, k, SECOND_POLE] * st.energy[w, k, 1] + j.heat[heat, k, SECOND_GAIN] * lost


@wp.kernel
def step_friction(
    time: wp.array(dtype=float),
    qpos: wp.array2d(dtype=float),
    qvel: wp.array2d(dtype=float),
    mass: wp.array2d(dtype=float),
    bias: wp.array2d(dtype=float),
    row_count: wp.array(dtype=int),
    row_begin: wp.array(dtype=int),
    column: wp.array(dtype=int),
    tree_begin: wp.array(dtype=int),
    tree_size: wp.array(dtype=int),
    dof_damping: wp.array2d(dtype=float),
    h: float,
    most: int,
    j: Joints,
    st: States,
    s: Scratch,
    passive: wp.array2d(dtype=float),
):
    w, tree = wp.tid()
    i0 = tree_begin[tree]
    n = tree_size[tree]
    begin(w, tree, i0, n, time[w], h, j, st)
    t = Tree()
    t.first = i0
    t.size = n
    t.row_begin = row_begin
    t.row_count = row_count
    t.column = column
    t.mass = mass[w]
    t.factor = s.factor[w]
    t.taken = s.taken[w]
    t.status = st.status[w]
    t.lower = s.lower[w]
    t.upper = s.upper[w]
    t.base = s.base[w]
    t.aim = s.aim[w]
    t.result = s.result[w]
    t.force = s.force[w]
    t.sum = s.sum[w]
    # levels, and by how much the springs of the bristles accelerate their joints
    for a in range(n):
        i = i0 + a
        k = j.of_dof[i]
        t.lower[i] = 0.0
        t.upper[i] = 0.0
        t.base[i] = 0.0
        t.aim[i] = 0.0
        t.taken[i] = -1
        if k >= 0:
            energy = float(st.energy[w, k, 0] + st.energy[w, k, 1])
            position = qpos[w, j.position[k]]
            t.upper[i] = wp.max(0.0, level_at(j, w, k, 1.0, qvel[w, i], st.slip[w, k], energy, position, bias[w, i]))
            t.lower[i] = wp.max(0.0, level_at(j, w, k, -1.0, qvel[w, i], st.slip[w, k], energy, position, bias[w, i]))
            t.aim[i] = j.shape[k, STIFFNESS] / (h * h) * (st.stretch[w, i] + h * qvel[w, i])
        if t.upper[i] == 0.0 and t.lower[i] == 0.0:
            t.status[i] = 2
        elif t.status[i] == 2 or float(t.status[i]) * qvel[w, i] < 0.0:
            # also what turned round holds at first
            t.status[i] = 0
    turns = nearest(t, most)
    # the dampers join, and their search begins with the set of the springs', which is near
    for a in range(n):
        i = i0 + a
        k = j.of_dof[i]
        t.base[i] = t.force[i]
        if k >= 0:
            # what holds keeps all digits
            st.next_stretch[w, i] = st.stretch[w, i] + h * qvel[w, i]
            if t.status[i] != 0:
                st.next_stretch[w, i] = h * h / j.shape[k, STIFFNESS] * t.result[i]
            t.aim[i] = j.shape[k, DAMPING] / h * qvel[w, i]
        if t.status[i] == 0:
            t.upper[i] = 2.0 * t.upper[i]
            t.lower[i] = 2.0 * t.lower[i]
        s.status[w, i] = t.status[i]
    t.status = s.status[w]
    st.turns[w, tree] = wp.max(turns, nearest(t, most))
    for a in range(n):
        i = i0 + a
        k = j.of_dof[i]
        if k >= 0:
            v = qvel[w, i]
            own = float(0.0)
            if t.force[i] == 0.0 and v != 0.0:
                energy = float(st.energy[w, k, 0] + st.energy[w, k, 1])
                own = level_at(j, w, k, wp.sign(v), v, st.slip[w, k], energy, qpos[w, j.position[k]], bias[w, i])
            kv = dof_damping[w % dof_damping.shape[0], i]
            finish(w, i, k, v, kv, t.force[i], own, st.status[w, i], j, st)
            # the engine adds the joint's damping itself
            passive[w, i] = passive[w, i] + finite(kv * v) - st.force[w, k]

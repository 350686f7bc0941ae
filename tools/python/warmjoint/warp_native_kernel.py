"""The kernel of warmjoint.warp_native: one thread drives the spring of one joint of one world."""

import warp as wp

# columns of `numbers`: k, level of sliding, its rise at rest with speed and exponent; of `heat`: what stays and what a loss adds
STIFFNESS, LEVEL, RISE, VELOCITY, EXPONENT = range(5)
POLE, GAIN, SECOND_POLE, SECOND_GAIN = range(4)


@wp.kernel
def drive(
    time: wp.array(dtype=float),
    qpos: wp.array2d(dtype=float),
    qvel: wp.array2d(dtype=float),
    damping: wp.array2d(dtype=float),
    places: wp.array2d(dtype=int),
    numbers: wp.array2d(dtype=float),
    heat: wp.array2d(dtype=wp.float64),
    start: wp.array3d(dtype=wp.float64),
    last: wp.array2d(dtype=float),
    energy: wp.array3d(dtype=wp.float64),
    plastic: wp.array2d(dtype=float),
    yields: wp.array2d(dtype=float),
):
    """[worlds x joints] threads. places: [joints x 4] of the joint in the model, in qpos, qvel and plastic."""
    w, k = wp.tid()
    joint = places[k, 0]
    q = qpos[w, places[k, 1]]
    dof = places[k, 2]
    v = qvel[w, dof]
    most = yields[w, joint]
    stretch = q - plastic[w, places[k, 3]]
    # a difference of angles in single precision
    slides = wp.abs(stretch) >= most - 2.4e-7 * wp.max(1.0, wp.abs(q)) and stretch * v > 0.0
    lost = damping[w % damping.shape[0], dof] * v * v
    if slides:
        lost += numbers[k, STIFFNESS] * most * wp.abs(v)
    if not wp.isfinite(lost):
        lost = 0.0
    for stage in range(2):
        if not wp.isfinite(energy[w, k, stage]):
            energy[w, k, stage] = wp.float64(0.0)
    if time[w] < last[w, k]:
        energy[w, k, 0] = start[w, k, 0]
        energy[w, k, 1] = start[w, k, 1]
    else:
        energy[w, k, 0] = heat[k, POLE] * energy[w, k, 0] + heat[k, GAIN] * wp.float64(lost)
        energy[w, k, 1] = heat[k, SECOND_POLE] * energy[w, k, 1] + heat[k, SECOND_GAIN] * wp.float64(lost)
    if wp.isfinite(time[w]):
        last[w, k] = time[w]
    level = numbers[k, LEVEL] + float(energy[w, k, 0] + energy[w, k, 1])
    if numbers[k, RISE] != 0.0 and wp.isfinite(v):
        level += numbers[k, RISE] * wp.exp(-wp.pow(wp.abs(v) / numbers[k, VELOCITY], numbers[k, EXPONENT]))
    yields[w, joint] = wp.max(0.0, level) / numbers[k, STIFFNESS]
    # a pose that was set anew begins with a relaxed spring; one that is no finite number leaves none behind
    if not wp.abs(stretch) <= 2.0 * most + 2.4e-7 * wp.max(1.0, wp.abs(q)):
        plastic[w, places[k, 3]] = wp.where(wp.isfinite(q), q, 0.0)

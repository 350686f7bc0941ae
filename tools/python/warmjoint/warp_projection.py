"""What of a kinematic tree holds and what slips, for warmjoint.warp: the force nearest to what the bristles press with, within the levels, in the measure
of M^-1. One thread does it for one tree of one world."""

import warp as wp


@wp.struct
class Tree:
    """A kinematic tree of one world, [nv] each. M stands in sparse rows, each the row of its parent and one number more, the diagonal."""

    first: int
    size: int
    row_begin: wp.array(dtype=int)
    row_count: wp.array(dtype=int)
    column: wp.array(dtype=int)  # [nM]
    mass: wp.array(dtype=float)  # [nM]
    factor: wp.array(dtype=float)  # [nM] L' D L of what is taken, as M; of D its inverse
    taken: wp.array(dtype=int)  # whether it slips; -1 where there is no factor yet
    status: wp.array(dtype=int)  # 1 and -1 slip at a bound, 0 holds, 2 has no friction
    lower: wp.array(dtype=float)
    upper: wp.array(dtype=float)
    base: wp.array(dtype=float)  # a force that is there already, N.m or N
    aim: wp.array(dtype=float)  # rad/s^2 or m/s^2
    result: wp.array(dtype=float)
    force: wp.array(dtype=float)
    sum: wp.array(dtype=wp.float64)


@wp.func
def add_product(t: Tree):
    """Adds M result to the sum, in double precision: what is held is the difference of large terms."""
    for a in range(t.size):
        i = t.first + a
        begin = t.row_begin[i]
        last = begin + t.row_count[i] - 1
        x = wp.float64(t.result[i])
        y = t.sum[i] + wp.float64(t.mass[last]) * x
        for e in range(begin, last):
            c = t.column[e]
            m = wp.float64(t.mass[e])
            y += m * wp.float64(t.result[c])
            t.sum[c] = t.sum[c] + m * x
        t.sum[i] = y


@wp.func
def factorise(t: Tree):
    """From the last to the first, so that nothing is filled in. Rows and columns of what is not taken are 0: what asks for it at each number costs more
    than it saves."""
    for a in range(t.size):
        i = t.first + a
        for e in range(t.row_begin[i], t.row_begin[i] + t.row_count[i]):
            t.factor[e] = wp.where(t.taken[i] != 0 and t.taken[t.column[e]] != 0, t.mass[e], 0.0)
    for b in range(t.size):
        i = t.first + t.size - 1 - b
        begin = t.row_begin[i]
        last = begin + t.row_count[i] - 1
        if t.taken[i] != 0:
            inverse = 1.0 / wp.max(t.factor[last], 1.0e-30)
            for e in range(begin, last):
                c = t.column[e]
                share = t.factor[e] * inverse
                above = t.row_begin[c] - begin
                for g in range(begin, begin + t.row_count[c]):
                    t.factor[above + g] = t.factor[above + g] - share * t.factor[g]
            for e in range(begin, last):
                t.factor[e] = t.factor[e] * inverse
            t.factor[last] = inverse


@wp.func
def solve(t: Tree, x: wp.array(dtype=float)):
    """What is taken, in place of its right side; the rest is 0 before and after."""
    for b in range(t.size):
        i = t.first + t.size - 1 - b
        begin = t.row_begin[i]
        last = begin + t.row_count[i] - 1
        y = x[i]
        for e in range(begin, last):
            c = t.column[e]
            x[c] = x[c] - t.factor[e] * y
        x[i] = y * t.factor[last]
    for a in range(t.size):
        i = t.first + a
        begin = t.row_begin[i]
        y = x[i]
        for e in range(begin, begin + t.row_count[i] - 1):
            y -= t.factor[e] * x[t.column[e]]
        x[i] = y


@wp.func
def bound_of(t: Tree, i: int) -> float:
    """The force of what slips."""
    if t.status[i] == 1:
        return t.upper[i]
    if t.status[i] == -1:
        return -t.lower[i]
    return 0.0


@wp.func
def nearest(t: Tree, most: int) -> int:
    """Projects the force base + M aim onto the box, from the status and with what that ends with. What holds is accelerated by its aim, and what slips by
    as much as its bound allows, so that large aims of what slips are in no sum. Leaves force and result, with force = base + M result. The number of
    turns."""
    turns = int(0)
    done = int(0)
    while done == 0:
        turns += 1
        # what slips, and whether the factor is of another set
        other = int(0)
        for a in range(t.size):
            i = t.first + a
            slips = wp.where(t.status[i] != 0, 1, 0)
            if slips != t.taken[i]:
                t.taken[i] = slips
                other = 1
            t.result[i] = wp.where(slips != 0, 0.0, t.aim[i])
            t.sum[i] = wp.float64(t.base[i])
        if other != 0:
            factorise(t)
        # M of what slips, times its result, is the bounds less what the others press it by
        add_product(t)
        for a in range(t.size):
            i = t.first + a
            t.result[i] = wp.where(t.taken[i] != 0, bound_of(t, i) - float(t.sum[i]), 0.0)
        solve(t, t.result)
        add_product(t)
        # forces of what holds, and whose status was wrong
        done = int(1)
        for a in range(t.size):
            i = t.first + a
            status = t.status[i]
            better = status
            if status == 0:
                x = float(t.sum[i])
                t.force[i] = wp.clamp(x, -t.lower[i], t.upper[i])
                t.result[i] = t.aim[i]
                # single precision is worth that much
                room = 1.0e-6 * (t.upper[i] + t.lower[i])
                if x > t.upper[i] + room:
                    better = 1
                elif -x > t.lower[i] + room:
                    better = -1
            else:
                t.force[i] = bound_of(t, i)
                if status != 2 and float(status) * (t.aim[i] - t.result[i]) < 0.0:
                    better = 0
            if better != status and turns < most:
                t.status[i] = better
                done = 0
    return turns

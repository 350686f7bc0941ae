"""Training: 64 worlds as an environment of gymnasium, whose friction each episode draws anew. Run it in the project's folder."""

import gymnasium as gym
import mujoco
import numpy as np
import warmjoint as wj
from mujoco import batch


class Turn(gym.vector.VectorEnv):
    """Turn a joint by its motor. Observed: angle to go, rad, and speed, rad/s; action: torque, N.m. Episodes take 1 s."""

    def __init__(self, worlds=64):
        robot = wj.attach("models/robots/rotary/rotary.xml", {"hinge": "models/robots/rotary/friction.json"})
        model = robot.spec.compile()
        self.friction, self.worlds = robot.bind(model, mujoco.MjData(model)), batch.Batch(model, worlds)
        self.num_envs, self.action_space = worlds, gym.spaces.Box(-130, 130, (worlds, 1), np.float64)
        self.observation_space = gym.spaces.Box(-np.inf, np.inf, (worlds, 2), np.float64)

    def reset(self, *, seed=None, options=None):
        super().reset(seed=seed)
        self.worlds.reset()
        self.friction.randomise(self.worlds, coulomb=(0.7, 1.3), warm=(0, 1), speed=0.5, rng=self.np_random)
        self.goal = self.np_random.uniform(-1, 1, (self.num_envs, 1))
        return np.hstack((self.goal, self.worlds.qvel)), {}

    def step(self, actions):
        self.worlds.ctrl = actions
        self.worlds.step(nstep=10)
        to_go = self.goal - self.worlds.qpos
        ended = np.full(self.num_envs, self.worlds.time[0] > 0.995)
        return np.hstack((to_go, self.worlds.qvel)), -np.abs(to_go[:, 0]), np.zeros_like(ended), ended, {}


if __name__ == "__main__":
    env = Turn()
    seen, _ = env.reset(seed=0)
    for _ in range(100):
        seen, *_ = env.step(100 * seen[:, :1] - 10 * seen[:, 1:])  # here acts the policy that learns
    print(f"angle to go after 1 s: {np.abs(seen[:, 0]).mean():.3f} rad in the mean, {np.abs(seen[:, 0]).max():.3f} at most")

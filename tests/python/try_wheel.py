"""What a wheel does on its own: a joint is simulated, identified and attached."""

import warmjoint as wj

made = wj.simulate({"plant": "mujoco", "robot": "rotary", "joint": "hinge",
                    "friction": {"law": "viscous_coulomb", "parameters": {"viscous": 5, "coulomb": 15}},
                    "motion": {"speeds": {"uniform": [0.1, 1]}, "hold": 20, "order": "alternating"}, "noise": {"torque": 0.5},
                    "sampling": {"rate": 20, "sensor_rate": 250, "cutoff": 8}, "duration": 600})
arm = '<mujoco><worldbody><body><joint name="elbow"/><geom size="0.1" pos="1 0 0"/></body></worldbody></mujoco>'
print("status of a simulated log:", wj.identify(made.log, "nominal-ls").raise_if_rejected().status)
wj.attach(arm, {"elbow": wj.Friction("coulomb", coulomb=2)}).spec.compile()

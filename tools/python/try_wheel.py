"""What a wheel does on its own: a joint is simulated, identified and attached."""

import warmjoint as wj

made = wj.simulate({"plant": "mujoco", "robot": "rotary", "joint": "hinge", "friction": {"law": "coulomb", "parameters": {"coulomb": 2}},
                    "motion": {"speeds": [0.5, 1], "hold": 5}, "duration": 60})
arm = '<mujoco><worldbody><body><joint name="elbow"/><geom size="0.1" pos="1 0 0"/></body></worldbody></mujoco>'
print("status of a simulated log:", wj.identify(made.log, "nominal-ls").raise_if_rejected().status)
wj.attach(arm, {"elbow": wj.Friction("coulomb", coulomb=2)}).spec.compile()

"""Inputs of the table that are made here, each by the few lines that a report of it would have."""

import numpy as np


def write_csv(path, **columns):
    """A recording, one column a name."""
    np.savetxt(path, np.column_stack(list(columns.values())), delimiter=",", comments="", fmt="%.9g",
               header=",".join(columns))


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

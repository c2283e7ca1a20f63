"""Hitch.fmu in MuJoCo, which has the rest: car, trailer, wheels and road (mujoco_hitch.xml). Figure 8's step brake.

Once with tyres whose force follows the slip, as the paper's does, once with MuJoCo's own contact. Its tyres hardly
slip, so the trailer's brakes answer sooner and the oscillation fades faster; CarTrailer.fmu with tyres a hundred times
as stiff does the same. Largest compression and frequency are within 0.5 % and 0.1 % of CarTrailer.fmu's at steps of 1
and 5 ms, or the exit status is 1.

Figure and film are in build/mujoco. Without a screen MUJOCO_GL=egl or osmesa makes the film.
"""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import matplotlib as mpl
import mujoco
import numpy as np
from fmpy import extract, read_model_description, simulate_fmu
from fmpy.fmi2 import FMU2Slave
from matplotlib.figure import Figure
from PIL import Image

from overrun_hitch.measure.oscillation import measure
from overrun_hitch.show.traces import CAR, STYLE, TRAILER, save

BRAKE_TORQUE, DURATION = 1000.0, 6.0  # N.m on the car's two axles together, s
STEPS = (0.001, 0.005)  # s
C_K, R = 200e3, 0.35  # N per unit slip, each axle; m
TYRES = {"slip": 1.0, "contact": 100.0}  # slip stiffness of CarTrailer.fmu's tyres that are as these, over figure 8's
PEAK, FREQUENCY = 0.005, 0.001  # farthest from CarTrailer.fmu, relative
NAMES = ("a_car", "a_trailer", "compression", "slip_car", "slip_trailer")
FRAME = 0.04  # s
Traces = dict[str, np.ndarray]


class Hitch:
    """The unit, with names instead of value references."""

    def __init__(self, fmu: str, **start: float) -> None:
        description = read_model_description(fmu)
        identifier = description.coSimulation.modelIdentifier
        self.references = {variable.name: variable.valueReference for variable in description.modelVariables}
        self.folder = tempfile.TemporaryDirectory()
        extract(fmu, self.folder.name)
        self.slave = FMU2Slave(guid=description.guid, unzipDirectory=self.folder.name, modelIdentifier=identifier)
        self.slave.instantiate()
        self.set(**start)
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()

    def set(self, **values: float) -> None:
        """Set by name."""
        self.slave.setReal([self.references[name] for name in values], list(values.values()))

    def get(self, *names: str) -> list[float]:
        """Get by name."""
        return list(self.slave.getReal([self.references[name] for name in names]))

    def free(self) -> None:
        """End it, and delete what was unpacked."""
        self.slave.terminate()
        self.slave.freeInstance()
        self.folder.cleanup()


def brake(model: mujoco.MjModel, fmu: str, tyres: str, step: float) -> tuple[Traces, np.ndarray]:
    """Traces of a run in MuJoCo, and its positions (n, nq)."""
    model.opt.timestep = step
    model.geom_condim[:] = 1 if tyres == "slip" else 3  # 1: the road carries, without friction
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, 0)
    car, drawbar = data.joint("car"), data.joint("drawbar")
    wheels = [model.joint(axle).dofadr[0] for axle in ("front", "rear", "trailer axle")]
    M_rear = model.body("trailer").subtreemass[0]
    M_front = model.body("car").subtreemass[0] - M_rear
    I_axle = model.body("front").inertia[1]
    masses = {"M_front": M_front + 2.0 * I_axle / R**2, "M_rear": M_rear + I_axle / R**2}
    hitch = Hitch(fmu, v_car=car.qvel[0], v_trailer=car.qvel[0], **masses)
    rows, positions = [], []
    for n in range(round(DURATION / step)):
        v_car, v_trailer = car.qvel[0], car.qvel[0] + drawbar.qvel[0]
        positions.append(data.qpos.copy())
        compression = drawbar.qpos[0]
        # Both make the step at once: each with what the other had at its beginning.
        force, torque = hitch.get("F_hitch_hold", "trailer_brake_torque_hold")
        hitch.set(v_car=v_car, v_trailer=v_trailer)
        hitch.slave.doStep(n * step, step)
        data.ctrl[:] = force
        model.dof_frictionloss[wheels] = BRAKE_TORQUE / 2.0, BRAKE_TORQUE / 2.0, torque
        model.tendon_damping[:] = C_K / np.array([v_car, v_car, v_trailer]) if tyres == "slip" else 0.0
        mujoco.mj_step(model, data)
        # What MuJoCo derives is that of the beginning of the step. A tendon's speed is the slip speed of an axle.
        a_car, (front, _, rear) = car.qacc[0], data.ten_velocity
        rows.append((n * step, a_car, a_car + drawbar.qacc[0], compression, front / v_car, rear / v_trailer))
    hitch.free()
    return dict(zip(("time", *NAMES), np.array(rows).T, strict=True)), np.array(positions)


def car_trailer(fmu: str, tyres: str) -> Traces:
    """The same run of CarTrailer.fmu."""
    start = {"brake_torque": BRAKE_TORQUE, "C_kc": 2.0 * C_K * TYRES[tyres], "C_kt": C_K * TYRES[tyres]}
    run = simulate_fmu(fmu, stop_time=DURATION, output_interval=0.001, start_values=start, output=NAMES)
    return {name: run[name] for name in run.dtype.names}


def show(title: str, run: Traces) -> tuple[float, float]:
    """A line for a run: largest compression (m) and frequency (Hz), which it returns, and growth rate."""
    found, peak = measure(run["time"], run["compression"]), run["compression"].max()
    print(f"{title}: {peak:.5f} m, {found.frequency:.4f} Hz, {found.growth_rate:.4f} 1/s")
    return peak, found.frequency


def draw(runs: dict[str, tuple[Traces, Traces]]) -> Figure:
    """The panels of the paper's figures for each kind of tyre; CarTrailer.fmu's traces are broad, grey, below."""
    with mpl.rc_context(STYLE):
        figure = Figure(figsize=(9.6, 6.6), layout="constrained")
        panels = figure.subplots(3, len(runs), sharex=True, sharey="row")
        for column, (tyres, (mujoco_run, reference)) in zip(panels.T, runs.items(), strict=True):
            column[0].set_title(f"tyres by {tyres}", fontsize=10)
            for axes, names, scale in zip(column, (NAMES[:2], NAMES[2:3], NAMES[3:]), (1.0, 1.0, 100.0), strict=True):
                for name, line in zip(names, (CAR, TRAILER), strict=False):
                    axes.plot(reference["time"], scale * reference[name], color="#cccccc", linewidth=4.0)
                    axes.plot(mujoco_run["time"], scale * mujoco_run[name], **line)
            column[-1].set_xlabel("Time (s)")
            column[-1].set_xlim(0.0, DURATION)
        for axes, label in zip(panels[:, 0], ("Acceleration (m/s²)", "Compression (m)", "Slip (%)"), strict=True):
            axes.set_ylabel(label)
        reference_line, car_line, _, trailer_line = panels[0, 0].lines
        lines = {"CarTrailer.fmu": reference_line, "car in MuJoCo": car_line, "trailer in MuJoCo": trailer_line}
        figure.legend(lines.values(), lines.keys(), loc="outside upper right", ncols=3)
    return figure


def film(model: mujoco.MjModel, positions: np.ndarray, path: Path) -> None:
    """The run seen from the side, or a word why not."""
    data = mujoco.MjData(model)
    try:
        renderer = mujoco.Renderer(model, 300, 800)
    except Exception as error:  # each of its ways to draw fails in a way of its own
        print(f"no film: {error}")
        return
    pictures = []
    for data.qpos[:] in positions:
        mujoco.mj_forward(model, data)
        renderer.update_scene(data, camera="side")
        pictures.append(Image.fromarray(renderer.render()))
    renderer.close()
    pictures[0].save(path, save_all=True, append_images=pictures[1:], duration=1000.0 * FRAME)


hitch, whole = sys.argv[1:] or ["build/fmi2/Hitch.fmu", "build/fmi2/CarTrailer.fmu"]
out = Path("build/mujoco")
model = mujoco.MjModel.from_xml_path(str(Path(__file__).with_suffix(".xml")))
runs, apart = {}, np.zeros(2)
for tyres in TYRES:
    reference = car_trailer(whole, tyres)
    expected = show(f"{tyres}, CarTrailer.fmu", reference)
    for step in STEPS:
        run, positions = brake(model, hitch, tyres, step)
        found = show(f"{tyres}, MuJoCo at {1000.0 * step:g} ms", run)
        apart = np.maximum(apart, np.abs(np.divide(found, expected) - 1.0))
    runs[tyres] = run, reference
print(f"apart: {apart[0]:.2%} in compression, {apart[1]:.2%} in frequency")
save(draw(runs), out / "hitch")
film(model, positions[:: round(FRAME / step)], out / "hitch.gif")
sys.exit(int(apart[0] > PEAK or apart[1] > FREQUENCY))

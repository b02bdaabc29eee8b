import contextlib
import io
import math

import planar_impact

with contextlib.redirect_stdout(io.StringIO()):
    from pycrash.model_calcs.carpenter_momentum import IMPC
    from pycrash.vehicle import Vehicle

# pycrash: lb, lb-ft-s^2, mph and deg/s; y to the right of the driver and angles clockwise; the impact center from the center of mass.
STRIKING = {"weight": 3200, "izz": 1850, "head_angle": 0, "vx_initial": 40, "vy_initial": 0, "omega_z": 0}
STRUCK = {"weight": 2900, "izz": 1600, "head_angle": -110, "vx_initial": 25, "vy_initial": 0, "omega_z": 0}
CENTERS = [(6.2, 0.4), (1.3, -2.6)]
PLANE = 10  # deg clockwise from the front of vehicle 1
RESTITUTION, FRICTION = 0.2, 0.6


def with_pycrash() -> list[dict[str, float]]:
    def turned(heading: float, x: float, y: float) -> tuple[float, float]:
        c, s = math.cos(math.radians(heading)), math.sin(math.radians(heading))
        return c * x - s * y, s * x + c * y

    # pycrash finds the impact center of vehicle 2 from where both vehicles are.
    one, two = (turned(vehicle["head_angle"], *center) for vehicle, center in zip((STRIKING, STRUCK), CENTERS))
    x, y = one[0] - two[0], one[1] - two[1]
    striking = {**STRIKING, "pimpact_x": CENTERS[0][0], "pimpact_y": CENTERS[0][1], "init_x_pos": 0, "init_y_pos": 0}
    struck = {**STRUCK, "init_x_pos": x, "init_y_pos": y}
    with contextlib.redirect_stdout(io.StringIO()):
        inputs = {"cor": RESTITUTION, "cof": FRICTION, "impact_norm_deg": PLANE}
        impact = IMPC("case", Vehicle("striking", striking), Vehicle("struck", struck), inputs)
    return [impact.v1_result, impact.v2_result]


def case(**contact: object) -> dict[str, object]:
    """The same collision as a case of planar-impact: y to the left and angles counter-clockwise, so both change sign."""

    def vehicle(given: dict[str, float], center: tuple[float, float]) -> dict[str, object]:
        return {
            "weight": f"{given['weight']} lbf",
            "yaw_inertia": f"{given['izz']} lbf s^2 ft",
            "heading": f"{-given['head_angle']} deg",
            "speed": f"{given['vx_initial']} mph",
            "yaw_rate": f"{-given['omega_z']} deg/s",
            "impact_center": [f"{center[0]} ft", f"{-center[1]} ft"],
        }

    vehicles = [vehicle(STRIKING, CENTERS[0]), vehicle(STRUCK, CENTERS[1])]
    plane = f"{-(STRIKING['head_angle'] + PLANE)} deg"
    # pycrash takes g = 32.2 ft/s^2.
    contact = {"crush_plane": plane, "restitution": RESTITUTION, **contact}
    return {"schema": 1, "gravity": "32.2 ft/s^2", "vehicle": vehicles, "contact": contact}


def row(name: str, delta_v: list[float], yaw_rate: list[float]) -> None:
    print(f"{name:45}" + "".join(f"{number:10.3f}" for number in (*delta_v, *yaw_rate)))


def main() -> None:
    print(f"{'':45}{'ΔV 1, 2 / mph':>20}{'yaw rate 1, 2 after / deg/s':>30}")
    theirs = with_pycrash()
    row("pycrash", [v["dv"] for v in theirs], [-v["oz_deg"] for v in theirs])
    laws: dict[str, dict[str, object]] = {
        "planar-impact, kudlich-slibar, friction 0.6": {"tangential_law": "kudlich-slibar", "friction": FRICTION},
        "planar-impact, brach, critical": {},
    }
    for name, contact in laws.items():
        ours = planar_impact.solve(case(**contact)).vehicles
        row(name, [v.delta_v_magnitude / 0.44704 for v in ours], [math.degrees(v.yaw_rate) for v in ours])


if __name__ == "__main__":
    main()
